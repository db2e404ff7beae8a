"""The designs that show a face exactly, or most nearly."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from drapery.arrays import Pixels
from drapery.banner import LOOM_LAYERS, MAX_LAYERS, Banner
from drapery.errors import OptionError
from drapery.match.art import HEIGHT, SIZE, WIDTH, FaceArt, Stack, read_art
from drapery.match.colours import UNIT, Floats, distances, oklab
from drapery.match.exact import ExactSearch
from drapery.match.nearest import Goal, NearestSearch
from drapery.option import within
from drapery.packs import PackLike, open_packs

EFFORT = 24
"""How many stacks are changed at random and improved, unless another number is given."""

MAX_EFFORT = 100_000
MAX_ALTERNATIVES = 64

_BEAM = 8
_SEED = 19
_WEIGHT = 1000
"""Weights are rounded to this many steps."""

_MOST_COUNT = 0.75
"""The least share of texels that count for a search for exact designs."""

_APART = UNIT // 100
"""The least mean distance between the faces of two alternatives."""


@dataclass(frozen=True)
class Match:
    """A design, and how far its face is from the one that was given.

    banner: the design.
    error: the weighted mean of the distances between colours in OKLab: 0 for the same face, 1 for
        black in place of white.
    """

    banner: Banner
    error: float


@dataclass(frozen=True)
class MatchProgress:
    """How much of a search is done.

    share: the part that is done, 0 to 1.
    matches: the best designs up to here, best first.
    """

    share: float
    matches: tuple[Match, ...]


class Matcher:
    """Finds designs in the look of one stack of packs; it prepares the packs once.

    packs: resource packs, see `drapery.packs.open_packs`.
    format: pack format of the game's version, see `drapery.packs.open_packs`.

    Raises OptionError for a wrong format, PackError for a pack that cannot be used.
    """

    def __init__(
        self, packs: PackLike | Sequence[PackLike] = (), *, format: int | None = None
    ) -> None:
        self.art: FaceArt = read_art(open_packs(packs, format=format))
        self._exact, self._nearest = ExactSearch(self.art), NearestSearch(self.art)

    def match(
        self,
        face: Pixels,
        *,
        layers: int = LOOM_LAYERS,
        weights: ArrayLike | None = None,
        alternatives: int = 5,
        effort: int = EFFORT,
    ) -> list[Match]:
        """The designs whose plain faces look most like a face, best first. See `match`.

        face: sRGB, uint8, shape [40, 20, 3].
        layers: the most layers, 0 to 16.
        weights: how much each texel counts, shape [40, 20], from 0; None counts all alike.
        alternatives: the most designs.
        effort: how many designs are changed at random and improved.

        Raises OptionError for a face or weights of another shape and numbers out of range.
        """
        found: tuple[Match, ...] = ()
        for progress in self.iter_matches(
            face, layers=layers, weights=weights, alternatives=alternatives, effort=effort
        ):
            found = progress.matches
        return list(found)

    def iter_matches(
        self,
        face: Pixels,
        *,
        layers: int = LOOM_LAYERS,
        weights: ArrayLike | None = None,
        alternatives: int = 5,
        effort: int = EFFORT,
    ) -> Iterator[MatchProgress]:
        """The state of the search of `match` again and again, until it is done.

        The arguments are checked before this returns.

        face: sRGB, uint8, shape [40, 20, 3].
        layers: the most layers, 0 to 16.
        weights: how much each texel counts, shape [40, 20], from 0; None counts all alike.
        alternatives: the most designs.
        effort: how many designs are changed at random and improved.

        Raises OptionError for a face or weights of another shape and numbers out of range.
        """
        within("layers", layers, 0, MAX_LAYERS, "layers")
        within("alternatives", alternatives, 1, MAX_ALTERNATIVES, "designs")
        within("effort", effort, 0, MAX_EFFORT, "attempts")
        shown, counts = _checked_face(face), _checked_weights(weights)
        return self._search(shown, counts, layers, alternatives, effort)

    def _search(
        self,
        face: NDArray[np.int32],
        weights: NDArray[np.int64],
        layers: int,
        alternatives: int,
        effort: int,
    ) -> Iterator[MatchProgress]:
        goal = self._nearest.goal(face, weights)
        pool = _Pool(goal, alternatives)
        # A first answer at once: the search for an exact design may take some seconds.
        *_, grown = goal.grow(layers, 1)
        pool.add(grown[0])
        yield MatchProgress(0.0, pool.matches())
        counts = weights > 0
        many = counts.mean() >= _MOST_COUNT
        exact = self._exact.find(face, layers, counts=counts) if many else None
        if exact is not None:
            pool.add(exact)
            if alternatives == 1:
                yield MatchProgress(1.0, pool.matches())
                return
        steps = layers + 2 + alternatives + effort
        for number, _ in enumerate(_improved(goal, pool, layers, alternatives, effort), 1):
            yield MatchProgress(min(number / steps, 1.0), pool.matches())
        yield MatchProgress(1.0, pool.matches())


def match(
    face: Pixels,
    *,
    layers: int = LOOM_LAYERS,
    packs: PackLike | Sequence[PackLike] = (),
    format: int | None = None,
    weights: ArrayLike | None = None,
    alternatives: int = 5,
    effort: int = EFFORT,
) -> list[Match]:
    """The designs whose plain faces look most like a given face, best first.

    If a design shows exactly this face, where texels count, it is first, with the fewest layers
    that the search found; not so if fewer than three texels in four count.

    face: sRGB, uint8, shape [40, 20, 3].
    layers: the most layers, 0 to 16.
    packs: resource packs, see `drapery.packs.open_packs`; the designs look so with these.
    format: pack format of the game's version, see `drapery.packs.open_packs`.
    weights: how much each texel counts, shape [40, 20], from 0; None counts all alike.
    alternatives: the most designs.
    effort: how many designs are changed at random and improved.

    Raises OptionError for a wrong argument, PackError for a pack that cannot be used.
    """
    matcher = Matcher(packs, format=format)
    return matcher.match(
        face, layers=layers, weights=weights, alternatives=alternatives, effort=effort
    )


def nearest_stacks(goal: Goal, layers: int, alternatives: int, effort: int) -> list[Stack]:
    """The stacks that are nearest to a goal, best first; see `match`."""
    pool = _Pool(goal, alternatives)
    for _ in _improved(goal, pool, layers, alternatives, effort):
        pass
    return pool.best()


class _Pool:
    """The best stacks that were found, with their errors."""

    def __init__(self, goal: Goal, alternatives: int) -> None:
        self.goal, self.alternatives = goal, alternatives
        self.errors: dict[Stack, int] = {}

    def add(self, stack: Stack) -> int:
        """Keep a stack without the layers that it does not need; its error."""
        error = self.errors.get(stack)
        if error is None:
            stack = self.goal.pruned(stack)
            error = self.errors[stack] = self.goal.error(stack)
        return error

    def best(self) -> list[Stack]:
        """The best stacks whose faces differ, best first."""
        art, faces = self.goal.search.art, list[Floats]()
        chosen: list[Stack] = []
        for stack in sorted(self.errors, key=lambda stack: (self.errors[stack], len(stack[1]))):
            lab = oklab(art.paint(*stack).reshape(-1, 3))
            if all(distances(lab, other).mean() >= _APART for other in faces):
                chosen.append(stack)
                faces.append(lab)
            if len(chosen) == self.alternatives:
                break
        # Those beyond can be forgotten: they are worse, or look like one of these.
        self.errors = {stack: self.errors[stack] for stack in chosen}
        return chosen

    def matches(self) -> tuple[Match, ...]:
        whole = UNIT * int(self.goal.weights.sum())
        art = self.goal.search.art
        return tuple(Match(art.banner(*stack), self.errors[stack] / whole) for stack in self.best())


def _improved(
    goal: Goal, pool: _Pool, layers: int, alternatives: int, effort: int
) -> Iterator[None]:
    """Put better and better stacks into a pool."""
    starts: list[Stack] = []
    for grown in goal.grow(layers, _BEAM):
        starts = grown
        pool.add(grown[0])
        yield
    if not layers:
        return
    for stack in starts[:alternatives]:
        pool.add(goal.descend(stack))
        yield
    rng = np.random.default_rng(_SEED)
    now = min(pool.errors, key=lambda stack: pool.errors[stack])
    for _ in range(effort):
        tried = goal.descend(_kicked(now, layers, goal.search.art, rng))
        if pool.add(tried) <= 1.01 * goal.error(now) or rng.random() < 0.03:
            now = tried
        yield
    # What was found on the way to the best one may be much worse than what is next to it.
    if alternatives > 1:
        for stack in goal.varied(pool.best()[0], alternatives - 1):
            pool.add(stack)
    yield


def _kicked(stack: Stack, most: int, art: FaceArt, rng: np.random.Generator) -> Stack:
    """A stack of `most` layers with some layers swapped, moved or replaced at random."""

    def any_layer() -> tuple[int, int]:
        return int(rng.integers(len(art.patterns))), int(rng.integers(art.dyes))

    base, layers = stack[0], list(stack[1])
    while len(layers) < most:
        layers.insert(int(rng.integers(len(layers) + 1)), any_layer())
    kind = int(rng.integers(4))
    if kind == 0:
        first, second = rng.integers(most, size=2)
        layers[first], layers[second] = layers[second], layers[first]
    elif kind == 1:
        layers.insert(int(rng.integers(most)), layers.pop(int(rng.integers(most))))
    else:
        for number in rng.integers(most, size=kind - 1):
            layers[number] = any_layer()
    return base, tuple(layers)


def _checked_face(face: NDArray[np.uint8]) -> NDArray[np.int32]:
    array = np.asarray(face)
    if array.shape != (HEIGHT, WIDTH, 3) or array.dtype != np.uint8:
        raise OptionError(
            f"the face is {array.dtype} {list(array.shape)}; give uint8 [{HEIGHT}, {WIDTH}, 3]"
        )
    return array.reshape(SIZE).astype(np.int32)


def _checked_weights(weights: ArrayLike | None) -> NDArray[np.int64]:
    if weights is None:
        return np.ones(HEIGHT * WIDTH, np.int64)
    array = np.asarray(weights, np.float64)
    if array.shape != (HEIGHT, WIDTH) or not np.isfinite(array).all() or (array < 0).any():
        raise OptionError(f"weights must be [{HEIGHT}, {WIDTH}] numbers from 0")
    if not array.any():
        raise OptionError("all weights are 0; let at least one texel count")
    whole: NDArray[np.int64] = np.rint(array.reshape(-1) / array.max() * _WEIGHT).astype(np.int64)
    return whole
