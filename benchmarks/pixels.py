"""How much pixel art flickers: `python -m benchmarks.pixels [--seconds 4] [--fps 20]`.

One loop is drawn in large pixels by several methods, all with the same tones and number of colours.
The table gives, as shares of all cloth pixels of all frames:

- A-B-A: pixels whose colour differs from the frames before and after, which are alike;
- back: pixels that leave a colour and come back to it within three frames, A-B-A and A-B-C-A;
- orphans: pixels whose colour none of the eight around them has;
- blots: squares of 2 x 2 pixels in the colour of the outline, as a share of its pixels.

"Plain" averages each large pixel, "nearest" takes the colour in its middle, and "snapped" does so
after every vertex has been moved to the lattice of large pixels.
"""

import argparse
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray
from rich.console import Console
from rich.table import Table

from benchmarks.quick import add_quick
from drapery import Banner, animate
from drapery.styles import STEPS, Canvas, Sheet, Style, StyleStep, find_style

BANNER = Banner.parse("white creeper:lime border:black")
SIZE = 6
"""Side of a large pixel [pixels]."""
PITCH = 2.3 * SIZE / 512
"""Side of a large pixel on the cloth [m]."""

OUTLINE = np.uint32(0xFF20161A)
"""The word of the outline's colour."""

Colours = NDArray[np.uint32]


def average(canvas: Canvas) -> Canvas:
    """Large pixels by the mean of their colours."""
    coarse = canvas.coarse(SIZE)
    height, width = (side // SIZE for side in canvas.pixels.shape[:2])
    grid = replace(canvas, grid=SIZE)
    mean = coarse.pixels.copy()
    mean[:height, :width] = grid.finished((width, height))
    mean[..., 3] = np.where(mean[..., 3] >= 128, 255, 0)
    return coarse.painted(mean)


def snap(sheet: Sheet) -> Sheet:
    """Every vertex on the lattice of large pixels."""
    return replace(sheet, positions=np.rint(sheet.positions / PITCH) * PITCH)


def picture(name: str, **parameters: object) -> StyleStep:
    return StyleStep("picture", STEPS["picture"][name], parameters)


def styles() -> dict[str, Style]:
    """The methods that are compared."""
    own = find_style("pixel-art")
    shape = tuple(step for step in own.steps if step.kind == "shape")
    given = {step.name: step for step in own.steps if step.kind == "picture"}
    pixels, outline = given["pixels"], given["outline"]
    tones, few = (given["shade"], given["posterize"]), (given["limit"], outline)
    steps = {
        "plain": (*shape, *tones, StyleStep("picture", average), *few),
        "nearest": (*shape, pixels, *tones, *few),
        "snapped": (*shape, StyleStep("shape", snap), pixels, *tones, *few),
        "pixel-art without hold": tuple(step for step in own.steps if step.kind != "motion"),
        "pixel-art": own.steps,
    }
    return {name: Style(name, each, own.light, own.samples) for name, each in steps.items()}


def loop(style: Style, seconds: float, fps: float, banner: Banner = BANNER) -> Colours:
    """The large pixels of a loop, 0 where nothing is seen, shape [F, H, W]."""
    frames = animate(banner, style=style, size=(512, 512), seconds=seconds, fps=fps).frames
    words = np.stack([f.pixels[::SIZE, ::SIZE].copy().view(np.uint32)[..., 0] for f in frames])
    words[words < 1 << 24] = 0
    return words


def shares(words: Colours) -> tuple[float, float, float, float]:
    """A-B-A, back, orphans and blots; see the docstring of this file."""
    now, one, two, three = (np.roll(words, -n, axis=0) for n in range(4))
    total = np.count_nonzero(words)
    leaves = now != one
    aba = leaves & (two == now)
    back = aba | (leaves & (three == now))
    framed = np.pad(words, ((0, 0), (1, 1), (1, 1)))
    alike = np.zeros(words.shape, np.bool_)
    height, width = words.shape[1:]
    for row in range(3):
        for column in range(3):
            if (row, column) != (1, 1):
                alike |= framed[:, row : row + height, column : column + width] == words
    orphans = ~alike & (words != 0)
    line = words == OUTLINE
    blots = line[:, 1:, 1:] & line[:, :-1, 1:] & line[:, 1:, :-1] & line[:, :-1, :-1]
    marks = aba.sum(), back.sum(), orphans.sum()
    aba_share, back_share, orphan_share = (float(count / total) for count in marks)
    return aba_share, back_share, orphan_share, float(blots.sum() / max(1, line.sum()))


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--seconds", type=float, default=4.0)
    parser.add_argument("--fps", type=float, default=20.0)
    parser.add_argument("--design", default=None)
    add_quick(parser)
    given = parser.parse_args()
    if given.quick:
        given.seconds, given.fps = 0.5, 10.0
    banner = Banner.parse(given.design) if given.design else BANNER
    table = Table("method", "A-B-A", "back", "orphans", "blots", "colours")
    for name, style in styles().items():
        words = loop(style, given.seconds, given.fps, banner)
        figures = (f"{share:.3%}" for share in shares(words))
        table.add_row(name, *figures, str(len(np.unique(words[words != 0]))))
    Console().print(table)


if __name__ == "__main__":
    main()
