"""Steps that change what cloth is made of: the texels of its material, and their shading.

A sheet is 64 texels wide in the game. A step first enlarges it to `fine` pixels a texel, so that
threads and stitches have room; steps that follow work on the larger sheet.
"""

from dataclasses import replace
from typing import Annotated

import numpy as np
from pydantic import Field

from drapery.arrays import Mask, Texels
from drapery.banner.dyes import DYES
from drapery.elementary import cos, sin, sine_of_turns
from drapery.mesh import Array
from drapery.render.scene import Material, TextureLayer
from drapery.styles.charges import (
    SHEET,
    Charges,
    Numbers,
    charges_of,
    is_dyed,
    merged_texels,
)
from drapery.styles.colours import as_pixels, rgb_of
from drapery.styles.palettes import (
    DARK_AND_LIGHT,
    Colour,
    DitherPattern,
    DitherStrength,
    PaletteColours,
    use_palette,
)
from drapery.styles.step import costs


@costs(8)
def weave(
    material: Material,
    *,
    threads: Annotated[int, Field(ge=1, le=4, description="threads along each texel")] = 2,
    depth: Annotated[float, Field(ge=0, le=1, description="darkness between the threads")] = 0.5,
) -> Material:
    """Plain weave: each thread goes over one and under the next."""
    texels, fine = _enlarged(material, 4 * threads)
    width = fine // threads
    y, x = np.indices(texels.shape[:2])
    column, row = x // width, y // width
    upright = (column + row) % 2 == 0
    across, along = np.where(upright, (x, y), (y, x)) % width
    height = _bulge(across, width) * (0.65 + 0.35 * _bulge(along, width))
    own = _noise((texels.shape[0] // width + 1, texels.shape[1] // width + 1), 1)
    uneven = 0.94 + 0.12 * np.where(upright, own[0, column], own[row, 0])
    return _sheet(material, _shaded(texels, (1 - depth * (1 - height)) * uneven))


@costs(16)
def felt(
    material: Material,
    *,
    fuzz: Annotated[float, Field(ge=0, le=1, description="how far fibres stray [texels]")] = 0.4,
    depth: Annotated[float, Field(ge=0, le=1, description="contrast of the fibres")] = 0.35,
) -> Material:
    """Matted wool: short fibres in all directions, which blur the edges of colours."""
    texels, fine = _enlarged(material, 8)
    shape = texels.shape[:2]
    y, x = np.indices(shape)
    stray = fuzz * fine
    shift = [
        stray * (0.6 * _smooth_noise(shape, 5, n) + 0.9 * _noise(shape, n + 2)) for n in (3, 4)
    ]
    rows = np.clip(y + np.rint(shift[0] - 0.75 * stray), 0, shape[0] - 1).astype(np.intp)
    columns = np.clip(x + np.rint(shift[1] - 0.75 * stray), 0, shape[1] - 1).astype(np.intp)
    fibres = sum(_blurred(_noise(shape, 20 + n), step) for n, step in enumerate(_DIRECTIONS))
    clouds = _smooth_noise(shape, 2 * fine, 9)
    light = 1 + depth * (1.6 * (fibres / len(_DIRECTIONS) - 0.5) * 2 + 0.35 * (clouds - 0.5))
    return _sheet(material, _shaded(texels[rows, columns], light))


@costs(32)
def embroider(
    material: Material,
    *,
    stitch: Annotated[int, Field(ge=2, le=8, description="width of a stitch [1/8 texel]")] = 3,
    depth: Annotated[float, Field(ge=0, le=1, description="darkness between stitches")] = 0.55,
) -> Material:
    """Patterns in satin stitch, each dye in a direction of its own, on a plainly woven ground.

    A gradient dyes the threads that lie below it, and has no stitches of its own.
    """
    texels, _ = _enlarged(material, 8)
    charges = _charges(material, texels)
    dyes = charges.dyes
    ground = _charges(replace(material, layers=material.layers[:2]), texels).dyes
    y, x = np.indices(texels.shape[:2])
    turns = np.radians(20 + 70 * (np.arange(len(DYES)) % 3 - 1.0))
    cosine, sine = cos(turns)[dyes], sin(turns)[dyes]
    across = (x * cosine + y * sine) / stitch
    along = (y * cosine - x * sine) / (9.0 * stitch) + 0.5 * (np.floor(across) % 2)
    satin = _bulge(across % 1 * 16, 16) * (0.75 + 0.25 * _bulge(along % 1 * 16, 16))
    edge = _near(_borders(charges.labels), 1)
    stitched = (1.12 - depth * (1 - satin)) * np.where(edge, 0.5, 1.0)
    linen = 0.93 - 0.16 * ((x // 2 + y // 2) % 2) + 0.06 * _noise(texels.shape[:2], 5)
    seam = np.where(_near(_borders(charges.labels), 3), 0.72, 1.0)
    return _sheet(material, _shaded(texels, np.where(dyes == ground, linen * seam, stitched)))


@costs(4)
def flatten(
    material: Material,
    *,
    gradients: Annotated[float, Field(ge=0, le=1, description="strength of gradients")] = 1.0,
) -> Material:
    """Each charge in its dye alone: no shading of its texture, and no half covered texels at edges.

    Gradients mix the dyes; those of less strength leave charges apart, for lines between them.
    Where layers are not of one dye each, the texture stays.
    """
    if not is_dyed(material):
        return material
    texels, _ = _enlarged(material, 1)
    charges = _charges(material, texels)
    own, mixed = _RGB[charges.dyes], _mixed_dyes(charges)
    return _sheet(material, _coloured(texels, own + gradients * (mixed - own)))


@costs(4)
def bevel(
    material: Material,
    *,
    width: Annotated[int, Field(ge=1, le=4, description="of the edges [1/8 texel]")] = 1,
    depth: Annotated[float, Field(ge=0, le=1, description="contrast of the edges")] = 0.4,
) -> Material:
    """Each texel as the side of a block: brighter at two of its edges, darker at the others."""
    texels, fine = _enlarged(material, 8)
    y, x = np.indices(texels.shape[:2]) % fine
    wide = max(1, width * fine // 8)
    lit, dark = (y < wide) | (x < wide), (y >= fine - wide) | (x >= fine - wide)
    light: Array = np.asarray(1 + depth * (0.5 * lit - dark), np.float64)
    return _sheet(material, _shaded(texels, light))


@costs(16)
def hatch(
    material: Material,
    *,
    paper: Annotated[Colour, Field(description="colour of the paper")] = "#f4ead2",
    ink: Annotated[Colour, Field(description="colour of the lines")] = "#2a221c",
    spacing: Annotated[int, Field(ge=3, le=16, description="between lines [1/8 texel]")] = 9,
    width: Annotated[int, Field(ge=1, le=8, description="of lines [1/8 texel]")] = 3,
    strength: Annotated[
        float, Field(ge=0.1, le=1, description="of lines; edges of charges are of full ink")
    ] = 0.7,
) -> Material:
    """Each dye as the heraldic hatching of Silvester Petra Sancta ("Tesserae gentilitiae", 1638).

    Dots are gold, upright lines red, level lines blue, lines down to the right green, lines down to
    the left purple, crossed lines black, and plain paper is silver. Under a gradient the lines of a
    charge become thinner and those of the gradient wider, as one dye fades into the other. Where
    lines cross, the ink is darker.
    """
    texels, _ = _enlarged(material, 8)
    charges = _charges(material, texels)
    blank, black = np.array(rgb_of(paper), float), np.array(rgb_of(ink), float)
    left = 1.0 - _near(_borders(charges.labels), 1)
    for number, share in charges.shares.items():
        for mark in _HATCHING[NAMES[number]]:
            left *= 1 - strength * _lines(mark, spacing, width * share)
    return _sheet(material, _coloured(texels, black + left[..., None] * (blank - black)))


@costs(24)
def stained_glass(
    material: Material,
    *,
    pane: Annotated[int, Field(ge=2, le=20, description="side of a pane [texels]")] = 7,
    lead: Annotated[int, Field(ge=1, le=8, description="half width of the lead [1/8 texel]")] = 3,
) -> Material:
    """Panes of bright glass in lead, which goes around charges; a wide field is in diamonds."""
    texels, fine = _enlarged(material, 8)
    charges = _charges(material, texels)
    flat, dyes = _mixed_dyes(charges), charges.dyes
    y, x = np.indices(texels.shape[:2])
    side = pane * fine
    one: Numbers = np.asarray((x + y // 2) // side)
    other: Numbers = np.asarray((x - y // 2 + 64 * side) // side)
    field = dyes == _charges(replace(material, layers=material.layers[:2]), texels).dyes
    wide = _opened(field, FIELD * fine)
    one, other = one * wide, other * wide
    shapes = _borders(charges.labels) | (_borders(one) | _borders(other)) & wide
    came, core = _near(shapes, lead - 1), _near(shapes, max(lead - 3, 0))
    own = _noise((256, 256), 7)[one % 256, (other + 7 * dyes) % 256]
    streaks = _smooth_noise(texels.shape[:2], fine, 8)
    glow = 0.72 + 0.4 * own + 0.35 * (streaks - 0.5)
    glass = _vivid(flat, 1.35) * glow[..., None] + 26
    metal = np.where(core[..., None], 92.0, 38.0) * np.array([0.95, 1.0, 1.05])
    colours = np.clip(np.where(came[..., None], metal, glass), 0, 255).astype(np.uint8)
    return _sheet(material, np.concatenate([colours, texels[..., 3:]], axis=-1))


def palette(
    material: Material,
    *,
    colours: PaletteColours = DARK_AND_LIGHT,
    dither: DitherStrength = 0.0,
    pattern: DitherPattern = "bayer",
) -> Material:
    """Only these colours in the texture: the nearest to each texel, as the picture step does.

    The light still shades them. In a file of a style, `file` may name a palette, .gpl or .hex.
    """
    texels, _ = _enlarged(material, 1)
    words = texels.view(np.uint32)[..., 0]
    use_palette(words, colours, dither, pattern)
    return _sheet(material, as_pixels(words))


@costs(4)
def age(
    material: Material,
    *,
    fade: Annotated[float, Field(ge=0, le=1, description="loss of colour")] = 0.4,
    dirt: Annotated[float, Field(ge=0, le=1, description="stains")] = 0.5,
    seed: Annotated[int, Field(ge=0, le=2**31, description="which stains")] = 0,
) -> Material:
    """Faded by the sun, and dirty."""
    texels, fine = _enlarged(material, 4)
    shape = texels.shape[:2]
    colour = texels[..., :3].astype(float)
    grey = 0.3 * colour[..., 0] + 0.59 * colour[..., 1] + 0.11 * colour[..., 2]
    worn = colour + fade * (0.45 * grey[..., None] + 0.55 * np.array([176, 160, 128]) - colour)
    stains = 0.6 * _smooth_noise(shape, 9 * fine, seed) + 0.4 * _smooth_noise(shape, 3 * fine, seed)
    share = dirt * np.clip(stains * 2.6 - 1.1, 0, 1)[..., None]
    mixed = worn + share * (np.array([66, 52, 36]) - worn)
    grain = 0.92 + 0.16 * _noise(shape, seed + 1)
    return _sheet(material, _coloured(texels, mixed * grain[..., None]))


@costs(4)
def parchment(
    material: Material,
    *,
    colour: Annotated[Colour, Field(description="of the parchment")] = "#e6d3a3",
    ink: Annotated[float, Field(ge=0, le=1, description="strength of the colours")] = 0.7,
    stains: Annotated[float, Field(ge=0, le=1, description="darkness of the stains")] = 0.35,
    seed: Annotated[int, Field(ge=0, le=2**31, description="which stains")] = 0,
) -> Material:
    """Old parchment, on which the colours are thin inks."""
    texels, fine = _enlarged(material, 4)
    shape, skin = texels.shape[:2], np.array(rgb_of(colour), float)
    clouds = 0.65 * _smooth_noise(shape, 6 * fine, seed) + 0.35 * _smooth_noise(shape, fine, seed)
    fibres = 0.97 + 0.06 * _blurred(_noise(shape, seed + 1), (1, 0))
    inked = 1 - ink * (1 - texels[..., :3] / 255)
    light = (1 - stains * np.clip(clouds * 2 - 0.7, 0, 1)) * fibres
    return _sheet(material, _coloured(texels, skin * inked * light[..., None]))


FIELD = 5
"""The least width of a part of the field that glass divides into diamonds [texels]."""
NAMES = tuple(DYES)
"""The names of the dyes by their numbers."""
_RGB = np.array([dye.rgb for dye in DYES.values()], np.float64)
"""The dyes by their numbers [0..255], shape [16, 3]."""

_HATCHING = {
    **{"white": "", "light_gray": ".-", "gray": "-:", "black": "|-", "brown": "-\\"},
    **{"red": "|", "orange": "|:", "yellow": ".", "lime": "\\.", "green": "\\", "cyan": "\\:"},
    **{"light_blue": ":", "blue": "-", "purple": "/", "magenta": "/|", "pink": "/."},
}
"""The lines of each dye; those without a colour in heraldry combine two."""

_DIRECTIONS = ((0, 1), (1, 0), (1, 1), (1, -1), (2, 1), (1, 2), (2, -1), (1, -2))


def _enlarged(material: Material, fine: int) -> tuple[Texels, int]:
    """The layers of a material as one, opaque, and its pixels a texel; at least `fine` of them."""
    merged = merged_texels(material)
    side = merged.shape[1]
    times = max(1, fine * SHEET // side)
    large = merged.repeat(times, axis=0).repeat(times, axis=1)
    return large, max(1, side * times // SHEET)


def _sheet(material: Material, texels: Texels) -> Material:
    return replace(material, layers=(TextureLayer(np.ascontiguousarray(texels)),))


def _charges(material: Material, texels: Texels) -> Charges:
    """The charges of a material on an enlarged sheet of it."""
    charges = charges_of(material)
    return charges.repeated(texels.shape[1] // charges.dyes.shape[1])


def _mixed_dyes(charges: Charges) -> Array:
    """The dyes that one sees at each texel, without the shading of their textures [0..255]."""
    flat = np.zeros((*charges.dyes.shape, 3))
    for number, share in charges.shares.items():
        flat += share[..., None] * _RGB[number]
    return flat


def _lines(mark: str, spacing: int, width: Array) -> Array:
    """How much of each texel a kind of lines covers, 0 to 1. width: of the lines [texels]."""
    places = np.indices(width.shape)
    y: Numbers = np.asarray(places[0])
    x: Numbers = np.asarray(places[1])
    level, upright = _stripes(y, spacing, width), _stripes(x, spacing, width)
    if mark == "|":
        return upright
    if mark == "-":
        return level
    if mark == ".":
        staggered: Numbers = np.asarray(y + x // spacing % 2 * (spacing // 2))
        return np.multiply(upright, _stripes(staggered, spacing, width))
    if mark == ":":
        dashes: Mask = (x + y // spacing % 2 * spacing) % (2 * spacing) < spacing
        return np.multiply(level, dashes)
    slanting: Array = np.asarray((x - y if mark == "\\" else x + y) / 2**0.5)
    return _stripes(slanting, spacing, width)


def _stripes(place: Array | Numbers, spacing: int, width: Array) -> Array:
    """How much of each texel stripes cover that begin at multiples of `spacing`, 0 to 1."""
    off = np.abs((place + 0.5) % spacing - 0.5 * width)
    covered: Array = np.clip(0.5 + 0.5 * width - np.minimum(off, spacing - off), 0, 1)
    return np.minimum(covered, width)


def _borders(values: Numbers) -> Mask:
    """Whether the value to the right of a pixel, or below it, is another one."""
    edge = np.zeros(values.shape, np.bool_)
    edge[:, :-1] |= values[:, :-1] != values[:, 1:]
    edge[:-1] |= values[:-1] != values[1:]
    return edge


def _near(marks: Mask, distance: int) -> Mask:
    """Pixels at most this far from a mark, across, down or diagonally."""
    from scipy.ndimage import binary_dilation

    if distance < 1:
        return marks
    near: Mask = binary_dilation(marks, np.ones((3, 3), np.bool_), distance)
    return near


def _opened(marks: Mask, width: int) -> Mask:
    """The marks that lie in a square of marks of about this width."""
    from scipy.ndimage import binary_erosion

    inner: Mask = binary_erosion(marks, np.ones((3, 3), np.bool_), max(1, width // 2))
    return _near(inner, max(1, width // 2)) & marks


def _bulge(place: Array | Numbers, width: int) -> Array:
    """The height 0..1 of a round thread at a place across its width."""
    bulge: Array = sine_of_turns((place + 0.5) / (2 * width))
    return np.clip(bulge, 0, 1)


def _noise(shape: tuple[int, ...], seed: int) -> Array:
    return np.random.default_rng(seed).random(shape)


def _smooth_noise(shape: tuple[int, int], cell: int, seed: int) -> Array:
    """Noise 0..1 that changes over `cell` pixels: values on a lattice, blended by smoothstep."""
    corners = _noise((shape[0] // cell + 2, shape[1] // cell + 2), seed)
    y, x = (np.arange(side) / cell for side in shape)
    row, column = y.astype(int), x.astype(int)
    s, t = ((part * part * (3 - 2 * part)) for part in (y - row, x - column))
    s, t = s[:, None], t[None, :]
    above = (1 - t) * corners[row][:, column] + t * corners[row][:, column + 1]
    below = (1 - t) * corners[row + 1][:, column] + t * corners[row + 1][:, column + 1]
    blend: Array = (1 - s) * above + s * below
    return blend


def _blurred(noise: Array, step: tuple[int, int]) -> Array:
    """Noise as short fibres in one direction: the mean along it, with its contrast restored."""
    moved = [np.roll(noise, (k * step[0], k * step[1]), (0, 1)) for k in range(-3, 4)]
    fibres: Array = 0.5 + (np.sum(moved, axis=0) / 7 - 0.5) * 1.9
    return fibres


def _vivid(colours: Array, times: float) -> Array:
    grey = colours.mean(axis=-1, keepdims=True)
    vivid: Array = grey + (colours - grey) * times
    return vivid


def _shaded(texels: Texels, light: Array) -> Texels:
    return _coloured(texels, texels[..., :3] * light[..., None])


def _coloured(texels: Texels, colours: Array) -> Texels:
    """The texels in other colours [0..255], as transparent as they were."""
    clipped = np.clip(np.rint(colours), 0, 255).astype(np.uint8)
    return np.concatenate([clipped, texels[..., 3:]], axis=-1)
