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
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np

from drapery.cloth import kernels
from drapery.cloth.cloth import Cloth
from drapery.cloth.compiled import door
from drapery.cloth.filters import BandFilter, Filter, cloth_filter
from drapery.cloth.forces import Force
from drapery.cloth.links import Links, limited_links
from drapery.cloth.pins import PinPath
from drapery.cloth.solvers.base import check_step
from drapery.cloth.solvers.rounds import (
    Body,
    Memory,
    advance,
    body_of,
    check_count,
    check_limit,
)
from drapery.cloth.spin import Correction, NoSpin, Spin, spin_correction
from drapery.cloth.state import State
from drapery.errors import OptionError


class Plan(NamedTuple):
    body: Body
    filter: Filter | BandFilter
    links: Links
    spin: Spin | NoSpin


@dataclass(frozen=True)
class SolverDesbrun:
    """See the module.

    limit: a spring's longest length over its rest length. sweeps: of the correction, a step.
    angular: how a free cloth's angular momentum is corrected, see `drapery.cloth.spin`.
    threads: None for as many as there are processors.
    """

    limit: float = 1.005
    sweeps: int = 3
    angular: Correction = "exact"
    threads: int | None = None

    def __post_init__(self) -> None:
        if self.angular not in ("exact", "paper", "none"):
            raise OptionError(f"angular {self.angular!r} is not known; use exact, paper or none")
        check_limit(self.limit)
        check_count("sweeps", self.sweeps, 0, 1000)

    def init(self, cloth: Cloth, dt: float) -> Memory:
        check_step(dt, 1)
        links = limited_links(cloth, self.limit, self.sweeps)
        spin = spin_correction(cloth, dt, self.angular)
        return Memory(Plan(body_of(cloth), cloth_filter(cloth, dt), links, spin), dt, 1)

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
        return advance(_advance, *args), memory


@door
def _advance(first: int, last: int, plan: Any, batch: Any, steps: int, substeps: int) -> None:
    """Steps of lanes first..last, a block at a time."""
    body, dtype = plan.body, batch.x.dtype
    dt = dtype.type(batch.numbers[0])
    rows, width = batch.x.shape[0], min(batch.width, last - first)
    y, u = np.empty((rows, width), dtype), np.empty((rows, width), dtype)
    both, old = np.empty((2, rows, width), dtype), np.empty((rows, width), dtype)
    g, mean = both[1], np.empty((3, width), dtype)
    wind = np.empty((3 * body.controls.size, width), dtype)
    work = np.empty((18, width), dtype)
    for block in range(first, last, width):
        # The last block overlaps the one before, so that all have one width.
        start = min(block, last - width)
        kernels.take_lanes(y, batch.x, start)
        kernels.take_lanes(u, batch.v, start)
        for step in range(steps):
            time = batch.numbers[2] + step * batch.numbers[0]
            kernels.frame_velocity(mean, u, body.pins)
            kernels.subtract_frame(both[0], u, mean)
            kernels.add_spring_velocities(both[0], y, body.springs, body.inv_mass, dt)
            kernels.filter_velocities(both, plan.filter, body.pins)
            kernels.keep_spin(g, y, u, plan.spin, work)
            for number in range(batch.gusts.seeds.size):
                kernels.blow(wind, y, body.controls, batch.gusts, number, start, time, work)
                pressure = batch.gusts.numbers[number, 16]
                kernels.add_wind_velocities(
                    g, y, u, body.faces, wind, pressure, body.inv_mass, dt, work
                )
            kernels.add_uniform(g, mean, body.inv_mass, batch.numbers, batch.push, start)
            kernels.move(y, g, old, dt)
            kernels.place_pins(y, old, body.pins, batch.targets, step, start)
            kernels.shorten(y, plan.links)
            kernels.set_velocities(u, y, old, dt)
        kernels.give_lanes(batch.new_x, y, start)
        kernels.give_lanes(batch.new_v, u, start)
