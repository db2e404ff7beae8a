"""From a photo or screenshot of a banner to its design.

Light, bends of the cloth and design are estimated by turns: designs are searched for in the light
of the best one so far, then the photo is aligned with the best of them, and so on.
"""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field, replace
from itertools import product

import numpy as np

from drapery.arrays import Pixels
from drapery.banner import LOOM_LAYERS, MAX_LAYERS
from drapery.match.art import HEIGHT, WIDTH, Stack, read_art
from drapery.match.colours import MEASURED, PERCEIVED, UNIT, Metric, distances, oklab
from drapery.match.light import SeenFace, seen_face
from drapery.match.nearest import Goal, NearestSearch
from drapery.match.perspective import (
    Corner,
    PhotoView,
    as_corners,
    bend_count,
    checked_picture,
    find_corners,
    texel_shifts,
)
from drapery.match.search import MAX_ALTERNATIVES, Match
from drapery.match.smooth import Reals, least_squares, row_sums
from drapery.option import within
from drapery.packs import PackLike, open_packs

_LOWERED = (0.0, 2.5, -2.5, -5.0)
"""How much lower than its outline tells the middle of the flag may be [texels]."""
_GAINS = (0.7, 0.78, 0.86)
"""Even lights that the search begins with."""
_METRICS = (MEASURED, PERCEIVED)
"""What one metric does not find, the other one often does."""
_LAYER = 40.0
"""What a layer costs, as an error [levels, summed over texels]."""
_BENT = 6.0
"""What a bend of the usual size costs, likewise."""
_LEFT_OUT = 10.0
"""What each texel of the flag costs that is outside the face that is read, likewise."""
_TINTED = 600.0
"""What light of a colour costs, times the range of its channels, likewise."""
_STIFF, _SOFT = 4000.0, 500.0
"""How much a flag resists being bent by `aligned`, times the squares of its bends."""
_Step = tuple[int, int]
"""How often both faces are softened in a step of `aligned`, and how many rows of texels count."""
_COARSE: tuple[_Step, ...] = tuple((times, HEIGHT) for times in (8, 8, 4, 2, 1))
"""First what is large is aligned."""
_DOWNWARDS: tuple[_Step, ...] = (
    *((2, rows) for rows in range(8, HEIGHT + 1, 4)),
    (1, HEIGHT),
    (1, HEIGHT),
)
"""From the upper edge, which hangs on a bar, downwards: what repeats is not aligned astray."""
_Way = tuple[tuple[_Step, ...], float]
"""The steps of `aligned`, and its stiffness."""
_COARSELY: _Way = _COARSE, _STIFF
WAYS: tuple[_Way, ...] = (_COARSELY, (_DOWNWARDS, _SOFT))
_EACH = 2
"""With how many designs of each number of layers the photo is aligned."""
_TURNS = 6
"""How often at most the best design is refined."""
_WELL = 1500.0
"""No search from other bends follows when the error is below this."""
_CLOSE = 1.3
"""Designs are refined whose errors are less than this multiple of the best one's."""
_OTHERS = 6
"""How many other layers are tried in place of each one of a design."""
_ALIGNED = 8
"""With how many of them the photo is aligned."""
_NEAR = 2
"""How many of them are refined."""
_POLISHED = 3
"""How many designs, and one of each number of layers, are aligned in the end."""
_DESCENTS = 2
"""How many designs are improved layer by layer after each search."""
_WIDTH = 6
"""How many stacks are kept while layers are added."""
_LOWEST = 4
"""How many stacks are kept while layers are found from the top downwards."""
_WEIGHT = 1000
"""Weights are rounded to this many steps."""
_LITTLE = 1.0
"""The search ends when the error falls by less than this [levels, summed over texels]."""


def match_photo(
    picture: Pixels,
    corners: Sequence[Corner] | None = None,
    *,
    layers: int = LOOM_LAYERS,
    packs: PackLike | Sequence[PackLike] = (),
    format: int | None = None,
    alternatives: int = 3,
) -> list[Match]:
    """The designs that a banner in a photo or screenshot most likely has, best first.

    The light, which changes smoothly over the cloth, is estimated. So is how the cloth bends
    between its corners. The error of each design is the mean distance of its face from the one that
    was seen, in OKLab.

    picture: sRGB, uint8, shape [H, W, 3] or [H, W, 4].
    corners: of the flag as one sees it, upper left, upper right, lower right, lower left [pixels
        right, pixels down]; None finds them, before a background of one colour.
    layers: the most layers, 0 to 16.
    packs: resource packs, see `drapery.packs.open_packs`.
    format: pack format of the game's version, see `drapery.packs.open_packs`.
    alternatives: the most designs.

    Raises OptionError for a wrong argument and where no flag is found, PackError for a pack that
    cannot be used.
    """
    within("layers", layers, 0, MAX_LAYERS, "layers")
    within("alternatives", alternatives, 1, MAX_ALTERNATIVES, "designs")
    shown = checked_picture(picture)
    view = PhotoView(shown, find_corners(shown) if corners is None else as_corners(corners))
    search = NearestSearch(read_art(open_packs(packs, format=format)))
    found = _PhotoSearch(view, search, layers)
    found.run()
    return [
        Match(search.art.banner(*stack), found.distance(stack))
        for stack in found.distinct(alternatives)
    ]


@dataclass(frozen=True, eq=False)
class _Fit:
    """How a design is seen in a photo: the texels, the light [n, 3], the bend, and the error."""

    seen: SeenFace
    light: Reals
    bend: Reals
    error: float


@dataclass(eq=False)
class _PhotoSearch:
    """The designs that were found for a photo, and how each fits."""

    view: PhotoView
    search: NearestSearch
    layers: int
    fits: dict[Stack, _Fit] = field(default_factory=dict)

    def run(self) -> None:
        """Find designs, and better ones until there are none."""
        outline, *others = (self.view.outline_bend(lowered) for lowered in _LOWERED)
        if outline.any():
            others.append(np.zeros(bend_count()))
        searches = [self.started(outline, _GAINS)]
        for bend in others:
            if min(search.error for search in searches) > _WELL:
                searches.append(self.started(bend, _GAINS[1:2]))
        for search in searches:
            for stack, fit in search.fits.items():
                self._keep(stack, fit)
        self.improve()

    def started(self, bend: Reals, gains: Sequence[float]) -> "_PhotoSearch":
        """Designs found in even lights, with the cloth bent in one way; the best are refined."""
        found = replace(self, fits={})
        seen = seen_face(self.view.face(bend))
        for gain, metric in product(gains, _METRICS):
            _, quick = self._goals(seen, np.full((HEIGHT * WIDTH, 3), gain), metric)
            stacks = [grown[0] for grown in quick.grow(self.layers, 2 * _WIDTH)]
            ends = [stacks[-1]]
            if metric is MEASURED:
                ends += _lowered(quick, self.layers)[:_DESCENTS]
            found._put(seen, bend, [*stacks, *map(quick.descend, ends)])
        found.align()
        for stack in found.distinct(len(gains)):
            found.refine(stack)
        return found

    def improve(self) -> None:
        """Refine the best design and those near it until nothing is better."""
        for _ in range(_TURNS):
            before, best = self.error, self.best()[0]
            near = [one for one in self.near(best) if self.fits[one].error < _CLOSE * before]
            for stack in [*near, best]:
                self.refine(stack)
            if self.error > before - _LITTLE:
                break
        best = self.best()[0]
        fit = self.fits[best]
        goal, _ = self._goals(fit.seen, fit.light)
        self._put(fit.seen, fit.bend, goal.varied(best, 1))
        self.polish()

    def polish(self) -> None:
        """Align the photo with the best designs, also of fewer layers, until nothing is better."""
        limit = _CLOSE * self.error
        best: dict[int, Stack] = {}
        for stack in self.best():
            best.setdefault(len(stack[1]), stack)
        for stack in dict.fromkeys([*self.distinct(_POLISHED), *best.values()]):
            before = limit
            while self.fits[stack].error < before - _LITTLE:
                before = self.fits[stack].error
                self._realign(stack, self.fits[stack], WAYS)

    def refine(self, stack: Stack) -> None:
        """Align the photo with a design, and search for better designs in its light."""
        self._realign(stack, self.fits[stack], WAYS)
        fit = self.fits[stack]
        goal, quick = self._goals(fit.seen, fit.light)
        lowered = _lowered(quick, self.layers)[:_DESCENTS]
        grown = [stack, *quick.regrown(stack, self.layers, _WIDTH), *lowered]
        near = {one: goal.error(one) for one in grown}
        best = sorted(near, key=lambda one: near[one])[:_DESCENTS]
        better = [goal.reordered(goal.descend(one)) for one in best]
        self._put(fit.seen, fit.bend, [*lowered, *better])

    def best(self) -> list[Stack]:
        """The designs, best first."""
        return sorted(self.fits, key=lambda stack: (self.fits[stack].error, stack))

    def align(self) -> None:
        """Align the photo with the best designs of each number of layers."""
        counts = [0] * (self.layers + 1)
        for stack in self.best():
            counts[len(stack[1])] += 1
            if counts[len(stack[1])] <= _EACH:
                self._realign(stack, self.fits[stack])

    def near(self, stack: Stack) -> list[Stack]:
        """The best designs that have one layer less, one other layer or a like face, aligned.

        A layer may only hide other faults, and two orders of layers may differ little.
        """
        fit, (base, layers) = self.fits[stack], stack
        _, quick = self._goals(fit.seen, fit.light)
        *_, grown = quick.grow(len(layers), _WIDTH)
        found = [*map(quick.reordered, quick.varied(stack, _OTHERS)), *grown]
        found += _lowered(quick, self.layers)
        errors = {quick.error(other): other for other in found}
        others = [errors[error] for error in sorted(errors)[:_ALIGNED]]
        others += [(base, (*layers[:n], *layers[n + 1 :])) for n in range(len(layers))]
        for one in others:
            self._realign(one, fit)
        known = dict.fromkeys(one for one in others if one != stack)
        return sorted(known, key=lambda one: self.fits[one].error)[:_NEAR]

    def _realign(self, stack: Stack, fit: _Fit, ways: tuple[_Way, ...] = (_COARSELY,)) -> None:
        """Align the photo with a design. fit: of this design, or of a similar one."""
        wanted = self._paint(stack) * fit.light
        for steps, stiffness in ways:
            bend = aligned(self.view, fit.bend, wanted, steps, stiffness)
            self._put(seen_face(self.view.face(bend)), bend, [stack])

    @property
    def error(self) -> float:
        """The error of the best design."""
        return min(fit.error for fit in self.fits.values())

    def distinct(self, count: int) -> list[Stack]:
        """The best designs whose faces differ."""
        chosen: list[Stack] = []
        for stack in self.best():
            shown = self._paint(stack)
            if all(np.abs(self._paint(other) - shown).mean() > 1 for other in chosen):
                chosen.append(stack)
            if len(chosen) == count:
                break
        return chosen

    def distance(self, stack: Stack) -> float:
        """The mean distance in OKLab between the face that was seen and the face of a design."""
        fit = self.fits[stack]
        seen = oklab(fit.seen.without(fit.light))
        return float(distances(seen, oklab(self._paint(stack))).mean() / UNIT)

    def _goals(self, seen: SeenFace, light: Reals, metric: Metric = MEASURED) -> tuple[Goal, Goal]:
        """The face without its light, and the same with every other texel only, which is quick."""
        # Differences are those of what is seen, so they count less where it is dark.
        weights = np.rint(seen.weights * light.mean(axis=1) * _WEIGHT).astype(np.int32)
        goal = self.search.goal(seen.without(light).reshape(-1), weights, metric)
        row, column = np.divmod(np.arange(HEIGHT * WIDTH), WIDTH)
        return goal, replace(goal, weights=np.where((row + column) % 2, weights, 0))

    def _paint(self, stack: Stack) -> Reals:
        return self.search.art.paint(*stack).reshape(-1, 3).astype(np.float64)

    def _put(self, seen: SeenFace, bend: Reals, stacks: Iterable[Stack]) -> None:
        """Add designs, each in the light that fits it, and without layers that are not needed."""
        for stack in dict.fromkeys(stacks):
            fit = self._fit(seen, bend, stack)
            self._keep(stack, fit)
            (base, layers), place = stack, 0
            while place < len(layers):
                fewer = (*layers[:place], *layers[place + 1 :])
                tried = self._fit(seen, bend, (base, fewer), fit.light)
                if tried.error < fit.error:
                    layers, fit, place = fewer, tried, 0
                else:
                    place += 1
            self._keep((base, layers), fit)

    def _keep(self, stack: Stack, fit: _Fit) -> None:
        known = self.fits.get(stack)
        if known is None or fit.error < known.error:
            self.fits[stack] = fit

    def _fit(self, seen: SeenFace, bend: Reals, stack: Stack, light: Reals | None = None) -> _Fit:
        face = self._paint(stack)
        light = seen.light_on(face) if light is None else light
        tint = light[0] / light[0].mean()
        cost = _LAYER * len(stack[1]) + _TINTED * float(tint.max() - tint.min())
        cost += _BENT * self.view.bend_cost(bend) + _LEFT_OUT * self.view.left_out(bend)
        return _Fit(seen, light, bend, seen.error(face, light) + cost)


def _lowered(goal: Goal, layers: int) -> list[Stack]:
    """Stacks that are found from the top layer downwards, best first."""
    every = (stack for stacks in goal.lowered(layers, _LOWEST) for stack in stacks)
    errors = {goal.error(stack): stack for stack in every}
    return [errors[error] for error in sorted(errors)]


def aligned(
    view: PhotoView,
    bend: Reals,
    wanted: Reals,
    steps: tuple[_Step, ...] = _COARSE,
    stiffness: float = _STIFF,
) -> Reals:
    """A bend with which the face looks more like one that is wanted, by Gauss-Newton steps."""
    shifts = texel_shifts()[..., None]
    resists = np.full(len(bend), stiffness)
    for times, count in steps:
        seen, goal = _softened(view.face(bend), times), _softened(wanted, times)
        levels = seen.reshape(HEIGHT, WIDTH, 3)
        slopes = [np.asarray(np.gradient(levels, axis=axis)).reshape(-1, 3) for axis in (1, 0)]
        rest = goal - seen
        weights = 1 / (1 + (np.abs(rest).mean(axis=1) / 25) ** 2)
        weights[count * WIDTH :] = 0
        rows = (shifts[:, 0] * slopes[0] + shifts[:, 1] * slopes[1]).reshape(len(bend), -1)
        # The whole bend is fitted, not the step, so that it is the bend that resists.
        whole = rest.ravel() + row_sums(rows.T, bend)
        edges, apart, _ = view.outline
        bend = least_squares(
            np.concatenate([rows, edges], axis=1),
            np.concatenate([whole, apart]),
            np.concatenate([np.repeat(weights, 3), stiffness * view.outline_weights(bend)]),
            resists,
        )
    return bend


def _softened(face: Reals, times: int) -> Reals:
    levels = face.reshape(HEIGHT, WIDTH, 3)
    for _ in range(times):
        for axis in (0, 1):
            wide = np.pad(levels, [(int(k == axis),) * 2 for k in range(3)], mode="edge")
            first, middle, last = (
                wide.take(range(k, k + levels.shape[axis]), axis=axis) for k in range(3)
            )
            levels = (first + 2 * middle + last) / 4
    return levels.reshape(-1, 3)
