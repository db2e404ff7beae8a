"""What styles cost: `python -m benchmarks.styles [--size 512] [--runs 30] [--crowd]`.

Each picture step of each preset is timed on one thread, on a square picture with one sample a
pixel, whose buffers are made already. A picture with more samples takes that many times longer.
With `--crowd`, the cube of 4913 banners is simulated and drawn on all cores instead;
the time to the first frame, in which the cloth settles, does not count.
"""

import argparse
import time
from dataclasses import replace

from rich.console import Console
from rich.table import Table

from benchmarks.quick import add_quick
from drapery import Banner, Settings
from drapery.packs import open_packs
from drapery.render.soft import draw_buffers, draw_scene
from drapery.scenes import Clip, find_scene, scene_frames, still
from drapery.styles import Canvas, Style, find_style, style_names

BANNER = Banner.parse("white creeper:lime border:black")
GOAL = 1.0
"""The most that a step may take at 512 x 512 [ms]."""


def canvas_of(style: Style, size: int) -> Canvas:
    """The banner in a style before its picture steps."""
    settings = Settings(size=(size, size), samples=1, style=(style,))
    scene = still(BANNER, open_packs(()), settings)
    buffers = draw_buffers(scene, threads=1)
    return Canvas(draw_scene(scene, threads=1).pixels, lambda: buffers)


def step_times(style: Style, size: int, runs: int) -> list[tuple[str, float]]:
    """The name of each picture step, and the least time that it took [ms]."""
    canvas, found = canvas_of(style, size), []
    for step in style.steps:
        if step.kind != "picture":
            continue
        times: list[float] = []
        for _ in range(runs + 1):
            given = replace(canvas)
            _ = given.buffers
            begin = time.perf_counter()
            result = step.apply([given])[0] if step.over_time else step.apply(given)
            times.append(time.perf_counter() - begin)
        canvas = result
        found.append((step.name, min(times[1:]) * 1e3))  # the first run compiles
    return found


def crowd_times(style: str, count: int) -> tuple[float, float]:
    """What a frame of the crowd of 4913 takes, simulated and drawn at 512 x 512 in a style [s].

    Wall clock, and the sum over all cores.
    """
    scene = find_scene("stress")
    given = scene.parameters({"settle": "0.5"})
    times = []
    for frames in (1, 1, 1 + count):  # the first run compiles
        begin = time.perf_counter(), time.process_time()
        drawn = scene_frames(scene, given, Clip((512, 512), frames), "soft", style=style)
        assert len([*drawn]) == frames
        times.append((time.perf_counter() - begin[0], time.process_time() - begin[1]))
    (_, short, long) = times
    return (long[0] - short[0]) / count, (long[1] - short[1]) / count


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--size", type=int, default=512, help="width and height [pixels]")
    parser.add_argument("--runs", type=int, default=30)
    parser.add_argument("--crowd", action="store_true", help="the crowd of 4913 instead")
    add_quick(parser)
    given = parser.parse_args()
    if given.quick:
        given.size, given.runs = 64, 1
    if given.crowd:
        for style in ("game", "pixel-art"):
            wall, busy = crowd_times(style, given.runs)
            rate = f"{1 / wall:.1f} frames/s, {1e3 * busy:.0f} ms of all cores a frame"
            print(f"4913 banners in {style}: {rate}")
        return
    table = Table("style", "step", f"ms at {given.size} x {given.size}")
    for name in style_names():
        for step, taken in step_times(find_style(name), given.size, given.runs):
            mark = "" if taken <= GOAL else f", over {GOAL:g}"
            table.add_row(name, step, f"{taken:.2f}{mark}")
    Console().print(table)


if __name__ == "__main__":
    main()
