"""Baraff, Witkin, "Large steps in cloth simulation" (SIGGRAPH 1998): implicit Euler, linearised.

Order 1. Each step solves (M - dt ∂f/∂v - dt² ∂f/∂x) Δv = dt (f + dt ∂f/∂x v) once, with the true
Jacobian of every spring, by conjugate gradients with their constraint filter: a pinned particle's
Δv is prescribed and not changed by the search. It is stable at any stiffness, damps oscillations
that are faster than the step, and needs tens of products with the matrix a step. In the paper only
stiffness resists stretch; here `attachments` limit it too, since stiffness differs much between
cloths. sweeps=0 is the method of the paper. Choose it where stiffness in N/m matters and steps are
long. It is not desbrun, which replaces the Jacobian by a constant matrix that is inverted once.

A compressed spring's Jacobian is indefinite; as in Choi and Ko, "Stable but responsive cloth"
(SIGGRAPH 2002), the part across the spring is then left out, so the matrix is positive definite.
"""

import warnings
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np

from drapery.cloth import kernels
from drapery.cloth.attachments import Attachments, stretch_limits
from drapery.cloth.bending import Stencils, force_stencils
from drapery.cloth.checks import check_count, check_number
from drapery.cloth.cloth import Cloth
from drapery.cloth.kernels import direction
from drapery.cloth.simd import fill, lane_count, load, maximum, sqrt, store
from drapery.cloth.solvers.base import check_step
from drapery.cloth.solvers.driver import (
    MAX_SUBSTEPS,
    SHARED,
    ClothBody,
    KernelSolver,
    SolverState,
    add_loads,
    body_of,
    check_common,
    loop_around,
)
from drapery.cloth.strain import allowed_stretch, strain_limit
from drapery.errors import counted
from drapery.jit import borrowing_kernel, entry_point, kernel
from drapery.mesh import Array

MAX_ITERATIONS = 10_000


class ImplicitPlan(NamedTuple):
    """bends: stencils of bending as forces. mass: [kg], [N]; 0 where a particle is pinned.
    damping: of springs [s]."""

    body: ClothBody
    bends: Stencils
    attachments: Attachments
    mass: Array
    damping: Array


class Matrix(NamedTuple):
    """The matrix of a step: masses, each spring's `linearise`d part, and h (h + damping) times the
    stiffness of bending, which is taken as flat."""

    mass: Any
    blocks: Any
    springs: Any
    bends: Any
    factor: Any


@dataclass(frozen=True)
class SolverImplicit(KernelSolver):
    """Baraff and Witkin's implicit Euler (1998).

    It is stable at any stiffness. Choose it where stiffness in N/m matters and steps are long.

    damping: of springs along their length, over their stiffness [s], 0 to 1e6.
    tolerance: residual over right-hand side at which the conjugate gradients stop, 1e-12 to 0.1.
    iterations: most iterations of the conjugate gradients, 1 to 10,000. A step that needs more
        gives a warning with the residual.
    limit: longest length of a structural spring over its rest length, 1 to 1e6.
    sweeps: sweeps of the attachments that enforce the limit, a substep, 0 to 1000; 0 for none.
    substeps: of each step, 1 to 1000.
    threads: 1 to 1000; None uses every processor. The result does not depend on it.
    Raises OptionError.
    """

    damping: float = 0.0
    tolerance: float = 1e-3
    iterations: int = 200
    limit: float = 1.02
    sweeps: int = 3
    substeps: int = 1
    threads: int | None = None

    def __post_init__(self) -> None:
        check_number("damping", self.damping, 0, 1e6, "s")
        check_number("tolerance", self.tolerance, 1e-12, 0.1)
        check_count("iterations", self.iterations, 1, MAX_ITERATIONS)
        check_count("substeps", self.substeps, 1, MAX_SUBSTEPS)
        check_common(self.limit, self.sweeps, self.substeps, self.threads)

    def init(self, cloth: Cloth, dt: float) -> SolverState:
        check_step(dt, 1)
        free = cloth.inv_mass > 0
        mass = np.where(free, 1 / np.where(free, cloth.inv_mass, 1), 0.0)
        attachments = stretch_limits(cloth, self.limit, self.sweeps)
        bends = force_stencils(cloth.bending, np.ones(len(mass)))
        plan = ImplicitPlan(body_of(cloth), bends, attachments, mass, np.array([self.damping]))
        options = self.iterations, self.tolerance
        limit = strain_limit(cloth, allowed_stretch(self.limit, self.sweeps))
        return SolverState(plan, dt, self.substeps, _advance, options, limit=limit, shares=SHARED)

    def warn_unsolved(self, residual: float) -> None:
        warnings.warn(
            f"SolverImplicit stopped after {counted(self.iterations, 'iteration')} with a residual"
            f" of {residual * self.tolerance:.2g} (tolerance {self.tolerance:g}); use a smaller"
            " dt, more substeps, more iterations or softer springs",
            stacklevel=3,
        )


@borrowing_kernel
def linearise(blocks: Any, b: Any, y: Any, u: Any, springs: Any, damping: Any, h: Any) -> None:
    """Compute each spring's part of the matrix, and add its part of the right-hand side to b.

    blocks: [5S, L]; for each spring its direction n (3), and the parts of the matrix across and
    along it: A = across I + along n nᵀ, with h² and h of the equation included.
    """
    F = y.dtype.type
    tiny, none, one = F(kernels.TINY), fill(F(0)), F(1)
    for s in range(springs.rest.size):
        i, j = 3 * np.intp(springs.pairs[s, 0]), 3 * np.intp(springs.pairs[s, 1])
        rest, k = springs.rest[s], springs.stiffness[s]
        shortest = fill(rest * tiny)
        for lane in range(0, y.shape[1], lane_count(y)):
            nx, ny, nz = direction(y, i, j, lane)
            d = sqrt(nx * nx + ny * ny + nz * nz)
            part = one / maximum(d, shortest)
            nx, ny, nz = part * nx, part * ny, part * nz
            across = h * h * k * maximum(none, one - rest * part)
            along = h * h * k - across + h * k * damping
            for place, value in enumerate((nx, ny, nz, across, along)):
                store(blocks, 5 * s + place, lane, value)
            ux, uy, uz = direction(u, i, j, lane)
            # h (f + h ∂f/∂x v): the force by the present strain plus its change over h.
            pull = h * k * (d - rest) + along * (nx * ux + ny * uy + nz * uz)
            fx, fy, fz = pull * nx + across * ux, pull * ny + across * uy, pull * nz + across * uz
            pull_together(b, i, j, lane, fx, fy, fz)


@borrowing_kernel
def pull_together(x: Any, i: Any, j: Any, lane: Any, fx: Any, fy: Any, fz: Any) -> None:
    """Add a force to one end of a spring and its opposite to the other end."""
    store(x, i, lane, load(x, i, lane) + fx)
    store(x, i + 1, lane, load(x, i + 1, lane) + fy)
    store(x, i + 2, lane, load(x, i + 2, lane) + fz)
    store(x, j, lane, load(x, j, lane) - fx)
    store(x, j + 1, lane, load(x, j + 1, lane) - fy)
    store(x, j + 2, lane, load(x, j + 2, lane) - fz)


@borrowing_kernel
def diagonal(out: Any, matrix: Any) -> None:
    """Inverses of the matrix's diagonal, the preconditioner; 0 where a particle is pinned."""
    mass, blocks, springs, bends = matrix.mass, matrix.blocks, matrix.springs, matrix.bends
    none, one = out.dtype.type(0), out.dtype.type(1)
    for row in range(out.shape[0]):
        for lane in range(out.shape[1]):
            out[row, lane] = mass[row // 3]
    for s in range(springs.rest.size):
        for end in range(2):
            for axis in range(3):
                row = 3 * springs.pairs[s, end] + axis
                for lane in range(out.shape[1]):
                    n = blocks[5 * s + axis, lane]
                    out[row, lane] += blocks[5 * s + 3, lane] + blocks[5 * s + 4, lane] * n * n
    for s in range(bends.rest.size):
        for corner in range(4):
            part = matrix.factor * bends.weights[s, corner] * bends.parts[s, corner]
            for axis in range(3):
                row = 3 * bends.particles[s, corner] + axis
                for lane in range(out.shape[1]):
                    out[row, lane] += part
    for row in range(out.shape[0]):
        if mass[row // 3] == 0:
            for lane in range(out.shape[1]):
                out[row, lane] = none
        else:
            for lane in range(out.shape[1]):
                out[row, lane] = one / out[row, lane]


@borrowing_kernel
def multiply(out: Any, p: Any, matrix: Any) -> None:
    """out = A p, without pinned rows."""
    mass, blocks, springs = matrix.mass, matrix.blocks, matrix.springs
    for row in range(p.shape[0]):
        for lane in range(p.shape[1]):
            out[row, lane] = mass[row // 3] * p[row, lane]
    for s in range(springs.rest.size):
        i, j = 3 * np.intp(springs.pairs[s, 0]), 3 * np.intp(springs.pairs[s, 1])
        for lane in range(0, p.shape[1], lane_count(p)):
            nx, ny = load(blocks, 5 * s, lane), load(blocks, 5 * s + 1, lane)
            nz = load(blocks, 5 * s + 2, lane)
            across, along = load(blocks, 5 * s + 3, lane), load(blocks, 5 * s + 4, lane)
            px, py, pz = direction(p, i, j, lane)
            part = along * (nx * px + ny * py + nz * pz)
            fx, fy, fz = across * px + part * nx, across * py + part * ny, across * pz + part * nz
            pull_together(out, i, j, lane, -fx, -fy, -fz)
    add_bending(out, p, matrix)
    clear_pins(out, mass)


@borrowing_kernel
def add_bending(out: Any, p: Any, matrix: Any) -> None:
    """out += the bending part of A p."""
    bends = matrix.bends
    for s in range(bends.rest.size):
        a, b = 3 * np.intp(bends.particles[s, 0]), 3 * np.intp(bends.particles[s, 1])
        c, d = 3 * np.intp(bends.particles[s, 2]), 3 * np.intp(bends.particles[s, 3])
        for lane in range(0, p.shape[1], lane_count(p)):
            px, py, pz = kernels.weighted(p, (a, b, c, d), bends.weights[s], lane)
            kernels.add(out, a, lane, matrix.factor * bends.parts[s, 0], px, py, pz)
            kernels.add(out, b, lane, matrix.factor * bends.parts[s, 1], px, py, pz)
            kernels.add(out, c, lane, matrix.factor * bends.parts[s, 2], px, py, pz)
            kernels.add(out, d, lane, matrix.factor * bends.parts[s, 3], px, py, pz)


@borrowing_kernel
def clear_pins(values: Any, mass: Any) -> None:
    """The constraint filter: set the rows of pinned particles to 0."""
    none = values.dtype.type(0)
    for row in range(values.shape[0]):
        if mass[row // 3] == 0:
            for lane in range(values.shape[1]):
                values[row, lane] = none


@borrowing_kernel
def dots(out: Any, p: Any, weight: Any, q: Any) -> None:
    """For each lane the sum of p weight q in the order of rows, in double precision, [L]."""
    for lane in range(out.size):
        out[lane] = 0.0
    for row in range(p.shape[0]):
        for lane in range(out.size):
            out[lane] += np.float64(p[row, lane]) * weight[row, lane] * q[row, lane]


@kernel
def solve(
    dv: Any,
    r: Any,
    matrix: Any,
    iterations: Any,
    tolerance: Any,
    residuals: Any,
    scratch: Any,
) -> None:
    """A dv = b by modified preconditioned conjugate gradients (Baraff, Witkin 1998).

    dv: the pins' prescribed changes on entry, 0 elsewhere. r: b on entry, overwritten.
    residuals: for lanes that have not converged, the larger of the given value and the residual
    over the tolerance, [L]. scratch: [4, 3N, L].
    A lane that has converged does not change any more, so lanes do not depend on each other.
    """
    F = dv.dtype.type
    inverse, c, q, ones = scratch[0], scratch[1], scratch[2], scratch[3]
    lanes = dv.shape[1]
    goal, rho, old = np.empty(lanes), np.empty(lanes), np.empty(lanes)
    for row in range(dv.shape[0]):
        for lane in range(lanes):
            ones[row, lane] = F(1)
    diagonal(inverse, matrix)
    clear_pins(r, matrix.mass)
    dots(goal, r, inverse, r)
    multiply(q, dv, matrix)
    for row in range(dv.shape[0]):
        for lane in range(lanes):
            r[row, lane] -= q[row, lane]
            c[row, lane] = inverse[row, lane] * r[row, lane]
    dots(rho, r, inverse, r)
    for lane in range(lanes):
        goal[lane] = max(goal[lane], rho[lane]) * tolerance * tolerance
    for _ in range(iterations):
        going = False
        for lane in range(lanes):
            going = going or rho[lane] > goal[lane]
        if not going:
            return
        multiply(q, c, matrix)
        dots(old, c, ones, q)
        for lane in range(lanes):
            moves = rho[lane] > goal[lane] and old[lane] > 0.0
            old[lane] = rho[lane] / old[lane] if moves else 0.0
        for row in range(dv.shape[0]):
            for lane in range(lanes):
                dv[row, lane] += F(old[lane]) * c[row, lane]
                r[row, lane] -= F(old[lane]) * q[row, lane]
        dots(old, r, inverse, r)
        for lane in range(lanes):
            old[lane], rho[lane] = rho[lane], old[lane]
            old[lane] = rho[lane] / old[lane] if old[lane] > 0.0 else 0.0
        for row in range(dv.shape[0]):
            for lane in range(lanes):
                c[row, lane] = inverse[row, lane] * r[row, lane] + F(old[lane]) * c[row, lane]
    for lane in range(lanes):
        if rho[lane] > goal[lane]:
            residuals[lane] = max(residuals[lane], np.sqrt(rho[lane] / goal[lane]))


@kernel
def keep_momentum(dv: Any, r: Any, mass: Any) -> None:
    """Conserve a free cloth's momentum: add the sum of the residual over the mass to all of dv."""
    total = 0.0
    for particle in range(mass.size):
        total += mass[particle]
    for axis in range(3):
        for lane in range(dv.shape[1]):
            left = 0.0
            for particle in range(mass.size):
                left += r[3 * particle + axis, lane]
            for particle in range(mass.size):
                dv[3 * particle + axis, lane] += dv.dtype.type(left / total)


@kernel
def lead_pins(
    dv: Any, y: Any, u: Any, pins: Any, targets: Any, step: Any, start: Any, h: Any
) -> None:
    """Set dv to the velocity change that moves the pins to their targets, and to 0 elsewhere."""
    none = dv.dtype.type(0)
    for row in range(dv.shape[0]):
        for lane in range(dv.shape[1]):
            dv[row, lane] = none
    for row in range(3 * pins.size):
        at = 3 * pins[row // 3] + row % 3
        for lane in range(dv.shape[1]):
            goal = y[at, lane]
            if targets.shape[0] > 0:
                goal = targets[step, row, start + lane if targets.shape[2] > 1 else 0]
            dv[at, lane] = (goal - y[at, lane]) / h - u[at, lane]


@kernel
def _substep(block: Any, plan: Any, h: Any, number: Any, options: Any) -> None:
    """Solve for the change of velocities, then move by the new ones."""
    y, u, old, body, bends = block.y, block.u, block.old, plan.body, plan.bends
    b, dv, (rows, lanes), (iterations, tolerance) = block.g, old, y.shape, options
    scratch, blocks = block.work[: 4 * rows].reshape((4, rows, lanes)), block.work[4 * rows :]
    residuals = block.residuals[block.start : block.start + lanes]
    kernels.load_lanes(b, u, 0)
    add_loads(block, body, h)
    for row in range(rows):
        for lane in range(lanes):
            b[row, lane] = plan.mass[row // 3] * (b[row, lane] - u[row, lane])
    linearise(blocks, b, y, u, body.springs, plan.damping[0], h)
    kernels.bend(b, y, u, bends, h, y.dtype.type(0), h + body.damping[0])
    lead_pins(dv, y, u, body.pins, block.targets, number, block.start, h)
    matrix = Matrix(plan.mass, blocks, body.springs, bends, h * (h + body.damping[0]))
    solve(dv, b, matrix, iterations, tolerance, residuals, scratch)
    if body.pins.size == 0:
        keep_momentum(dv, b, plan.mass)
    for row in range(rows):
        for lane in range(lanes):
            u[row, lane] += dv[row, lane]
    kernels.move(y, u, old, h)
    kernels.place_pins(y, old, body.pins, block.targets, number, block.start)
    kernels.shorten(y, plan.attachments)
    kernels.set_velocities(u, y, old, h)


_advance_blocks = loop_around(_substep)


@entry_point
def _advance(
    first: Any,
    last: Any,
    plan: Any,
    batch: Any,
    steps: Any,
    substeps: Any,
    iterations: Any,
    tolerance: Any,
) -> None:
    """Steps of lanes first..last."""
    given, scratch = (iterations, tolerance), 4 * batch.x.shape[0] + 5 * plan.body.springs.rest.size
    _advance_blocks(first, last, plan, batch, steps, substeps, given, scratch)
