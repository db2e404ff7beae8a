"""Code that all solvers share: states to lanes, the kernel of a method, and lanes to states.

A method provides its plan (constant arrays) and a kernel that steps the lanes first..last.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from drapery.arrays import Floats
from drapery.cloth import kernels, lanes, simd, strain
from drapery.cloth.bending import Stencils, fastest_bending, force_stencils
from drapery.cloth.checks import check_count, check_number
from drapery.cloth.cloth import Cloth
from drapery.cloth.contact import lanes_contact
from drapery.cloth.contact.box_data import NO_CONTACT, BoxColliders, BoxContact
from drapery.cloth.contact.lanes_contact import ContactWork, contact_work
from drapery.cloth.contact.self_contact_data import NOT_ITSELF, SelfContact
from drapery.cloth.faces import Faces, wind_faces
from drapery.cloth.forces import Force, Loads, custom_accelerations, lower_forces
from drapery.cloth.pins import PinPath
from drapery.cloth.solvers.base import all_finite, check_state, check_step
from drapery.cloth.state import State
from drapery.cloth.strain import NEVER, NOTES, StrainLimit, limit_strain
from drapery.cloth.wind import Gusts
from drapery.errors import OptionError, counted
from drapery.jit import (
    address_of,
    borrowing_kernel,
    call_by_address,
    called_next,
    entry_point,
    kernel,
)
from drapery.mesh import Array

MAX_SUBSTEPS = MAX_SWEEPS = MAX_THREADS = 1000
WINDS = "blow", "add_winds"
SHARED = *WINDS, "meet_lanes"
"""Functions that most kernels call by address, so that each is compiled once for all of them."""
MAX_SWING = 0.3
"""Phase [radians] of the fastest spring's oscillation in a substep. Symplectic methods are stable
up to 2; the limit on stretch, with one or two sweeps a substep, needs smaller substeps."""
MAX_DECAY = 0.5
"""Part of a velocity that damping removes in a substep; up to 2 is stable."""


Shared = tuple[Callable[..., Any], tuple[Any, ...]]
"""A function that kernels call by address, and an example of its arguments."""


class Springs(NamedTuple):
    """pairs: [S, 2]; rest: lengths [m], [S]; stiffness: [N/m], [S]."""

    pairs: NDArray[np.int32]
    rest: Array
    stiffness: Array


class ClothBody(NamedTuple):
    """What every method needs of a cloth.

    stencils: of bending, as accelerations. damping: of bending [s]. controls: particles at which
    wind is sampled, [C].
    """

    springs: Springs
    stencils: Stencils
    damping: Array
    faces: Faces
    controls: NDArray[np.int32]
    inv_mass: Array
    pins: NDArray[np.int64]


class Batch(NamedTuple):
    """B cloths as a kernel reads and writes them, lanes [3N, B].

    numbers: the substep [s], drag [1/s], time [s], gravity [m/s²] (3).
    targets: positions of the pins after each substep. push: accelerations by user-defined forces.
    contact: the boxes that the cloths meet. itself: what their contact with themselves needs.
        poses: of the boxes before the first step and after each, [T, K, 12]; one entry where no
        box moves. resolve: address of the function that resolves it; 0 without contact. work:
        arrays for it, which no other thread uses.
    often: see `SolverState`. cloths: their number, B.
    limit: the longest springs, see `drapery.cloth.strain`. squares: of their lengths [m²], [1, S];
        for a plane of lanes see `plane_squares`. strains: of the worst step of each cloth in which
        its limit was not held, see `NOTES`; 0 where it was, [6, B].
    limit_strain, blow, add_winds, meet_lanes: addresses of these functions; 0 for those that the
        kernel does not call.
    width: lanes of a block.
    residuals: for a solver that iterates, the largest residual of each cloth over its tolerance;
        0 where every solve reached the tolerance, [B].
    """

    x: Array
    v: Array
    new_x: Array
    new_v: Array
    gusts: Gusts
    numbers: Array
    targets: Array
    push: Array
    width: int
    residuals: Array
    contact: BoxContact
    itself: SelfContact
    poses: Array
    resolve: int
    work: ContactWork
    often: bool
    cloths: int
    limit: StrainLimit
    squares: Array
    strains: Array
    limit_strain: int
    blow: int
    add_winds: int
    meet_lanes: int


@dataclass(frozen=True, eq=False)
class SolverState:
    """A method's plan for one cloth and step, in each floating-point type that is used.

    plan: the constant data of the cloth, as named tuples of arrays.
    dt: one step [s].
    substeps: of each step.
    kernel: called with first, last, plan, batch, steps, substeps and the options; it steps whole
        registers of cloths, or one cloth at a time.
    options: further arguments of the kernel.
    alone: whether the kernel steps one cloth at a time.
    often: whether contacts are resolved in every substep, not once a step. Free cloth lies still
        only so.
    limit: see `Batch`.
    squares: of a plane of lanes, shape [2, S], see `plane_squares`.
    shares: the functions that the kernel calls by address, see `functions_of`.
    by_type: the plan in each floating-point type, made when it is used.
    addresses: those of these functions, found when they are used.
    """

    plan: Any
    dt: float
    substeps: int
    kernel: Callable[..., None]
    options: tuple[Any, ...] = ()
    alone: bool = False
    often: bool = False
    limit: StrainLimit = NEVER
    squares: Floats = field(default_factory=lambda: np.zeros((2, 0)))
    shares: tuple[str, ...] = ()
    by_type: dict[Any, Any] = field(default_factory=dict)
    addresses: dict[Any, dict[str, Any]] = field(default_factory=dict)

    def of(self, dtype: Any) -> Any:
        if dtype not in self.by_type:
            self.by_type[dtype] = cast_all(self.plan, dtype)
        return self.by_type[dtype]


def cast_all(plan: Any, dtype: Any) -> Any:
    """A named tuple, possibly nested, with its floating-point arrays as `dtype`."""
    parts = (cast_all(part, dtype) if isinstance(part, tuple) else part for part in plan)
    return lanes.cast(type(plan)(*parts), dtype)


def body_of(cloth: Cloth) -> ClothBody:
    faces, controls = wind_faces(cloth)
    springs = Springs(cloth.spring_pairs, cloth.spring_length, cloth.spring_stiffness)
    return ClothBody(
        springs,
        force_stencils(cloth.bending, cloth.inv_mass),
        np.array([cloth.bending.damping]),
        faces,
        controls,
        cloth.inv_mass,
        np.flatnonzero(cloth.inv_mass == 0),
    )


class KernelSolver:
    """The step of every method that has a kernel."""

    threads: int | None

    def step(
        self,
        cloth: Cloth,
        state: State,
        solver_state: SolverState,
        forces: Sequence[Force],
        dt: float,
        *,
        steps: int = 1,
        pins: PinPath | None = None,
        boxes: BoxColliders | None = None,
    ) -> tuple[State, SolverState]:
        """The state of the cloths some steps later, and the next solver state, see `Solver.step`.

        cloth: the cloth of which these are.
        state: positions and velocities before the steps.
        solver_state: what `init` or the call before returned.
        forces: what acts on the cloths in these steps.
        dt: one step [s].
        steps: number of steps.
        pins: a path that the pinned particles follow; None leaves them in place.
        boxes: what the cloths meet at the end of each step.

        Raises OptionError for a force or path that gives a wrong value.
        """
        check_step(dt, steps)
        check_state(cloth, state)
        if dt != solver_state.dt:
            raise OptionError(
                f"dt {dt:g} is not the {solver_state.dt:g} of the solver state; call init again"
            )
        loads = lower_forces(forces, cloth, len(state.positions))
        at_once = 1 if loads.custom else steps
        threads = lanes.thread_count(self.threads)
        unsolved, worst = 0.0, state.worst
        for _ in range(steps // at_once):
            state, residual = _advance(
                cloth, state, solver_state, loads, at_once, pins, threads, boxes
            )
            unsolved, worst = max(unsolved, residual), strain.worse(worst, state.worst)
        if unsolved > 0:
            self.warn_unsolved(unsolved)
        return replace(state, worst=worst), solver_state

    def warn_unsolved(self, residual: float) -> None:
        """For solvers that iterate: warn of a residual, given as a multiple of the tolerance."""


def _advance(
    cloth: Cloth,
    state: State,
    solver_state: SolverState,
    loads: Loads,
    steps: int,
    pins: PinPath | None,
    threads: int,
    boxes: BoxColliders | None,
) -> tuple[State, float]:
    plan = solver_state.of(state.positions.dtype)
    batch = batch_of(cloth, state, solver_state, loads, steps, pins, threads, boxes)
    rest = steps, solver_state.substeps, *solver_state.options
    with called_next(solver_state.kernel, (0, 1, plan, batch, *rest)):
        batch = with_addresses(batch, solver_state)

    def work(first: int, last: int) -> None:
        mine = batch._replace(work=contact_work(batch.contact, len(cloth.inv_mass), batch.itself))
        solver_state.kernel(first, last, plan, mine, *rest)

    count = len(state.positions)
    lanes.run_blocks(work, count if solver_state.alone else batch.x.shape[1], batch.width, threads)
    if not all_finite(batch.new_x):
        raise OptionError(
            f"positions became infinite within {counted(steps, 'step')} of {solver_state.dt:g} s; "
            "use a smaller dt, weaker forces or another solver"
        )
    time = state.time + steps * solver_state.dt
    moved = State(
        lanes.from_lanes(batch.new_x, count),
        lanes.from_lanes(batch.new_v, count),
        time,
        strain.worst_noted(batch.strains, batch.limit, state.time, solver_state.dt),
    )
    return moved, float(batch.residuals.max(initial=0.0))


def batch_of(
    cloth: Cloth,
    state: State,
    solver_state: SolverState,
    loads: Loads,
    steps: int,
    pins: PinPath | None,
    threads: int,
    boxes: BoxColliders | None,
) -> Batch:
    """The arguments of a kernel for some steps; see `with_addresses`."""
    dtype = state.positions.dtype
    x, v = lanes.to_lanes(state.positions), lanes.to_lanes(state.velocities)
    h, count = solver_state.dt / solver_state.substeps, int((cloth.inv_mass == 0).sum())
    limit = solver_state.limit
    squares = solver_state.squares if solver_state.alone else limit.squares[None]
    itself = NOT_ITSELF if boxes is None else boxes.itself
    return Batch(
        x,
        v,
        # Cloths that are stepped one at a time do not write the padding of the last register.
        x.copy() if solver_state.alone else np.empty_like(x),
        v.copy() if solver_state.alone else np.empty_like(v),
        loads.gusts._replace(
            phases=lanes.padded(loads.gusts.phases, x.shape[1]),
            origins=lanes.padded(loads.gusts.origins.astype(dtype), x.shape[1]),
            sines=loads.gusts.sines.astype(dtype),
            cosines=loads.gusts.cosines.astype(dtype),
        ),
        np.array([h, loads.drag, state.time, *loads.gravity]),
        lanes.pin_targets(pins, state, h, steps * solver_state.substeps, count),
        lanes.to_lanes(custom_accelerations(loads, cloth, state)),
        lanes.block_width(len(cloth.inv_mass), x, threads),
        np.zeros(x.shape[1]),
        NO_CONTACT if boxes is None else boxes.contact,
        itself,
        _box_poses(boxes, state.time, solver_state.dt, steps),
        0,
        contact_work(NO_CONTACT),
        solver_state.often,
        len(state.positions),
        limit,
        squares.astype(dtype),
        np.zeros((NOTES, x.shape[1])),
        0,
        0,
        0,
        0,
    )


def with_addresses(batch: Batch, solver_state: SolverState) -> Batch:
    """The batch with the addresses of the functions that its kernel calls, which may be compiled
    for it."""
    dtype, addresses = batch.x.dtype, solver_state.addresses
    meets = len(batch.contact.halves) > 0 or len(batch.itself.triangles) > 0
    if (dtype, meets) not in addresses:
        found = functions_of(batch, solver_state)
        if not meets:
            del found["resolve"]
        addresses[dtype, meets] = {name: address_of(*each) for name, each in found.items()}
    return batch._replace(**addresses[dtype, meets])


def functions_of(batch: Batch, solver_state: SolverState) -> dict[str, Shared]:
    """The functions whose addresses are in a batch, by the name of the field, each with arguments
    of the types of those that kernels give it."""
    plan, y = solver_state.of(batch.x.dtype), np.zeros((1, 1), batch.x.dtype)
    found: dict[str, Shared] = {
        "limit_strain": (limit_strain, strain.EXAMPLE),
        "resolve": (lanes_contact.resolve, lanes_contact.EXAMPLE),
    }
    if "blow" in solver_state.shares:
        found["blow"] = blow, (y, y, plan.body.controls, batch.gusts, 0, 0.0, y)
        found["add_winds"] = add_winds, (y, y, y, plan.body, y, batch.gusts, y.dtype.type(0))
    if "meet_lanes" in solver_state.shares:
        found["meet_lanes"] = lanes_contact.meet_lanes, lanes_contact.meeting_example(y, batch)
    return found


def _box_poses(boxes: BoxColliders | None, time: float, dt: float, steps: int) -> Array:
    """The poses of a `Batch` that starts at a time [s]."""
    if boxes is None:
        return NO_CONTACT.ends[None]
    return boxes.poses([time + number * dt for number in range(steps + 1)])


def explicit_substeps(cloth: Cloth, dt: float) -> int:
    """Substeps of at most `MAX_SWING` radians of the fastest oscillation.

    Gershgorin's circles bound the squares of the frequencies: 2/m times a particle's stiffness.
    The damping of bending may remove at most `MAX_DECAY` of a velocity in a substep.
    Raises OptionError if more than `MAX_SUBSTEPS` are needed.
    """
    stiffness = np.zeros(len(cloth.inv_mass))
    for end in range(2):
        np.add.at(stiffness, cloth.spring_pairs[:, end], cloth.spring_stiffness)
    bending = fastest_bending(cloth.bending, cloth.inv_mass)
    fastest = float(np.sqrt((2 * stiffness * cloth.inv_mass).max(initial=0.0) + bending))
    decay = dt * cloth.bending.damping * bending / MAX_DECAY
    substeps = max(1, int(np.ceil(max(dt * fastest / MAX_SWING, decay))))
    if substeps > MAX_SUBSTEPS:
        raise OptionError(
            f"stiffness {cloth.spring_stiffness.max():g} N/m needs {substeps} substeps of an "
            f"explicit solver; use one of at most {MAX_SUBSTEPS}, softer springs or desbrun"
        )
    return substeps


def chosen_substeps(wanted: int | None, cloth: Cloth, dt: float) -> int:
    """`wanted`, or as many as an explicit method needs."""
    return explicit_substeps(cloth, dt) if wanted is None else wanted


def half_shares(cloth: Cloth, pairs: NDArray[np.integer]) -> Array:
    """Each end's part of a correction, [K, 2]: half, or all of it if the other end is pinned."""
    free = cloth.inv_mass[pairs] > 0
    shares: Array = free / free.sum(axis=1, keepdims=True)
    return shares


def movable(cloth: Cloth) -> NDArray[np.bool_]:
    """Whether a spring has an end that is not pinned, [S]."""
    return np.asarray((cloth.inv_mass[cloth.spring_pairs] > 0).any(axis=1))


def check_common(limit: float, sweeps: int, substeps: int | None, threads: int | None) -> None:
    """The options that most solvers have. Raises OptionError."""
    check_limit(limit)
    check_count("sweeps", sweeps, 0, MAX_SWEEPS)
    check_stepping(substeps, threads)


def check_stepping(substeps: int | None, threads: int | None) -> None:
    """Raises OptionError unless each is None or a whole number in bounds."""
    if substeps is not None:
        check_count("substeps", substeps, 1, MAX_SUBSTEPS)
    if threads is not None:
        check_count("threads", threads, 1, MAX_THREADS)


def check_limit(limit: float) -> None:
    """Raises OptionError unless a spring may be at least as long as it is at rest."""
    check_number("limit", limit, 1, 1e6, "times the rest length")


@entry_point
def blow(wind: Any, y: Any, controls: Any, gusts: Any, start: Any, time: Any, work: Any) -> None:
    """All winds W at the control particles C, and the phases of K waves, into [W (3C + 2K), L]."""
    rows = 3 * controls.size + 2 * gusts.rates.shape[1]
    for number in range(gusts.seeds.size):
        out = wind[number * rows : (number + 1) * rows]
        kernels.blow(out, y, controls, gusts, number, start, time, work)


@entry_point
def add_winds(g: Any, y: Any, u: Any, body: Any, wind: Any, gusts: Any, h: Any) -> None:
    """g += h · acceleration by winds, see `blow`, at places y and velocities u."""
    rows = 3 * body.controls.size + 2 * gusts.rates.shape[1]
    for number in range(gusts.seeds.size):
        here = wind[number * rows : (number + 1) * rows]
        kernels.add_wind_velocities(g, y, u, body, here, gusts, number, h)


blow_at = call_by_address(None)
add_winds_at = call_by_address(None)


@kernel
def wind_lanes(batch: Any, body: Any, width: Any) -> Any:
    """Lanes for all winds, and the scratch that `blow` needs."""
    rows = 3 * body.controls.size + 2 * batch.gusts.rates.shape[1]
    wind = simd.empty_lanes(rows * batch.gusts.seeds.size, width, batch.x)
    return wind, simd.empty_lanes(18, width, batch.x)


@entry_point
def fall(g: Any, inv_mass: Any, numbers: Any, push: Any, h: Any, start: Any) -> None:
    """g += h (gravity + push), then implicit drag: the speed of a fall tends to g / drag."""
    F = g.dtype.type
    slow = F(1 / (1 + h * numbers[1]))
    for row in range(g.shape[0]):
        if inv_mass[row // 3] == 0:
            continue
        gain = F(h * numbers[3 + row % 3])
        if push.size > 0:
            for lane in range(g.shape[1]):
                g[row, lane] += h * push[row, start + lane]
        for lane in range(g.shape[1]):
            g[row, lane] = (g[row, lane] + gain) * slow


class Block(NamedTuple):
    """Lanes of a batch that are stepped together, L of them, and what a method needs of the batch:
    each substep passes it on, and all of a batch is hundreds of words.

    y, u: positions [m] and velocities [m/s], [3N, L]. g, old: scratch like these. wind: see `blow`.
    work: scratch of `blow` and of the method. start: the first of the lanes in the batch. others:
    see `Batch`.
    """

    y: Array
    u: Array
    g: Array
    old: Array
    wind: Array
    work: Array
    start: int
    gusts: Gusts
    numbers: Array
    targets: Array
    push: Array
    residuals: Array
    add_winds: int


def loop_around(substep: Callable[..., None]) -> Callable[..., None]:
    """The kernel that makes steps of lanes first..last, a block at a time, with the wind of the
    start of each step and contact at its end.

    substep: a kernel (block, plan, h, number, options) that moves a block by h [s]; numbers count
    over all steps. It is in a cell, since code that is given a kernel as an argument cannot be
    stored. Options are those of the method, scratch the rows that it needs in `work`.
    """

    @kernel
    def advance(
        first: Any,
        last: Any,
        plan: Any,
        batch: Any,
        steps: Any,
        substeps: Any,
        options: Any,
        scratch: Any = 0,
    ) -> None:
        body, h = plan.body, batch.x.dtype.type(batch.numbers[0])
        for start in range(first, last, batch.width):
            block = load_block(batch, body, start, last, scratch)
            y, u = block.y, block.u
            before = lanes_contact.begin_lanes(y, u, batch)
            number, again = 0, False
            while number < steps * substeps:
                if number % substeps == 0:
                    time = batch.numbers[2] + number * batch.numbers[0]
                    blown = block.wind, y, body.controls, batch.gusts, start, time, block.work
                    blow_at(batch.blow, blown)
                substep(block, plan, h, number, options)
                number, again = lanes_contact.meet_substep(
                    y, u, before, batch, start, number, substeps, h, again
                )
            kernels.store_lanes(batch.new_x, y, start)
            kernels.store_lanes(batch.new_v, u, start)

    return advance


@kernel
def load_block(batch: Any, body: Any, start: Any, last: Any, scratch: Any) -> Any:
    """The block that begins at a lane. scratch: rows of `work` that its method needs."""
    rows, width = batch.x.shape[0], min(batch.width, last - start)
    y, u = simd.empty_lanes(rows, width, batch.x), simd.empty_lanes(rows, width, batch.x)
    g, old = simd.empty_lanes(rows, width, batch.x), simd.empty_lanes(rows, width, batch.x)
    wind, work = wind_lanes(batch, body, width)
    if scratch > work.shape[0]:
        work = simd.empty_lanes(scratch, width, batch.x)
    kernels.load_lanes(y, batch.x, start)
    kernels.load_lanes(u, batch.v, start)
    given = batch.gusts, batch.numbers, batch.targets, batch.push, batch.residuals, batch.add_winds
    return Block(y, u, g, old, wind, work, start, *given)


@borrowing_kernel
def kick(block: Any, body: Any, h: Any) -> None:
    """u += h · acceleration by springs and loads; g is overwritten."""
    y, u, g = block.y, block.u, block.g
    kernels.load_lanes(g, u, 0)
    kernels.add_spring_velocities(g, y, body.springs, body.inv_mass, h)
    kernels.bend(g, y, u, body.stencils, h, g.dtype.type(0), body.damping[0])
    add_loads(block, body, h)
    kernels.load_lanes(u, g, 0)


@borrowing_kernel
def add_loads(block: Any, body: Any, h: Any) -> None:
    """g += h · acceleration by winds, gravity, pushes and drag, at places y and velocities u."""
    y, u, g = block.y, block.u, block.g
    add_winds_at(block.add_winds, (g, y, u, body, block.wind, block.gusts, h))
    fall(g, body.inv_mass, block.numbers, block.push, h, block.start)
