"""What shadows, samples and ground cost: `python -m benchmarks.light [--runs N]`.

Frames are drawn by our own rasteriser on one thread; the times are those of the processor.
`python -m benchmarks.commands` measures whole commands.
"""

import argparse
import statistics
import time
from collections.abc import Callable
from dataclasses import replace

from benchmarks.quick import add_quick
from drapery.banner import read_design
from drapery.packs import open_packs
from drapery.render.light import GAME_LIGHT
from drapery.render.scene import Scene
from drapery.render.soft import draw_scene
from drapery.scenes import still
from drapery.settings import Settings

DESIGN = "white creeper:lime border:black"


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


def main() -> None:
    """Measure and print."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--runs", type=int, default=15)
    add_quick(parser)
    given = parser.parse_args()
    frames(1 if given.quick else given.runs)


if __name__ == "__main__":
    main()
