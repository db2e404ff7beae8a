"""Störmer-Verlet on springs, with Provot's limit on stretch taken in Jacobi order.

Verlet, "Computer experiments on classical fluids" (Phys. Rev. 159, 1967). The limit on stretch is
taken from Provot, "Deformation constraints in a mass-spring model" (Graphics Interface 1995), with
all corrections summed from the same positions and then applied together.

Order 2 while no spring is too long. The step is written with velocities (Swope et al. 1982): half a
kick, a drift, half a kick; the positions are those of x_{n+1} = 2 x_n - x_{n-1} + a dt². The method
is explicit, so the stiffest spring decides the number of substeps. It does not lose energy: use
Drag. Choose it for lively, springy cloth and for teaching. It differs from the "Verlet integration"
of position based dynamics (pbd), which has no springs.
"""

from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np

from drapery.cloth import kernels, sheet_kernels
from drapery.cloth.attachments import Attachments
from drapery.cloth.checks import check_number
from drapery.cloth.cloth import STRUCTURAL, Cloth
from drapery.cloth.kernels import add, direction
from drapery.cloth.sheets import is_sheet, together
from drapery.cloth.simd import fill, lane_count, load, maximum, sqrt, store
from drapery.cloth.solvers import planes
from drapery.cloth.solvers.base import check_step
from drapery.cloth.solvers.driver import (
    SHARED,
    ClothBody,
    KernelSolver,
    SolverState,
    body_of,
    check_common,
    chosen_substeps,
    half_shares,
    kick,
    loop_around,
    movable,
)
from drapery.cloth.strain import allowed_stretch, plane_squares, strain_limit
from drapery.jit import borrowing_kernel, entry_point


class VerletPlan(NamedTuple):
    body: ClothBody
    attachments: Attachments


@dataclass(frozen=True)
class SolverVerlet(KernelSolver):
    """Velocity Verlet (1967) with Provot's limit on stretch, for lively, springy cloth.

    limit: longest length of a structural spring over its rest length, 1 to 1e6; Provot allows 1.1.
    sweeps: sweeps of the correction of long springs, a substep, 0 to 1000.
    relaxation: part of a sweep's summed corrections that is applied, 0 to 1. With 1 the method
        becomes unstable where neighbouring springs are too long alternately; up to 2/3 it is stable
        (the sum may move the ends of a spring twice as far as needed).
    substeps: of each step, 1 to 1000; None uses as many as the stiffest spring needs.
    threads: 1 to 1000; None uses every processor. The result does not depend on it.
    Raises OptionError.
    """

    limit: float = 1.1
    sweeps: int = 2
    relaxation: float = 0.5
    substeps: int | None = None
    threads: int | None = None

    def __post_init__(self) -> None:
        check_common(self.limit, self.sweeps, self.substeps, self.threads)
        check_number("relaxation", self.relaxation, 0, 1)

    def init(self, cloth: Cloth, dt: float) -> SolverState:
        check_step(dt, 1)
        attachments = half_attachments(cloth, self.limit, self.relaxation)
        substeps, options = chosen_substeps(self.substeps, cloth, dt), (self.sweeps,)
        limit = strain_limit(cloth, allowed_stretch(self.limit, self.sweeps))
        if is_sheet(cloth):
            fine = planes.plane_plan(cloth, dt / substeps / 2, attachments, together)
            squares = plane_squares(fine.sheet, limit)
            return SolverState(
                fine, dt, substeps, _advance_plane, options, True, limit=limit, squares=squares
            )
        plan = VerletPlan(body_of(cloth), attachments)
        return SolverState(plan, dt, substeps, _advance, options, limit=limit, shares=SHARED)


def half_attachments(cloth: Cloth, limit: float, relaxation: float) -> Attachments:
    """The structural springs; each end takes half of a correction times the relaxation."""
    chosen = (cloth.spring_kind == STRUCTURAL) & movable(cloth)
    pairs = cloth.spring_pairs[chosen]
    longest = cloth.spring_length[chosen] * limit
    part_i, part_j = (relaxation * half_shares(cloth, pairs)).T.copy()
    return Attachments(pairs, longest, part_i, part_j)


@borrowing_kernel
def shorten_together(y: Any, attachments: Any, sums: Any) -> None:
    """One Jacobi sweep: corrections from the same positions are summed, then applied."""
    none = y.dtype.type(0)
    for row in range(y.shape[0]):
        for lane in range(y.shape[1]):
            sums[row, lane] = none
    for s in range(attachments.longest.size):
        i, j = 3 * np.intp(attachments.pairs[s, 0]), 3 * np.intp(attachments.pairs[s, 1])
        longest, part_i, part_j = (
            fill(attachments.longest[s]),
            attachments.share_i[s],
            -attachments.share_j[s],
        )
        for lane in range(0, y.shape[1], lane_count(y)):
            dx, dy, dz = direction(y, i, j, lane)
            d = maximum(sqrt(dx * dx + dy * dy + dz * dz), longest)
            excess = (d - longest) / d
            add(sums, i, lane, part_i * excess, dx, dy, dz)
            add(sums, j, lane, part_j * excess, dx, dy, dz)
    for row in range(y.shape[0]):
        for lane in range(y.shape[1]):
            y[row, lane] += sums[row, lane]


@borrowing_kernel
def _substep(block: Any, plan: Any, h: Any, number: Any, options: Any) -> None:
    """Half a kick, a drift with the limit on stretch, half a kick."""
    y, old, body = block.y, block.old, plan.body
    half = y.dtype.type(block.numbers[0] / 2)
    (sweeps,) = options
    kick(block, body, half)
    kernels.move(y, block.u, old, h)
    kernels.place_pins(y, old, body.pins, block.targets, number, block.start)
    for _ in range(sweeps):
        shorten_together(y, plan.attachments, block.g)
    kernels.set_velocities(block.u, y, old, h)
    kick(block, body, half)


_advance_blocks = loop_around(_substep)


@entry_point
def _advance(
    first: Any, last: Any, plan: Any, batch: Any, steps: Any, substeps: Any, sweeps: Any
) -> None:
    """Steps of lanes first..last."""
    _advance_blocks(first, last, plan, batch, steps, substeps, (sweeps,))


@borrowing_kernel
def _plane_substep(block: Any, plan: Any, h: Any, number: Any, options: Any) -> None:
    """The same for a plane of lanes."""
    y, u, g, old, sheet = block.y, block.u, block.g, block.old, plan.sheet
    half = y.dtype.type(block.numbers[0] / 2)
    (sweeps,) = options
    planes.kick(block, plan, half)
    sheet_kernels.move(y, g, old, h, sheet)
    sheet_kernels.place(y, sheet, block.targets, number, block.cloth)
    for _ in range(sweeps):
        shorten_plane(y, g, plan.attachments, sheet, block.work)
    sheet_kernels.set_velocities(u, y, old, h, sheet)
    planes.kick(block, plan, half)
    sheet_kernels.take_free(u, g, sheet)


@borrowing_kernel
def shorten_plane(y: Any, sums: Any, attachments: Any, sheet: Any, work: Any) -> None:
    """`shorten_together` for a plane of lanes."""
    none = fill(y.dtype.type(0))
    for axis in range(3):
        for lane in range(0, sheet.size, lane_count(y)):
            store(sums, axis, lane, none)
    last = attachments.a.size
    sheet_kernels.solve_batches(y, sums, attachments, 0, last, sheet_kernels.SHORTEN, work)
    for axis in range(3):
        for lane in range(0, sheet.size, lane_count(y)):
            store(y, axis, lane, load(y, axis, lane) + load(sums, axis, lane))


_advance_planes = planes.loop_around_plane(_plane_substep)


@entry_point
def _advance_plane(
    first: Any, last: Any, plan: Any, batch: Any, steps: Any, substeps: Any, sweeps: Any
) -> None:
    """Steps of cloths first..last, one after another."""
    _advance_planes(first, last, plan, batch, steps, substeps, (sweeps,))
