"""Many cloths of several topologies, each simulated as finely as its distance deserves.

Cloths come and go while the world runs. Those near the eye are simulated on their own grid, those
further off on every second row and column, and the rest follow a stiff motion or keep still; at
most so many are simulated at once, the nearest first. When a cloth changes its level of detail,
what it showed before fades into what it shows now, so nothing jumps.
"""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from drapery.cloth.builders import grid
from drapery.cloth.cloth import Cloth
from drapery.cloth.fabric import Fabric
from drapery.cloth.forces import Force, Gravity
from drapery.cloth.solvers.base import Solver, check_step
from drapery.cloth.solvers.xpbd import SolverXPBD
from drapery.cloth.state import State
from drapery.errors import OptionError
from drapery.mesh import Array

FULL, HALF, STIFF = 0, 1, 2
"""Levels of detail: every particle, every second row and column, no simulation."""

HYSTERESIS = 1.1
"""A cloth goes back to a finer level only when it is nearer than the limit by this factor."""

ForcesAt = Callable[[Array], Sequence[Force]]
"""The forces on cloths at places [B, 3]; a wind takes the places as its origins."""

StiffMotion = Callable[[Cloth, Array, float], Array]
"""Positions [B, N, 3] of cloths at places [B, 3] at a time [s], without simulation."""


@dataclass(frozen=True)
class Detail:
    """How finely cloths are simulated.

    full, half: distances from the eye [m] up to which they are, on their own and on half a grid.
    most: how many are simulated at once.
    fade: how long a change of level takes to show [s].
    """

    full: float = 16.0
    half: float = 40.0
    most: int = 5000
    fade: float = 0.5

    def __post_init__(self) -> None:
        if not (0 <= self.full <= self.half and self.most >= 0 and self.fade >= 0):
            raise OptionError(f"{self} is out of range; use 0 <= full <= half, most and fade >= 0")


@dataclass
class _Herd:
    """All cloths of one topology: a row for each in every array."""

    cloth: Cloth
    coarse: Cloth | None
    memories: tuple[Any, Any]
    ids: NDArray[np.int64]
    places: Array
    level: NDArray[np.int8]
    positions: Array
    velocities: Array
    fading: Array
    left: Array

    def select(self, rows: NDArray[Any]) -> None:
        for name in ("ids", "places", "level", "positions", "velocities", "fading", "left"):
            setattr(self, name, getattr(self, name)[rows])


@dataclass
class World:
    """Cloths of several topologies in one place and time.

    forces: at given places. stiff: the motion of cloths that are not simulated; None leaves them
    as they were. solver: one whose memory holds nothing of single cloths (desbrun, xpbd).
    Positions are in each cloth's own frame; add its place [m].
    """

    dt: float = 1.0 / 60.0
    solver: Solver = field(default_factory=SolverXPBD)
    forces: ForcesAt = lambda places: (Gravity(),)
    stiff: StiffMotion | None = None
    detail: Detail = field(default_factory=Detail)
    time: float = 0.0
    _herds: dict[int, _Herd] = field(default_factory=dict, repr=False)
    _next: int = 0

    def __post_init__(self) -> None:
        check_step(self.dt, 1)

    def add(self, cloth: Cloth, places: Array) -> NDArray[np.int64]:
        """Hang cloths of one topology at places [B, 3]; their ids, which stay theirs, shape [B].

        Give the same Cloth object for all cloths that are to step together.
        """
        places = np.asarray(places, np.float64).reshape(-1, 3)
        if not np.isfinite(places).all():
            raise OptionError("places hold NaN or infinity; give finite numbers [m]")
        herd = self._herds.setdefault(id(cloth), self._empty(cloth))
        count = len(places)
        ids = np.arange(self._next, self._next + count)
        self._next += count
        rest = np.broadcast_to(cloth.rest_positions, (count, *cloth.rest_positions.shape))
        joined = {
            "ids": ids,
            "places": places,
            "level": np.full(count, FULL, np.int8),
            "positions": rest,
            "velocities": np.zeros_like(rest),
            "fading": np.zeros_like(rest),
            "left": np.zeros(count),
        }
        for name, rows in joined.items():
            setattr(herd, name, np.concatenate([getattr(herd, name), rows]))
        return ids

    def remove(self, ids: Sequence[int] | NDArray[np.int64]) -> None:
        """Take cloths away. Raises OptionError for an id that is not here."""
        wanted = np.asarray(ids, np.int64).reshape(-1)
        missing = np.setdiff1d(wanted, self.ids())
        if missing.size:
            raise OptionError(f"cloth {missing[0]} is not here; it may have been removed before")
        for herd in self._herds.values():
            herd.select(~np.isin(herd.ids, wanted))

    def ids(self) -> NDArray[np.int64]:
        """The ids of all cloths, in the order of `shown`."""
        every = [herd.ids for herd in self._herds.values()]
        return np.concatenate([np.empty(0, np.int64), *every])

    def shown(self) -> Iterator[tuple[Cloth, NDArray[np.int64], Array, Array, NDArray[np.int8]]]:
        """For each topology: the cloth, ids [B], places [B, 3], positions [B, N, 3], levels [B]."""
        for herd in self._herds.values():
            faded = herd.positions + _weight(herd.left, self.detail.fade) * herd.fading
            yield herd.cloth, herd.ids, herd.places, faded, herd.level

    def step(self, eye: Array) -> None:
        """Move all cloths on by dt, seen from a point [m], shape [3]."""
        for herd, levels in zip(self._herds.values(), self._levels(np.asarray(eye)), strict=True):
            self._change(herd, levels)
            self._advance(herd)
            herd.left = np.maximum(herd.left - self.dt, 0)
        self.time += self.dt

    def _empty(self, cloth: Cloth) -> _Herd:
        coarse = coarsen(cloth)
        memories = (
            self.solver.init(cloth, self.dt),
            None if coarse is None else self.solver.init(coarse, self.dt),
        )
        none = np.empty((0, *cloth.rest_positions.shape))
        flat = np.empty(0)
        ids, level = flat.astype(np.int64), flat.astype(np.int8)
        return _Herd(cloth, coarse, memories, ids, np.empty((0, 3)), level, none, none, none, flat)

    def _levels(self, eye: Array) -> Iterator[NDArray[np.int8]]:
        """The level that each cloth ought to have, herd by herd."""
        herds = list(self._herds.values())
        away = [np.linalg.norm(herd.places - eye, axis=1) for herd in herds]
        levels = [self._by_distance(h, d) for h, d in zip(herds, away, strict=True)]
        every, level = (
            np.concatenate([_nothing(), *away]),
            np.concatenate([_nothing(), *levels]),
        )
        simulated = np.flatnonzero(level < STIFF)
        # The nearest first; of two at one distance the older.
        order = simulated[np.argsort(every[simulated], kind="stable")]
        level[order[self.detail.most :]] = STIFF
        cuts = np.cumsum([len(herd.ids) for herd in herds])[:-1]
        return iter([part.astype(np.int8) for part in np.split(level, cuts)])

    def _by_distance(self, herd: _Herd, away: Array) -> NDArray[np.int8]:
        limits = np.array([self.detail.full, self.detail.half])
        # The limits of levels coarser than a cloth's own are those at which it would come back.
        slack = np.where(herd.level[:, None] > np.arange(2), 1 / HYSTERESIS, 1.0)
        level = (away[:, None] > limits * slack).sum(axis=1).astype(np.int8)
        return np.where((level == HALF) & (herd.coarse is None), FULL, level).astype(np.int8)

    def _change(self, herd: _Herd, levels: NDArray[np.int8]) -> None:
        """Give cloths their new levels; what they showed fades into what they will show."""
        rows = np.flatnonzero(levels != herd.level)
        if not rows.size:
            return
        shown = herd.positions[rows] + (
            _weight(herd.left[rows], self.detail.fade) * herd.fading[rows]
        )
        herd.level[rows] = levels[rows]
        finer = levels[rows] == FULL
        # Back on its own grid a cloth goes on from what it shows; else it starts elsewhere.
        herd.positions[rows[finer]] = shown[finer]
        kept = self._target(herd, rows)
        herd.fading[rows] = shown - kept
        herd.positions[rows] = kept
        herd.left[rows] = self.detail.fade

    def _target(self, herd: _Herd, rows: NDArray[np.intp]) -> Array:
        """What cloths show at their present level, before any fading."""
        target = herd.positions[rows]
        half, stiff = herd.level[rows] == HALF, herd.level[rows] == STIFF
        if half.any():
            target[half] = refine(thin(target[half], herd.cloth), herd.cloth)
        if stiff.any() and self.stiff is not None:
            target[stiff] = self.stiff(herd.cloth, herd.places[rows[stiff]], self.time)
        return target

    def _advance(self, herd: _Herd) -> None:
        full, half, stiff = (np.flatnonzero(herd.level == level) for level in (FULL, HALF, STIFF))
        self._simulate(herd, full, herd.cloth, herd.memories[0])
        if herd.coarse is not None:
            self._simulate(herd, half, herd.coarse, herd.memories[1])
        if stiff.size and self.stiff is not None:
            now = self.stiff(herd.cloth, herd.places[stiff], self.time + self.dt)
            herd.velocities[stiff] = (now - herd.positions[stiff]) / self.dt
            herd.positions[stiff] = now
        elif stiff.size:
            herd.velocities[stiff] = 0

    def _simulate(
        self, herd: _Herd, rows: NDArray[np.intp], cloth: Cloth, solver_state: Any
    ) -> None:
        if not rows.size:
            return
        positions, velocities = herd.positions[rows], herd.velocities[rows]
        if cloth is not herd.cloth:
            positions, velocities = (thin(a, herd.cloth) for a in (positions, velocities))
        state = State(positions, velocities, self.time)
        forces = self.forces(herd.places[rows])
        state, _ = self.solver.step(cloth, state, solver_state, forces, self.dt)
        moved = state.positions, state.velocities
        if cloth is not herd.cloth:
            moved = refine(moved[0], herd.cloth), refine(moved[1], herd.cloth)
        herd.positions[rows], herd.velocities[rows] = moved


def coarsen(cloth: Cloth) -> Cloth | None:
    """The same cloth on every second row and column of its grid, pinned where both have particles.

    None where there is no such grid: the counts must be odd and at least five.
    """
    if cloth.grid_shape is None or any(n < 5 or n % 2 == 0 for n in cloth.grid_shape):
        return None
    rows, columns = cloth.grid_shape
    rest = thin(cloth.rest_positions[None], cloth)[0]
    free = cloth.inv_mass > 0
    width, height = np.ptp(cloth.rest_positions[:, 0]), np.ptp(cloth.rest_positions[:, 1])
    mass = len(free) / cloth.inv_mass[free].mean() if free.any() else 1.0
    by_kind = [cloth.spring_stiffness[cloth.spring_kind == kind] for kind in range(3)]
    stiffness = [float(k.mean()) if k.size else 0.0 for k in by_kind]
    pinned = np.flatnonzero(thin(cloth.inv_mass[None, :, None], cloth)[0, :, 0] == 0)
    coarse = grid(
        columns // 2 + 1,
        rows // 2 + 1,
        float(width),
        float(height),
        pins=pinned,
        fabric=Fabric(float(mass / (width * height)), *stiffness, drag=cloth.drag),
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


def _nothing() -> Array:
    """Nothing, as an array to join others to."""
    return np.empty(0)


def _shape(cloth: Cloth) -> tuple[int, int]:
    assert cloth.grid_shape is not None
    return cloth.grid_shape


def _weight(left: Array, fade: float) -> Array:
    """How much of what was before still shows, shape [B, 1, 1]: smooth at both ends."""
    s = left / fade if fade > 0 else np.zeros_like(left)
    weight: Array = (s * s * (3 - 2 * s))[:, None, None]
    return weight
