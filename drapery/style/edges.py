"""The edges of fabrics: hems with their seams, selvages, and cuts.

A strip lies along an edge, WIDE texels from the edge inwards and LONG along it, of the same pitch
as the tiles of `finish`. Its slopes and tones are added to those of the cloth. The shine of a strip
is the share of the cloth's own weave that shows; what covers the rest is smooth and shines fully.
The rim has the first column too.
"""

import numpy as np

from drapery.elementary import sine_of_turns
from drapery.mesh import Array
from drapery.render.detail import EDGE_LONG as LONG, EDGE_WIDE as WIDE
from drapery.style.surface import Surface, noise, smoothstep

AWAY = np.arange(WIDE)[None, :] + 0.5
"""Of each column from the edge [texels]."""
ALONG = np.arange(LONG)[:, None] + 0.5
"""Of each row from the strip's beginning [texels]."""


def hem(
    width: float, seams: tuple[float, ...], stitch: int, gap: int, thread: float, *, depth: float
) -> Surface:
    """Cloth that is turned in and sewn: a second layer, pressed flat, in which seams lie.

    width: of the second layer. seams: how far each is from the edge. stitch, gap: lengths along a
    seam; their sum divides LONG. thread: its width. depth: height of the second layer [all texels].
    """
    layer = _layer(width)
    height = depth * layer * np.ones_like(ALONG)
    tone = -0.34 * _ridge(width + 0.8, 2.2) - 0.14 * _ridge(width + 3, 5)
    tone, own = tone * np.ones_like(ALONG), (1 - 0.5 * layer) * np.ones_like(ALONG)
    place = ALONG % (stitch + gap)
    on = smoothstep((stitch / 2 + 0.5 - np.abs(place - stitch / 2)) / 1.2)
    for seam in seams:
        sewn = _ridge(seam, 1.3 * thread)
        # The thread pulls the layers together, so that it lies in a furrow.
        height = height - 0.6 * depth * _ridge(seam, 3.2 * thread) + 1.8 * on * sewn
        furrow = _ridge(seam - 1.3 * thread, thread) + _ridge(seam + 1.3 * thread, thread)
        tone = tone + (0.5 * on - 0.4 * (1 - on)) * sewn - 0.22 * furrow
        own = own * (1 - sewn)
    return Surface(height, tone, own)


def blanket_stitch(length: float, step: int) -> Surface:
    """A thick thread along the edge, and one from it inwards at each step, which divides LONG."""
    place = np.abs(ALONG % step - step / 2)
    spoke = smoothstep((2.3 - place) / 1.2) * smoothstep((length + 0.5 - AWAY) / 1.5)
    beside = smoothstep((4.2 - place) / 2) * smoothstep((length + 2.0 - AWAY) / 2)
    cord = smoothstep((3.6 - AWAY) / 1.4) * np.ones_like(ALONG)
    thread = np.maximum(spoke, cord)
    shadow = np.maximum(beside, smoothstep((5.8 - AWAY) / 2.2)) - thread
    return Surface(2.0 * thread - 0.6 * shadow, 0.42 * thread - 0.34 * shadow, 1 - thread)


def selvage(width: float, cords: int, loop: int, seed: int) -> Surface:
    """The edge at which the weft turns back: warp threads that lie close, in cords, and its loops.

    width: [texels]. cords: how many lie side by side. loop: from one loop to the next, which
    divides LONG [texels].
    """
    within = smoothstep((width - AWAY) / 1.5) * np.ones_like(ALONG)
    cord = np.clip(sine_of_turns(AWAY * (cords / (2 * width)) % 0.5), 0, 1)
    loops = 0.5 + 0.5 * sine_of_turns(ALONG / loop)
    turn = smoothstep((3 - AWAY) / 2.5) * (loops - 0.5)
    uneven = noise((LONG // loop, 1), seed).repeat(loop, axis=0) - 0.5
    height = within * (1.6 * cord + 0.5 * loops * cord) + 1.2 * turn
    tone = within * (0.36 * (cord - 0.5) + 0.10 * uneven) + 0.36 * turn
    return Surface(height, tone - 0.30 * _ridge(width + 0.6, 1.8), 1 - within)


def rolled(width: float, step: int) -> Surface:
    """A thin hem that is rolled in and whipped with slanting stitches.

    width: of the roll. step: from one stitch to the next, which divides LONG [texels].
    """
    roll = np.clip(sine_of_turns(np.clip(AWAY / width, 0, 1) / 2), 0, 1) * np.ones_like(ALONG)
    slant = np.abs((ALONG + 0.6 * AWAY) % step - step / 2)
    pinch = smoothstep((1.6 - slant) / 1.0) * smoothstep((width + 2 - AWAY) / 2)
    tone = 0.10 * roll - 0.34 * _ridge(width + 0.8, 2.2) - 0.34 * pinch
    return Surface(0.42 * width * roll - 0.9 * pinch, tone, 1 - roll)


def drawn_thread(width: float, holes: float, step: int) -> Surface:
    """A hem at a ladder of holes, where threads were drawn out and the others tied in bundles.

    width: of the second layer. holes: their length. step: from one to the next, which divides LONG.
    """
    place = np.abs(ALONG % step - step / 2)
    middle = width + holes / 2
    open_part = smoothstep((holes / 2 + 0.6 - np.abs(AWAY - middle)) / 1.2)
    # A bundle is tied at the hem and spreads on its other side.
    spread = 0.30 * step * (0.8 + 0.3 * (AWAY - middle) / holes)
    hole = open_part * smoothstep((spread - place) / 1.2)
    bundle = open_part * np.ones_like(ALONG) - hole
    layer = _layer(width) * np.ones_like(ALONG)
    tone = -0.70 * hole + 0.16 * bundle - 0.26 * _ridge(width - 1.0, 1.8)
    return Surface(1.5 * layer + 1.2 * bundle - 0.8 * hole, tone, 1 - 0.4 * layer - open_part)


def pared(seed: int) -> Surface:
    """A cut that is bevelled, burnished smooth and creased, as of leather."""
    bevel = smoothstep(AWAY / 5) * np.ones_like(ALONG)
    burnished = smoothstep((6 + 2 * (_along(16, seed) - 0.5) - AWAY) / 5)
    crease = _ridge(9, 1.8)
    tone = -0.48 * burnished - 0.42 * crease + 0.20 * _ridge(11, 1.6)
    own = smoothstep((AWAY - 9) / 3) * np.ones_like(ALONG)
    return Surface(2.4 * bevel - 1.4 * crease, tone * np.ones_like(ALONG), own)


def cut(seed: int) -> Surface:
    """A cut of matted fibres: uneven, thin and lighter where they come loose."""
    reach = 3.0 + 7.0 * _along(4, seed) + 4.0 * _along(16, seed + 1)
    loose = smoothstep((reach - AWAY) / 4)
    fibres = noise((LONG, WIDE), seed + 2)
    fibres = (fibres + np.roll(fibres, 1, 1) + np.roll(fibres, 2, 1)) / 3
    tone = loose * (0.22 + 0.9 * (fibres - 0.5))
    return Surface(-2.2 * loose + 2.4 * loose * (fibres - 0.5), tone, 1 - 0.6 * loose)


def _layer(width: float) -> Array:
    """1 on a layer that is round at the edge, 0 beyond its width; shape [1, WIDE]."""
    return smoothstep((AWAY + 1) / 4) * smoothstep((width + 0.6 - AWAY) / 1.6)


def _ridge(place: float, width: float) -> Array:
    """A line along the edge: 1 in its middle, 0 beside it; shape [1, WIDE]."""
    return smoothstep(1 - np.abs(AWAY - place) / width)


def _along(cell: int, seed: int) -> Array:
    """Noise 0..1 that changes along the edge over `cell` texels; shape [LONG, 1]."""
    corners = noise((LONG // cell, 1), seed)
    at = np.arange(LONG)
    low, share = at // cell, smoothstep((at % cell)[:, None] / cell)
    blend: Array = (1 - share) * corners[low] + share * corners[(low + 1) % len(corners)]
    return blend
