"""Many cloths of several topologies, with a level of detail that depends on the distance.

Cloths can be added and removed while the world runs. Cloths near the eye are simulated on their
full grid, cloths farther away on every second row and column; the others follow a stiff motion or
do not move. At most `Detail.maximum` are simulated at once, the nearest first. When a cloth changes
its level of detail, its shape fades from the old one to the new one, so it does not jump.
"""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field, replace
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from drapery.arrays import Integers, Vectors
from drapery.cloth.bending import grid_rigidity
from drapery.cloth.builders import grid
from drapery.cloth.checks import check_count, check_number
from drapery.cloth.cloth import Cloth
from drapery.cloth.fabric import Fabric
from drapery.cloth.forces import Force, Gravity
from drapery.cloth.solvers.base import Solver, check_step
from drapery.cloth.solvers.registry import solver
from drapery.cloth.state import MAX_CLOTHS, State
from drapery.errors import OptionError, shown
from drapery.mesh import Array

FULL, HALF, STIFF = 0, 1, 2
"""Levels of detail: every particle, every second row and column, no simulation."""

MAX_DISTANCE = 1e9
HYSTERESIS = 1.1
"""A cloth returns to a finer level only when it is nearer than the limit by this factor."""

ForcesAt = Callable[[Vectors], Sequence[Force]]
"""The forces on cloths at places [B, 3]; a wind takes the places as its origins."""

StiffMotion = Callable[[Cloth, Vectors, float], Vectors]
"""Positions [B, N, 3] of cloths at places [B, 3] at a time [s], without simulation."""


@dataclass(frozen=True)
class Detail:
    """How finely cloths are simulated.

    full: distance from the eye up to which cloths have their full grid [m].
    half: distance from the eye up to which cloths have every second row and column [m].
    maximum: how many cloths are simulated at once.
    fade: how long a change of level takes to show [s].

    Raises OptionError for numbers out of range.
    """

    full: float = 16.0
    half: float = 40.0
    maximum: int = 5000
    fade: float = 0.5

    def __post_init__(self) -> None:
        check_number("detail full", self.full, 0, MAX_DISTANCE, "m")
        check_number("detail half", self.half, self.full, MAX_DISTANCE, "m")
        check_count("detail maximum", self.maximum, 0, MAX_CLOTHS)
        check_number("detail fade", self.fade, 0, 1e6, "s")


class WorldView(NamedTuple):
    """The shapes of all cloths of one topology.

    cloth: their topology.
    ids: of the cloths, shape [B].
    places: of the cloths [m], shape [B, 3].
    positions: of the particles relative to the place of their cloth [m], shape [B, N, 3].
    levels: FULL, HALF or STIFF, shape [B].
    """

    cloth: Cloth
    ids: Integers
    places: Vectors
    positions: Vectors
    levels: Integers


@dataclass
class _ClothBatch:
    """All cloths of one topology: a row for each in every array.

    offsets: from the new shape to the old one, which fade out [m], [B, N, 3]. remaining: time until
    they are 0 [s], [B].
    """

    cloth: Cloth
    coarse: Cloth | None
    solver_states: tuple[Any, Any]
    ids: NDArray[np.int64]
    places: Array
    levels: NDArray[np.int8]
    positions: Array
    velocities: Array
    offsets: Array
    remaining: Array

    def rows(self) -> dict[str, NDArray[Any]]:
        names = ("ids", "places", "levels", "positions", "velocities", "offsets", "remaining")
        return {name: getattr(self, name) for name in names}

    def select(self, chosen: NDArray[Any]) -> None:
        for name, values in self.rows().items():
            setattr(self, name, values[chosen])

    def extend(self, ids: NDArray[np.int64], places: Array) -> None:
        """Add cloths at rest, on their full grid."""
        count = len(ids)
        rest = np.broadcast_to(self.cloth.rest_positions, (count, *self.cloth.rest_positions.shape))
        still = np.zeros_like(rest)
        levels = np.full(count, FULL, np.int8)
        new = (ids, places, levels, rest, still, still, np.zeros(count))
        for (name, values), more in zip(self.rows().items(), new, strict=True):
            setattr(self, name, np.concatenate([values, more]))


@dataclass
class World:
    """Cloths of several topologies that are simulated together.

    dt: one step [s].
    solver: one whose solver state does not depend on single cloths (SolverDesbrun, SolverXPBD).
    forces: the forces on cloths at given places.
    stiff: the motion of cloths that are not simulated; None leaves their shape unchanged.
    detail: how finely cloths are simulated.
    time: of the next step [s].

    Raises OptionError for a step that is not above 0.
    """

    dt: float = 1.0 / 60.0
    solver: Solver = field(default_factory=solver)
    forces: ForcesAt = lambda places: (Gravity(),)
    stiff: StiffMotion | None = None
    detail: Detail = field(default_factory=Detail)
    time: float = 0.0
    _batches: dict[int, _ClothBatch] = field(default_factory=dict, repr=False)
    _next: int = 0

    def __post_init__(self) -> None:
        check_step(self.dt, 1)

    def add(self, cloth: Cloth, places: Vectors) -> Integers:
        """Add cloths of one topology; returns their ids, shape [B].

        An id never changes and is never used again. Use the same Cloth object for all cloths of a
        topology: they are prepared once and stepped together.

        cloth: of what these cloths are.
        places: where they are [m], shape [B, 3].

        Raises OptionError for places of another shape or that are not finite.
        """
        places = _points("places", places).reshape(-1, 3)
        if id(cloth) not in self._batches:
            self._batches[id(cloth)] = self._empty(cloth)
        ids = np.arange(self._next, self._next + len(places))
        self._next += len(places)
        self._batches[id(cloth)].extend(ids, places)
        return ids

    def remove(self, ids: Sequence[int] | Integers) -> None:
        """Remove cloths, and a topology of which none is left.

        Raises OptionError for an unknown id.
        """
        wanted = np.asarray(ids, np.int64).reshape(-1)
        missing = np.setdiff1d(wanted, self.ids())
        if missing.size:
            raise OptionError(f"cloth {missing[0]} is not in the world; use ids that `ids` lists")
        for batch in self._batches.values():
            batch.select(~np.isin(batch.ids, wanted))
        kept = {key: batch for key, batch in self._batches.items() if batch.ids.size}
        self._batches = kept

    def ids(self) -> Integers:
        """The ids of all cloths, in the order of `shown`."""
        return np.concatenate([np.empty(0, np.int64), *(b.ids for b in self._batches.values())])

    def shown(self) -> Iterator[WorldView]:
        """The shapes of all cloths, one `WorldView` per topology, in the order of adding."""
        for batch in self._batches.values():
            weight = _weight(batch.remaining, self.detail.fade)
            faded = batch.positions + weight * batch.offsets
            yield WorldView(batch.cloth, batch.ids, batch.places, faded, batch.levels)

    def step(self, eye: Vectors) -> None:
        """Advance all cloths by dt.

        eye: the viewer's position [m], [3].

        Raises OptionError for an eye of another shape or that is not finite.
        """
        eye = _points("eye", eye).reshape(3)
        batches = list(self._batches.values())
        for batch, levels in zip(batches, self._wanted_levels(batches, eye), strict=True):
            self._change(batch, levels)
            self._advance(batch)
            batch.remaining = np.maximum(batch.remaining - self.dt, 0)
        self.time += self.dt

    def _empty(self, cloth: Cloth) -> _ClothBatch:
        coarse = coarsen(cloth)
        solver_states = (
            self.solver.init(cloth, self.dt),
            None if coarse is None else self.solver.init(coarse, self.dt),
        )
        none, flat = np.empty((0, *cloth.rest_positions.shape)), np.empty(0)
        ids, levels = flat.astype(np.int64), flat.astype(np.int8)
        return _ClothBatch(
            cloth, coarse, solver_states, ids, np.empty((0, 3)), levels, none, none, none, flat
        )

    def _wanted_levels(self, batches: Sequence[_ClothBatch], eye: Array) -> list[NDArray[np.int8]]:
        """The level that each cloth should have, batch by batch."""
        if not batches:
            return []
        distances = [np.linalg.norm(batch.places - eye, axis=1) for batch in batches]
        by_batch = [self._by_distance(*pair) for pair in zip(batches, distances, strict=True)]
        distance, level = np.concatenate(distances), np.concatenate(by_batch)
        simulated = np.flatnonzero(level < STIFF)
        # The nearest first; of two at the same distance the older one.
        order = simulated[np.argsort(distance[simulated], kind="stable")]
        level[order[self.detail.maximum :]] = STIFF
        return np.split(level, np.cumsum([len(batch.ids) for batch in batches])[:-1])

    def _by_distance(self, batch: _ClothBatch, distance: Array) -> NDArray[np.int8]:
        limits = np.array([self.detail.full, self.detail.half])
        # A cloth returns to a finer level only if it is nearer than the limit by a factor.
        slack = np.where(batch.levels[:, None] > np.arange(2), 1 / HYSTERESIS, 1.0)
        level = (distance[:, None] > limits * slack).sum(axis=1).astype(np.int8)
        return np.where((level == HALF) & (batch.coarse is None), FULL, level).astype(np.int8)

    def _change(self, batch: _ClothBatch, levels: NDArray[np.int8]) -> None:
        """Give cloths their new levels; their shapes fade from the old ones to the new ones."""
        rows = np.flatnonzero(levels != batch.levels)
        if not rows.size:
            return
        weight = _weight(batch.remaining[rows], self.detail.fade)
        shown = batch.positions[rows] + weight * batch.offsets[rows]
        batch.levels[rows] = levels[rows]
        finer = levels[rows] == FULL
        # A cloth that returns to its full grid continues from its visible shape; others do not.
        batch.positions[rows[finer]] = shown[finer]
        target = self._target(batch, rows)
        batch.offsets[rows] = shown - target
        batch.positions[rows] = target
        batch.remaining[rows] = self.detail.fade

    def _target(self, batch: _ClothBatch, rows: NDArray[np.intp]) -> Array:
        """The shapes of cloths at their present level, before any fading."""
        target = batch.positions[rows]
        half, stiff = batch.levels[rows] == HALF, batch.levels[rows] == STIFF
        if half.any():
            target[half] = refine(thin(target[half], batch.cloth), batch.cloth)
        if stiff.any() and self.stiff is not None:
            target[stiff] = self.stiff(batch.cloth, batch.places[rows[stiff]], self.time)
        return target

    def _advance(self, batch: _ClothBatch) -> None:
        full, half, stiff = (np.flatnonzero(batch.levels == level) for level in (FULL, HALF, STIFF))
        self._simulate(batch, full, batch.cloth, batch.solver_states[0])
        if batch.coarse is not None:
            self._simulate(batch, half, batch.coarse, batch.solver_states[1])
        if stiff.size and self.stiff is not None:
            now = self.stiff(batch.cloth, batch.places[stiff], self.time + self.dt)
            batch.velocities[stiff] = (now - batch.positions[stiff]) / self.dt
            batch.positions[stiff] = now
        elif stiff.size:
            batch.velocities[stiff] = 0

    def _simulate(
        self, batch: _ClothBatch, rows: NDArray[np.intp], cloth: Cloth, solver_state: Any
    ) -> None:
        if not rows.size:
            return
        positions, velocities = batch.positions[rows], batch.velocities[rows]
        if cloth is not batch.cloth:
            positions, velocities = (thin(a, batch.cloth) for a in (positions, velocities))
        state = State(positions, velocities, self.time)
        forces = self.forces(batch.places[rows])
        state, _ = self.solver.step(cloth, state, solver_state, forces, self.dt)
        moved = state.positions, state.velocities
        if cloth is not batch.cloth:
            moved = refine(moved[0], batch.cloth), refine(moved[1], batch.cloth)
        batch.positions[rows], batch.velocities[rows] = moved


def coarsen(cloth: Cloth) -> Cloth | None:
    """The same cloth on every second row and column of its grid; it keeps the pins that remain.

    None where there is no such grid: both counts must be odd and at least five.
    """
    if cloth.grid_shape is None or any(n < 5 or n % 2 == 0 for n in cloth.grid_shape):
        return None
    rows, columns = cloth.grid_shape
    rest = thin(cloth.rest_positions[None], cloth)[0]
    free = cloth.inv_mass > 0
    width, height = np.ptp(cloth.rest_positions[:, 0]), np.ptp(cloth.rest_positions[:, 1])
    mass = len(free) / cloth.inv_mass[free].mean() if free.any() else 1.0
    by_kind = [cloth.spring_stiffness[cloth.spring_kind == kind] for kind in range(3)]
    stretch, shear, flexion = (float(k.mean()) if k.size else 0.0 for k in by_kind)
    pinned = np.flatnonzero(thin(cloth.inv_mass[None, :, None], cloth)[0, :, 0] == 0)
    size = float(width), float(height)
    rigidity = grid_rigidity(cloth.bending, cloth.grid_shape, size)
    density = float(mass / (width * height))
    coarse = grid(
        columns // 2 + 1,
        rows // 2 + 1,
        *size,
        pins=pinned,
        fabric=Fabric(
            density, stretch, shear, flexion, cloth.drag, rigidity, cloth.bending.damping
        ),
    )
    return replace(coarse, rest_positions=rest)


def thin(values: Array, cloth: Cloth) -> Array:
    """Every second row and column of a grid's values [B, N, K]: [B, N', K]."""
    rows, columns = _shape(cloth)
    grids = values.reshape(len(values), rows, columns, -1)[:, ::2, ::2]
    return grids.reshape(len(values), -1, values.shape[-1])


def refine(values: Array, cloth: Cloth) -> Array:
    """Values [B, N', K] of every second row and column on the whole grid, [B, N, K], bilinearly."""
    rows, columns = _shape(cloth)
    coarse = values.reshape(len(values), rows // 2 + 1, columns // 2 + 1, -1)
    whole = np.empty((len(values), rows, columns, values.shape[-1]), values.dtype)
    whole[:, ::2, ::2] = coarse
    whole[:, ::2, 1::2] = (coarse[:, :, :-1] + coarse[:, :, 1:]) / 2
    whole[:, 1::2] = (whole[:, :-1:2] + whole[:, 2::2]) / 2
    return whole.reshape(len(values), rows * columns, -1)


def _points(name: str, values: Array) -> Array:
    """Finite points [m] as an array. Raises OptionError."""
    try:
        points = np.asarray(values, np.float64)
    except (TypeError, ValueError):
        points = np.empty((1, 0))
    wanted = (3,) if name == "eye" else (*points.shape[:-1], 3)
    if points.shape != wanted or points.ndim > 2 or not np.isfinite(points).all():
        raise OptionError(f"{name} {shown(values)} must be finite numbers [m], three a point")
    return points


def _shape(cloth: Cloth) -> tuple[int, int]:
    assert cloth.grid_shape is not None
    return cloth.grid_shape


def _weight(remaining: Array, fade: float) -> Array:
    """The weight of the old shape, shape [B, 1, 1]; its slope is 0 at both ends of the fade."""
    s = remaining / fade if fade > 0 else np.zeros_like(remaining)
    weight: Array = (s * s * (3 - 2 * s))[:, None, None]
    return weight
