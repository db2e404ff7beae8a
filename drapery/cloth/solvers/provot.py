"""Provot, "Deformation constraints in a mass-spring model to describe rigid cloth behaviour"
(Graphics Interface 1995): Euler's method, then the dynamic inverse.

Order 1: v' = v + dt a(x), x' = x + dt v' (nowadays called symplectic Euler). Then every spring that
is too long is shortened to its longest length, one after another in the order of the cloth; in a
grid of 16 or more columns, one direction after another, each in parts that share no particle. Both
ends share the correction; a pinned end takes none of it. The velocities are computed from the
corrected positions. The method is explicit, so the stiffest spring decides the number of substeps.
Choose it to compare the other methods with their origin. It differs from desbrun, which ends with
the same correction but integrates implicitly, and from verlet, which corrects in Jacobi order.
"""

from dataclasses import dataclass
from typing import Any, NamedTuple

from drapery.cloth import kernels, sheet_kernels
from drapery.cloth.attachments import Attachments
from drapery.cloth.cloth import FLEXION, Cloth
from drapery.cloth.sheets import in_turn, is_sheet
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


class ProvotPlan(NamedTuple):
    body: ClothBody
    attachments: Attachments


@dataclass(frozen=True)
class SolverProvot(KernelSolver):
    """Provot's explicit method (1995), the origin of the others.

    limit: longest length of a structural or shear spring over its rest length, 1 to 1e6; Provot
        allows 1.1.
    sweeps: sweeps of the correction of long springs, a substep, 0 to 1000.
    substeps: of each step, 1 to 1000; None uses as many as the stiffest spring needs.
    threads: 1 to 1000; None uses every processor. The result does not depend on it.
    Raises OptionError.
    """

    limit: float = 1.1
    sweeps: int = 1
    substeps: int | None = None
    threads: int | None = None

    def __post_init__(self) -> None:
        check_common(self.limit, self.sweeps, self.substeps, self.threads)

    def init(self, cloth: Cloth, dt: float) -> SolverState:
        check_step(dt, 1)
        attachments = listed_attachments(cloth, self.limit)
        substeps, options = chosen_substeps(self.substeps, cloth, dt), (self.sweeps,)
        limit = strain_limit(cloth, allowed_stretch(self.limit, self.sweeps))
        if is_sheet(cloth):
            fine = planes.plane_plan(cloth, dt / substeps, attachments, in_turn)
            squares = plane_squares(fine.sheet, limit)
            return SolverState(
                fine, dt, substeps, _advance_plane, options, True, limit=limit, squares=squares
            )
        plan = ProvotPlan(body_of(cloth), attachments)
        return SolverState(plan, dt, substeps, _advance, options, limit=limit, shares=SHARED)


def listed_attachments(cloth: Cloth, limit: float) -> Attachments:
    """The structural and shear springs in the cloth's order; flexion springs have no limit."""
    chosen = (cloth.spring_kind != FLEXION) & movable(cloth)
    pairs = cloth.spring_pairs[chosen]
    part_i, part_j = half_shares(cloth, pairs).T.copy()
    return Attachments(pairs, cloth.spring_length[chosen] * limit, part_i, part_j)


@borrowing_kernel
def _substep(block: Any, plan: Any, h: Any, number: Any, options: Any) -> None:
    """Euler's method, then sweeps over the springs that are too long."""
    y, old, body = block.y, block.old, plan.body
    (sweeps,) = options
    kick(block, body, h)
    kernels.move(y, block.u, old, h)
    kernels.place_pins(y, old, body.pins, block.targets, number, block.start)
    for _ in range(sweeps):
        kernels.shorten(y, plan.attachments)
    kernels.set_velocities(block.u, y, old, h)


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
    y, old, sheet, attachments = block.y, block.old, plan.sheet, plan.attachments
    (sweeps,) = options
    planes.kick(block, plan, h)
    sheet_kernels.move(y, block.g, old, h, sheet)
    sheet_kernels.place(y, sheet, block.targets, number, block.cloth)
    for _ in range(sweeps):
        last = attachments.a.size
        sheet_kernels.solve_batches(y, y, attachments, 0, last, sheet_kernels.SHORTEN, block.work)
    sheet_kernels.set_velocities(block.u, y, old, h, sheet)


_advance_planes = planes.loop_around_plane(_plane_substep)


@entry_point
def _advance_plane(
    first: Any, last: Any, plan: Any, batch: Any, steps: Any, substeps: Any, sweeps: Any
) -> None:
    """Steps of cloths first..last, one after another."""
    _advance_planes(first, last, plan, batch, steps, substeps, (sweeps,))
