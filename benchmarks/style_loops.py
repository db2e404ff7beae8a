"""What styles do to a design: `python -m benchmarks.style_loops [STYLE...] [--sizes 128 256]`.

For each style, or each that is named, and each size:

- off: how far the still pictures of some designs are from the plain ones, as the mean over red,
  green and blue of all pixels where both show something, and over the designs [levels];
- flicker: the share of such pixels in a loop of the first design which differ by more than FAR
  levels of brightness from the frames before and after, which are alike. Of poses that are held,
  frames that are so far apart.
"""

import argparse

import numpy as np
from numpy.typing import NDArray
from rich.console import Console
from rich.table import Table

from benchmarks.quick import add_quick
from drapery import Banner, Settings, animate, draw
from drapery.render import Pixels
from drapery.styles import find_style, style_names

DESIGNS = (
    "black skull:white border:red gradient_up:purple",
    "white creeper:lime border:black",
    "red rhombus:yellow",
    "orange bricks:brown border:black",
    "white flower:pink rhombus:lime border:green",
    "gray piglin:purple border:black",
)
FAR, NEAR = 48, 24
"""Levels by which a pixel that flickers differs at least, and the frames beside it at most."""
FPS = 20.0


def off(one: Pixels, other: Pixels) -> float:
    """The mean difference of two pictures where both show something [levels]."""
    both = (one[..., 3] > 0) & (other[..., 3] > 0)
    apart = np.abs(one.astype(int) - other.astype(int))[..., :3]
    return float(apart[both].mean())


def flicker(frames: list[Pixels], apart: int) -> float:
    """The share of pixels that differ from those `apart` frames before and after, which agree."""
    pixels = np.stack(frames)
    shown = pixels[..., 3] > 0
    bright: NDArray[np.float64] = pixels[..., :3] @ np.array([0.299, 0.587, 0.114])
    before, after = np.roll(bright, apart, axis=0), np.roll(bright, -apart, axis=0)
    all_shown = shown & np.roll(shown, apart, axis=0) & np.roll(shown, -apart, axis=0)
    leaves = np.minimum(np.abs(bright - before), np.abs(bright - after)) > FAR
    found = leaves & (np.abs(before - after) < NEAR) & all_shown
    return float(np.count_nonzero(found) / np.count_nonzero(all_shown))


def held(name: str) -> int:
    """For how many frames a style shows a pose."""
    steps = find_style(name).steps if name != "plain" else ()
    return max([1, *(dict(step.parameters)["every"] for step in steps if step.name == "hold")])


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("styles", nargs="*", default=["plain", *style_names()])
    parser.add_argument("--sizes", type=int, nargs="+", default=[128, 256], help="[pixels]")
    parser.add_argument("--seconds", type=float, default=2.0, help="length of the loop")
    add_quick(parser)
    given = parser.parse_args()
    if given.quick:
        given.sizes, given.seconds = [32], 0.3
    designs = [Banner.parse(each) for each in DESIGNS[: 1 if given.quick else None]]
    table = Table("style", "size", "off [levels]", "flicker")
    for size in given.sizes:
        settings = Settings(size=(size, size))
        plain = [draw(each, settings).pixels for each in designs]
        for name in given.styles:
            styled = settings if name == "plain" else settings.changed(style=(name,))
            drawn = [draw(each, styled).pixels for each in designs]
            loop = animate(designs[0], styled, seconds=given.seconds, fps=FPS)
            share = flicker([frame.pixels for frame in loop.frames], held(name))
            levels = np.mean([off(*pair) for pair in zip(plain, drawn, strict=True)])
            table.add_row(name, str(size), f"{levels:.1f}", f"{share:.2%}")
    Console().print(table)


if __name__ == "__main__":
    main()
