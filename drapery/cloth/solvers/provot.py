"""Provot, "Deformation constraints in a mass-spring model to describe rigid cloth behaviour"
(Graphics Interface 1995): Euler's method, then the dynamic inverse.

Order 1: v' = v + dt a(x), x' = x + dt v' (nowadays called symplectic Euler). Then every over-long
spring is pulled back to its longest length, one after another in the order in which
the cloth lists them; both ends share the correction, a pinned end takes none of it. The velocities
follow the corrected places. Explicit, so substeps are taken as the stiffest spring needs. To be
chosen to see where all the others come from. Not to be confused with desbrun, which ends with the
same correction but integrates implicitly, or with verlet, which corrects in Jacobi order.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple

from drapery.cloth import kernels, simd
from drapery.cloth.cloth import FLEXION, Cloth
from drapery.cloth.compiled import door
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
class SolverProvot:
    """See the module.

    limit: longest length of a structural or shear spring over its rest length; Provot's 10 %.
    sweeps: of the correction, a substep. substeps: None for as many as the stiffest spring needs.
    threads: None for as many as there are processors.
    """

    limit: float = 1.1
    sweeps: int = 1
    substeps: int | None = None
    threads: int | None = None

    def __post_init__(self) -> None:
        check_limit(self.limit)
        check_count("sweeps", self.sweeps, 0, 1000)
        check_count("substeps", self.substeps, 1, MAX_SUBSTEPS)

    def init(self, cloth: Cloth, dt: float) -> Memory:
        check_step(dt, 1)
        plan = Plan(body_of(cloth), listed_links(cloth, self.limit))
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


def listed_links(cloth: Cloth, limit: float) -> Links:
    """The structural and shear springs, as listed; flexion springs only bend."""
    chosen = (cloth.spring_kind != FLEXION) & movable(cloth)
    pairs = cloth.spring_pairs[chosen]
    part_i, part_j = half_shares(cloth, pairs).T.copy()
    return Links(pairs, cloth.spring_length[chosen] * limit, part_i, part_j)


@door
def _advance(
    first: Any, last: Any, plan: Any, batch: Any, steps: Any, substeps: Any, sweeps: Any
) -> None:
    """Steps of lanes first..last, a block at a time."""
    dtype, body = batch.x.dtype, plan.body
    h = dtype.type(batch.numbers[0])
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
            kick(u, y, g, body, batch, wind, h, start, work)
            kernels.move(y, u, old, h)
            kernels.place_pins(y, old, body.pins, batch.targets, step, start)
            for _ in range(sweeps):
                kernels.shorten(y, plan.links)
            kernels.set_velocities(u, y, old, h)
        kernels.give_lanes(batch.new_x, y, start)
        kernels.give_lanes(batch.new_v, u, start)
