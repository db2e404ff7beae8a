"""Steps that change the finished picture, by its colours and by what lies in each pixel.

Invisible pixels stay as they are. The kernels are imported when a step first runs.
"""

from dataclasses import replace
from functools import lru_cache
from typing import Annotated

import numpy as np
from numpy.typing import NDArray
from pydantic import Field

from drapery.arrays import Pixels, Vectors, Words
from drapery.elementary import cos, sin
from drapery.render.buffers import BACKGROUND, Buffers
from drapery.styles.canvas import Canvas, laid_over
from drapery.styles.colours import as_pixels, rgb_of, word_of
from drapery.styles.palettes import (
    DARK_AND_LIGHT,
    Colour,
    DitherPattern,
    DitherStrength,
    PaletteColours,
    thresholds,
    use_palette,
)
from drapery.styles.step import costs

DARK, BRIGHT = 0.1, 0.5
"""Cosines to the light between which cel shading divides its steps: a cloth's folds are shallow."""

FINE = 16
"""Steps of opacity in a step of alpha, while it is blurred."""

SOLID = 0.985
"""A place darker than this is ink alone."""
ENDED = 0.86
"""So dark are places in which strokes of paper end."""


@costs(8)
def shade(
    canvas: Canvas,
    *,
    bands: Annotated[int, Field(ge=2, le=16, description="steps from dark to bright")] = 3,
    darkest: Annotated[float, Field(ge=0, le=1, description="brightness of the darkest")] = 0.5,
    brightest: Annotated[float, Field(ge=0, le=1, description="brightness of the brightest")] = 1.0,
    azimuth: Annotated[float, Field(ge=-180, le=180, description="of the light [degrees]")] = -55,
    elevation: Annotated[float, Field(ge=-90, le=90, description="of the light [degrees]")] = 40,
    around: Annotated[
        int, Field(ge=0, le=3, description="samples to each side that count too")
    ] = 0,
) -> Canvas:
    """Cel shading: light from one side in a few steps. Use it with `light = "flat"`.

    The light stands at an azimuth from the front, to the viewer's right if positive. With `around`
    a pixel has the middle step of its model's pixels in the square around it: there are no specks,
    and the narrow side of thick cloth has the step of the cloth beside it.
    """
    from drapery.styles.kernels import cel

    a, e = np.radians([azimuth, elevation])
    towards = sin(a) * cos(e), sin(e), cos(a) * cos(e)
    light = np.array([*towards, DARK, BRIGHT - DARK], np.float32)
    factors = darkest + (brightest - darkest) * (np.arange(bands, dtype=np.float32) / (bands - 1))
    table = np.rint(np.arange(256) * factors[:, None].astype(np.float64)).astype(np.uint8)
    drawn, found = canvas.words(), canvas.buffers
    normal = found.normal
    if around:
        normal = _middle_normals(normal, found.model, light, bands, around)
    cel(drawn, normal, found.model, light, bands, table)
    return canvas.painted(as_pixels(drawn))


@costs(8)
def outline(
    canvas: Canvas,
    *,
    colour: Annotated[Colour, Field(description="of the lines")] = "#1a1620",
    width: Annotated[float, Field(ge=0.5, le=16, description="of the lines [pixels]")] = 1.0,
    depth: Annotated[float, Field(ge=0.001, le=10, description="step in depth [m]")] = 0.08,
    crease: Annotated[float, Field(ge=1, le=180, description="angle of a crease [degrees]")] = 60,
    contrast: Annotated[int, Field(ge=0, le=255, description="between colours; 0 for none")] = 0,
    darken: Annotated[float, Field(ge=0, le=1, description="1 is `colour`, 0 the own")] = 1.0,
    materials: Annotated[bool, Field(description="whether also between materials")] = False,
    white_below: Annotated[
        int, Field(ge=0, le=255, description="brightness of places with white lines; 0 for none")
    ] = 0,
) -> Canvas:
    """Lines along silhouettes, between models, along steps in depth, creases and colours.

    A line is white where all beside it is darker than `white_below`.
    The method is Saito and Takahashi's ("Comprehensible rendering of 3-D shapes", 1990).
    """
    from drapery.styles.kernels import draw_marks

    levels = np.arange(256)[None] * (1 - darken) + np.array(rgb_of(colour))[:, None] * darken
    # A line of one pixel is as it is; others grow by discs.
    reach, table = disc_widths((width * canvas.grid - 1) / 2), np.rint(levels).astype(np.uint8)
    limits = np.array([depth, cos(np.radians(crease))], np.float32)
    source, drawn, found = _own_words(canvas), canvas.words(), canvas.buffers
    if materials:
        found = replace(found, model=_surface_numbers(found))
    edges = _edges(source, found, limits, contrast)
    if white_below:
        pale = _between_dark(source, edges, white_below)
        draw_marks(drawn, source, pale, reach, np.full((3, 256), 255, np.uint8))
    draw_marks(drawn, source, edges, reach, table)
    return canvas.painted(as_pixels(drawn))


def posterize(
    canvas: Canvas,
    *,
    levels: Annotated[int, Field(ge=2, le=64, description="of brightness")] = 6,
    dither: DitherStrength = 0.0,
    pattern: DitherPattern = "bayer",
) -> Canvas:
    """A few levels of brightness, dithered if wanted; hues stay."""
    from drapery.styles.kernels import level_out

    drawn = canvas.words()
    level_out(drawn, *_level_table(levels, dither, pattern))
    return canvas.painted(as_pixels(drawn))


def palette(
    canvas: Canvas,
    *,
    colours: PaletteColours = DARK_AND_LIGHT,
    dither: DitherStrength = 0.0,
    pattern: DitherPattern = "bayer",
) -> Canvas:
    """Only these colours: the nearest to each, by a weighted distance in sRGB.

    In a file of a style, `file` may name a palette in place of `colours`: .gpl or .hex.
    """
    drawn = canvas.words()
    use_palette(drawn, colours, dither, pattern)
    return canvas.painted(as_pixels(drawn))


def tones(
    canvas: Canvas,
    *,
    dark: Annotated[Colour, Field(description="what black becomes")] = "#10243e",
    light: Annotated[Colour, Field(description="what white becomes")] = "#f2f6fa",
    gamma: Annotated[float, Field(ge=0.1, le=10, description="over 1 darkens the middle")] = 1.0,
) -> Canvas:
    """All colours by their brightness, on the way from one colour to another."""
    from drapery.styles.kernels import tone

    drawn = canvas.words()
    tone(drawn, np.array(rgb_of(dark), np.float64), np.array(rgb_of(light), np.float64), gamma)
    return canvas.painted(as_pixels(drawn))


def hatching(
    canvas: Canvas,
    *,
    colour: Annotated[Colour, Field(description="of the strokes")] = "#1c1a18",
    spacing: Annotated[float, Field(ge=2, le=64, description="between strokes [pixels]")] = 6.0,
    width: Annotated[float, Field(ge=0.2, le=16, description="of the strokes [pixels]")] = 1.2,
    paper: Annotated[Colour, Field(description="of what is bright")] = "#f6f1e4",
    layers: Annotated[int, Field(ge=1, le=4, description="directions of strokes")] = 3,
    strength: Annotated[float, Field(ge=0.1, le=4, description="over 1: more strokes")] = 1.0,
    turned: Annotated[
        float, Field(ge=0.1, le=1, description="darkness from which strokes are of paper on ink")
    ] = 1.0,
) -> Canvas:
    """Strokes of a pen: the darker a place, the more directions of strokes cross there.

    From the darkness `turned` on, strokes of paper on ink become thinner and end. What is black is
    ink alone, such as lines of an outline in black.
    """
    from drapery.styles.kernels import hatch

    angles = np.radians((45, -45, 0, 90)[:layers])
    least = 0.22 + 0.6 * np.arange(layers) / layers
    strokes = np.stack([cos(angles), sin(angles), least], axis=-1)
    pen = np.array([spacing, width, strength, SOLID, turned, max(ENDED, turned + 0.01)])
    drawn, model = canvas.words(), canvas.buffers.model
    hatch(drawn, model, strokes, canvas.grid, pen, word_of(colour), word_of(paper))
    return canvas.painted(as_pixels(drawn))


def scanlines(
    canvas: Canvas,
    *,
    every: Annotated[int, Field(ge=2, le=64, description="distance of the lines [pixels]")] = 3,
    width: Annotated[int, Field(ge=1, le=32, description="of the lines [pixels]")] = 1,
    strength: Annotated[float, Field(ge=0, le=1, description="darkness of the lines")] = 0.4,
) -> Canvas:
    """Dark lines across, as on the screen of a tube."""
    table = np.rint(np.arange(256) * (1 - strength)).astype(np.uint8)
    rows = np.arange(len(canvas.pixels)) // canvas.grid % every < width
    drawn = canvas.pixels.copy()
    at = rows[:, None] & (drawn[..., 3] > 0)
    drawn[at, :3] = table[drawn[at, :3]]
    return canvas.painted(drawn)


def drop_shadow(
    canvas: Canvas,
    *,
    right: Annotated[int, Field(ge=-256, le=256, description="shift to the right [pixels]")] = 6,
    down: Annotated[int, Field(ge=-256, le=256, description="shift downwards [pixels]")] = 8,
    blur: Annotated[int, Field(ge=0, le=128, description="softness of the edge [pixels]")] = 6,
    colour: Annotated[Colour, Field(description="of the shadow")] = "#000000",
    strength: Annotated[float, Field(ge=0, le=1, description="opacity")] = 0.5,
) -> Canvas:
    """A soft shadow on the page behind what is drawn."""
    return _laid_under(canvas, down, right, blur, colour, strength)


def glow(
    canvas: Canvas,
    *,
    radius: Annotated[int, Field(ge=1, le=128, description="of the glow [pixels]")] = 12,
    colour: Annotated[Colour, Field(description="of the glow")] = "#ffe9a0",
    strength: Annotated[float, Field(ge=0, le=8, description="over 1: brighter near it")] = 1.6,
) -> Canvas:
    """Light around what is drawn."""
    return _laid_under(canvas, 0, 0, radius, colour, strength)


@costs(3)
def paper(
    canvas: Canvas,
    *,
    colour: Annotated[Colour, Field(description="of the paper")] = "#f4ead2",
    lines: Annotated[Colour, Field(description="of the lines on it")] = "#e4d6b8",
    spacing: Annotated[int, Field(ge=0, le=256, description="of the lines [pixels]; 0: none")] = 0,
    grain: Annotated[float, Field(ge=0, le=1, description="unevenness")] = 0.0,
) -> Canvas:
    """Paper behind what is drawn, plain or ruled in squares."""
    behind = _sheet_of_paper(canvas.pixels.shape[:2], canvas.grid, colour, lines, spacing, grain)
    return canvas.painted(as_pixels(laid_over(canvas.words(), behind)))


def _middle_normals(
    normal: Vectors, model: NDArray[np.int32], light: NDArray[np.float32], bands: int, reach: int
) -> Vectors:
    """Vectors along the light whose band is the median of those around; see `kernels.cel`."""
    facing = (normal[..., 0] * light[0] + normal[..., 1] * light[1]) + normal[..., 2] * light[2]
    own = np.clip(np.floor((facing - light[3]) / light[4] * bands), 0, bands - 1).astype(np.uint8)
    middle = _middle_bands(own, model, reach)
    cosine = light[3] + (middle + np.float32(0.5)) / bands * light[4]
    along: Vectors = (cosine[..., None] * light[:3]).astype(np.float32)
    return along


def _middle_bands(bands: NDArray[np.uint8], model: NDArray[np.int32], reach: int) -> Pixels:
    """The median in the square around each place of what its model has there, shape [H, W].

    Each place counts itself by half, so that what lies beside a straight edge outweighs it.
    """
    height, width = model.shape
    models, framed = np.pad(model, reach, constant_values=BACKGROUND), np.pad(bands, reach)
    counts = np.zeros((int(bands.max(initial=0)) + 1, height, width), np.uint8)
    for row in range(2 * reach + 1):
        for column in range(2 * reach + 1):
            at = slice(row, row + height), slice(column, column + width)
            own, weight = models[at] == model, 1 if row == column == reach else 2
            for band, count in enumerate(counts):
                count += weight * (own & (framed[at] <= band)).view(np.uint8)
    middle: Pixels = np.argmax(2 * counts >= counts[-1], axis=0).astype(np.uint8)
    return middle


def _own_words(canvas: Canvas) -> Words:
    """The pixels of a canvas as words to read, if it can be without a copy."""
    pixels = canvas.pixels
    # A kernel would be compiled again for arrays that are read-only or not contiguous.
    if not (pixels.flags.writeable and pixels.flags.c_contiguous):
        return canvas.words()
    words: Words = pixels.view(np.uint32)[..., 0]
    return words


def _surface_numbers(found: Buffers) -> NDArray[np.int32]:
    """A number for each pair of model and material, shape [H, W]; -1 on the background."""
    count = int(found.material.max(initial=0)) + 1
    numbers = np.where(found.coverage, found.model * count + found.material, BACKGROUND)
    return np.ascontiguousarray(numbers, np.int32)


def _edges(
    words: Words, found: Buffers, limits: NDArray[np.float32], contrast: int
) -> NDArray[np.uint64]:
    """The pixels at edges, a byte each, eight in a number; see `mark_edges`."""
    from drapery.styles.kernels import mark_edges

    height, width = words.shape
    eights = np.zeros((height + 1, -(-width // 8)), np.uint64)
    marks, flags = eights.view(np.uint8), eights[-1].view(np.uint8)
    given = found.depth, found.normal.reshape(height, -1), found.model, limits
    mark_edges(marks, words, *given, contrast, flags, eights[-1])
    return eights[:-1]


def _between_dark(words: Words, edges: NDArray[np.uint64], limit: int) -> NDArray[np.uint64]:
    """The pixels at edges that are darker than a limit, and all four beside them; see `_edges`.

    They are taken out of `edges`.
    """
    marks, (height, width) = edges.view(np.uint8), words.shape
    y, x = np.nonzero(marks)
    dark = np.ones(len(y), np.bool_)
    for down, right in ((0, 0), (-1, 0), (1, 0), (0, -1), (0, 1)):
        row, column = np.clip(y + down, 0, height - 1), np.clip(x + right, 0, width - 1)
        beside = as_pixels(words[row, column][None])[0].astype(np.int32)
        bright = (beside[:, :3] * (299, 587, 114)).sum(axis=1)
        dark &= (bright < 1000 * limit) & (beside[:, 3] > 0)
    result = np.zeros_like(edges)
    result.view(np.uint8)[y[dark], x[dark]] = 1
    marks[y[dark], x[dark]] = 0
    return result


def _laid_under(
    canvas: Canvas, down: int, right: int, reach: int, colour: str, strength: float
) -> Canvas:
    """What is visible, moved, blurred and in one colour, laid below itself."""
    from drapery.styles.kernels import blur, lay_under

    drawn = canvas.words()
    below = _moved((drawn >> 24).astype(np.int32) * FINE, down * canvas.grid, right * canvas.grid)
    # Two boxes of half the radius reach as far as the radius.
    radius = -(-reach * canvas.grid // 2)
    if radius:
        row = np.zeros(below.shape[1] + 2 * radius + 1, np.int32)
        blur(below, np.empty_like(below), row, radius)
    lay_under(drawn, below, word_of(colour), strength / (FINE * 255))
    return canvas.painted(as_pixels(drawn))


def _moved(values: NDArray[np.int32], down: int, right: int) -> NDArray[np.int32]:
    """The values moved; 0 where nothing has moved to."""
    result = np.zeros_like(values)
    height, width = values.shape
    rows, columns = max(0, height - abs(down)), max(0, width - abs(right))
    top, left, from_top, from_left = (max(0, n) for n in (down, right, -down, -right))
    part = values[from_top : from_top + rows, from_left : from_left + columns]
    result[top : top + rows, left : left + columns] = part
    return result


def disc_widths(radius: float) -> NDArray[np.int64]:
    """How far a disc reaches to each side, in each row from its top to its foot [pixels]."""
    height = max(0, int(radius))
    rows = np.arange(-height, height + 1)
    sides: NDArray[np.int64] = np.sqrt(max(radius, 0) ** 2 - rows * rows).astype(np.int64)
    return sides


@lru_cache(maxsize=8)
def _level_table(
    levels: int, dither: float, pattern: DitherPattern
) -> tuple[Pixels, NDArray[np.int32]]:
    """What becomes of each level of a channel, and the tile of dither; see `level_out`."""
    step = 255 / (levels - 1)
    offsets, tile = thresholds(dither, pattern)
    bright = np.arange(256.0)
    raised = bright + dither * step * offsets[:, None]
    factors = np.rint(raised / step) * step / np.maximum(bright, 1)
    return np.clip(np.rint(factors[..., None] * bright), 0, 255).astype(np.uint8), tile


@lru_cache(maxsize=4)
def _sheet_of_paper(
    shape: tuple[int, int], grid: int, colour: str, lines: str, spacing: int, grain: float
) -> Words:
    y, x = (axis // grid for axis in np.indices(shape))
    ruled = (x % spacing == 0) | (y % spacing == 0) if spacing else np.zeros(shape, np.bool_)
    sheet = np.where(ruled[..., None], rgb_of(lines), rgb_of(colour)).astype(float)
    sheet *= 1 + grain * (np.random.default_rng(0).random(shape)[..., None] - 0.5) * 0.2
    pixels = np.full((*shape, 4), 255, np.uint8)
    pixels[..., :3] = np.rint(np.clip(sheet, 0, 255))
    return pixels.view(np.uint32)[..., 0]
