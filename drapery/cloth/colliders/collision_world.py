"""The collision response of a step: cloths against themselves and against colliders.

A solver's step moves the cloth without regard to colliders. Then positions and velocities are
corrected here, and the next step starts from the corrected state. So collisions are the same for
every solver, whatever the layout of its arrays.

Against colliders the sample points of the cloth are tested: its particles and, on the faces between
them, a lattice of points that move with their triangle. A push on such a point is shared by the
triangle's corners in proportion to weight and inverse mass, as in Bridson, Fedkiw and Anderson 2002
("Robust treatment of collisions, contact and friction for cloth animation", section 7). Each point
is swept along its whole motion, so nothing passes through, however fast. Points are taken in a
fixed order, one after another.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from drapery.cloth.attachments import Attachments
from drapery.cloth.colliders.collider import Collider
from drapery.cloth.colliders.fields import Field
from drapery.cloth.colliders.pose import Pose
from drapery.cloth.colliders.sampling import SamplePoints
from drapery.cloth.colliders.sweep import BOUNCED, MISSED, ContactParams, RigidSweep, sweep_point
from drapery.cloth.colliders.vectors import Vector, add_scaled, norm, row, scale, subtract
from drapery.cloth.contact.box_data import NO_CONTACT
from drapery.cloth.contact.lanes_contact import resolve_block
from drapery.cloth.contact.self_contact_data import SelfContact
from drapery.cloth.lanes import run_blocks, thread_count
from drapery.cloth.state import State
from drapery.cloth.strain import NEVER, StrainLimit, limit_strain, strain_of
from drapery.errors import OptionError
from drapery.jit import entry_point, kernel
from drapery.mesh import Array

THINNEST = 1e-4
"""The least distance kept from a surface [m]: on the surface itself normals are not reliable."""
SHORTENING_ROUNDS = 16
"""How often springs that end over the limit are shortened and colliders applied again."""


class ClothMotion(NamedTuple):
    """Cloths during the collision response: positions at the step's start and now [m] and
    velocities [m/s], shape [B, N, 3]; which particles bounced, [B, N]."""

    start: Array
    x: Array
    v: Array
    bounced: NDArray[np.bool_]


@dataclass(frozen=True, eq=False)
class CollisionWorld:
    """What one cloth collides with, prepared once for all its steps.

    It holds no state of a step, so several threads may use one object at the same time.

    inv_mass: [1/kg], shape [N].
    colliders: applied one after another; where two overlap, the last one decides.
    points: of the cloth, see `sample_points`.
    radius: distance kept from every surface, half the cloth's thickness [m]; at least `THINNEST`.
    self_contact: None lets the cloth pass through itself.
    attachments: springs to shorten where colliders stretched them. Colliders are then applied
        again, `rounds` times in all.
    threads: None for as many as there are processors.
    limit: of the strain of each cloth. Where it is exceeded in the end, springs are shortened and
        colliders applied once more, some times.
    """

    inv_mass: Array
    colliders: Sequence[Collider]
    points: SamplePoints
    radius: float
    self_contact: SelfContact | None = None
    attachments: Attachments | None = None
    rounds: int = 1
    threads: int | None = None
    limit: StrainLimit = NEVER

    def resolve(self, before: State, after: State) -> State:
        """The state after a step, with penetrations of colliders and of the cloth itself resolved.

        before, after: the states at the start and the end of the solver's step. Pinned particles
        are not moved. Raises OptionError for a step without duration, and for a collider whose
        signed distance is not a number somewhere near the cloth.
        """
        dt = after.time - before.time
        if not dt > 0:
            raise OptionError(f"a collision step of {dt} s is out of range; use a time above 0 s")
        start, x, v = (
            np.array(a, float, order="C")
            for a in (before.positions, after.positions, after.velocities)
        )
        motion = ClothMotion(start, x, v, np.zeros(start.shape[:2], np.bool_))
        sweeps = [sweep_between(c.path(before.time), c.path(after.time)) for c in self.colliders]

        def work(first: int, last: int) -> None:
            self._resolve_block(first, last, motion, sweeps, dt)

        run_blocks(work, len(start), 1, thread_count(self.threads))
        dtype, strain = after.positions.dtype, max(before.strain, strain_of(x, self.limit))
        return State(x.astype(dtype), v.astype(dtype), after.time, strain)

    def _resolve_block(
        self, first: int, last: int, motion: ClothMotion, sweeps: Sequence[RigidSweep], dt: float
    ) -> None:
        """Cloths first..last of a batch; each is one thread's alone, so threads change no bit."""
        solved, speeds = motion.x[first:last].copy(), motion.v[first:last].copy()
        if self.self_contact is not None:
            block = motion.start, motion.x, (first, last)
            resolve_block(*block, NO_CONTACT, self.self_contact)
        active = np.ones(len(motion.x), np.bool_)

        def collide() -> None:
            for collider, sweep in zip(self.colliders, sweeps, strict=True):
                self._collide_block(first, last, collider, sweep, motion, active, dt)

        for number in range(self.rounds):
            collide()
            if number + 1 < self.rounds and self.attachments is not None:
                shorten_all(first, last, motion.x, self.attachments, active)
        active[:] = True
        for _ in range(SHORTENING_ROUNDS):
            for cloth in np.flatnonzero(active[first:last]) + first:
                active[cloth] = limit_strain(motion.start[cloth], motion.x[cloth], self.limit)
            if not active[first:last].any():
                break
            collide()
        update_velocities(first, last, motion, solved, speeds, dt)

    def _collide_block(
        self,
        first: int,
        last: int,
        collider: Collider,
        sweep: RigidSweep,
        motion: ClothMotion,
        active: NDArray[np.bool_],
        dt: float,
    ) -> None:
        radius = max(self.radius, THINNEST)
        contact = ContactParams(radius, float(collider.restitution), float(collider.friction))
        fixed = collider.packed, sweep, contact, self.points, self.inv_mass
        collide_all(first, last, *fixed, motion, active, dt)
        if not np.isfinite(motion.x[first:last]).all():
            raise OptionError(
                f"collider {type(collider.shape).__name__}: its signed_distance is not a number "
                "near the cloth; return a finite number everywhere"
            )


def sweep_between(start: Pose, end: Pose) -> RigidSweep:
    """A collider's motion over a step."""
    return RigidSweep(
        *(
            np.ascontiguousarray(part, float)
            for pose in (start, end)
            for part in (pose.position, pose.rotation)
        )
    )


@entry_point
def collide_all(
    first: int,
    last: int,
    shape: Field,
    sweep: RigidSweep,
    contact: ContactParams,
    points: SamplePoints,
    inv_mass: Array,
    motion: ClothMotion,
    active: NDArray[np.bool_],
    dt: float,
) -> None:
    """Cloths first..last of a batch; each is one thread's alone, so threads change no bit."""
    for cloth in range(first, last):
        if active[cloth]:
            here = ClothMotion(
                motion.start[cloth], motion.x[cloth], motion.v[cloth], motion.bounced[cloth]
            )
            collide_one(shape, sweep, contact, points, inv_mass, here, dt)


@kernel
def collide_one(
    shape: Field,
    sweep: RigidSweep,
    contact: ContactParams,
    points: SamplePoints,
    inv_mass: Array,
    motion: ClothMotion,
    dt: float,
) -> None:
    """One cloth: motion holds [N, 3]."""
    for m in range(len(points.particles)):
        particles, weights = points.particles[m], points.weights[m]
        point_inv_mass = inverse_mass_at(particles, weights, inv_mass)
        if point_inv_mass == 0.0:
            continue
        a = interpolate(motion.start, particles, weights)
        b = interpolate(motion.x, particles, weights)
        u = interpolate(motion.v, particles, weights)
        touch, end, velocity = sweep_point(shape, sweep, contact, a, b, u, dt)
        if touch == MISSED:
            continue
        distribute(motion.x, particles, weights, inv_mass, point_inv_mass, subtract(end, b))
        distribute(motion.v, particles, weights, inv_mass, point_inv_mass, subtract(velocity, u))
        for corner in range(3):
            if touch == BOUNCED and weights[corner] > 0.0:
                motion.bounced[particles[corner]] = True


@entry_point
def shorten_all(
    first: int, last: int, x: Array, attachments: Attachments, active: NDArray[np.bool_]
) -> None:
    """Shorten each pair that is too long; cloths without one become inactive."""
    for cloth in range(first, last):
        if active[cloth]:
            active[cloth] = shorten_one(x[cloth], attachments)


@kernel
def shorten_one(x: Array, attachments: Attachments) -> bool:
    """Shorten the pairs of one cloth that are too long; returns whether there was one."""
    found = False
    for s in range(len(attachments.longest)):
        i, j = attachments.pairs[s, 0], attachments.pairs[s, 1]
        offset = subtract(row(x, j), row(x, i))
        length = norm(offset)
        if length > attachments.longest[s]:
            found = True
            part = 1 - attachments.longest[s] / length
            for axis in range(3):
                x[i, axis] += attachments.share_i[s] * part * offset[axis]
                x[j, axis] -= attachments.share_j[s] * part * offset[axis]
    return found


@entry_point
def update_velocities(
    first: int, last: int, motion: ClothMotion, solved: Array, speeds: Array, dt: float
) -> None:
    """Give particles that were moved here, and did not bounce, the velocity of their motion over
    the step. Otherwise a cloth that its solver pulls into a surface at every step would keep the
    speed of that pull. The new speed is at most the speed before the collision response, or that
    of an impact.

    solved, speeds: positions [m] and velocities [m/s] before colliders, of cloths first..last.
    """
    for cloth in range(first, last):
        x, v, start = motion.x[cloth], motion.v[cloth], motion.start[cloth]
        for i in range(len(x)):
            if motion.bounced[cloth, i] or same(x, solved[cloth - first], i):
                continue
            seen = scale(1 / dt, subtract(row(x, i), row(start, i)))
            maximum = max(norm(row(speeds[cloth - first], i)), norm(row(v, i)))
            length = norm(seen)
            part = maximum / length if length > maximum else 1.0
            for axis in range(3):
                v[i, axis] = part * seen[axis]


@kernel
def same(x: Array, y: Array, i: int) -> bool:
    return bool(x[i, 0] == y[i, 0] and x[i, 1] == y[i, 1] and x[i, 2] == y[i, 2])


@kernel
def inverse_mass_at(particles: NDArray[np.int32], weights: Array, inv_mass: Array) -> float:
    """Inverse of the effective mass [1/kg] of a sample point; 0 if all its particles are pinned."""
    total = 0.0
    for corner in range(3):
        total += weights[corner] * weights[corner] * inv_mass[particles[corner]]
    return total


@kernel
def interpolate(rows: Array, particles: NDArray[np.int32], weights: Array) -> Vector:
    """Weighted sum of three rows of an array [N, 3]."""
    total = (0.0, 0.0, 0.0)
    for corner in range(3):
        i = particles[corner]
        total = add_scaled(total, weights[corner], (rows[i, 0], rows[i, 1], rows[i, 2]))
    return total


@kernel
def distribute(
    rows: Array,
    particles: NDArray[np.int32],
    weights: Array,
    inv_mass: Array,
    point_inv_mass: float,
    change: Vector,
) -> None:
    """Change the particles so that their weighted sum changes by `change`, momentum kept."""
    for corner in range(3):
        i = particles[corner]
        part = weights[corner] * inv_mass[i] / point_inv_mass
        for axis in range(3):
            rows[i, axis] += part * change[axis]
