"""The grain of wood, for the banner's pole and bar."""

import numpy as np

from assets.drawing.canvas import BAR, POLE, TexelRect, Texels, TextureBox, put
from assets.drawing.noise import Field, grid, scatter

TONES = ((66, 46, 26), (84, 60, 34), (102, 75, 44), (119, 90, 54), (137, 107, 67))
"""Colours from a dark joint to a light planed face."""

OUTLINE = -1
"""Added to the tone where the wood ends."""


def grain(width: int, height: int, seed: int) -> Field:
    """Tones 1 to 3 in upright streaks of four to seven texels, shape [height, width]."""
    x, y = grid(width, height)
    run = 4 + scatter(x, 0 * x, seed) % 4
    streak = (y + scatter(x, 0 * x, seed + 1) % run) // run
    return 1 + scatter(x, streak, seed + 2) % 3


def in_wood(tones: Field) -> Texels:
    """Opaque texels of wood for tone numbers, clamped to the palette."""
    palette = np.array([(*tone, 255) for tone in TONES], np.uint8)
    return palette[np.clip(tones, 0, len(TONES) - 1)]


def _rings(width: int, height: int) -> Field:
    """A cut end: light wood within a darker rim, for caps of a couple of texels across."""
    x, y = grid(width, height)
    return 2 + (x + y) % 2


def _put_tones(sheet: Texels, region: TexelRect, tones: Field) -> None:
    put(sheet, region, in_wood(tones))


def paint_pole(sheet: Texels, pole: TextureBox = POLE) -> None:
    """Upright grain; each side is lighter on its left; the ends are darker."""
    around = pole.sides
    tones = grain(around.width, around.height, seed=11)
    tones[:, ::2] += 1
    tones[0] += OUTLINE
    tones[-2:] += OUTLINE
    _put_tones(sheet, around, tones)
    for cap in (pole.top, pole.bottom):
        _put_tones(sheet, cap, _rings(cap.width, cap.height))


def paint_bar(sheet: Texels, bar: TextureBox = BAR) -> None:
    """Grain along the bar, lighter above than below; cut ends on its short sides."""
    for seed, region in enumerate((bar.front, bar.back, bar.top, bar.bottom), start=21):
        tones = grain(region.height, region.width, seed).T.copy()
        tones[0] += 1
        tones[:, [0, -1]] += OUTLINE
        _put_tones(sheet, region, tones)
    for cut in (bar.left, bar.right):
        _put_tones(sheet, cut, _rings(cut.width, cut.height))
