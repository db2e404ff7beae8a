"""The art of a stack of packs as arrays: what each dye and each pattern shows on a face."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from drapery.arrays import Texels
from drapery.banner import (
    DYE_NAMES,
    DYES,
    FLAG_REGIONS,
    PATTERN_NAMES,
    Banner,
    Layer,
)
from drapery.packs import Packs

Levels = NDArray[np.int32]
"""8-bit channels in wider integers."""

Stack = tuple[int, tuple[tuple[int, int], ...]]
"""A base dye and layers of (pattern, dye), lowest first, all by index."""

HEIGHT, WIDTH = 40, 20
"""Texels of a face at the size of a 64 x 64 sheet."""

SIZE = HEIGHT * WIDTH * 3
"""Channels of a face; faces are flat, with the three channels of a texel side by side."""


@dataclass(frozen=True, eq=False)
class FaceArt:
    """What each dye and each pattern shows on a face.

    N is SIZE, P the number of patterns, D the number of dyes, 16 unless some are left out.
    patterns: their ids. bases: the undecorated face in each dye, [D, N].
    alpha: of each pattern, [P, N]. dyed: the colours of each pattern in each dye, [P, D, N].
    """

    patterns: tuple[str, ...]
    bases: Levels
    alpha: Levels
    dyed: Levels

    @property
    def dyes(self) -> int:
        """How many dyes there are."""
        return len(self.bases)

    def paint(self, base: int, layers: Sequence[tuple[int, int]]) -> Levels:
        """The face [N] of a base dye and layers of (pattern, dye), lowest first, all by index."""
        below: Levels = self.bases[base]
        for pattern, dye in layers:
            below = self.lay(pattern, dye, below)
        return below

    def lay(self, pattern: int, dye: int, below: Levels) -> Levels:
        """A face [..., N] with one more layer on it, rounded as `composite` does."""
        alpha = self.alpha[pattern]
        # An integer x is round(x / 255) of 255 below and above: x / 255 has no ties.
        mixed = alpha * self.dyed[pattern, dye] + (255 - alpha) * below
        return np.asarray((mixed + 127) // 255, np.int32)

    def banner(self, base: int, layers: Sequence[tuple[int, int]]) -> Banner:
        """The design of a base dye and layers of (pattern, dye), lowest first, all by index."""
        made = (Layer(self.patterns[pattern], DYE_NAMES[dye]) for pattern, dye in layers)
        return Banner(DYE_NAMES[base], tuple(made))

    @cached_property
    def darkest(self) -> Levels:
        """The least value that any stack of layers shows, [N]."""
        shown = np.where(self.alpha[:, None] > 0, self.dyed, 255).min(axis=(0, 1))
        return np.asarray(np.minimum(shown, self.bases.min(axis=0)), np.int32)

    @cached_property
    def brightest(self) -> Levels:
        """The greatest value that any stack of layers shows, [N]."""
        shown = np.where(self.alpha[:, None] > 0, self.dyed, 0).max(axis=(0, 1))
        return np.asarray(np.maximum(shown, self.bases.max(axis=0)), np.int32)


def read_art(packs: Packs, patterns: Sequence[str] = PATTERN_NAMES) -> FaceArt:
    """The art of a stack of packs. A pattern that shows nothing is left out, and so is `base`.

    Sheets of any size are sampled at the texels of a 64 x 64 sheet. Raises PackError.
    """
    plain, cloth = _front(packs.base_sheet()), _front(packs.sheet("base"))
    alpha = cloth[:, 3:]
    bases = (alpha * _dyed(cloth) + (255 - alpha) * plain[:, :3] + 127) // 255
    fronts = {name: _front(packs.sheet(name)) for name in patterns if name != "base"}
    fronts = {name: front for name, front in fronts.items() if front[:, 3].any()}
    return FaceArt(
        tuple(fronts),
        bases.reshape(len(DYES), SIZE),
        np.array([front[:, 3].repeat(3) for front in fronts.values()]).reshape(-1, SIZE),
        np.array([_dyed(front) for front in fronts.values()]).reshape(-1, len(DYES), SIZE),
    )


def _front(sheet: Texels) -> Levels:
    """The texels of the front, [HEIGHT * WIDTH, 4]."""
    return FLAG_REGIONS["front"].sample(sheet, 1).reshape(-1, 4).astype(np.int32)


def _dyed(front: Levels) -> Levels:
    """The colours of texels in all dyes, [16, HEIGHT * WIDTH, 3]."""
    dyes = np.array([dye.rgb for dye in DYES.values()], np.int32)
    coloured: Levels = (front[:, :3] * dyes[:, None] + 127) // 255
    return coloured
