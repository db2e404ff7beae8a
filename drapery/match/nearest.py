"""The designs that look most like a given face: a beam of stacks, then layer by layer descent.

A stack of layers shows A + h c at a texel: c is one layer's colour over what is below it, A and h
what the layers above add and let through. For one layer, the others held, the errors of all
patterns in all dyes are sums of few distances: opaque texels show a plain dye, whatever is below,
and all patterns share most of these; only translucent texels depend on the pattern too.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from drapery.match.art import SIZE, FaceArt, Levels, Stack
from drapery.match.colours import PERCEIVED, Floats, Metric, Whole

Totals = NDArray[np.int64]

_TEXELS = SIZE // 3
_HARDLY = 0.005
"""A layer is left out if the error grows by no more than this share of it."""
_SWEEPS = 6
"""The most times that descent goes over all layers of a stack."""
_UNKNOWN = 600
"""What a texel costs as long as no layer is known that hides what is below, as a distance."""


@dataclass(frozen=True, eq=False)
class _Parts:
    """The texels of all patterns, those of each pattern side by side.

    colours: [n, D, 3], of each entry in each dye, times its alpha. clear: 1 less its alpha, [n].
    texels: of each entry, [n].
    entries: which entries each pattern has, [m]. starts: where the entries of each pattern begin.
    """

    colours: Floats
    clear: Floats
    texels: NDArray[np.intp]
    entries: NDArray[np.intp]
    starts: NDArray[np.intp]

    def within(self, chosen: NDArray[np.bool_]) -> "_Parts":
        """Those at some of the texels, [N / 3]."""
        used = chosen[self.texels]
        if used.all():
            return self
        kept = used[self.entries]
        entries = (np.cumsum(used) - 1)[self.entries[kept]]
        starts = np.append(0, np.cumsum(kept))[self.starts]
        return _Parts(self.colours[used], self.clear[used], self.texels[used], entries, starts)

    def sums(self, values: Whole) -> Totals:
        """The sums over each pattern's entries of values [n, D], as [P, D]."""
        total = np.zeros((len(self.starts), values.shape[1]), np.int64)
        has = np.diff(self.starts, append=len(self.entries)) > 0
        if has.any():
            rows = values[self.entries]
            total[has] = np.add.reduceat(rows, self.starts[has], axis=0, dtype=np.int64)
        return total


@dataclass(frozen=True, eq=False)
class NearestSearch:
    """The tables of a search for the nearest designs in one `FaceArt`."""

    art: FaceArt

    @cached_property
    def _opaque(self) -> _Parts:
        """Opaque texels; patterns that show the same colours there share an entry."""
        rows, texels, starts = list[int](), list[int](), list[int]()
        colours = list[Levels]()
        known: dict[tuple[int, bytes], int] = {}
        for pattern, alpha in enumerate(self.art.alpha[:, ::3]):
            starts.append(len(rows))
            dyed = self.art.dyed[pattern].reshape(-1, _TEXELS, 3)
            for texel in np.flatnonzero(alpha == 255):
                key = (int(texel), dyed[:, texel].tobytes())
                if key not in known:
                    known[key] = len(known)
                    colours.append(dyed[:, texel])
                    texels.append(int(texel))
                rows.append(known[key])
        entries = np.array(rows, np.intp)
        made = np.array(colours, np.float32).reshape(-1, self.art.dyes, 3)
        clear = np.zeros(len(made), np.float32)
        return _Parts(made, clear, np.array(texels, np.intp), entries, np.array(starts, np.intp))

    @cached_property
    def _translucent(self) -> _Parts:
        """Translucent texels."""
        colours, clear, texels, starts, count = [], [], [], [], 0
        for pattern, alpha in enumerate(self.art.alpha[:, ::3]):
            starts.append(count)
            part = np.flatnonzero((alpha > 0) & (alpha < 255))
            dyed = self.art.dyed[pattern].reshape(-1, _TEXELS, 3)[:, part]
            colours.append(dyed.transpose(1, 0, 2) * (alpha[part] / 255)[:, None, None])
            clear.append(1 - alpha[part] / 255)
            texels.append(part)
            count += len(part)
        return _Parts(
            np.concatenate(colours).astype(np.float32),
            np.concatenate(clear).astype(np.float32),
            np.concatenate(texels),
            np.arange(count, dtype=np.intp),
            np.array(starts, np.intp),
        )

    @cached_property
    def _covered(self) -> NDArray[np.bool_]:
        """Where each pattern is opaque, [P, N / 3]."""
        return np.asarray(self.art.alpha[:, ::3] == 255)

    @cached_property
    def _alpha(self) -> Floats:
        return np.asarray(self.art.alpha[:, ::3, None] / 255, np.float32)

    def goal(
        self, face: NDArray[np.generic], weights: NDArray[np.generic], metric: Metric = PERCEIVED
    ) -> "Goal":
        """What is searched for: a face [N], and the weight of each texel [N / 3]."""
        target = metric.coordinates(np.asarray(face).reshape(_TEXELS, 3))
        return Goal(self, target, np.asarray(weights, np.int32).reshape(_TEXELS), metric)


@dataclass(frozen=True, eq=False)
class Goal:
    """A face that is searched for: its colours [N / 3, 3] and the weights of its texels.

    Errors are sums of weighted distances, whole numbers.
    """

    search: NearestSearch
    target: Floats
    weights: Whole
    metric: Metric

    @cached_property
    def _parts(self) -> tuple[_Parts, _Parts]:
        """The opaque and the translucent texels of patterns that count."""
        counts = self.weights > 0
        return self.search._opaque.within(counts), self.search._translucent.within(counts)

    def error(self, stack: Stack) -> int:
        """Of the face that a stack of layers shows."""
        face = self.search.art.paint(*stack).reshape(_TEXELS, 3)
        apart = self.metric.distances(self.metric.coordinates(face), self.target)
        return int((apart * self.weights).sum(dtype=np.int64))

    def bases(self, over: tuple[Floats, Floats] | None = None) -> Totals:
        """The errors of the bases below layers that add and let through `over`, [D]."""
        colours = self.search.art.bases.reshape(-1, _TEXELS, 3).astype(np.float32)
        added, through = over or _nothing()
        return np.asarray(
            self._errors(added + through * colours, slice(None)).sum(axis=1, dtype=np.int64)
        )

    def choices(
        self,
        below: Floats,
        over: tuple[Floats, Floats] | None = None,
        opaque: Totals | None = None,
    ) -> Totals:
        """The errors of all patterns in all dyes as one layer, the others held, [P, D].

        below: what is below the layer, [N / 3, 3]. over: what the layers above add [N / 3, 3], and
        let through [N / 3, 1]. opaque: the `opaque_errors` below `over`, if they are known.
        """
        added, through = over or _nothing()
        before = self._errors(added + through * below, slice(None))
        part = self._parts[1]
        # What is below shows through translucent texels.
        seen = part.colours + (part.clear[:, None] * below[part.texels])[:, None]
        seen *= through[part.texels, None]
        seen += added[part.texels, None]
        gained = self._errors(seen, part.texels)
        gained -= before[part.texels, None]
        total = part.sums(gained)
        total += self.opaque_errors(over) if opaque is None else opaque
        total += (~self.search._covered * before).sum(axis=1, dtype=np.int64)[:, None]
        return total

    def opaque_errors(self, over: tuple[Floats, Floats] | None = None) -> Totals:
        """The errors of the opaque texels of all patterns in all dyes, [P, D].

        They are the same whatever is below. over: as in `choices`.
        """
        added, through = over or _nothing()
        part = self._parts[0]
        seen = through[part.texels, None] * part.colours
        seen += added[part.texels, None]
        return part.sums(self._errors(seen, part.texels))

    def _errors(self, seen: Floats, texels: slice | NDArray[np.intp]) -> Whole:
        """Of colours [n, D, 3] at texels [n], or [..., N / 3, 3] at all of them."""
        target, weights = self.target[texels], self.weights[texels]
        if not isinstance(texels, slice):
            target, weights = target[:, None], weights[:, None]
        found = self.metric.distances(self.metric.quick_coordinates(seen), target)
        found *= weights
        return found

    def below(self, base: int, layers: Sequence[tuple[int, int]]) -> Floats:
        """What a base and layers show, [N / 3, 3]."""
        colour: Floats = self.search.art.bases[base].reshape(_TEXELS, 3).astype(np.float32)
        for pattern, dye in layers:
            colour = self.lay(pattern, dye, colour)
        return colour

    def lay(self, pattern: int, dye: int, below: Floats) -> Floats:
        """One more layer on top, [N / 3, 3]."""
        dyed = self.search.art.dyed[pattern, dye].reshape(_TEXELS, 3)
        return np.asarray(below + self.search._alpha[pattern] * (dyed - below), np.float32)

    def over(self, layers: Sequence[tuple[int, int]]) -> tuple[Floats, Floats]:
        """What layers add to what is below [N / 3, 3], and how much of it they let through."""
        added, through = _nothing()
        for pattern, dye in reversed(layers):
            alpha = self.search._alpha[pattern]
            dyed = self.search.art.dyed[pattern, dye].reshape(_TEXELS, 3)
            added = added + (through * alpha) * dyed
            through = through * (1 - alpha)
        return added.astype(np.float32), through.astype(np.float32)

    def grow(
        self, layers: int, width: int, above: Sequence[tuple[int, int]] = ()
    ) -> Iterator[list[Stack]]:
        """The `width` best stacks of 0, 1, 2, ... layers, each found from those before it.

        above: layers that lie on top of them, and are not part of what is returned.
        """
        over = self.over(above)
        # Only what shows through the layers above differs.
        goal = replace(self, weights=np.where(over[1][:, 0] > 0, self.weights, 0))
        errors = goal.bases(over)
        order = np.argsort(errors, kind="stable")
        stacks: list[Stack] = [(int(base), ()) for base in order]
        yield stacks
        opaque = goal.opaque_errors(over)
        for _ in range(layers):
            tables = [
                goal.choices(goal.below(*stack), over, opaque).reshape(-1) for stack in stacks
            ]
            grown: list[Stack] = []
            seen: set[int] = set()
            every = np.concatenate(tables)
            for place in np.argsort(every, kind="stable")[: 4 * width]:
                if int(every[place]) not in seen and len(grown) < width:
                    seen.add(int(every[place]))
                    number, choice = divmod(int(place), len(tables[0]))
                    base, below = stacks[number]
                    grown.append((base, (*below, divmod(choice, self.search.art.dyes))))
            stacks = grown
            yield stacks

    def regrown(self, stack: Stack, layers: int, width: int) -> Iterator[Stack]:
        """Stacks of at most `layers` layers that keep the top ones of a stack: 1, 2, 3, ... .

        What is below them is searched anew: it is easier to find once the layers that hide a part
        of it are known.
        """
        for kept in range(1, len(stack[1]) + 1):
            above = stack[1][len(stack[1]) - kept :]
            for stacks in self.grow(layers - kept, width, above):
                base, below = stacks[0]
                yield base, (*below, *above)

    def lowered(self, layers: int, width: int) -> Iterator[list[Stack]]:
        """The `width` best stacks of 1, 2, 3, ... layers, found from the top layer downwards.

        A layer is seen wherever no higher one hides it, so it can be told before those below it are
        known. A beam that grows upwards may lose one of which later layers hide much.
        """
        states: dict[int, tuple[tuple[int, int], ...]] = {0: ()}
        for _ in range(layers):
            found: dict[int, tuple[tuple[int, int], ...]] = {}
            for above in states.values():
                table = self._lower_choices(self.over(above)).reshape(-1)
                for place in np.argsort(table, kind="stable")[: 2 * width].tolist():
                    layer = divmod(place, self.search.art.dyes)
                    found.setdefault(int(table[place]), (layer, *above))
            states = {error: found[error] for error in sorted(found)[:width]}
            yield [(int(self.bases(self.over(above)).argmin()), above) for above in states.values()]

    def _lower_choices(self, over: tuple[Floats, Floats]) -> Totals:
        """The errors of all patterns in all dyes as the next layer below `over`, [P, D].

        Below that one each texel has the dye that suits it best, and costs _UNKNOWN more times how
        much of it is seen.
        """
        added, through = over
        colours = self.search.art.bases.reshape(-1, _TEXELS, 3).astype(np.float32)
        unknown = (_UNKNOWN * through[:, 0] * self.weights).astype(np.int32)
        before = self._errors(added + through * colours, slice(None)).min(axis=0) + unknown
        part = self._parts[1].within(through[:, 0] > 0)
        texels = part.texels
        layer = added[texels, None] + through[texels, None] * part.colours
        clear = through[texels] * part.clear[:, None]
        gained = np.full(layer.shape[:2], np.iinfo(np.int32).max, np.int32)
        for colour in colours:
            seen = layer + (clear * colour[texels])[:, None]
            np.minimum(gained, self._errors(seen, texels), out=gained)
        gained += ((part.clear * unknown[texels]).astype(np.int32) - before[texels])[:, None]
        total = part.sums(gained)
        total += self.opaque_errors(over)
        total += (~self.search._covered * before).sum(axis=1, dtype=np.int64)[:, None]
        return total

    def varied(self, stack: Stack, count: int) -> Iterator[Stack]:
        """Stacks with one of the `count` next best layers in place of each one of a stack."""
        base, layers = stack
        for place, layer in enumerate(layers):
            table = self.choices(self.below(base, layers[:place]), self.over(layers[place + 1 :]))
            for other in np.argsort(table, axis=None, kind="stable")[: count + 1].tolist():
                chosen = divmod(other, self.search.art.dyes)
                if chosen != layer:
                    yield base, (*layers[:place], chosen, *layers[place + 1 :])

    def descend(self, stack: Stack) -> Stack:
        """Replace each layer by the best one, and the base, until nothing is better."""
        base, layers = stack[0], list(stack[1])
        least: int | None = None
        for _ in range(_SWEEPS):
            over = [self.over(layers[number + 1 :]) for number in range(len(layers))]
            below = self.below(base, ())
            for number in range(len(layers)):
                # The layers above are those of the last sweep: layers change from below upwards.
                table = self.choices(below, over[number])
                layers[number] = divmod(int(table.argmin()), self.search.art.dyes)
                below = self.lay(*layers[number], below)
            errors = self.bases(self.over(layers))
            base, error = int(errors.argmin()), int(errors.min())
            if least is not None and error >= least:
                break
            least = error
        return base, tuple(layers)

    def reordered(self, stack: Stack) -> Stack:
        """The stack after swaps of two layers that make it better."""
        base, layers = stack
        error = self.error(stack)
        for second in range(1, len(layers)):
            for first in range(second):
                tried = list(layers)
                tried[first], tried[second] = tried[second], tried[first]
                other = self.error((base, tuple(tried)))
                if other < error:
                    layers, error = tuple(tried), other
        return base, layers

    def pruned(self, stack: Stack) -> Stack:
        """The stack without the layers that hardly make it better, or do not."""
        base, layers = stack
        error, number = self.error(stack), 0
        while number < len(layers):
            fewer = base, (*layers[:number], *layers[number + 1 :])
            if self.error(fewer) <= error * (1 + _HARDLY):
                layers, error, number = fewer[1], self.error(fewer), 0
            else:
                number += 1
        return base, layers


def _nothing() -> tuple[Floats, Floats]:
    """What no layers add and let through."""
    return np.zeros((_TEXELS, 3), np.float32), np.ones((_TEXELS, 1), np.float32)
