"""Desbrun, Schröder, Barr, "Interactive animation of structured deformable objects" (1999).

A predictor-corrector of first order. The linear part of the springs is integrated implicitly by a
filter that is made once per cloth and step, the other forces explicitly. Springs that are then too
long are shortened (Provot 1995). It is stable for any stiffness and step. The filter damps motion,
more with stiffer springs. Choose it for many small hanging cloths. It is not implicit Euler
(Baraff, Witkin 1998), which solves with the true Hessian at every step.

The paper's force (section 3.2) is printed with the wrong sign: a stretched spring pulls i towards
j. Its implicit viscosity k dt (v_j - v_i) equals dt H v, and W dt² M⁻¹ H = W - I, so instead of
filtering that force the velocity itself is filtered: v' = W (v + dt/m F) + dt/m F_ext.
"""

from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np

from drapery.cloth import kernels, sheet_kernels, simd
from drapery.cloth.attachments import Attachments, stretch_limits
from drapery.cloth.checks import check_choice
from drapery.cloth.cloth import Cloth
from drapery.cloth.contact import lanes_contact
from drapery.cloth.faces import wind_faces
from drapery.cloth.filters import (
    BandFilter,
    Filter,
    SheetFilter,
    cloth_filter,
    is_regular,
    sheet_filter,
)
from drapery.cloth.sheets import (
    ConstraintBatches,
    SheetBending,
    SheetLayout,
    is_sheet,
    limits,
    sheet_bending,
    sheet_of,
    spring_batches,
)
from drapery.cloth.solvers.base import check_step
from drapery.cloth.solvers.driver import (
    SHARED,
    ClothBody,
    KernelSolver,
    SolverState,
    add_winds_at,
    blow_at,
    body_of,
    check_common,
    wind_lanes,
)
from drapery.cloth.spin import Correction, NoSpin, Spin, spin_correction
from drapery.cloth.strain import allowed_stretch, plane_squares, strain_limit
from drapery.jit import entry_point

MAX_CELLS = 60
"""A step has one substep per this many cells along the longer side of a grid: a gust must not move
a particle past several neighbours in one substep."""


class DesbrunPlan(NamedTuple):
    body: ClothBody
    filter: Filter | BandFilter
    attachments: Attachments
    spin: Spin | NoSpin


class DesbrunSheetPlan(NamedTuple):
    sheet: SheetLayout
    springs: ConstraintBatches
    bending: SheetBending
    attachments: ConstraintBatches
    filter: SheetFilter


@dataclass(frozen=True)
class SolverDesbrun(KernelSolver):
    """Desbrun's predictor-corrector (1999).

    It is stable for any stiffness and step and fast for many small hanging cloths; it damps motion.

    limit: longest length of a structural spring over its rest length, 1 to 1e6.
    sweeps: sweeps of the correction of long springs, a step, 0 to 1000; 0 corrects none.
    angular: how the angular momentum of a cloth without pins is corrected: `exact`, `paper` or
        `none`; see `drapery.cloth.spin`.
    substeps: of each step, 1 to 1000; None uses one per 60 cells of a grid's longer side.
    threads: 1 to 1000; None uses every processor. The result does not depend on it.
    Raises OptionError.
    """

    limit: float = 1.005
    sweeps: int = 3
    angular: Correction = "exact"
    substeps: int | None = None
    threads: int | None = None

    def __post_init__(self) -> None:
        check_choice("angular", self.angular, ("exact", "paper", "none"))
        check_common(self.limit, self.sweeps, self.substeps, self.threads)

    def init(self, cloth: Cloth, dt: float) -> SolverState:
        check_step(dt, 1)
        substeps = self.substeps or -(-max(cloth.grid_shape or (1,)) // MAX_CELLS)
        h = dt / substeps
        pinned = (cloth.inv_mass == 0).any()
        limit = strain_limit(cloth, allowed_stretch(self.limit, self.sweeps))
        if is_sheet(cloth) and is_regular(cloth) and (pinned or self.angular == "none"):
            fine = sheet_plan(cloth, h, self.limit, self.sweeps)
            squares = plane_squares(fine.sheet, limit)
            return SolverState(
                fine, dt, substeps, _advance_sheet, alone=True, limit=limit, squares=squares
            )
        attachments = stretch_limits(cloth, self.limit, self.sweeps)
        spin = spin_correction(cloth, h, self.angular)
        plan = DesbrunPlan(body_of(cloth), cloth_filter(cloth, h), attachments, spin)
        return SolverState(plan, dt, substeps, _advance, limit=limit, shares=SHARED)


def sheet_plan(cloth: Cloth, dt: float, limit: float, sweeps: int) -> DesbrunSheetPlan:
    """The plan of a fine grid, which is laid out as a plane of lanes."""
    sheet = sheet_of(cloth, *wind_faces(cloth))
    return DesbrunSheetPlan(
        sheet,
        spring_batches(sheet, cloth, dt),
        sheet_bending(sheet, cloth.bending),
        limits(sheet, cloth, limit, sweeps),
        sheet_filter(cloth, dt, sheet.width),
    )


@entry_point
def _advance(first: int, last: int, plan: Any, batch: Any, steps: int, substeps: int) -> None:
    """Steps of lanes first..last, a block at a time."""
    body, dtype = plan.body, batch.x.dtype
    dt = dtype.type(batch.numbers[0])
    rows, width = batch.x.shape[0], min(batch.width, last - first)
    y, u = simd.empty_lanes(rows, width, batch.x), simd.empty_lanes(rows, width, batch.x)
    both = simd.empty_lanes(2 * rows, width, batch.x).reshape((2, rows, width))
    old = simd.empty_lanes(rows, width, batch.x)
    g, mean = both[1], simd.empty_lanes(3, width, batch.x)
    wind, work = wind_lanes(batch, body, width)
    for block in range(first, last, width):
        # The last block overlaps the one before, so all blocks have the same width.
        start = min(block, last - width)
        kernels.load_lanes(y, batch.x, start)
        kernels.load_lanes(u, batch.v, start)
        before = lanes_contact.begin_lanes(y, u, batch)
        step, again = 0, False
        while step < steps * substeps:
            time = batch.numbers[2] + step * batch.numbers[0]
            kernels.frame_velocity(mean, u, body.pins)
            kernels.subtract_frame(both[0], u, mean)
            kernels.add_spring_velocities(both[0], y, body.springs, body.inv_mass, dt)
            kernels.bend(both[0], y, u, body.stencils, dt, dtype.type(0), body.damping[0])
            kernels.filter_velocities(both, plan.filter, body.pins)
            kernels.restore_angular_momentum(g, y, u, plan.spin, work)
            blow_at(batch.blow, (wind, y, body.controls, batch.gusts, start, time, work))
            add_winds_at(batch.add_winds, (g, y, u, body, wind, batch.gusts, dt))
            kernels.add_uniform(g, mean, body.inv_mass, batch.numbers, batch.push, start)
            kernels.move(y, g, old, dt)
            kernels.place_pins(y, old, body.pins, batch.targets, step, start)
            kernels.shorten(y, plan.attachments)
            kernels.set_velocities(u, y, old, dt)
            step, again = lanes_contact.meet_substep(
                y, u, before, batch, start, step, substeps, dt, again
            )
        kernels.store_lanes(batch.new_x, y, start)
        kernels.store_lanes(batch.new_v, u, start)


@entry_point
def _advance_sheet(first: int, last: int, plan: Any, batch: Any, steps: int, substeps: int) -> None:
    """Steps of cloths first..last, one after another."""
    sheet, dtype = plan.sheet, batch.x.dtype
    dt, width = dtype.type(batch.numbers[0]), sheet.plane * (1 + sheet.anchors.size)
    y, u = simd.empty_lanes(3, width, batch.x), simd.empty_lanes(3, sheet.plane, batch.x)
    g, old = simd.empty_lanes(3, sheet.plane, batch.x), simd.empty_lanes(3, sheet.plane, batch.x)
    work, mean = simd.empty_lanes(3, 2 * sheet.plane, batch.x), np.empty(3, dtype)
    scratch = sheet_kernels.wind_scratch(sheet, batch.gusts, dtype)
    for cloth in range(first, last):
        sheet_kernels.load_plane(y, batch.x, cloth, sheet)
        sheet_kernels.load_plane(u, batch.v, cloth, sheet)
        before = lanes_contact.begin_plane(y, u, batch, sheet)
        gusts = sheet_kernels.own_gusts(batch.gusts, cloth, sheet.controls.size)
        step, again = 0, False
        while step < steps * substeps:
            time = batch.numbers[2] + step * batch.numbers[0]
            sheet_kernels.subtract_mean(g, u, mean, sheet)
            sheet_kernels.add_spring_velocities(g, y, plan.springs, work)
            sheet_kernels.bend(
                g, y, u, plan.bending, sheet, dt, dtype.type(0), plan.bending.damping[0], work
            )
            sheet_kernels.filter_sheet(g, old, plan.filter, sheet)
            sheet_kernels.blow(y, sheet, gusts, time, scratch)
            sheet_kernels.add_winds(g, y, u, sheet, gusts, dt, scratch)
            sheet_kernels.add_push(g, sheet, batch.push, dt, cloth)
            sheet_kernels.fall(g, mean, sheet, batch.numbers, batch.numbers[0])
            sheet_kernels.move(y, g, old, dt, sheet)
            sheet_kernels.place(y, sheet, batch.targets, step, cloth)
            sheet_kernels.solve_batches(
                y, y, plan.attachments, 0, plan.attachments.a.size, sheet_kernels.LIMIT, work
            )
            sheet_kernels.set_velocities(u, y, old, dt, sheet)
            step, again = lanes_contact.meet_plane_substep(
                y, u, before, batch, cloth, step, substeps, dt, sheet, again
            )
        sheet_kernels.store_plane(batch.new_x, y, cloth, sheet)
        sheet_kernels.store_plane(batch.new_v, u, cloth, sheet)
