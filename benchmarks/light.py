"""What shadows, samples and ground cost: `python -m benchmarks.light [--before PYTHON] [--runs N]`.

Frames are drawn by our own rasteriser on one thread, in the time of the processor. `--before` names
the Python of an environment with an earlier commit; commands are then run by it and by this one in
turns, so that other work on the machine meets both, and the medians are compared.
"""

import argparse
import statistics
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

from drapery.banner import read_design
from drapery.packs import open_packs
from drapery.render.light import GAME_LIGHT
from drapery.render.scene import Scene
from drapery.render.soft import draw_scene
from drapery.scenes.stager import still
from drapery.settings import Settings

DESIGN = "white creeper:lime border:black"
COMMANDS = {
    "render": ("render", DESIGN, "-o", "banner.png"),
    "animate": ("animate", DESIGN, "-o", "banner.gif", "--seconds", "4", "--fps", "20"),
}


def milliseconds(work: Callable[[], object], runs: int) -> tuple[float, float]:
    """The least and the median processor time of some runs [ms], after one that is not counted."""
    work()
    times = []
    for _ in range(runs):
        start = time.process_time()
        work()
        times.append(1e3 * (time.process_time() - start))
    return min(times), statistics.median(times)


def frames(runs: int) -> None:
    """Print what one frame of the hero view costs in several ways."""
    settings = Settings(view="hero", grid=(33, 65), size=(512, 512))
    hero = still(read_design(DESIGN), open_packs(), settings)
    plain = replace(hero, light=GAME_LIGHT)
    scenes: dict[str, Scene] = {
        "game light, 1 sample": replace(plain, samples=1),
        "game light, 4 samples": plain,
        "shadows, 1 sample": replace(hero, samples=1),
        "shadows, 4 samples": hero,
    }
    print("hero, 512 x 512, cloth of 33 x 65, ground of grass, one thread: least and median [ms]")
    for name, scene in scenes.items():
        least, median = milliseconds(lambda drawn=scene: draw_scene(drawn, threads=1), runs)  # type: ignore[misc]
        print(f"  {name:24} {least:7.2f} {median:7.2f}")


def commands(before: str, runs: int) -> None:
    """Print how long commands take here and in the environment of another Python."""
    for name, words in COMMANDS.items():
        times: dict[str, list[float]] = {before: [], sys.executable: []}
        with tempfile.TemporaryDirectory() as folder:
            for run in range(runs + 1):
                for python, spent in times.items():
                    start = time.perf_counter()
                    command = [python, "-m", "drapery", *words]
                    subprocess.run(command, cwd=Path(folder), check=True, capture_output=True)
                    if run:
                        spent.append(time.perf_counter() - start)
        old, new = (statistics.median(spent) for spent in times.values())
        print(f"  {name:10} before {old:6.2f} s, now {new:6.2f} s: {new / old:.2f} x")


def main() -> None:
    """Measure and print."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--before", help="the Python of an environment with an earlier commit")
    parser.add_argument("--runs", type=int, default=15)
    given = parser.parse_args()
    frames(given.runs)
    if given.before:
        commands(given.before, given.runs)


if __name__ == "__main__":
    main()
