"""Desbrun, Schröder, Barr, "Interactive animation of structured deformable objects" (1999).

A predictor-corrector of first order: the springs' linear part is integrated implicitly by a filter
that is made once per cloth and step, the rest explicitly, and springs that are then too long are
pulled back (Provot 1995). Stable for any stiffness and step; the filter damps, the more so the
stiffer the springs. To be chosen for small hanging cloths, many of them. Not to be confused with
implicit Euler (Baraff, Witkin 1998), which solves with the true Hessian at every step.

The paper's force (section 3.2) is printed with the wrong sign: a stretched spring pulls i towards
j. Its implicit viscosity k dt (v_j - v_i) equals dt H v, and W dt² M⁻¹ H = W - I, so instead of
filtering that force the velocity itself is filtered: v' = W (v + dt/m F) + dt/m F_ext.
"""

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any, NamedTuple

import numpy as np
from numba import njit
from numpy.typing import NDArray

from drapery.cloth import kernels, lanes
from drapery.cloth.cloth import Cloth
from drapery.cloth.faces import Faces, wind_faces
from drapery.cloth.filters import Filter, cloth_filter
from drapery.cloth.forces import Force, Loads, custom_accelerations, lower_forces
from drapery.cloth.links import Links, limited_links
from drapery.cloth.pins import PinPath
from drapery.cloth.solvers.base import check_state, check_step
from drapery.cloth.state import State
from drapery.errors import OptionError
from drapery.mesh import Array


class Springs(NamedTuple):
    pairs: NDArray[np.int32]
    rest: Array
    stiffness: Array


class Plan(NamedTuple):
    """All that is constant while a cloth moves."""

    springs: Springs
    links: Links
    faces: Faces
    controls: NDArray[np.int32]
    filter: Filter
    inv_mass: Array
    pins: NDArray[np.int64]


@dataclass(frozen=True, eq=False)
class Memory:
    """One cloth's plan for one step, in each floating-point type that has been asked for."""

    plan: Plan
    dt: float
    by_type: dict[Any, Plan] = field(default_factory=dict)

    def of(self, dtype: Any) -> Plan:
        if dtype not in self.by_type:
            parts = (lanes.cast(p, dtype) if isinstance(p, tuple) else p for p in self.plan)
            self.by_type[dtype] = Plan(*parts)._replace(inv_mass=self.plan.inv_mass.astype(dtype))
        return self.by_type[dtype]


@dataclass(frozen=True)
class SolverDesbrun:
    """See the module.

    limit: a spring's longest length over its rest length. sweeps: of the correction, a step.
    threads: None for as many as there are processors.
    """

    limit: float = 1.02
    sweeps: int = 3
    threads: int | None = None

    def __post_init__(self) -> None:
        if not self.limit >= 1:
            raise OptionError(f"limit {self.limit!r} is out of range; use 1 or more")
        if self.sweeps < 0:
            raise OptionError(f"sweeps {self.sweeps} is out of range; use 0 or more")

    def init(self, cloth: Cloth, dt: float) -> Memory:
        check_step(dt, 1)
        faces, controls = wind_faces(cloth)
        springs = Springs(cloth.spring_pairs, cloth.spring_length, cloth.spring_stiffness)
        links = limited_links(cloth, self.limit, self.sweeps)
        pins = np.flatnonzero(cloth.inv_mass == 0)
        filter_ = cloth_filter(cloth, dt)
        return Memory(Plan(springs, links, faces, controls, filter_, cloth.inv_mass, pins), dt)

    def step(
        self,
        cloth: Cloth,
        state: State,
        memory: Memory,
        forces: Sequence[Force],
        dt: float,
        *,
        steps: int = 1,
        pins: PinPath | None = None,
    ) -> tuple[State, Memory]:
        check_step(dt, steps)
        check_state(cloth, state)
        if dt != memory.dt:
            raise OptionError(f"dt {dt:g} is not the {memory.dt:g} of the memory; call init again")
        loads = lower_forces(forces, len(state.positions))
        if not loads.custom:
            return self._advance(cloth, state, memory, loads, steps, pins), memory
        for _ in range(steps):
            state = self._advance(cloth, state, memory, loads, 1, pins)
        return state, memory

    def _advance(
        self,
        cloth: Cloth,
        state: State,
        memory: Memory,
        loads: Loads,
        steps: int,
        pins: PinPath | None,
    ) -> State:
        dtype = state.positions.dtype
        plan = memory.of(dtype)
        x, v = lanes.to_lanes(state.positions), lanes.to_lanes(state.velocities)
        new_x, new_v = np.empty_like(x), np.empty_like(v)
        targets = lanes.pin_targets(pins, state, memory.dt, steps, len(plan.pins))
        push = lanes.to_lanes(custom_accelerations(loads, cloth, state))
        width = lanes.block_width(len(cloth.inv_mass), dtype.itemsize)
        numbers = np.array([memory.dt, loads.drag, state.time, *loads.gravity])
        gusts = loads.gusts._replace(origins=loads.gusts.origins.astype(dtype))

        def work(first: int, last: int) -> None:
            _advance(
                x,
                v,
                new_x,
                new_v,
                first,
                last,
                width,
                plan,
                gusts,
                numbers,
                targets,
                push,
                steps,
            )

        lanes.run_blocks(work, x.shape[1], width, lanes.thread_count(self.threads))
        time = state.time + steps * memory.dt
        return State(lanes.from_lanes(new_x), lanes.from_lanes(new_v), time)


@njit(cache=True, error_model="numpy", nogil=True)
def _advance(
    x: Any,
    v: Any,
    new_x: Any,
    new_v: Any,
    first: Any,
    last: Any,
    width: Any,
    plan: Any,
    gusts: Any,
    numbers: Any,
    targets: Any,
    push: Any,
    steps: Any,
) -> None:
    """Steps of lanes first..last, a block at a time."""
    dt = x.dtype.type(numbers[0])
    rows = x.shape[0]
    for start in range(first, last, width):
        lanes = min(width, last - start)
        y, u = np.empty((rows, lanes), x.dtype), np.empty((rows, lanes), x.dtype)
        both, old = np.empty((2, rows, lanes), x.dtype), np.empty((rows, lanes), x.dtype)
        g, mean = both[1], np.empty((3, lanes), x.dtype)
        wind = np.empty((3 * plan.controls.size, lanes), x.dtype)
        work = np.empty((18, lanes), x.dtype)
        kernels.take_lanes(y, x, start)
        kernels.take_lanes(u, v, start)
        for step in range(steps):
            time = numbers[2] + step * numbers[0]
            kernels.frame_velocity(mean, u, plan.pins)
            kernels.subtract_frame(both[0], u, mean)
            kernels.add_spring_velocities(both[0], y, plan.springs, plan.inv_mass, dt)
            kernels.filter_velocities(both, plan.filter, plan.pins)
            for number in range(gusts.seeds.size):
                kernels.blow(wind, y, plan.controls, gusts, number, start, time, work)
                kernels.add_wind_velocities(
                    g, y, u, plan.faces, wind, gusts.numbers[number, 16], plan.inv_mass, dt, work
                )
            kernels.add_uniform(g, mean, plan.inv_mass, numbers, push, start)
            kernels.move(y, g, old, dt)
            kernels.place_pins(y, old, plan.pins, targets, step, start)
            kernels.shorten(y, plan.links)
            kernels.set_velocities(u, y, old, dt)
        kernels.give_lanes(new_x, y, start)
        kernels.give_lanes(new_v, u, start)
