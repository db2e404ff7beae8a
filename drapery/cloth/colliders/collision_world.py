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

Cloth that also meets itself does so first. If colliders then push parts of it into others, its step
is made again in short parts, in which it moves evenly and a push cannot reach past the next layer;
each part ends with contact of the cloth with itself. (The solver's motion is not computed anew, as
it is where boxes tear at cloth, see `contact`.)
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from drapery.cloth.attachments import Attachments
from drapery.cloth.colliders.collider import Collider
from drapery.cloth.colliders.fields import Field
from drapery.cloth.colliders.pose import Pose
from drapery.cloth.colliders.sampling import SamplePoints
from drapery.cloth.colliders.sweep import BOUNCED, MISSED, ContactParams, RigidSweep, sweep_point
from drapery.cloth.colliders.vectors import Vector, add_scaled, norm, row, subtract
from drapery.cloth.contact.box_data import NO_CONTACT
from drapery.cloth.contact.lanes_contact import resolve_block
from drapery.cloth.contact.self_contact_data import SelfContact
from drapery.cloth.contact.velocities import set_velocities, speeds_of
from drapery.cloth.lanes import run_blocks, thread_count
from drapery.cloth.state import State
from drapery.cloth.strain import NEVER, StrainLimit, limit_strain, worse, worst_now
from drapery.errors import OptionError
from drapery.jit import entry_point, kernel
from drapery.mesh import Array

THINNEST = 1e-4
"""The least distance kept from a surface [m]: on the surface itself normals are not reliable."""
SHORTENING_ROUNDS = 16
"""How often springs that end over the limit are shortened and colliders applied again."""
NEARER = 0.5
"""Cloth may come nearer to a surface by this part of the distance that it keeps, to hold its
limit."""
PARTS = 16
"""The parts of a step in which colliders push a cloth into itself. A collider of 4 m/s moves in one
by a quarter of a thickness of 2 cm, which is how far contact moves a part of the cloth at once."""
TURNS = 4
"""How often colliders and contact of the cloth with itself take turns in a part."""
PUSHED, PARTED = 0.1, 0.02
"""Cloth is pushed into itself if contact with itself would then move it by more than this part of
its thickness; less than the second leaves it where it is."""


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
        solved, speeds, crossed = x.copy(), v.copy(), np.zeros(len(x), np.bool_)
        (sweeps,) = self._sweeps(before.time, after.time, 1)
        threads = thread_count(self.threads)

        def work(first: int, last: int) -> None:
            crossed[first:last] = self._resolve_block(first, last, motion, sweeps, dt)

        run_blocks(work, len(start), 1, threads)
        parts = self._sweeps(before.time, after.time, PARTS) if crossed.any() else []

        def finish(first: int, last: int) -> None:
            for cloth in (first + int(each) for each in np.flatnonzero(crossed[first:last])):
                here = one_of(motion, cloth)
                here.x[:], here.v[:], here.bounced[:] = solved[cloth], speeds[cloth], False
                self._resolve_in_parts(here, parts, dt / PARTS)
            block = slice(first, last)
            # A bounce has set a velocity of its own; the speed of an impact is allowed to all.
            moved = (x[block] != solved[block]).any(axis=2) & ~motion.bounced[block]
            most = np.maximum(speeds_of(speeds[block]), speeds_of(v[block]))
            set_velocities(v[block], (x[block] - start[block]) * (1 / dt), moved, most)

        run_blocks(finish, len(start), 1, threads)
        dtype = after.positions.dtype
        worst = worse(before.worst, worst_now(x, self.limit, after.time))
        return State(x.astype(dtype), v.astype(dtype), after.time, worst)

    def _resolve_block(
        self, first: int, last: int, motion: ClothMotion, sweeps: Sequence[RigidSweep], dt: float
    ) -> list[bool]:
        """Cloths first..last of a batch; each is one thread's alone, so threads change no bit.

        Returns whether colliders pushed each of them into itself.
        """
        for cloth in range(first, last):
            self._part(one_of(motion, cloth))
        apart = motion.x[first:last].copy()
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
            for cloth in (first + int(each) for each in np.flatnonzero(active[first:last])):
                active[cloth] = limit_strain(motion.start[cloth], motion.x[cloth], self.limit)
            if not active[first:last].any():
                break
            collide()
        else:
            self._limit_outside(first, last, motion, active, collide)
        pushed = (motion.x[first:last] != apart).any(axis=(1, 2)).tolist()
        return [moved and self._is_in_itself(motion, first + n) for n, moved in enumerate(pushed)]

    def _limit_outside(
        self,
        first: int,
        last: int,
        motion: ClothMotion,
        active: NDArray[np.bool_],
        collide: Callable[[], None],
    ) -> None:
        """Limit the strain of cloths that friction holds, which brings them nearer to a surface;
        not of those that would come nearer than `NEARER`."""
        x, v = motion.x[first:last], motion.v[first:last]
        places, speeds = x.copy(), v.copy()
        for cloth in (first + int(each) for each in np.flatnonzero(active[first:last])):
            limit_strain(motion.start[cloth], motion.x[cloth], self.limit)
        limited = x.copy()
        collide()
        near = np.abs(x - limited).max(axis=(1, 2)) > NEARER * self.radius
        x[:] = np.where(near[:, None, None], places, limited)
        v[:] = speeds

    def _resolve_in_parts(
        self, motion: ClothMotion, parts: Sequence[Sequence[RigidSweep]], dt: float
    ) -> None:
        """The contacts of one cloth, in as many parts of its step as there are sweeps."""
        x, active, begin = motion.x, np.ones(1, np.bool_), motion.start
        free = self.inv_mass > 0
        way = (x - begin) / len(parts)
        for sweeps in parts:
            end = begin + way
            part = motion._replace(start=begin, x=end)
            self._part(part)
            for _ in range(TURNS):
                for collider, sweep in zip(self.colliders, sweeps, strict=True):
                    self._collide_block(0, 1, collider, sweep, part, active, dt)
                limited = limit_strain(begin[0], end[0], self.limit)
                if self._part(part) <= PARTED and not limited:
                    break
            begin = end
        x[:, free] = begin[:, free]

    def _part(self, motion: ClothMotion) -> float:
        """Resolve the contact of one cloth with itself; returns how far that moved a particle along
        an axis, as a part of the thickness. It is 0 where edges have no length, and so no room to
        be kept apart."""
        if self.self_contact is None:
            return 0.0
        before = motion.x.copy()
        resolve_block(motion.start, motion.x, (0, 1), NO_CONTACT, self.self_contact)
        thickness = self.self_contact.thickness
        return float(np.abs(motion.x - before).max()) / thickness if thickness else 0.0

    def _is_in_itself(self, motion: ClothMotion, cloth: int) -> bool:
        """Whether contact of a cloth with itself would have to move it once more."""
        here = one_of(motion, cloth)
        return self._part(here._replace(x=here.x.copy())) > PUSHED

    def _sweeps(self, start: float, end: float, count: int) -> list[list[RigidSweep]]:
        """The motion of each collider in each of some equal parts of a time [s]."""
        times = [start + (end - start) * number / count for number in range(count)]
        poses = [[c.path(time) for c in self.colliders] for time in (*times, end)]
        return [[*map(sweep_between, *pair)] for pair in pairwise(poses)]

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


def one_of(motion: ClothMotion, cloth: int) -> ClothMotion:
    """One cloth of a motion, as a motion of one."""
    chosen = slice(cloth, cloth + 1)
    return ClothMotion(
        motion.start[chosen], motion.x[chosen], motion.v[chosen], motion.bounced[chosen]
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
