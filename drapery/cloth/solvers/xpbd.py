"""Extended position based dynamics in small steps.

Macklin, Müller, Chentanez, "XPBD: position-based simulation of compliant constrained dynamics"
(MIG 2016), and Macklin et al., "Small steps in physics simulation" (SCA 2019): n substeps of one
iteration are better than one step of n iterations. The order is 1. It is stable at any stiffness
and damps little, less with more substeps. Choose it for cloth that hardly stretches, for fine grids
and for lively motion. It differs from position based dynamics (pbd), whose stiffness depends on the
step.

A spring of rest length l is the constraint (d² - l²) / (d² + l²) · d = 0, which is d - l to second
order and needs no square root (Jakobsen, "Advanced character physics", GDC 2001). With one
iteration a substep its multiplier starts from 0 (2016, eq. 18): Δλ = -C / (w_i + w_j + α / h²).

Soft springs are solved in only t of the n substeps of a step, with α / (h dt / t) instead of
α / h². This is multiple time stepping (Tuckerman, Berne, Martyna 1992): the short steps are used
for the stiff springs. Gravity acts in every substep, wind and other loads once a step. Long-range
attachments (`drapery.cloth.attachments`) correct errors over many springs at once. Bending
(`drapery.cloth.bending`) is soft, so it acts as a force in as many substeps as it needs: as a
compliant constraint with one iteration it would be too soft where stencils overlap.
"""

import pickle
from dataclasses import dataclass, replace
from functools import lru_cache
from itertools import pairwise
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from drapery.cloth import kernels, sheet_kernels, simd
from drapery.cloth.attachments import Attachments, long_range_attachments
from drapery.cloth.bending import BendingStep, bending_step, fastest_bending
from drapery.cloth.checks import check_flag, check_number, check_three
from drapery.cloth.cloth import STRUCTURAL, Cloth
from drapery.cloth.contact import lanes_contact
from drapery.cloth.faces import wind_faces
from drapery.cloth.kernels import add, direction
from drapery.cloth.order import across_then_outwards, pin_distances
from drapery.cloth.sheet_kernels import bend
from drapery.cloth.sheets import (
    ConstraintBatch,
    ConstraintBatches,
    Pairs,
    SheetBending,
    SheetLayout,
    anchored,
    constraint_batches,
    in_turn,
    is_sheet,
    limits,
    sheet_bending,
    sheet_of,
)
from drapery.cloth.simd import fill, lane_count, load, maximum, store
from drapery.cloth.solvers.base import check_step
from drapery.cloth.solvers.driver import (
    MAX_SUBSTEPS,
    WINDS,
    ClothBody,
    KernelSolver,
    SolverState,
    add_winds_at,
    blow_at,
    body_of,
    check_stepping,
    wind_lanes,
)
from drapery.cloth.strain import MOST_STRETCH, plane_squares, strain_limit
from drapery.jit import borrowing_kernel, entry_point
from drapery.mesh import Array

SLACK = 1.02
"""Attachments are longer than at rest by this factor, so they act only on stretched cloth."""
NEAR = 2
"""Particles at most this many springs from a pin need no attachment."""
FINE = 30
"""The most particles along a side of a sheet without desbrun's limits, which act once a step."""
LIMIT, SWEEPS = 1.02, 1
"""Settings of those limits."""
MAX_FINE_SUBSTEPS = 26
"""Most substeps of larger sheets. In shorter steps rounding would shake their small cells."""
INTERVAL = 2
"""Attachments act in the last of every this many substeps."""
SOFT_RATE = 3.0
"""Soft springs are solved this many times as often as an explicit step would need."""
MAX_REMEMBERED = 4096
"""The most particles of a cloth whose plan is kept for the next cloth with the same contents."""


class XPBDConstraints(NamedTuple):
    """Springs in the order of solving; those of substep n are from begin[n] to begin[n + 1].

    pairs: [K, 2]. square: rest lengths squared [m²], [K]. share_i, share_j: w / (w_i + w_j + α~).
    begin: [substeps + 1].
    """

    pairs: NDArray[np.int32]
    square: Array
    share_i: Array
    share_j: Array
    begin: NDArray[np.int64]


class XPBDPlan(NamedTuple):
    body: ClothBody
    constraints: XPBDConstraints
    every: int
    bending_step: BendingStep
    attachments: Attachments


class XPBDSheetPlan(NamedTuple):
    """begin: the first entry of each substep, [substeps + 1]."""

    sheet: SheetLayout
    constraints: ConstraintBatches
    begin: NDArray[np.int64]
    bending: SheetBending
    every: int
    bending_step: BendingStep
    attachments: ConstraintBatches
    limits: ConstraintBatches


@dataclass(frozen=True)
class SolverXPBD(KernelSolver):
    """Extended position based dynamics (Macklin et al. 2016) in small steps (2019).

    It is stable at any stiffness and damps little. Choose it for cloth that hardly stretches, for
    fine grids and for lively motion.

    substeps: of each step, 1 to 1000; None chooses them by the number of springs to the pins.
    compliance: of structural, shear and flexion springs [m/N], 0 to 1e12 each; None uses the
        inverse of each spring's stiffness. By default structural springs do not stretch.
    attach: whether long-range attachments limit the distance of particles from their pins.
    threads: 1 to 1000; None uses every processor. The result does not depend on it.
    Raises OptionError.
    """

    substeps: int | None = None
    compliance: tuple[float | None, float | None, float | None] = (0.0, None, None)
    attach: bool = True
    threads: int | None = None

    def __post_init__(self) -> None:
        check_stepping(self.substeps, self.threads)
        check_three("compliance", self.compliance)
        object.__setattr__(self, "compliance", tuple(self.compliance))  # plans are kept by solver
        for value in self.compliance:
            if value is not None:
                check_number("compliance", value, 0, 1e12, "m/N")
        check_flag("attach", self.attach)

    def init(self, cloth: Cloth, dt: float) -> SolverState:
        check_step(dt, 1)
        if len(cloth.inv_mass) > MAX_REMEMBERED:
            return self._planned(cloth, dt)
        # By its contents, since a caller may change the arrays of a cloth.
        return replace(_remembered(self, pickle.dumps(cloth), dt), by_type={})

    def _planned(self, cloth: Cloth, dt: float) -> SolverState:
        substeps = self.substeps or max(enough_substeps(cloth), bending_substeps(cloth, dt))
        constraints = solved_springs(cloth, self._compliances(cloth), dt, substeps)
        attachments = self._attachments(cloth)
        turns = bending_turns(cloth, dt, substeps)
        often = bool((cloth.inv_mass > 0).all())
        limit = strain_limit(cloth, MOST_STRETCH if self.compliance[0] == 0.0 else np.inf)
        if is_sheet(cloth):
            fine = sheet_plan(cloth, constraints, attachments, turns)
            return SolverState(
                fine,
                dt,
                substeps,
                _advance_sheet,
                alone=True,
                often=often,
                limit=limit,
                squares=plane_squares(fine.sheet, limit),
            )
        plan = XPBDPlan(body_of(cloth), constraints, *turns, attachments)
        return SolverState(plan, dt, substeps, _advance, often=often, limit=limit, shares=WINDS)

    def _compliances(self, cloth: Cloth) -> Array:
        own = 1 / np.maximum(cloth.spring_stiffness, 1e-12)
        for kind, value in enumerate(self.compliance):
            if value is not None:
                own[cloth.spring_kind == kind] = value
        return own

    def _attachments(self, cloth: Cloth) -> Attachments:
        pairs, max_distance = long_range_attachments(cloth, SLACK)
        own = cloth.spring_length[cloth.spring_kind == STRUCTURAL]
        far = self.attach & (max_distance > (NEAR + 0.5) * SLACK * own.mean())
        ones = np.ones(int(far.sum()))
        return Attachments(pairs[far], max_distance[far], 0 * ones, ones)


@lru_cache(maxsize=8)
def _remembered(solver: SolverXPBD, cloth: bytes, dt: float) -> SolverState:
    """The plan of a pickled cloth; a banner's takes a third of the time of its picture."""
    return solver._planned(pickle.loads(cloth), dt)


def is_fine(cloth: Cloth) -> bool:
    """Whether a cloth is a sheet to which desbrun's limits also apply, once a step."""
    return is_sheet(cloth) and max(cloth.grid_shape or (1,)) > FINE


def enough_substeps(cloth: Cloth) -> int:
    """Substeps with which a hanging cloth stretches by a few per cent at most in a strong wind: one
    for every two or three springs to its pins, or across a cloth without pins."""
    if is_fine(cloth):
        return min(MAX_FINE_SUBSTEPS, -(-max(cloth.grid_shape or (1,)) * 10 // 25))
    if cloth.grid_shape is not None:
        return max(4, -(-max(cloth.grid_shape) * 10 // 21))
    distances = pin_distances(cloth)
    max_distance = distances[np.isfinite(distances)].max(initial=0.0)
    springs = max_distance / cloth.spring_length[cloth.spring_kind == STRUCTURAL].mean()
    return max(4, min(MAX_SUBSTEPS, int(np.ceil(springs / 2.1))))


def bending_substeps(cloth: Cloth, dt: float) -> int:
    """Substeps of at most one radian of the fastest oscillation of bending."""
    swing = dt * np.sqrt(fastest_bending(cloth.bending, cloth.inv_mass))
    return int(min(MAX_SUBSTEPS, np.ceil(swing)))


def solved_springs(cloth: Cloth, compliance: Array, dt: float, substeps: int) -> XPBDConstraints:
    """The springs of each substep in order: all stiff ones and the soft ones of that substep."""
    w = cloth.inv_mass[cloth.spring_pairs].sum(axis=1)
    times = turns_a_step(compliance, w, dt, substeps)
    first = _first_turns(cloth, times < substeps, substeps)
    movable = w > 0
    chosen = []
    for substep in range(substeps):
        due = (substep - first) % -(-substeps // times) == 0
        springs = np.flatnonzero(movable & (due | (times == substeps)))
        chosen.append(across_then_outwards(cloth, springs))
    order = np.concatenate(chosen)
    each = dt**2 / substeps / -(-substeps // (-(-substeps // times)))
    shares = cloth.inv_mass[cloth.spring_pairs] / (w + compliance / each + ~movable)[:, None]
    return XPBDConstraints(
        cloth.spring_pairs[order],
        cloth.spring_length[order] ** 2,
        shares[order, 0],
        shares[order, 1],
        np.cumsum([0, *(len(springs) for springs in chosen)]),
    )


def turns_a_step(compliance: Array, w: Array, dt: float, substeps: int) -> NDArray[np.int64]:
    """In how many of a step's substeps each spring is solved, [S].

    A spring oscillates with a frequency of sqrt(w / α), and twice that with its neighbours. The
    number is the least at which that is well below the limit of an explicit step.
    """
    swing = SOFT_RATE * dt * np.sqrt(w / np.maximum(compliance, 1e-30))
    return np.clip(np.ceil(swing), 1, substeps).astype(np.int64)


def bending_turns(cloth: Cloth, dt: float, substeps: int) -> tuple[int, BendingStep]:
    """After how many substeps bending acts again, before the first of them, and its step."""
    every = max(1, substeps // max(1, bending_substeps(cloth, dt)))
    time = dt / -(-substeps // every)
    return every, bending_step(cloth.bending, cloth.inv_mass, time)


def _first_turns(cloth: Cloth, soft: NDArray[np.bool_], substeps: int) -> NDArray[np.int64]:
    """The substep in which each soft spring is solved first, [S], evenly spread over the substeps.

    Springs of one direction of a grid are solved together.
    """
    shifts = cloth.spring_pairs[:, 1] - cloth.spring_pairs[:, 0]
    if cloth.grid_shape is None:
        shifts = np.arange(len(shifts))
    _, number = np.unique(shifts[soft], return_inverse=True)
    first = np.zeros(len(soft), np.int64)
    first[soft] = number.ravel() * substeps // max(1, int(number.max(initial=0)) + 1)
    return first


def sheet_plan(
    cloth: Cloth,
    constraints: XPBDConstraints,
    attachments: Attachments,
    turns: tuple[int, BendingStep],
) -> XPBDSheetPlan:
    """The plan of a fine grid, which is laid out as a plane of lanes."""
    sheet = sheet_of(cloth, *wind_faces(cloth))
    batches: list[ConstraintBatch] = []
    begin = [0]
    for first, last in pairwise(constraints.begin):
        turn = slice(first, last)
        due = Pairs(
            constraints.pairs[turn],
            np.sqrt(constraints.square[turn]),
            constraints.share_i[turn],
            constraints.share_j[turn],
        )
        batches += in_turn(sheet, due)
        begin.append(len(batches))
    held = constraint_batches(list(anchored(sheet, Pairs(*attachments))))
    return XPBDSheetPlan(
        sheet,
        constraint_batches(batches),
        np.array(begin),
        sheet_bending(sheet, cloth.bending),
        *turns,
        held,
        limits(sheet, cloth, LIMIT, SWEEPS * is_fine(cloth)),
    )


@borrowing_kernel
def solve(x: Any, constraints: Any, substep: Any) -> None:
    """The constraints of one substep, one after another."""
    for s in range(constraints.begin[substep], constraints.begin[substep + 1]):
        i, j = 3 * np.intp(constraints.pairs[s, 0]), 3 * np.intp(constraints.pairs[s, 1])
        rest = constraints.square[s]
        part_i, part_j = constraints.share_i[s], -constraints.share_j[s]
        for lane in range(0, x.shape[1], lane_count(x)):
            dx, dy, dz = direction(x, i, j, lane)
            square = dx * dx + dy * dy + dz * dz
            strain = (square - rest) / (square + rest)
            add(x, i, lane, part_i * strain, dx, dy, dz)
            add(x, j, lane, part_j * strain, dx, dy, dz)


@borrowing_kernel
def apply_attachments(x: Any, attachments: Any) -> None:
    """Move particles that are too far from their pins back; see the module for the constraint."""
    for s in range(attachments.longest.size):
        pin, i = 3 * np.intp(attachments.pairs[s, 0]), 3 * np.intp(attachments.pairs[s, 1])
        limit = attachments.longest[s] * attachments.longest[s]
        minimum = fill(limit)
        for lane in range(0, x.shape[1], lane_count(x)):
            dx, dy, dz = direction(x, pin, i, lane)
            square = maximum(dx * dx + dy * dy + dz * dz, minimum)
            add(x, i, lane, (limit - square) / (limit + square), dx, dy, dz)


@borrowing_kernel
def drift(x: Any, old: Any, v: Any, inv_mass: Any, numbers: Any, moves_by_v: Any) -> None:
    """New positions, into old: x moves by v, or else as in the last substep, and by gravity.

    The old positions are overwritten; the caller swaps the two arrays. Pins: see `place_pins`.
    """
    F = x.dtype.type
    h = F(numbers[0])
    for row in range(x.shape[0]):
        if inv_mass[row // 3] == 0:
            continue
        fall = F(numbers[0] * numbers[0] * numbers[3 + row % 3])
        for lane in range(0, x.shape[1], lane_count(x)):
            here = load(x, row, lane)
            motion = h * load(v, row, lane) if moves_by_v else here - load(old, row, lane)
            store(old, row, lane, here + (motion + fall))


@borrowing_kernel
def add_pushes(u: Any, inv_mass: Any, numbers: Any, push: Any, dt: Any, start: Any) -> None:
    """u += dt push, then implicit drag over dt; see `kernels.add_uniform`.

    Gravity is added later, in the substeps; the drag already includes that speed.
    """
    F = u.dtype.type
    slow = F(1 / (1 + dt * numbers[1]))
    if push.size == 0 and numbers[1] == 0:
        return
    for row in range(u.shape[0]):
        if inv_mass[row // 3] == 0:
            continue
        fall = F(dt * numbers[3 + row % 3])
        for lane in range(0, u.shape[1], lane_count(u)):
            speed = load(u, row, lane)
            if push.size > 0:
                speed = speed + dt * load(push, row, start + lane)
            store(u, row, lane, (speed + fall) * slow - fall)


@entry_point
def _advance(first: int, last: int, plan: Any, batch: Any, steps: int, substeps: int) -> None:
    """Steps of lanes first..last, a block at a time."""
    body, dtype = plan.body, batch.x.dtype
    h = dtype.type(batch.numbers[0])
    dt = dtype.type(batch.numbers[0] * substeps)
    none, bend_time, damping = (
        dtype.type(0),
        plan.bending_step.time[0],
        plan.bending_step.damping[0],
    )
    rows, width = batch.x.shape[0], min(batch.width, last - first)
    y, u = simd.empty_lanes(rows, width, batch.x), simd.empty_lanes(rows, width, batch.x)
    old = simd.empty_lanes(rows, width, batch.x)
    wind, work = wind_lanes(batch, body, width)
    for block in range(first, last, width):
        # The last block overlaps the one before, so all blocks have the same width.
        start = min(block, last - width)
        kernels.load_lanes(y, batch.x, start)
        kernels.load_lanes(u, batch.v, start)
        before = lanes_contact.begin_lanes(y, u, batch)
        # A step of one substep cannot have more contacts.
        always = batch.often or substeps == 1
        step, careful = 0, always
        while step < steps:
            time = batch.numbers[2] + step * substeps * batch.numbers[0]
            blow_at(batch.blow, (wind, y, body.controls, batch.gusts, start, time, work))
            add_winds_at(batch.add_winds, (u, y, u, body, wind, batch.gusts, dt))
            add_pushes(u, body.inv_mass, batch.numbers, batch.push, dt, start)
            for substep in range(substeps):
                # After contact the cloth moves on more slowly than contact moved it.
                moves_by_u = substep == 0 or (careful and not batch.often)
                if moves_by_u and substep % plan.every == 0:
                    kernels.bend(u, y, u, body.stencils, bend_time, none, damping)
                elif substep % plan.every == 0:
                    # The motion of a substep is y - old.
                    rate = damping / h
                    kernels.bend(old, y, old, body.stencils, -h * bend_time, rate, -rate)
                drift(y, old, u, body.inv_mass, batch.numbers, moves_by_u)
                y, old = old, y
                turn = step * substeps + substep
                kernels.place_pins(y, old, body.pins, batch.targets, turn, start)
                solve(y, plan.constraints, substep)
                if (substeps - substep) % INTERVAL == 1:
                    apply_attachments(y, plan.attachments)
                if careful and substep + 1 < substeps:
                    kernels.set_velocities(u, y, old, h)
                    when = step, substep / substeps, (substep + 1) / substeps
                    lanes_contact.meet_lanes(y, u, before, batch, start, when, h, True)
            kernels.set_velocities(u, y, old, h)
            when = step, (substeps - 1) / substeps if careful else 0.0, 1.0
            moved = h if careful else dt
            met = lanes_contact.meet_lanes(y, u, before, batch, start, when, moved, careful)
            again = met == 1
            careful = again or always
            step += not again
        kernels.store_lanes(batch.new_x, y, start)
        kernels.store_lanes(batch.new_v, u, start)


@entry_point
def _advance_sheet(first: int, last: int, plan: Any, batch: Any, steps: int, substeps: int) -> None:
    """Steps of cloths first..last, one after another."""
    sheet, dtype = plan.sheet, batch.x.dtype
    h = dtype.type(batch.numbers[0])
    dt = dtype.type(batch.numbers[0] * substeps)
    none, bend_time, damping = (
        dtype.type(0),
        plan.bending_step.time[0],
        plan.bending_step.damping[0],
    )
    y = simd.empty_lanes(3, sheet.plane * (1 + sheet.anchors.size), batch.x)
    u, old = simd.empty_lanes(3, sheet.plane, batch.x), simd.empty_lanes(3, sheet.plane, batch.x)
    work, scratch = (
        simd.empty_lanes(3, 2 * sheet.plane, batch.x),
        sheet_kernels.wind_scratch(sheet, batch.gusts, dtype),
    )
    for cloth in range(first, last):
        sheet_kernels.load_plane(y, batch.x, cloth, sheet)
        sheet_kernels.load_plane(u, batch.v, cloth, sheet)
        before = lanes_contact.begin_plane(y, u, batch, sheet)
        gusts = sheet_kernels.own_gusts(batch.gusts, cloth, sheet.controls.size)
        # A step of one substep cannot have more contacts.
        always = batch.often or substeps == 1
        step, careful = 0, always
        while step < steps:
            time = batch.numbers[2] + step * substeps * batch.numbers[0]
            sheet_kernels.blow(y, sheet, gusts, time, scratch)
            sheet_kernels.add_winds(u, y, u, sheet, gusts, dt, scratch)
            sheet_kernels.add_push(u, sheet, batch.push, dt, cloth)
            sheet_kernels.slow_down(u, sheet, batch.numbers, dt)
            for substep in range(substeps):
                # After contact the cloth moves on more slowly than contact moved it.
                moves_by_u = substep == 0 or (careful and not batch.often)
                if moves_by_u and substep % plan.every == 0:
                    bend(u, y, u, plan.bending, sheet, bend_time, none, damping, work)
                elif substep % plan.every == 0:
                    # The motion of a substep is y - old.
                    rate, back = damping / h, -h * bend_time
                    bend(old, y, old, plan.bending, sheet, back, rate, -rate, work)
                sheet_kernels.drift(y, old, u, sheet, batch.numbers, moves_by_u)
                turn = step * substeps + substep
                sheet_kernels.place(y, sheet, batch.targets, turn, cloth)
                begin, end = plan.begin[substep], plan.begin[substep + 1]
                sheet_kernels.solve_batches(
                    y, y, plan.constraints, begin, end, sheet_kernels.SOLVE, work
                )
                if (substeps - substep) % INTERVAL == 1:
                    last = plan.attachments.a.size
                    sheet_kernels.solve_batches(
                        y, y, plan.attachments, 0, last, sheet_kernels.LIMIT, work
                    )
                if careful and substep + 1 < substeps:
                    sheet_kernels.set_velocities(u, y, old, h, sheet)
                    when = step, substep / substeps, (substep + 1) / substeps
                    lanes_contact.meet_plane(y, u, before, batch, cloth, when, h, sheet, True)
            sheet_kernels.set_velocities(u, y, old, h, sheet)
            if plan.limits.a.size > 0:
                sheet_kernels.move(y, u, old, dtype.type(0), sheet)
                last_limit = plan.limits.a.size
                sheet_kernels.solve_batches(
                    y, y, plan.limits, 0, last_limit, sheet_kernels.LIMIT, work
                )
                sheet_kernels.add_velocities(u, y, old, dt, sheet)
            when = step, (substeps - 1) / substeps if careful else 0.0, 1.0
            moved = h if careful else dt
            again = lanes_contact.meet_plane(
                y, u, before, batch, cloth, when, moved, sheet, careful
            )
            careful = again or always
            step += not again
        sheet_kernels.store_plane(batch.new_x, y, cloth, sheet)
        sheet_kernels.store_plane(batch.new_v, u, cloth, sheet)
