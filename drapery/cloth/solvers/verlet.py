"""Störmer-Verlet on springs, with Provot's limit on stretch taken in Jacobi order.

Verlet, "Computer experiments on classical fluids" (Phys. Rev. 159, 1967); the over-extension limit
is that of Provot, "Deformation constraints in a mass-spring model" (Graphics Interface 1995), with
all corrections summed from the same places and then applied together.

Order 2 while nothing is over-long. The step is written with velocities (Swope et al. 1982): half a
kick, a drift, half a kick; the places are those of x_{n+1} = 2 x_n - x_{n-1} + a dt². Explicit, so
substeps are taken as the stiffest spring needs. It loses no energy by itself: use Drag. To be
chosen for lively, springy cloth and for teaching. Not to be confused with the "Verlet integration"
of position based dynamics (pbd), which has no springs.
"""

from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np

from drapery.cloth import kernels
from drapery.cloth.attachments import Attachments
from drapery.cloth.checks import check_number
from drapery.cloth.cloth import STRUCTURAL, Cloth
from drapery.cloth.kernels import add, way
from drapery.cloth.simd import fill, larger, root, span
from drapery.cloth.solvers.base import check_step
from drapery.cloth.solvers.driver import (
    Body,
    SolverState,
    Stepped,
    blow_all,
    body_of,
    check_common,
    chosen_substeps,
    give_block,
    half_shares,
    kick,
    movable,
    take_block,
)
from drapery.jit import entry_point, kernel


class Plan(NamedTuple):
    body: Body
    attachments: Attachments


@dataclass(frozen=True)
class SolverVerlet(Stepped):
    """See the module.

    limit: longest length of a structural spring over its rest length; Provot's 10 %.
    sweeps: of the correction, a substep. relaxation: the part of a sweep's summed corrections that
        is applied. All of it, 1, is what the plain method does, and it explodes when neighbours
        are over-long by turns: Verlet stays stable up to 2/3 (the sum moves a spring's ends up to
        twice too far, and the velocity carries that on).
    substeps: None for as many as the stiffest spring needs.
    threads: None for as many as there are processors.
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
        plan = Plan(body_of(cloth), half_links(cloth, self.limit, self.relaxation))
        substeps = chosen_substeps(self.substeps, cloth, dt)
        return SolverState(plan, dt, substeps, _advance, (self.sweeps,))


def half_links(cloth: Cloth, limit: float, relaxation: float) -> Attachments:
    """The structural springs, each end to take half of a correction times the relaxation."""
    chosen = (cloth.spring_kind == STRUCTURAL) & movable(cloth)
    pairs = cloth.spring_pairs[chosen]
    longest = cloth.spring_length[chosen] * limit
    part_i, part_j = (relaxation * half_shares(cloth, pairs)).T.copy()
    return Attachments(pairs, longest, part_i, part_j)


@kernel
def shorten_together(y: Any, attachments: Any, sums: Any) -> None:
    """One Jacobi sweep: corrections from the same places are summed, then applied."""
    none = y.dtype.type(0)
    for row in range(y.shape[0]):
        for lane in range(y.shape[1]):
            sums[row, lane] = none
    for s in range(attachments.longest.size):
        i, j = 3 * np.intp(attachments.pairs[s, 0]), 3 * np.intp(attachments.pairs[s, 1])
        most, part_i, part_j = (
            fill(attachments.longest[s]),
            attachments.share_i[s],
            -attachments.share_j[s],
        )
        for lane in range(0, y.shape[1], span(y)):
            dx, dy, dz = way(y, i, j, lane)
            d = larger(root(dx * dx + dy * dy + dz * dz), most)
            excess = (d - most) / d
            add(sums, i, lane, part_i * excess, dx, dy, dz)
            add(sums, j, lane, part_j * excess, dx, dy, dz)
    for row in range(y.shape[0]):
        for lane in range(y.shape[1]):
            y[row, lane] += sums[row, lane]


@entry_point
def _advance(
    first: Any, last: Any, plan: Any, batch: Any, steps: Any, substeps: Any, sweeps: Any
) -> None:
    """Steps of lanes first..last, a block at a time."""
    dtype, body = batch.x.dtype, plan.body
    h, half = dtype.type(batch.numbers[0]), dtype.type(batch.numbers[0] / 2)
    for start in range(first, last, batch.width):
        y, u, g, old, wind, work = take_block(batch, body, start, last)
        for step in range(steps * substeps):
            if step % substeps == 0:
                time = batch.numbers[2] + step * batch.numbers[0]
                blow_all(wind, y, body, batch, start, time, work)
            kick(u, y, g, body, batch, wind, half, start, work)
            kernels.move(y, u, old, h)
            kernels.place_pins(y, old, body.pins, batch.targets, step, start)
            for _ in range(sweeps):
                shorten_together(y, plan.attachments, g)
            kernels.set_velocities(u, y, old, h)
            kick(u, y, g, body, batch, wind, half, start, work)
        give_block(batch, y, u, start)
