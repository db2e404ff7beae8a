"""What can lie below the layers of a face: intervals of colours, and the layers that fit on top.

A layer of alpha a and colour s shows f(c) = round((a s + (255 - a) c) / 255) over a colour c. It
never falls as c rises, so the colours c whose f(c) lies in an interval are an interval again: none
where no c fits, and every colour below an opaque texel.
"""

from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from drapery.match.art import SIZE, FaceArt, Levels

Bytes = NDArray[np.uint8]
Indices = NDArray[np.intp]

_TEXELS = SIZE // 3
_SCREEN = 240
"""Channels that are compared first; most layers fail there."""

_SHOWN = 6
"""A dye counts as shown if at least this many texels have its colour and no other dye's."""

_STRIDE = 301
"""Texels are compared in steps of this many, so that the first ones lie all over the face."""

_DYES = 16

_INFORMATION = np.round(16 * np.log2(256 / np.arange(1, 257))).astype(np.int32)
"""How much is known of a channel whose interval spans 0, 1, 2, ... steps [1/16 bit]."""


@dataclass(frozen=True, eq=False)
class Below:
    """What is known of the colours below some layers: they lie from `low` to `high`, [..., N].

    owners: the dye whose plain colour each texel must show, [..., N / 3]; 16 where any may be.
    """

    low: Bytes
    high: Bytes
    owners: Bytes

    def __getitem__(self, index: int | np.integer[Any] | Indices) -> "Below":
        return Below(self.low[index], self.high[index], self.owners[index])

    @property
    def known(self) -> Levels:
        """How much is known of each stack, [...], in sixteenths of a bit."""
        return np.asarray(_INFORMATION[self.high - self.low].sum(axis=-1), np.int32)


@dataclass(frozen=True, eq=False)
class Peeled:
    """Layers that can be the top one, those that explain most first, and what is below each.

    tops: their numbers, [m]. below: [m, ...]. base: of the first one, if a base alone fits below.
    """

    tops: Indices
    below: Below
    base: int | None = None


@dataclass(frozen=True, eq=False)
class PeelTables:
    """What each layer needs and leaves when it is taken off a face, for one `FaceArt`.

    Layers are numbered 16 pattern + dye. Channels are in an order in which the first ones lie all
    over the face, so that layers that do not fit fail early.
    """

    art: FaceArt

    @cached_property
    def _order(self) -> Indices:
        texels = np.arange(_TEXELS) * _STRIDE % _TEXELS
        return (texels[:, None] * 3 + np.arange(3)).reshape(-1)

    @cached_property
    def _bases(self) -> Bytes:
        return self.art.bases[:, self._order].astype(np.uint8)

    @cached_property
    def _alpha(self) -> Levels:
        return self.art.alpha[:, self._order]

    @cached_property
    def _dyed(self) -> Levels:
        return self.art.dyed[:, :, self._order].reshape(-1, SIZE)

    @cached_property
    def _hull(self) -> Below:
        """The colours that any stack of layers may show."""
        low, high = self.art.darkest[self._order], self.art.brightest[self._order]
        unknown = np.full(_TEXELS, _DYES, np.uint8)
        return Below(low.astype(np.uint8), high.astype(np.uint8), unknown)

    @cached_property
    def _range(self) -> tuple[Bytes, Bytes]:
        """The least and the greatest value that each layer shows over any stack, [P 16, N]."""
        alpha = self._alpha.repeat(_DYES, axis=0)
        added = alpha * self._dyed + 127
        least = (added + (255 - alpha) * self._hull.low) // 255
        greatest = (added + (255 - alpha) * self._hull.high) // 255
        return least.astype(np.uint8), greatest.astype(np.uint8)

    @cached_property
    def _opaque(self) -> NDArray[np.bool_]:
        return np.asarray(self._alpha == 255)

    @cached_property
    def _translucent(self) -> list[Indices]:
        """The channels of the translucent texels of each pattern."""
        return [np.flatnonzero((row > 0) & (row < 255)) for row in self._alpha]

    @cached_property
    def commuting(self) -> NDArray[np.bool_]:
        """Whether layers of two patterns may be taken off in either order, [P, P]."""
        some = (self._alpha > 0).astype(np.int32)
        part = some - self._opaque
        clash = part @ some.T > 0
        return np.asarray(~(clash | clash.T))

    def start(self, face: Levels, tolerance: int, counts: NDArray[np.bool_]) -> Below:
        """What is known of a face [N] whose channels may be off by a tolerance.

        counts: the texels of which something is known, [N / 3].
        """
        counts = counts.repeat(3)[self._order]
        shown = face[self._order].astype(np.int32)
        low = np.clip(shown - tolerance, 0, 255).astype(np.uint8)
        high = np.clip(shown + tolerance, 0, 255).astype(np.uint8)
        low, high = np.where(counts, low, self._hull.low), np.where(counts, high, self._hull.high)
        return Below(low, high, self._owners(low, high, np.arange(_TEXELS)))

    def _owners(self, low: Bytes, high: Bytes, texels: Indices) -> Bytes:
        """The dye of each texel whose interval holds the plain colour of one dye only."""
        plain = self._bases.reshape(_DYES, _TEXELS, 3)[:, texels]
        low, high = low.reshape(-1, 3), high.reshape(-1, 3)
        fits = ((plain >= low) & (plain <= high)).all(axis=2)
        return np.where(fits.sum(axis=0) == 1, fits.argmax(axis=0), _DYES).astype(np.uint8)

    def base(self, below: Below) -> int | None:
        """The first base that may lie below, or None."""
        fits = ((self._bases >= below.low) & (self._bases <= below.high)).all(axis=1)
        return int(fits.argmax()) if fits.any() else None

    def peel(self, below: Below, layers: int) -> Peeled:
        """Take off each layer that can be the top one of `layers` layers.

        Layers are left out if another one leaves intervals that contain theirs, or if too many dyes
        show below them. If a base fits below one of them, that one is the only one.
        """
        tops, under = self._take_off(below, self._tops(below))
        found = self._base_of_any(under)
        if found is not None:
            index, base = found
            return Peeled(tops[[index]], under[np.array([index])], base)
        few = np.flatnonzero(least_layers(under.owners) < layers)
        tops, under = tops[few], under[few]
        widest = self._widest(under)
        return Peeled(tops[widest], under[widest])

    def _base_of_any(self, below: Below) -> tuple[int, int] | None:
        """The first of many stacks that may be a base alone, and that base."""
        part, bases = slice(_SCREEN), self._bases[:, None, :_SCREEN]
        may = ((bases >= below.low[:, part]) & (bases <= below.high[:, part])).all(axis=2)
        for index in np.flatnonzero(may.any(axis=0)):
            base = self.base(below[index])
            if base is not None:
                return int(index), base
        return None

    def _tops(self, below: Below) -> Indices:
        """The layers (16 pattern + dye) that may be the top one; those that explain most first."""
        least, greatest = self._range
        part = slice(_SCREEN)
        may = (least[:, part] <= below.high[part]) & (greatest[:, part] >= below.low[part])
        tops = np.flatnonzero(may.all(axis=1))
        fits = (least[tops] <= below.high) & (greatest[tops] >= below.low)
        tops = tops[fits.all(axis=1)]
        patterns = np.unique(tops // _DYES)
        scores = np.zeros(len(self._alpha), np.int64)
        scores[patterns] = self._alpha[patterns] @ _INFORMATION[below.high - below.low]
        tops = tops[scores[tops // _DYES] > 0]
        return tops[np.argsort(-scores[tops // _DYES], kind="stable")]

    def _take_off(self, below: Below, tops: Indices) -> tuple[Indices, Below]:
        """Those layers that can be the top one, and what is below each."""
        patterns = tops // _DYES
        opaque = self._opaque[patterns]
        low = np.where(opaque, self._hull.low, below.low)
        high = np.where(opaque, self._hull.high, below.high)
        owners = np.where(opaque[:, ::3], np.uint8(_DYES), below.owners)
        parts = [self._translucent[pattern] for pattern in patterns]
        columns = np.concatenate([np.zeros(0, np.intp), *parts])
        rows = np.arange(len(tops)).repeat([len(part) for part in parts])
        alpha = self._alpha[patterns[rows], columns]
        rest, added = 255.0 - alpha, alpha * self._dyed[tops[rows], columns]
        least = np.ceil((255 * below.low[columns].astype(np.int32) - 127 - added) / rest)
        most = np.floor((255 * below.high[columns].astype(np.int32) + 127 - added) / rest)
        least = np.maximum(least, self._hull.low[columns])
        most = np.minimum(most, self._hull.high[columns])
        possible = np.ones(len(tops), np.bool_)
        possible[rows[least > most]] = False
        low[rows, columns], high[rows, columns] = least % 256, most % 256
        texels = columns[::3] // 3
        owners[rows[::3], texels] = self._owners(least, most, texels)
        kept = np.flatnonzero(possible)
        return tops[kept], Below(low, high, owners)[kept]

    def _widest(self, below: Below) -> Indices:
        """The stacks whose intervals are not within those of another one."""
        known = (below.low != self._hull.low) | (below.high != self._hull.high)
        bits = np.packbits(known, axis=1).view(np.uint32)
        within = np.asarray(~(bits[:, None] & ~bits[None]).any(axis=2))
        np.fill_diagonal(within, False)
        gone = np.zeros(len(bits), np.bool_)
        for inner in range(len(bits)):
            outer = np.flatnonzero(within[:, inner] & ~gone)
            contains = (below.low[outer] <= below.low[inner]).all(axis=1)
            contains &= (below.high[outer] >= below.high[inner]).all(axis=1)
            gone[inner] = contains.any()
        return np.flatnonzero(~gone)


def least_layers(owners: Bytes) -> Indices:
    """The fewest layers over a base that show all plain dyes of stacks [m, N / 3]."""
    counts = (owners[:, None] == np.arange(_DYES, dtype=np.uint8)[:, None]).sum(axis=2)
    least: Indices = np.maximum((counts >= _SHOWN).sum(axis=1) - 1, 0)
    return least
