"""What styles do to a design: `python -m benchmarks.style_loops [STYLE...] [--sizes 128 256]`.

For each style, or each that is named, and each size:

- off: how far the still pictures of some designs are from the plain ones, as the mean over red,
  green and blue of all pixels where both show something, and over the designs [levels];
- on the screen: the share of such pixels in a loop of each design which differ by more than FAR
  levels of brightness from the frames before and after, which are alike;
- on the cloth: the same of points of the cloth, which are followed by their texture coordinates. A
  point is about a pixel, and its brightness is blended from the four pixels around it;
- on both: the share of pixels that flicker on the screen and show a point that flickers, too.

A line that moves with the cloth flickers on the screen alone, and one that stands on the screen on
the cloth alone: both are motion. What is fixed to neither flickers on both. Of poses that are held,
frames that are so far apart are compared.
"""

import argparse

import numpy as np
from numpy.typing import NDArray
from rich.console import Console
from rich.table import Table

from benchmarks.quick import add_quick
from drapery import Banner, Settings, animate, draw
from drapery.arrays import Pixels
from drapery.styles import Canvas, Style, StyleStep, find_style, style_names

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
SHEET, TEXELS_HIGH = 64, 85
"""Texels across a texture, and from top to bottom of a picture."""

Levels = NDArray[np.float64]
Marks = NDArray[np.bool_]


def off(one: Pixels, other: Pixels) -> float:
    """The mean difference of two pictures where both show something [levels]."""
    both = (one[..., 3] > 0) & (other[..., 3] > 0)
    apart = np.abs(one.astype(int) - other.astype(int))[..., :3]
    return float(apart[both].mean())


class Followed:
    """Where each point of the cloth is in each frame of a loop.

    side: points along a side of the texture. places: row and column of each, in pixels, shape
    [side * side, 2] a frame; NaN where it is not seen. points: the number of the point that each
    pixel shows, shape [H, W] a frame; side * side for none.
    """

    def __init__(self, height: int) -> None:
        self.side = SHEET * max(1, round(height / TEXELS_HIGH))
        self.places: list[Levels] = []
        self.points: list[NDArray[np.intp]] = []
        self.step = StyleStep("picture", self._follow)

    def _follow(self, canvas: Canvas) -> Canvas:
        found, scale, side = canvas.buffers, canvas.pixel / canvas.grid, self.side
        models, counts = np.unique(found.model[found.coverage], return_counts=True)
        at = np.clip((found.uv * side).astype(np.intp), 0, side - 1)
        cloth = found.model == models[np.argmax(counts)]
        point = np.where(cloth, at[..., 1] * side + at[..., 0], side * side)
        ravelled, every = point.reshape(-1), side * side + 1
        seen = np.bincount(ravelled, minlength=every)
        places = [
            np.bincount(ravelled, (axis.reshape(-1) + 0.5) * scale - corner, every)
            for axis, corner in zip(np.indices(point.shape), canvas.corner, strict=True)
        ]
        mean = np.stack(places, axis=-1) / np.where(seen, seen, np.nan)[:, None]
        self.places.append(mean[:-1])
        top, left = canvas.corner
        middle = point[canvas.grid // 2 :: canvas.grid, canvas.grid // 2 :: canvas.grid]
        large = middle.repeat(canvas.pixel, axis=0).repeat(canvas.pixel, axis=1)
        self.points.append(large[top:, left:])
        return canvas


def flicker(frames: list[Pixels], apart: int, followed: Followed) -> tuple[float, float, float]:
    """The shares of what differs from `apart` frames before and after: screen, cloth, both."""
    pixels = np.stack(frames)
    bright: Levels = pixels[..., :3] @ np.array([0.299, 0.587, 0.114])
    screen, shown = _leaving(bright, pixels[..., 3] > 0, apart)
    places = np.stack(followed.places)
    tracked = np.stack([_blended(*each) for each in zip(bright, places, strict=True)])
    cloth, seen = _leaving(tracked, ~np.isnan(places[..., 0]), apart)
    height, width = bright.shape[1:]
    none = np.zeros((len(cloth), 1), np.bool_)
    points = np.stack([each[:height, :width] for each in followed.points])
    beneath = np.concatenate([cloth, none], axis=1)[np.arange(len(cloth))[:, None, None], points]
    both = np.count_nonzero(screen & beneath)
    return screen.sum() / shown, cloth.sum() / seen, both / shown


def _leaving(bright: Levels, shown: Marks, apart: int) -> tuple[Marks, int]:
    """What differs from before and after, which are alike, and how many are shown three times."""
    before, after = np.roll(bright, apart, axis=0), np.roll(bright, -apart, axis=0)
    all_shown = shown & np.roll(shown, apart, axis=0) & np.roll(shown, -apart, axis=0)
    leaves = np.minimum(np.abs(bright - before), np.abs(bright - after)) > FAR
    found = leaves & (np.abs(before - after) < NEAR) & all_shown
    return found, int(np.count_nonzero(all_shown))


def _blended(bright: Levels, places: Levels) -> Levels:
    """The brightness at places in a picture, shape [P, 2], from four pixels each."""
    most = np.array(bright.shape) - 1.001
    at = np.clip(np.nan_to_num(places) - 0.5, 0, most)
    (row, column), (down, right) = at.astype(np.intp).T, (at % 1).T
    upper = bright[row, column] * (1 - right) + bright[row, column + 1] * right
    lower = bright[row + 1, column] * (1 - right) + bright[row + 1, column + 1] * right
    blended: Levels = upper * (1 - down) + lower * down
    return blended


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("styles", nargs="*", default=["plain", *style_names()])
    parser.add_argument("--sizes", type=int, nargs="+", default=[128, 256], help="[pixels]")
    parser.add_argument("--seconds", type=float, default=2.0, help="length of the loop")
    parser.add_argument("--loops", type=int, default=2, help="designs of which a loop is drawn")
    add_quick(parser)
    given = parser.parse_args()
    if given.quick:
        given.sizes, given.seconds, given.loops = [32], 0.3, 1
    designs = [Banner.parse(each) for each in DESIGNS[: 1 if given.quick else None]]
    table = Table("style", "size", "off [levels]", "on the screen", "on the cloth", "on both")
    for size in given.sizes:
        settings = Settings(size=(size, size))
        plain = [draw(each, settings).pixels for each in designs]
        for name in given.styles:
            style = Style("plain") if name == "plain" else find_style(name)
            drawn = [draw(each, settings, style=style).pixels for each in designs]
            shares = [
                _flicker_of(each, settings, style, given.seconds) for each in designs[: given.loops]
            ]
            levels = np.mean([off(*pair) for pair in zip(plain, drawn, strict=True)])
            percents = [f"{share:.2%}" for share in np.mean(shares, axis=0)]
            table.add_row(name, str(size), f"{levels:.1f}", *percents)
    Console().print(table)


def _flicker_of(
    design: Banner, settings: Settings, style: Style, seconds: float
) -> tuple[float, float, float]:
    followed = Followed(settings.size[1])
    watched = style | Style("followed", (followed.step,))
    loop = animate(design, settings, style=watched, seconds=seconds, fps=FPS)
    every = [dict(step.parameters)["every"] for step in style.steps if step.name == "hold"]
    return flicker([frame.pixels for frame in loop.frames], max([1, *every]), followed)


if __name__ == "__main__":
    main()
