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

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np

from drapery.cloth import kernels, simd
from drapery.cloth.cloth import STRUCTURAL, Cloth
from drapery.cloth.compiled import door, kernel
from drapery.cloth.forces import Force
from drapery.cloth.links import Links
from drapery.cloth.pins import PinPath
from drapery.cloth.solvers.base import check_step
from drapery.cloth.solvers.rounds import (
    MAX_SUBSTEPS,
    Body,
    Memory,
    advance,
    blow_all,
    body_of,
    check_count,
    check_limit,
    check_part,
    chosen_substeps,
    half_shares,
    kick,
    movable,
)
from drapery.cloth.state import State


class Plan(NamedTuple):
    body: Body
    links: Links


@dataclass(frozen=True)
class SolverVerlet:
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
        check_limit(self.limit)
        check_count("sweeps", self.sweeps, 0, 1000)
        check_part("relaxation", self.relaxation)
        check_count("substeps", self.substeps, 1, MAX_SUBSTEPS)

    def init(self, cloth: Cloth, dt: float) -> Memory:
        check_step(dt, 1)
        plan = Plan(body_of(cloth), half_links(cloth, self.limit, self.relaxation))
        return Memory(plan, dt, chosen_substeps(self.substeps, cloth, dt))

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
        args = (cloth, state, memory, forces, dt, steps, pins, self.threads)
        return advance(_advance, *args, self.sweeps), memory


def half_links(cloth: Cloth, limit: float, relaxation: float) -> Links:
    """The structural springs, each end to take half of a correction times the relaxation."""
    chosen = (cloth.spring_kind == STRUCTURAL) & movable(cloth)
    pairs = cloth.spring_pairs[chosen]
    longest = cloth.spring_length[chosen] * limit
    part_i, part_j = (relaxation * half_shares(cloth, pairs)).T.copy()
    return Links(pairs, longest, part_i, part_j)


@kernel
def shorten_together(y: Any, links: Any, sums: Any) -> None:
    """One Jacobi sweep: corrections from the same places are summed, then applied."""
    none = y.dtype.type(0)
    for row in range(y.shape[0]):
        for lane in range(y.shape[1]):
            sums[row, lane] = none
    for s in range(links.longest.size):
        i, j = 3 * links.pairs[s, 0], 3 * links.pairs[s, 1]
        most, part_i, part_j = links.longest[s], links.share_i[s], links.share_j[s]
        for lane in range(y.shape[1]):
            dx = y[j, lane] - y[i, lane]
            dy = y[j + 1, lane] - y[i + 1, lane]
            dz = y[j + 2, lane] - y[i + 2, lane]
            d = max(np.sqrt(dx * dx + dy * dy + dz * dz), most)
            excess = (d - most) / d
            sums[i, lane] += part_i * excess * dx
            sums[i + 1, lane] += part_i * excess * dy
            sums[i + 2, lane] += part_i * excess * dz
            sums[j, lane] -= part_j * excess * dx
            sums[j + 1, lane] -= part_j * excess * dy
            sums[j + 2, lane] -= part_j * excess * dz
    for row in range(y.shape[0]):
        for lane in range(y.shape[1]):
            y[row, lane] += sums[row, lane]


@door
def _advance(
    first: Any, last: Any, plan: Any, batch: Any, steps: Any, substeps: Any, sweeps: Any
) -> None:
    """Steps of lanes first..last, a block at a time."""
    dtype, body = batch.x.dtype, plan.body
    h, half = dtype.type(batch.numbers[0]), dtype.type(batch.numbers[0] / 2)
    rows = batch.x.shape[0]
    for start in range(first, last, batch.width):
        lanes = min(batch.width, last - start)
        y, u = simd.room(rows, lanes, batch.x), simd.room(rows, lanes, batch.x)
        g, old = simd.room(rows, lanes, batch.x), simd.room(rows, lanes, batch.x)
        wind = simd.room(3 * body.controls.size * batch.gusts.seeds.size, lanes, batch.x)
        work = simd.room(18, lanes, batch.x)
        kernels.take_lanes(y, batch.x, start)
        kernels.take_lanes(u, batch.v, start)
        for step in range(steps * substeps):
            if step % substeps == 0:
                time = batch.numbers[2] + step * batch.numbers[0]
                blow_all(wind, y, body, batch, start, time, work)
            kick(u, y, g, body, batch, wind, half, start, work)
            kernels.move(y, u, old, h)
            kernels.place_pins(y, old, body.pins, batch.targets, step, start)
            for _ in range(sweeps):
                shorten_together(y, plan.links, g)
            kernels.set_velocities(u, y, old, h)
            kick(u, y, g, body, batch, wind, half, start, work)
        kernels.give_lanes(batch.new_x, y, start)
        kernels.give_lanes(batch.new_v, u, start)
