"""Position based dynamics: move, then satisfy constraints by relaxation.

Müller, Heidelberger, Hennix, Ratcliff, "Position based dynamics" (J. Vis. Commun. 18(2), 2007);
before it Jakobsen, "Advanced character physics" (GDC 2001). Three things are added so that a fine
cloth keeps its size: small substeps (Macklin et al. 2019, "Small steps in physics simulation"),
constraints in order from the pins outwards, and attachments of every length (see `attachments`).

The order is 1. It is stable for any step. Stiffness is not in N/m: it depends on the number of
passes, and the stiffness of the springs is not used. Bending is in physical units, as in xpbd.
Choose it for fast cloth that hardly stretches and for pixel-art capes. It differs from xpbd, whose
compliance does not depend on dt, and from verlet, although it is often called that: here no forces
act between particles.
"""

from dataclasses import dataclass
from typing import Any, Literal, NamedTuple

import numpy as np
from numpy.typing import NDArray

from drapery.cloth import kernels
from drapery.cloth.attachments import Attachments, stretch_limits
from drapery.cloth.bending import BendingStep, bending_step
from drapery.cloth.checks import check_choice, check_count, check_number, check_three
from drapery.cloth.cloth import STRUCTURAL, Cloth
from drapery.cloth.kernels import add, direction
from drapery.cloth.order import outwards, pin_distances, sweep_order
from drapery.cloth.simd import fill, lane_count, load, maximum, minimum, sqrt
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
    movable,
)
from drapery.cloth.strain import allowed_stretch, strain_limit
from drapery.jit import borrowing_kernel, entry_point
from drapery.mesh import Array

TOLERATED = 1.005
"""A pair farther apart than this factor times its longest length causes another sweep."""
BEYOND = 1e6
"""A factor of the longest length that no pair reaches."""


class PBDConstraints(NamedTuple):
    """Distances of pairs [C, 2] between `minimum` and `maximum` [m], [C], and the part of a
    correction that each end takes."""

    pairs: NDArray[np.int32]
    minimum: Array
    maximum: Array
    share_i: Array
    share_j: Array


class PBDPlan(NamedTuple):
    body: ClothBody
    constraints: PBDConstraints
    bending_step: BendingStep
    attachments: Attachments
    springs: Attachments
    keep: Array


@dataclass(frozen=True)
class SolverPBD(KernelSolver):
    """Position based dynamics (Müller et al. 2007).

    It is stable for any step. Choose it for fast cloth that hardly stretches and for pixel art.

    passes: passes of relaxation, a substep, 0 to 1000.
    substeps: of each step, 1 to 1000.
    constraint: `equal` holds distances at their rest length; `at-most` lets them shrink, for capes.
    stiffness: part of a correction that one pass makes, for structural, shear and flexion springs,
        0 to 1 each.
    order: `pins` corrects springs from the pins outwards, `given` in the order of the cloth.
    shares: `mass` divides a correction by inverse mass; with `half` each end that is not pinned
        moves half of it, even if the other end is pinned.
    limit: longest length of a structural spring over its rest length, 1 to 1e6; `attachments`
        enforce it.
    sweeps: most sweeps over springs that are still too long, a substep, 0 to 1000; 0 also removes
        the attachments.
    damping: rate at which all velocities decay [1/s], 0 to 1e6.
    threads: 1 to 1000; None uses every processor. The result does not depend on it.
    Raises OptionError.
    """

    passes: int = 1
    substeps: int = 4
    constraint: Literal["equal", "at-most"] = "equal"
    stiffness: tuple[float, float, float] = (1.0, 0.5, 0.05)
    order: Literal["pins", "given"] = "pins"
    shares: Literal["mass", "half"] = "mass"
    limit: float = 1.02
    sweeps: int = 10
    damping: float = 0.0
    threads: int | None = None

    def __post_init__(self) -> None:
        check_count("passes", self.passes, 0, 1000)
        check_count("substeps", self.substeps, 1, MAX_SUBSTEPS)
        check_choice("constraint", self.constraint, ("equal", "at-most"))
        check_choice("order", self.order, ("pins", "given"))
        check_choice("shares", self.shares, ("mass", "half"))
        check_three("stiffness", self.stiffness)
        for part in self.stiffness:
            check_number("stiffness", part, 0, 1)
        check_common(self.limit, self.sweeps, self.substeps, self.threads)
        check_number("damping", self.damping, 0, 1e6, "1/s")

    @classmethod
    def plain(cls, passes: int = 6) -> "SolverPBD":
        """The loop of tutorials: equal structural distances in the given order, halved shares."""
        return cls(
            passes=passes,
            substeps=1,
            stiffness=(1.0, 0.0, 0.0),
            order="given",
            shares="half",
            sweeps=0,
        )

    @classmethod
    def cape(cls, passes: int = 3, damping: float = 1.0) -> "SolverPBD":
        """Pixel-art capes: neighbours no farther than at rest, a few passes, air resistance.

        passes: passes of relaxation, a substep, 0 to 1000.
        damping: rate at which all velocities decay [1/s], 0 to 1e6.
        """
        return cls(
            passes=passes,
            substeps=1,
            constraint="at-most",
            stiffness=(1.0, 0.0, 0.0),
            sweeps=0,
            damping=damping,
        )

    def init(self, cloth: Cloth, dt: float) -> SolverState:
        check_step(dt, 1)
        h = dt / self.substeps
        keep = np.array([1 / (1 + self.damping * dt / self.substeps)])
        attachments = stretch_limits(cloth, self.limit, min(self.sweeps, 1))
        plan = PBDPlan(
            body_of(cloth),
            self._constraints(cloth),
            bending_step(cloth.bending, cloth.inv_mass, h),
            attachments,
            stretched(cloth, self.limit),
            keep,
        )
        limit = strain_limit(cloth, allowed_stretch(self.limit, self.sweeps))
        options = self.passes, self.sweeps
        return SolverState(plan, dt, self.substeps, _advance, options, limit=limit, shares=SHARED)

    def _constraints(self, cloth: Cloth) -> PBDConstraints:
        stiffness = np.asarray(self.stiffness, float)[cloth.spring_kind]
        chosen = np.flatnonzero(movable(cloth) & (stiffness > 0))
        if self.order == "pins":
            chosen = chosen[bending_first(cloth, chosen)]
        pairs, rest = cloth.spring_pairs[chosen], cloth.spring_length[chosen]
        half = self.shares == "half"
        shares = 0.5 * (cloth.inv_mass[pairs] > 0) if half else mass_shares(cloth, pairs)
        shares = shares * stiffness[chosen, None]
        shortest = rest if self.constraint == "equal" else np.zeros_like(rest)
        return PBDConstraints(
            np.ascontiguousarray(pairs), shortest, rest, shares[:, 0].copy(), shares[:, 1].copy()
        )


def bending_first(cloth: Cloth, springs: NDArray[np.int64]) -> NDArray[np.int64]:
    """Indices in `springs`: flexion, shear, then structural springs, each kind from the pins
    outwards. Structural springs come last, so their lengths are the most accurate."""
    pairs, lengths = cloth.spring_pairs[springs], cloth.spring_length[springs]
    order = outwards(pin_distances(cloth), pairs, lengths)
    return order[np.argsort(-cloth.spring_kind[springs][order].astype(int), kind="stable")]


def stretched(cloth: Cloth, limit: float) -> Attachments:
    """The structural springs from the pins outwards, at most `limit` times their rest length."""
    chosen = sweep_order(cloth, np.flatnonzero(cloth.spring_kind == STRUCTURAL))
    pairs = cloth.spring_pairs[chosen]
    part_i, part_j = mass_shares(cloth, pairs).T.copy()
    return Attachments(pairs, cloth.spring_length[chosen] * limit, part_i, part_j)


def mass_shares(cloth: Cloth, pairs: NDArray[np.integer]) -> Array:
    """Parts of a correction in proportion to inverse mass, so that momentum is kept, [K, 2]."""
    inv_mass = cloth.inv_mass[pairs]
    shares: Array = inv_mass / inv_mass.sum(axis=1, keepdims=True)
    return shares


@borrowing_kernel
def relax(y: Any, constraints: Any) -> None:
    """One Gauss-Seidel pass: each pair in turn is moved to its distance."""
    tiny = fill(y.dtype.type(1e-30))
    for s in range(constraints.maximum.size):
        i, j = 3 * np.intp(constraints.pairs[s, 0]), 3 * np.intp(constraints.pairs[s, 1])
        shortest, longest = fill(constraints.minimum[s]), fill(constraints.maximum[s])
        part_i, part_j = constraints.share_i[s], -constraints.share_j[s]
        for lane in range(0, y.shape[1], lane_count(y)):
            dx, dy, dz = direction(y, i, j, lane)
            d = sqrt(dx * dx + dy * dy + dz * dz)
            part = (d - minimum(maximum(d, shortest), longest)) / maximum(d, tiny)
            add(y, i, lane, part_i * part, dx, dy, dz)
            add(y, j, lane, part_j * part, dx, dy, dz)


@borrowing_kernel
def shorten_too_long(y: Any, attachments: Any, sweeps: Any, factors: Any) -> None:
    """Sweep over the lanes in which a pair is too far apart, each lane until it has none.

    factors: scratch; its first row is each lane's factor of `longest`.
    """
    for _ in range(sweeps):
        if not mark_too_long(factors[0], y, attachments):
            return
        for s in range(attachments.longest.size):
            i, j = 3 * np.intp(attachments.pairs[s, 0]), 3 * np.intp(attachments.pairs[s, 1])
            longest, part_i, part_j = (
                attachments.longest[s],
                attachments.share_i[s],
                -attachments.share_j[s],
            )
            for lane in range(0, y.shape[1], lane_count(y)):
                dx, dy, dz = direction(y, i, j, lane)
                limit = load(factors, 0, lane) * longest
                d = maximum(sqrt(dx * dx + dy * dy + dz * dz), limit)
                excess = (d - limit) / d
                add(y, i, lane, part_i * excess, dx, dy, dz)
                add(y, j, lane, part_j * excess, dx, dy, dz)


@borrowing_kernel
def mark_too_long(factors: Any, y: Any, attachments: Any) -> bool:
    """Factors: 1 for lanes with a pair over TOLERATED times its longest length, else BEYOND.

    Returns whether there is such a lane.
    """
    F = y.dtype.type
    slack = F(TOLERATED * TOLERATED)
    found = False
    for lane in range(factors.size):
        factors[lane] = F(BEYOND)
    for s in range(attachments.longest.size):
        i, j = 3 * attachments.pairs[s, 0], 3 * attachments.pairs[s, 1]
        square = slack * attachments.longest[s] * attachments.longest[s]
        for lane in range(y.shape[1]):
            dx = y[j, lane] - y[i, lane]
            dy = y[j + 1, lane] - y[i + 1, lane]
            dz = y[j + 2, lane] - y[i + 2, lane]
            long = dx * dx + dy * dy + dz * dz > square
            factors[lane] = F(1) if long else factors[lane]
            found = found or long
    return found


@borrowing_kernel
def damp(u: Any, keep: Any) -> None:
    for row in range(u.shape[0]):
        for lane in range(u.shape[1]):
            u[row, lane] *= keep


@borrowing_kernel
def _substep(block: Any, plan: Any, h: Any, number: Any, options: Any) -> None:
    """Move, then relax the constraints and shorten what is too long."""
    y, u, g, old, body = block.y, block.u, block.g, block.old, plan.body
    passes, sweeps = options
    kernels.load_lanes(g, u, 0)
    damp(g, plan.keep[0])
    bend_time, damping = plan.bending_step.time[0], plan.bending_step.damping[0]
    kernels.bend(g, y, u, body.stencils, bend_time, y.dtype.type(0), damping)
    add_loads(block, body, h)
    kernels.move(y, g, old, h)
    kernels.place_pins(y, old, body.pins, block.targets, number, block.start)
    for _ in range(passes):
        relax(y, plan.constraints)
    kernels.shorten(y, plan.attachments)
    shorten_too_long(y, plan.springs, sweeps, block.work)
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
    passes: Any,
    sweeps: Any,
) -> None:
    """Steps of lanes first..last."""
    _advance_blocks(first, last, plan, batch, steps, substeps, (passes, sweeps))
