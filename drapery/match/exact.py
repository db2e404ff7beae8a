"""The design of a given face, texel for texel, by taking layers off from the top.

A depth-first search takes layers off until one of the sixteen bases fits, and so finds every design
of a face; these facts keep it short:

- If the intervals below layer A contain those below layer B, every stack below B fits below A, and
  B need not be tried.
- Two layers that may be taken off in either order are taken off in one order only ("sleep sets":
  Godefroid, Partial-Order Methods for the Verification of Concurrent Systems, LNCS 1032, 1996).
- Each plain dye that still shows takes one layer, or the base.

It is repeated with one more layer each time, so the first design is the shortest. If it takes too
long, a beam search takes layers off instead: it keeps the stacks of which the least is known.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from drapery.match.art import FaceArt, Levels, Stack
from drapery.match.peel import Below, PeelTables, least_layers

_DYES = 16
_DEEPEST = 6
"""The most layers of the depth-first search."""

_BUDGET, _SMALL_BUDGET = 400, 60
"""How many stacks it peels for each number of layers; the second, if more layers are allowed."""

_BEAMS = (10, 40)
"""How many stacks the beam searches keep."""


class ExactSearch:
    """Searches exact designs in one `FaceArt`, whose tables it keeps."""

    def __init__(self, art: FaceArt) -> None:
        self._tables = PeelTables(art)

    def find(
        self,
        face: Levels,
        layers: int,
        *,
        tolerance: int = 0,
        counts: NDArray[np.bool_] | None = None,
        on_step: Callable[[], object] = lambda: None,
    ) -> Stack | None:
        """The stack whose face is a given one [N], or None if none is found.

        layers: the most layers. tolerance: how far each channel may be off. counts: the texels that
        must be the same, [N / 3]; None is all. on_step: called for each stack that is peeled; an
        exception that it raises ends the search.
        """
        every = np.ones(len(face) // 3, np.bool_)
        start = self._tables.start(face, tolerance, every if counts is None else counts)
        base = self._tables.base(start)
        if base is not None:
            return base, ()
        budget = _BUDGET if layers <= _DEEPEST else _SMALL_BUDGET
        for count in range(1, min(layers, _DEEPEST) + 1):
            found = _DepthFirst(self._tables, on_step, budget).search(start, count, frozenset())
            if found is not None:
                return found
        for width in _BEAMS:
            found = _beam(self._tables, start, layers, width, on_step)
            if found is not None:
                return found
        return None


@dataclass
class _DepthFirst:
    """One depth-first search. budget: how many stacks it may still peel."""

    tables: PeelTables
    on_step: Callable[[], object]
    budget: int

    def search(self, below: Below, layers: int, asleep: frozenset[int]) -> Stack | None:
        """The stack that fits below, or None.

        layers: the most of them. asleep: layers that were tried before in another order.
        """
        if layers == 0 or self.budget <= 0 or least_layers(below.owners[None])[0] > layers:
            return None
        self.budget -= 1
        self.on_step()
        peeled = self.tables.peel(below, layers)
        tops = peeled.tops.tolist()
        if peeled.base is not None:
            return peeled.base, (divmod(tops[0], _DYES),)
        for number, top in enumerate(tops):
            if top in asleep or layers == 1:
                continue
            commuting = self.tables.commuting[top // _DYES]
            earlier = asleep.union(tops[:number])
            sleeping = frozenset(other for other in earlier if commuting[other // _DYES])
            found = self.search(peeled.below[number], layers - 1, sleeping)
            if found is not None:
                return found[0], (*found[1], divmod(top, _DYES))
        return None


def _beam(
    tables: PeelTables, start: Below, layers: int, width: int, on_step: Callable[[], object]
) -> Stack | None:
    """The stack that fits, or None; after each layer the `width` least known stacks are kept."""
    stacks: list[tuple[Below, tuple[tuple[int, int], ...]]] = [(start, ())]
    for more in range(layers, 0, -1):
        grown: dict[bytes, tuple[Below, tuple[tuple[int, int], ...]]] = {}
        for below, above in stacks:
            if least_layers(below.owners[None])[0] > more:
                continue
            on_step()
            peeled = tables.peel(below, more)
            if peeled.base is not None:
                return peeled.base, (divmod(int(peeled.tops[0]), _DYES), *above)
            for number, top in enumerate(peeled.tops.tolist()):
                one = peeled.below[number]
                key = one.low.tobytes() + one.high.tobytes()
                grown.setdefault(key, (one, (divmod(top, _DYES), *above)))
        every = list(grown.values())
        known = np.array([one.known for one, _ in every])
        stacks = [every[place] for place in np.argsort(known, kind="stable")[:width]]
    return None
