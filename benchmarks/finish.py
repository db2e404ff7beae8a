"""What the finish of fabrics costs: `python -m benchmarks.finish [--runs N] [--sheet FILE]`.

A picture is what `draw` makes: the cloth moves for three seconds and is drawn. The drawing alone is
that of a frame of a loop. Times are those of the processor, the least of some runs that take turns
with plain ones.
"""

import argparse
import time
from collections.abc import Callable
from itertools import count
from pathlib import Path
from typing import Literal

from benchmarks.quick import add_quick
from drapery import Banner, draw
from drapery.cloth import FABRICS
from drapery.packs import open_packs
from drapery.render import Frame
from drapery.render.contact import contact_table
from drapery.render.soft import draw_scene
from drapery.scenes import still
from drapery.settings import Settings

DESIGN = "white rhombus:red stripe_bottom:light_blue"
SIZES = (128, 256, 512, 1024)
FINISHES: tuple[Literal["plain", "fabric"], ...] = ("plain", "fabric")


def least(works: list[Callable[[], object]], runs: int) -> list[float]:
    """The least processor time of each work [ms]; they take turns, and the first is not counted."""
    times: list[list[float]] = [[] for _ in works]
    for _ in range(runs + 1):
        for work, taken in zip(works, times, strict=True):
            start = time.process_time()
            work()
            taken.append(1e3 * (time.process_time() - start))
    return [min(taken[1:]) for taken in times]


def pictures(fabric: str, side: int) -> list[Callable[[], object]]:
    """Draw a banner in the hero view, each time in other gusts, with either finish."""
    design, seed = Banner.parse(DESIGN), count()

    def drawn(finish: Literal["plain", "fabric"]) -> Callable[[], object]:
        return lambda: draw(
            design,
            Settings(view="hero", size=(side, side), fabric=fabric, finish=finish, seed=next(seed)),
        )

    return [drawn(finish) for finish in FINISHES]


def frames(fabric: str, side: int) -> list[Callable[[], object]]:
    """Draw one scene on one thread with either finish."""
    design, packs = Banner.parse(DESIGN), open_packs()
    scenes = [
        still(design, packs, Settings(view="hero", size=(side, side), fabric=fabric, finish=finish))
        for finish in FINISHES
    ]
    return [lambda scene=scene: draw_scene(scene, threads=1) for scene in scenes]  # type: ignore[misc]


def sheet(side: int) -> Frame:
    """All fabrics in the hero view at a height [pixels]."""
    drawn = [
        draw(
            Banner.parse(DESIGN),
            Settings(view="hero", size=(side * 3 // 4, side), fabric=fabric, background="#b8c4d0"),
        ).pixels
        for fabric in FABRICS
    ]
    return contact_table(tuple(FABRICS), (f"{side} pixels",), drawn)


def main() -> None:
    """Measure and print."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--runs", type=int, default=10)
    parser.add_argument("--sheet", type=Path, help="only draw all fabrics to this file")
    parser.add_argument("--side", type=int, default=256, help="height of a picture of the sheet")
    add_quick(parser)
    options = parser.parse_args()
    if options.sheet:
        sheet(options.side).save(options.sheet)
        return
    quick = options.quick
    fabrics, sizes, runs = ([*FABRICS][:1], (64,), 1) if quick else (FABRICS, SIZES, options.runs)
    print("hero view: plain [ms], with its finish [ms], ratio; of a picture, of its drawing alone")
    for side in sizes:
        for fabric in fabrics:
            row = [f"  {side:4} {fabric:8}"]
            for works in (pictures(fabric, side), frames(fabric, side)):
                plain, finished = least(works, runs)
                row.append(f"{plain:7.1f} {finished:7.1f} {finished / plain:5.2f}")
            print("  ".join(row), flush=True)


if __name__ == "__main__":
    main()
