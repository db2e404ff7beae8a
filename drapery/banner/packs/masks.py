"""Masks from before 1.15, told from present sheets by a vote of a pack's sheets.

Up to 1.14 a sheet was a mask: its red channel was the dye's alpha, and its own alpha only said
whether a texel was there. Masks are black and white and opaque. Present sheets are cut out by their
alpha, and gradients have many translucent texels. Single sheets of both kinds break these rules, so
all sheets of a pack decide together.
"""

from collections.abc import Iterable

import numpy as np

from drapery.arrays import Texels
from drapery.banner.packs.resampling import common_side, resize

MIN_SHARE = 32
"""A sheet votes if at least one in this many texels is black, or translucent."""

BLACK = 8
"""The brightest channel of a texel that counts as black."""


def are_masks(sheets: Iterable[Texels], *, default: bool) -> bool:
    """Whether most sheets of a pack look like masks; `default` where none or equally many do."""
    balance = sum(map(_vote, sheets))
    return balance > 0 if balance else default


def _vote(texels: Texels) -> int:
    """1 for a mask, -1 for a present sheet, 0 where it tells nothing."""
    alpha = texels[..., 3]
    opaque = alpha == 255
    brightest = texels[..., :3].max(axis=-1)
    black = int(np.count_nonzero(opaque & (brightest <= BLACK)))
    translucent = int(np.count_nonzero((alpha > 0) & ~opaque))
    if max(black, translucent) * MIN_SHARE < alpha.size:
        return 0
    if translucent >= black:
        return -1
    return 1 if (opaque & (brightest > BLACK) & _grey(texels)).any() else 0


def looks_like_mask(texels: Texels) -> bool:
    """Whether a newer sheet looks like an old mask: grey, with opaque black and opaque white."""
    alpha, red = texels[..., 3], texels[..., 0]
    if ((alpha > 0) & (alpha < 255)).any():
        return False
    shown = red[alpha > 0]
    has_both = bool((shown == 0).any() and (shown == 255).any())
    return has_both and bool((_grey(texels) | (alpha == 0)).all())


def from_mask(mask: Texels, base: Texels) -> Texels:
    """A sheet of the present kind that looks like a mask over a base: its colours, alpha from red.

    `common_side` gives its side.
    """
    side = common_side((len(mask), len(base)))
    shown = np.where(mask[..., 3] > 0, mask[..., 0], 0).astype(np.uint8)
    sheet = resize(base, side)
    sheet[..., 3] = resize(shown, side)
    sheet.setflags(write=False)
    return sheet


def _grey(texels: Texels) -> np.ndarray[tuple[int, ...], np.dtype[np.bool_]]:
    """Where the three channels are equal, shape [H, W]."""
    grey: np.ndarray[tuple[int, ...], np.dtype[np.bool_]] = (
        texels[..., :1] == texels[..., 1:3]
    ).all(axis=-1)
    return grey
