"""Where the time of a large film goes: `python -m benchmarks.film [--view NAME] [--seconds N]`.

A loop of 1920 x 1080 pixels and 30 frames/s is drawn, then drawn and written, then made by the
command in a process of its own, which also holds the start of Python. Times are those of all cores.
"""

import argparse
import resource
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator
from pathlib import Path

import numpy as np

from benchmarks.quick import add_quick, is_installed
from drapery import Banner, Settings, iter_frames
from drapery.render import Frame, save_animation

DESIGN = "red creeper:lime"
FPS = 30


def drawn(settings: Settings, seconds: float) -> Iterator[Frame]:
    """The frames; the cloth moves when the first is asked for."""
    return iter_frames(Banner.parse(DESIGN), settings, seconds=seconds, fps=FPS)


def whole(settings: Settings, seconds: float, path: Path) -> float:
    """Processor time of the command [s]."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    size = "{}x{}".format(*settings.size)
    command = f"animate --view {settings.view} --size {size} --seconds {seconds} --fps {FPS}"
    start = [sys.executable, "-m", "drapery"]
    subprocess.run([*start, *command.split(), DESIGN, "-o", str(path)], check=True)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def main() -> None:
    """Measure and print."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--view", default="front")
    parser.add_argument("--seconds", type=float, default=10.0)
    add_quick(parser)
    given = parser.parse_args()
    size, seconds = ((64, 36), 0.5) if given.quick else ((1920, 1080), given.seconds)
    if not is_installed("av"):
        return
    settings = Settings(view=given.view, size=size)
    next(drawn(settings, 0.1))  # what is done once a process
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "film.mp4"
        times = [time.process_time()]
        frames = drawn(settings, seconds)
        next(frames)
        times.append(time.process_time())
        count = 1 + sum(1 for _ in frames)
        times.append(time.process_time())
        save_animation(drawn(settings, seconds), FPS, path)
        times.append(time.process_time())
        cloth, drawing, film = np.diff(times)
        rows = {
            "cloth and the first frame": cloth,
            "the other frames": drawing,
            "colours and encoder": film - drawing,  # the cloth's motion is known
            "the whole command": whole(settings, seconds, path),
        }
        print(
            f"{count} frames, view {given.view}, {path.stat().st_size / 1e6:.2f} MB: CPU time [s]"
        )
    for name, taken in rows.items():
        print(f"  {name:28} {taken:6.1f}")


if __name__ == "__main__":
    main()
