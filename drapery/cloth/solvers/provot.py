"""Provot, "Deformation constraints in a mass-spring model to describe rigid cloth behaviour"
(Graphics Interface 1995): Euler's method, then the dynamic inverse.

Order 1: v' = v + dt a(x), x' = x + dt v' (nowadays called symplectic Euler). Then every spring that
is too long is shortened to its longest length, one after another in the order of the cloth. Both
ends share the correction; a pinned end takes none of it. The velocities are computed from the
corrected positions. The method is explicit, so the stiffest spring decides the number of substeps.
Choose it to compare the other methods with their origin. It differs from desbrun, which ends with
the same correction but integrates implicitly, and from verlet, which corrects in Jacobi order.
"""

from dataclasses import dataclass
from typing import Any, NamedTuple

from drapery.cloth import kernels
from drapery.cloth.attachments import Attachments
from drapery.cloth.cloth import FLEXION, Cloth
from drapery.cloth.contact import lanes_contact
from drapery.cloth.solvers.base import check_step
from drapery.cloth.solvers.driver import (
    SHARED,
    ClothBody,
    KernelSolver,
    SolverState,
    blow_at,
    body_of,
    check_common,
    chosen_substeps,
    half_shares,
    kick,
    load_block,
    movable,
    store_block,
)
from drapery.cloth.strain import allowed_stretch, strain_limit
from drapery.jit import entry_point


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
        plan = ProvotPlan(body_of(cloth), listed_attachments(cloth, self.limit))
        substeps = chosen_substeps(self.substeps, cloth, dt)
        limit = strain_limit(cloth, allowed_stretch(self.limit, self.sweeps))
        return SolverState(plan, dt, substeps, _advance, (self.sweeps,), limit=limit, shares=SHARED)


def listed_attachments(cloth: Cloth, limit: float) -> Attachments:
    """The structural and shear springs in the cloth's order; flexion springs have no limit."""
    chosen = (cloth.spring_kind != FLEXION) & movable(cloth)
    pairs = cloth.spring_pairs[chosen]
    part_i, part_j = half_shares(cloth, pairs).T.copy()
    return Attachments(pairs, cloth.spring_length[chosen] * limit, part_i, part_j)


@entry_point
def _advance(
    first: Any, last: Any, plan: Any, batch: Any, steps: Any, substeps: Any, sweeps: Any
) -> None:
    """Steps of lanes first..last, a block at a time."""
    dtype, body = batch.x.dtype, plan.body
    h = dtype.type(batch.numbers[0])
    for start in range(first, last, batch.width):
        y, u, g, old, wind, work = load_block(batch, body, start, last)
        before = lanes_contact.begin_lanes(y, u, batch)
        step, again = 0, False
        while step < steps * substeps:
            if step % substeps == 0:
                time = batch.numbers[2] + step * batch.numbers[0]
                blow_at(batch.blow, (wind, y, body.controls, batch.gusts, start, time, work))
            kick(u, y, g, body, batch, wind, h, start)
            kernels.move(y, u, old, h)
            kernels.place_pins(y, old, body.pins, batch.targets, step, start)
            for _ in range(sweeps):
                kernels.shorten(y, plan.attachments)
            kernels.set_velocities(u, y, old, h)
            step, again = lanes_contact.meet_substep(
                y, u, before, batch, start, step, substeps, h, again
            )
        store_block(batch, y, u, start)
