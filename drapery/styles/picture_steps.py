"""Steps that change the finished picture, by its colours and by what lies in each pixel."""

from typing import Annotated

import numpy as np
from numpy.typing import NDArray
from pydantic import Field

from drapery.mesh import Array
from drapery.render.pixels import Pixels
from drapery.styles.canvas import Canvas
from drapery.styles.step import COLOUR_PATTERN

Colour = Annotated[str, Field(pattern=COLOUR_PATTERN)]
Marks = NDArray[np.bool_]
Place = tuple[slice, ...]

DARK, BRIGHT = 0.1, 0.5
"""Cosines to the light between which cel shading divides its steps: a cloth's folds are shallow."""

SOLID = 0.985
"""A place darker than this is ink alone."""

BAYER = np.array([[0, 8, 2, 10], [12, 4, 14, 6], [3, 11, 1, 9], [15, 7, 13, 5]])
"""Order of the thresholds of a 4 x 4 ordered dither (Bayer 1973)."""


def pixels(
    canvas: Canvas,
    *,
    size: Annotated[int, Field(ge=2, le=64, description="side of a large pixel [pixels]")] = 4,
) -> Canvas:
    """Large pixels, each with the one colour in its middle. Steps after this one work on them."""
    return canvas.coarse(size)


def shade(
    canvas: Canvas,
    *,
    bands: Annotated[int, Field(ge=2, le=16, description="steps from dark to bright")] = 3,
    darkest: Annotated[float, Field(ge=0, le=1, description="brightness of the darkest")] = 0.5,
    azimuth: Annotated[float, Field(ge=-180, le=180, description="of the light [degrees]")] = -55,
    elevation: Annotated[float, Field(ge=-90, le=90, description="of the light [degrees]")] = 40,
) -> Canvas:
    """Cel shading: light from one side in a few steps. Use it with `light = "flat"`.

    The light stands at an azimuth from the front, to the viewer's right if positive.
    """
    a, e = np.radians([azimuth, elevation])
    light = np.array([np.sin(a) * np.cos(e), np.sin(e), np.cos(a) * np.cos(e)], np.float32)
    normal = canvas.buffers.normal
    facing = sum(normal[..., axis] * light[axis] for axis in range(3))
    share = (facing - DARK) / (BRIGHT - DARK)
    level = np.clip(np.floor(share * bands), 0, bands - 1) / (bands - 1)
    factor: Array = np.where(canvas.buffers.coverage, darkest + (1 - darkest) * level, 1)
    return _with_colours(canvas, canvas.pixels[..., :3].astype(np.float64) * factor[..., None])


def outline(
    canvas: Canvas,
    *,
    colour: Annotated[Colour, Field(description="of the lines")] = "#1a1620",
    width: Annotated[float, Field(ge=0.5, le=16, description="of the lines [pixels]")] = 1.0,
    depth: Annotated[float, Field(ge=0.001, le=10, description="step in depth [m]")] = 0.08,
    crease: Annotated[float, Field(ge=1, le=180, description="angle of a crease [degrees]")] = 60,
    contrast: Annotated[int, Field(ge=0, le=255, description="between colours; 0 for none")] = 0,
    darken: Annotated[float, Field(ge=0, le=1, description="1 is `colour`, 0 the own")] = 1.0,
) -> Canvas:
    """Lines along silhouettes, between models, along steps in depth, creases and colours.

    The method is Saito and Takahashi's ("Comprehensible rendering of 3-D shapes", 1990).
    """
    marks = _edges(canvas, depth, float(np.cos(np.radians(crease))))
    if contrast:
        marks |= _colour_edges(canvas.pixels, contrast)
    # A line of one pixel is as it is; others grow by discs.
    thick = _grown(marks, max(0.0, (width * canvas.grid - 1) / 2))
    drawn = canvas.pixels.copy()
    own = drawn[thick][:, :3] * (1 - darken) + np.array(_rgb(colour)) * darken
    drawn[thick, :3] = np.rint(own).astype(np.uint8)
    drawn[thick, 3] = 255
    return canvas.painted(drawn)


def posterize(
    canvas: Canvas,
    *,
    levels: Annotated[int, Field(ge=2, le=64, description="of brightness")] = 6,
    dither: Annotated[float, Field(ge=0, le=1, description="strength of ordered dither")] = 0.0,
) -> Canvas:
    """A few levels of brightness, with ordered dither if wanted; hues stay."""
    step = 255 / (levels - 1)
    bright = canvas.pixels[..., :3].max(axis=-1).astype(np.float64)
    level = np.rint((bright + dither * step * _thresholds(canvas)) / step) * step
    factor = level / np.maximum(bright, 1)
    return _with_colours(canvas, canvas.pixels[..., :3] * factor[..., None])


def palette(
    canvas: Canvas,
    *,
    colours: Annotated[
        tuple[Colour, ...], Field(min_length=2, max_length=64, description="the colours to use")
    ] = ("#1a1620", "#f4f0e8"),
    dither: Annotated[float, Field(ge=0, le=1, description="strength of ordered dither")] = 0.0,
) -> Canvas:
    """Only these colours: the nearest to each, by a weighted distance in sRGB."""
    table = np.array([_rgb(colour) for colour in colours], np.float64)
    raised = canvas.pixels[..., :3] + dither * 48 * _thresholds(canvas)[..., None]
    best, nearest = None, np.zeros(canvas.pixels.shape[:2], np.intp)
    for number, entry in enumerate(table):
        apart = ((raised - entry) ** 2 * np.array([2.0, 4.0, 3.0])).sum(axis=-1)
        closer = apart < best if best is not None else np.ones(apart.shape, np.bool_)
        best = np.where(closer, apart, best if best is not None else apart)
        nearest = np.where(closer, number, nearest)
    return _with_colours(canvas, table[nearest])


def tones(
    canvas: Canvas,
    *,
    dark: Annotated[Colour, Field(description="what black becomes")] = "#10243e",
    light: Annotated[Colour, Field(description="what white becomes")] = "#f2f6fa",
    gamma: Annotated[float, Field(ge=0.1, le=10, description="over 1 darkens the middle")] = 1.0,
) -> Canvas:
    """All colours by their brightness, on the way from one colour to another."""
    share = (_brightness(canvas.pixels) / 255)[..., None] ** gamma
    return _with_colours(canvas, _rgb(dark) + share * np.subtract(_rgb(light), _rgb(dark)))


def hatching(
    canvas: Canvas,
    *,
    colour: Annotated[Colour, Field(description="of the strokes")] = "#1c1a18",
    spacing: Annotated[float, Field(ge=2, le=64, description="between strokes [pixels]")] = 6.0,
    width: Annotated[float, Field(ge=0.2, le=16, description="of the strokes [pixels]")] = 1.2,
    paper: Annotated[Colour, Field(description="of what is bright")] = "#f6f1e4",
    layers: Annotated[int, Field(ge=1, le=4, description="directions of strokes")] = 3,
    strength: Annotated[float, Field(ge=0.1, le=4, description="over 1: more strokes")] = 1.0,
) -> Canvas:
    """Strokes of a pen: the darker a place, the more directions of strokes cross there.

    What is black is ink alone, such as lines of an outline in black.
    """
    black = 1 - _brightness(canvas.pixels) / 255
    dark = strength * black
    y, x = (axis / canvas.grid for axis in np.indices(dark.shape))
    drawn = black > SOLID
    for number, degrees in enumerate((45, -45, 0, 90)[:layers]):
        angle = np.radians(degrees)
        across = (x * np.cos(angle) + y * np.sin(angle)) % spacing
        least = 0.22 + 0.6 * number / layers
        swell = width * np.clip((dark - least) * 3 + 0.5, 0, 1.6)
        drawn |= (across < swell) & (dark > least)
    colours = np.where(drawn[..., None], _rgb(colour), _rgb(paper))
    shown = canvas.buffers.coverage[..., None]
    return _with_colours(canvas, np.where(shown, colours, canvas.pixels[..., :3]).astype(float))


def paper(
    canvas: Canvas,
    *,
    colour: Annotated[Colour, Field(description="of the paper")] = "#f4ead2",
    lines: Annotated[Colour, Field(description="of the lines on it")] = "#e4d6b8",
    spacing: Annotated[int, Field(ge=0, le=256, description="of the lines [pixels]; 0: none")] = 0,
    grain: Annotated[float, Field(ge=0, le=1, description="unevenness")] = 0.0,
) -> Canvas:
    """Paper behind what is drawn, plain or ruled in squares."""
    shape = canvas.pixels.shape[:2]
    y, x = (axis // canvas.grid for axis in np.indices(shape))
    ruled = (x % spacing == 0) | (y % spacing == 0) if spacing else np.zeros(shape, np.bool_)
    behind = np.where(ruled[..., None], _rgb(lines), _rgb(colour)).astype(float)
    behind *= 1 + grain * (np.random.default_rng(0).random(shape)[..., None] - 0.5) * 0.2
    alpha = canvas.pixels[..., 3:] / 255
    mixed = canvas.pixels[..., :3] * alpha + np.clip(behind, 0, 255) * (1 - alpha)
    opaque = np.full((*shape, 1), 255, np.uint8)
    return canvas.painted(np.concatenate([np.rint(mixed).astype(np.uint8), opaque], axis=-1))


def _edges(canvas: Canvas, depth: float, cosine: float) -> Marks:
    """Pixels at an edge of what is seen: on the nearer side of it."""
    found = canvas.buffers
    marks = np.zeros(found.model.shape, np.bool_)
    for axis, (one, other) in enumerate(_pairs()):
        far = _steps(found.depth, one, other)
        apart = found.model[one] != found.model[other]
        step = np.abs(far) - _slopes(far, 1 - axis) > depth
        near, behind = far >= 0, far < 0
        facing = (found.normal[one] * found.normal[other]).sum(axis=-1)
        both = (found.model[one] >= 0) & (found.model[other] >= 0)
        edge = apart | (both & step)
        marks[one] |= (edge & near) | (both & ~edge & (facing < cosine))
        marks[other] |= edge & behind
    return marks & found.coverage


def _steps(depth: NDArray[np.float32], one: Place, other: Place) -> NDArray[np.float32]:
    """How much farther neighbours are [m]; none between two pixels of the background."""
    with np.errstate(invalid="ignore"):  # the background is infinitely far
        far: NDArray[np.float32] = depth[other] - depth[one]
    return np.where(np.isnan(far), np.float32(0), far)


def _slopes(far: NDArray[np.float32], axis: int) -> NDArray[np.float32]:
    """The smaller step before or after each step: what a plane in perspective has by itself."""
    steps = np.abs(far)
    padding = [(1, 1) if each == axis else (0, 0) for each in range(2)]
    around = np.pad(steps, padding, constant_values=np.inf)
    count = steps.shape[axis]
    least = np.minimum(around.take(range(count), axis), around.take(range(2, count + 2), axis))
    return np.where(np.isfinite(least), least, np.float32(0))


def _colour_edges(colours: Pixels, contrast: int) -> Marks:
    marks = np.zeros(colours.shape[:2], np.bool_)
    rgb = colours.astype(np.int16)
    for one, other in _pairs():
        inside = (rgb[one][..., 3] > 0) & (rgb[other][..., 3] > 0)
        marks[one] |= inside & (np.abs(rgb[one] - rgb[other])[..., :3].max(axis=-1) >= contrast)
    return marks


def _pairs() -> tuple[tuple[Place, Place], ...]:
    """Places of neighbours: each pixel with that to its right, and with that below it."""
    every, first, last = slice(None), slice(None, -1), slice(1, None)
    return ((every, first), (every, last)), ((first, every), (last, every))


def _grown(marks: Marks, radius: float) -> Marks:
    """Pixels whose middle is at most this far from that of a mark [pixels]."""
    from scipy.ndimage import distance_transform_edt

    if radius < 0.5:
        return marks
    near: Marks = np.asarray(distance_transform_edt(~marks)) <= radius
    return near


def _thresholds(canvas: Canvas) -> Array:
    """The ordered dither's offset of each pixel, -0.5..0.5."""
    height, width = canvas.pixels.shape[:2]
    tile = (BAYER + 0.5) / BAYER.size - 0.5
    offsets: Array = np.tile(tile, (-(-height // 4), -(-width // 4)))[:height, :width]
    return offsets


def _brightness(colours: Pixels) -> Array:
    red, green, blue = (colours[..., channel].astype(np.float64) for channel in range(3))
    return 0.299 * red + 0.587 * green + 0.114 * blue


def _with_colours(canvas: Canvas, colours: Array) -> Canvas:
    """The canvas with other colours and its own opacity. colours: 0..255, shape [H, W, 3]."""
    whole = np.clip(np.rint(colours), 0, 255).astype(np.uint8)
    return canvas.painted(np.concatenate([whole, canvas.pixels[..., 3:]], axis=-1))


def _rgb(colour: str) -> tuple[int, ...]:
    return tuple(bytes.fromhex(colour.removeprefix("#")))
