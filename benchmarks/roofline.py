"""How close the solvers come to the peak performance of this machine.

The flops and bytes of a step are counted from the solver's plan: one flop for every addition,
product, quotient and root that changes a particle, and the bytes of every number that such a
calculation reads or writes, in any kind of memory. The machine's rates are measured with a copy,
and with alternating additions and products. Both use the same registers, one thread and numbers in
the first-level cache, so no order of the work could be faster.
"""

from dataclasses import dataclass
from time import perf_counter
from typing import Any

import numpy as np
from numba import njit

from drapery.cloth import Cloth, simd

BLOCK = 16, 128
"""Rows and lanes of the copied array, 8 KB of single precision."""
PULL, SPRING, DRIFT, VELOCITY, PRESS, NOISE = 25, 27, 9, 6, 75, 300
"""The flops of a constraint of two particles, a spring's force, a particle's drift and speed, the
pressure of the wind on it, and the noise at one sample."""
BOTH_ENDS, FORCE_ENDS, WAY, SPEED, PRESSED, SAMPLED = 12, 18, 9, 9, 33, 12
"""The numbers that the same calculations read and write."""


@dataclass(frozen=True)
class Machine:
    """copy: bytes read and written per second. flops: flops per second."""

    copy: float
    flops: float


@dataclass(frozen=True)
class Cost:
    """The flops and bytes of one step of one particle."""

    flops: float
    bytes: float

    def fraction(self, machine: Machine, particle_steps_per_s: float) -> float:
        """The fraction of the machine's peak rate that these particle steps per second reach."""
        shortest = max(self.flops / machine.flops, self.bytes / machine.copy)
        return shortest * particle_steps_per_s


def measured() -> Machine:
    """Measure this machine's rates; each is the best of several tries."""
    x, y = np.ones(BLOCK, np.float32), np.zeros(BLOCK, np.float32)
    copy = _best(lambda: _copy(y, x, 20_000)) / (20_000 * 2 * x.nbytes)
    flops = _best(lambda: _calculate(x, np.float32(0.5), 20_000)) / (20_000 * 16 * 16)
    return Machine(1 / copy, 1 / flops)


def _best(work: Any) -> float:
    times = []
    for _ in range(12):
        start = perf_counter()
        work()
        times.append(perf_counter() - start)
    return min(times)


@njit(error_model="numpy")
def _copy(y: Any, x: Any, times: int) -> None:
    for _ in range(times):
        for row in range(x.shape[0]):
            for lane in range(0, x.shape[1], simd.lane_count(x)):
                simd.store(y, row, lane, simd.load(x, row, lane))


@njit(error_model="numpy")
def _calculate(x: Any, part: Any, times: int) -> None:
    """Eight independent chains of a product and a sum, which the processor can run in parallel."""
    a, b, c, d = simd.load(x, 0, 0), simd.load(x, 1, 0), simd.load(x, 2, 0), simd.load(x, 3, 0)
    e, f, g, h = simd.load(x, 4, 0), simd.load(x, 5, 0), simd.load(x, 6, 0), simd.load(x, 7, 0)
    for _ in range(times):
        a, b = a * part + part, b * part + part
        c, d = c * part + part, d * part + part
        e, f = e * part + part, f * part + part
        g, h = g * part + part, h * part + part
    simd.store(x, 8, 0, ((a + b) + (c + d)) + ((e + f) + (g + h)))


def cost(cloth: Cloth, solver_state: Any, winds: int) -> Cost:
    """The cost of a step, from the plan in a solver state of desbrun or xpbd."""
    plan, free = solver_state.plan, int((cloth.inv_mass > 0).sum())
    sheet = hasattr(plan, "sheet")
    controls = plan.sheet.controls if sheet else plan.body.controls
    substeps = solver_state.substeps
    parts = [
        (winds * len(controls), NOISE, SAMPLED),
        (winds * free, PRESS, PRESSED),
        (free, VELOCITY, SPEED),
    ]
    if hasattr(plan, "constraints"):
        attachments = _pairs(plan.attachments) if sheet else len(plan.attachments.longest)
        solved = _pairs(plan.constraints) if sheet else len(plan.constraints.square)
        parts += [
            (solved + attachments * -(-substeps // 2), PULL, BOTH_ENDS),
            (free * substeps, DRIFT, WAY),
        ]
    else:
        attachments = _pairs(plan.attachments) if sheet else len(plan.attachments.longest)
        parts += [
            (attachments * substeps, PULL + 1, BOTH_ENDS),
            (len(cloth.spring_length) * substeps, SPRING, FORCE_ENDS),
            (free * substeps, DRIFT, WAY),
            (substeps, *_filter(cloth, plan.filter)),
        ]
    count = len(cloth.inv_mass)
    flops = sum(number * each for number, each, _ in parts)
    numbers = sum(number * each for number, _, each in parts)
    return Cost(flops / count, 4 * numbers / count)


def _pairs(batches: Any) -> int:
    """The number of particle pairs in a sheet's constraint batches that can move."""
    moved = (batches.values[1:] != 0).any(axis=0)
    ends = zip(batches.start, batches.lanes, strict=True)
    return int(sum(moved[start : start + lanes].sum() for start, lanes in ends))


def _filter(cloth: Cloth, filter: Any) -> tuple[float, float]:
    """The flops of one filter pass, and the numbers that it reads and writes."""
    if hasattr(filter, "into"):
        rows, columns = cloth.grid_shape or (0, 0)
        flops = 3 * rows * columns * (4 * columns + 9)
        return flops, 3 * rows * columns * (2 * columns + 14)
    sizes = filter.products[:, 1]
    return float((6 * sizes * sizes).sum()), float((3 * sizes * (sizes + 1)).sum())


def show(label: str, cost: Cost, machine: Machine, particle_steps_per_s: float) -> str:
    return (
        f"{label}: {cost.flops:.0f} flops and {cost.bytes:.0f} bytes a particle step; this machine "
        f"{machine.flops / 1e9:.0f} GFlop/s and {machine.copy / 1e9:.0f} GB/s: "
        f"{100 * cost.fraction(machine, particle_steps_per_s):.0f} % of the machine's limit"
    )
