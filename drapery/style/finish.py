"""How each fabric looks: its weave, nap or grain, its edges, gloss and fuzz, one row a fabric.

A tile repeats over the cloth, PITCH texels of it to the metre. It is drawn from heights: slopes
bend the light, hollows are darker, and what stands out shines. Threads are about ten times as thick
as real ones, so that a picture of a few hundred pixels shows them.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from functools import cache, lru_cache
from types import MappingProxyType
from typing import Any

import numpy as np

from drapery.arrays import Texels
from drapery.elementary import sine_of_turns
from drapery.mesh import Array
from drapery.render.scene import Material, SurfaceDetail
from drapery.style.edges import (
    blanket_stitch,
    cut,
    drawn_thread,
    hem,
    pared,
    rolled,
    selvage,
)
from drapery.style.surface import Surface, noise, smoothstep
from drapery.style.uv_mapping import Rect, UVMapping

SIDE = 256
"""Side of a tile [texels of it]; periods of weaves divide it."""
PITCH = 384
"""Texels of a tile along a metre of cloth: 16 for each texel of a flag."""


@dataclass(frozen=True)
class Finish:
    """The look of a fabric.

    surface: draws its tile. sides, ends: draw the strips along its upright and its level edges; see
    `edges`. All else: see `SurfaceDetail`.
    """

    surface: Callable[[], Surface]
    sides: Callable[[], Surface]
    ends: Callable[[], Surface]
    gloss: float = 0.0
    across: float = 0.0
    along: float = 0.0
    sharpness: int = 3
    fuzz: float = 0.0


def twill() -> Surface:
    """Wool: ribs that run up to the right, under a nap of short fibres."""
    y, x = _places()
    rib = 0.5 + 0.5 * sine_of_turns((x + y) * (28 / SIDE) + 0.15 * _clouds(16, 1))
    nap, clouds = _strands(6, 2), _clouds(16, 4)
    height = 0.6 * rib + 1.3 * nap
    tone = 0.08 * (rib - 0.5) + 0.16 * (nap - 0.5) + 0.12 * (clouds - 0.5)
    return Surface(height, tone, np.ones_like(rib))


def plain_weave(width: int, depth: float, uneven: float, slub: float, seed: int) -> Surface:
    """Threads that go over one and under the next.

    width: of a thread [texels of the tile]. depth: how much darker the gaps are. uneven: how much
    threads differ in tone. slub: by how much they are thicker at some places [texels of the tile].
    """
    y, x = _places()
    column, row = x // width, y // width
    upright = (column + row) % 2 == 0
    across, along = np.where(upright, (x, y), (y, x)) % width
    bulge = _bulge(across, width) * (0.55 + 0.45 * _bulge(along, width))
    own = noise((2, SIDE // width), seed)
    thread = np.where(upright, own[0][column], own[1][row]) - 0.5
    warp, weft = _streaks(width, seed + 1), _streaks(width, seed + 2).T
    swollen = np.where(upright, warp, weft) - 0.5
    tone = depth * (bulge - 0.6) + uneven * (thread + swollen)
    return Surface(0.25 * width * bulge + slub * swollen, tone, 0.3 + 0.7 * bulge)


def satin() -> Surface:
    """Silk: fine level threads that float over many others, some of them thicker."""
    y, _ = _places()
    threads, slubs = _streaks(2, 11).T, _streaks(4, 12).T
    fine = 0.5 + 0.5 * sine_of_turns(y / 4)
    height = 0.3 * fine + 0.35 * threads + 0.3 * slubs
    tone = 0.05 * (threads - 0.5) + 0.05 * (slubs - 0.5) + 0.03 * (fine - 0.5)
    return Surface(height, tone, 0.6 + 0.25 * threads + 0.15 * slubs)


def matted() -> Surface:
    """Felt: short fibres in all directions, and clouds where they are denser."""
    fibres, knots, clouds = _strands(9, 21), _clouds(8, 23), _clouds(16, 22)
    tone = 0.24 * (fibres - 0.5) + 0.10 * (knots - 0.5) + 0.16 * (clouds - 0.5)
    return Surface(1.6 * fibres + 1.2 * knots, tone, np.ones_like(tone))


def grain() -> Surface:
    """Leather: pebbles of uneven size between creases, and patches that are worn smooth."""
    patches = _clouds(64, 33)
    pebble = smoothstep(_cells(8, 31) / 4)
    small = smoothstep(_cells(4, 32) / 2)
    height = 1.3 * pebble + 0.4 * small
    tone = 0.20 * (pebble - 0.7) + 0.04 * (small - 0.7) + 0.14 * (patches - 0.5)
    return Surface(height, tone, (0.25 + 0.75 * pebble) * (0.5 + 0.5 * patches))


def both(draw: Callable[[], Surface]) -> tuple[Callable[[], Surface], Callable[[], Surface]]:
    """The same strip for upright and level edges."""
    return draw, draw


FINISHES: Mapping[str, Finish] = MappingProxyType(
    {
        "wool": Finish(twill, *both(lambda: blanket_stitch(13, 16)), fuzz=0.3),
        "cotton": Finish(
            lambda: plain_weave(4, 0.20, 0.07, 0.2, 41),
            *both(lambda: hem(14, (10.5,), 6, 2, 1.4, depth=1.8)),
        ),
        "linen": Finish(
            lambda: plain_weave(4, 0.26, 0.22, 1.2, 51),
            lambda: selvage(10, 3, 8, 52),
            lambda: drawn_thread(16, 7, 8),
            gloss=0.10,
            sharpness=2,
        ),
        "silk": Finish(
            satin,
            lambda: selvage(8, 2, 4, 13),
            lambda: rolled(7, 8),
            gloss=0.55,
            across=0.7,
            sharpness=5,
        ),
        "canvas": Finish(
            lambda: plain_weave(8, 0.34, 0.08, 0.3, 61),
            *both(lambda: hem(24, (5.0, 18.0), 12, 4, 2.0, depth=3.0)),
        ),
        "leather": Finish(grain, *both(lambda: pared(34)), gloss=0.55, sharpness=4),
        "felt": Finish(matted, *both(lambda: cut(24)), fuzz=0.7),
    }
)
"""By the names of fabrics; see `drapery.cloth.FABRICS`."""


def finished(
    material: Material,
    fabric: str,
    transmission: float,
    mapping: UVMapping,
    size: tuple[float, float],
) -> Material:
    """A material with the look of a fabric.

    fabric: a name of `FINISHES`. transmission: see `Material`.
    mapping: where the cloth lies on its texture. size: width and height of the cloth [m].
    """
    detail = _detail(fabric, mapping, size)
    return replace(material, detail=detail, transmission=transmission)


@lru_cache(maxsize=32)
def _detail(fabric: str, mapping: UVMapping, size: tuple[float, float]) -> SurfaceDetail:
    """The same object for the same cloth, by which tables of materials are found again."""
    look, ends = FINISHES[fabric], np.array([[0.0, 0.0], [1.0, 1.0]])
    front, back = mapping.front(ends), mapping.back(ends)
    across, down = np.abs(front[1] - front[0]) * SIDE / PITCH
    tile, strips = _texels(fabric)
    return SurfaceDetail(
        tile,
        (float(size[0] / across), float(size[1] / down)),
        gloss=look.gloss,
        across=look.across,
        along=look.along,
        sharpness=look.sharpness,
        fuzz=look.fuzz,
        strips=strips,
        edges=(_rect(front), _rect(back)),
    )


def _rect(ends: Array) -> Rect:
    left, top, right, bottom = map(float, (*ends.min(axis=0), *ends.max(axis=0)))
    return left, top, right, bottom


@cache
def _texels(name: str) -> tuple[Texels, Texels]:
    """The tile of a fabric and its strips, see `SurfaceDetail`."""
    look = FINISHES[name]
    drawn = look.surface()
    level = replace(drawn, tone=drawn.tone - drawn.tone.mean())
    strips = [draw().texels(wraps=False) for draw in (look.sides, look.ends)]
    return level.texels(), np.stack(strips)


def _places() -> Any:
    """Row and column of each texel."""
    return np.indices((SIDE, SIDE))


def _bulge(place: Array, width: int) -> Array:
    """The height 0..1 of a round thread at a place across its width."""
    bulge: Array = np.clip(sine_of_turns((place + 0.5) / (2 * width)), 0, 1)
    return bulge


def _clouds(cell: int, seed: int) -> Array:
    """Noise 0..1 that changes over `cell` texels and repeats after SIDE."""
    count = max(1, SIDE // cell)
    return _lattice(noise((count, count), seed))


def _streaks(width: int, seed: int) -> Array:
    """Noise 0..1 in upright stripes of a width, that changes slowly along them."""
    stripes = noise((SIDE // 32, SIDE // width), seed)
    along = _lattice(stripes, columns=False)
    return along[:, np.arange(SIDE) // width]


def _lattice(corners: Array, columns: bool = True) -> Array:
    """Values on a lattice that repeats, blended by smoothstep to SIDE rows, and columns."""
    blend = _blended(corners)
    return _blended(blend.T).T if columns else blend


def _blended(corners: Array) -> Array:
    at = np.arange(SIDE) * (len(corners) / SIDE)
    low = at.astype(int)
    part = at - low
    share = smoothstep(part)[:, None]
    blend: Array = (1 - share) * corners[low] + share * corners[(low + 1) % len(corners)]
    return blend


def _strands(length: int, seed: int) -> Array:
    """Noise 0..1 of short fibres in eight directions."""
    total = np.zeros((SIDE, SIDE))
    for number, (down, right) in enumerate(_DIRECTIONS):
        grains = noise((SIDE, SIDE), seed + number)
        fibres = sum(
            np.roll(grains, (k * down // 2, k * right // 2), (0, 1)) for k in range(length)
        )
        # Of the same spread for every length: the sum of random numbers grows as its root.
        total = np.maximum(total, 0.5 + (fibres / length - 0.5) * np.sqrt(length))
    return np.clip((total - 0.55) / 0.9, 0, 1)


def _cells(size: int, seed: int) -> Array:
    """How far each texel is from the edge of its cell [texels]; cells are about `size` wide.

    Steven Worley, "A cellular texture basis function" (SIGGRAPH 1996): a point in each square of a
    lattice, and the distances to the nearest and to the second of them.
    """
    count = SIDE // size
    side = SIDE / count
    points = noise((2, count, count), seed) * 0.8 + 0.1
    y, x = _places()
    row, column = (y / side).astype(int), (x / side).astype(int)
    first = np.full((SIDE, SIDE), np.inf)
    second = first.copy()
    for down in (-2, -1, 0, 1, 2):
        for right in (-2, -1, 0, 1, 2):
            r, c = row + down, column + right
            py = (r + points[0][r % count, c % count]) * side - y
            px = (c + points[1][r % count, c % count]) * side - x
            far = py * py + px * px
            second = np.minimum(second, np.maximum(first, far))
            first = np.minimum(first, far)
    edge: Array = np.sqrt(second) - np.sqrt(first)
    return edge


_DIRECTIONS = ((0, 2), (1, 2), (2, 2), (2, 1), (2, 0), (2, -1), (2, -2), (1, -2))
"""Two steps along a fibre, down and to the right."""
