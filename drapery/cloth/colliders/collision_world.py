"""The collision stage of a step: cloths against colliders, after the solver has moved them.

The points tested are the particles and, on the faces between them, a lattice of points that move
with their triangle; a push on such a point is shared by the triangle's corners in proportion to
weight and inverse mass, as in Bridson, Fedkiw and Anderson 2002 ("Robust treatment of collisions,
contact and friction for cloth animation", section 7). Each point is swept along its whole motion,
so nothing passes through, however fast. Points are taken in a fixed order, one after another.
"""

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from drapery.cloth.attachments import Attachments
from drapery.cloth.cloth import Cloth
from drapery.cloth.colliders.fields import Field
from drapery.cloth.colliders.packing import pack
from drapery.cloth.colliders.pose import Path, Pose, still
from drapery.cloth.colliders.shapes import Shape
from drapery.cloth.colliders.sweep import BOUNCED, MISSED, Frame, Skin, meet
from drapery.cloth.colliders.vectors import Vector, along, norm, row, scale, subtract
from drapery.cloth.lanes import run_blocks, thread_count
from drapery.cloth.state import State
from drapery.errors import OptionError
from drapery.jit import entry_point, kernel
from drapery.mesh import Array, Triangles

THINNEST = 1e-4
"""The least distance kept from a surface [m]: normals are well known only off the surface."""


@dataclass(frozen=True, eq=False)
class Collider:
    """A shape that cloth cannot enter.

    path: the shape's pose through time; still by default.
    restitution: part of the approach speed that a bounce gives back, 0 to 1.
    friction: Coulomb's coefficient.
    """

    shape: Shape
    path: Path = still
    restitution: float = 0.0
    friction: float = 0.3
    packed: Field = field(init=False, repr=False)

    def __post_init__(self) -> None:
        if not 0 <= self.restitution <= 1:
            raise OptionError(f"restitution {self.restitution}: give a number from 0 to 1")
        if not 0 <= self.friction < np.inf:
            raise OptionError(f"friction {self.friction}: give a number of at least 0")
        object.__setattr__(self, "packed", pack(self.shape))


class Probes(NamedTuple):
    """The points that are tested: particle indices [M, 3] and their weights [M, 3]."""

    particles: NDArray[np.int32]
    weights: Array


class Moved(NamedTuple):
    """Cloths on their way through the stage: places at the step's start and now [m] and
    velocities [m/s], shape [B, N, 3]; which particles bounced, [B, N]."""

    start: Array
    x: Array
    v: Array
    bounced: NDArray[np.bool_]


def probes(cloth: Cloth, order: int = 2) -> Probes:
    """The points of a cloth to test, face points first and particles last.

    order: parts into which each side of a face is cut. 1 tests the particles alone, 2 also the
        middles of all edges, 3 two points on every edge and the middle of every face, and so on.
        Choose it so that the points lie closer than the thinnest collider is wide.
    """
    if not 1 <= order <= 16:
        raise OptionError(f"collision order {order}: give a whole number from 1 to 16")
    return face_probes(len(cloth.inv_mass), cloth.triangles, order)


def face_probes(count: int, triangles: Triangles, order: int) -> Probes:
    """As `probes`, for `count` particles and triangles [T, 3]."""
    own = np.arange(count, dtype=np.int32)
    alone = Probes(np.stack([own, own, own], axis=1), np.tile([1.0, 0.0, 0.0], (count, 1)))
    shares = [
        (i, j, order - i - j)
        for i in range(order + 1)
        for j in range(order + 1 - i)
        if order not in (i, j, order - i - j)
    ]
    if not shares or not len(triangles):
        return alone
    lattice = np.array(shares)
    corners = np.repeat(triangles, len(lattice), axis=0)
    parts = np.tile(lattice, (len(triangles), 1))
    # Two triangles share the points of their common edge: keep each point once.
    rank = np.argsort(np.where(parts > 0, corners, np.iinfo(np.int32).max), axis=1, kind="stable")
    corners = np.take_along_axis(corners, rank, axis=1)
    parts = np.take_along_axis(parts, rank, axis=1)
    corners = np.where(parts > 0, corners, corners[:, :1])
    unique = np.unique(np.concatenate([corners, parts], axis=1), axis=0)
    return Probes(
        np.concatenate([unique[:, :3].astype(np.int32), alone.particles]),
        np.concatenate([unique[:, 3:] / order, alone.weights]),
    )


def collide(
    cloth: Cloth,
    before: State,
    after: State,
    colliders: Sequence[Collider],
    points: Probes,
    *,
    radius: float,
    links: Attachments | None = None,
    rounds: int = 1,
    threads: int | None = None,
) -> State:
    """The state after a step, with everything that entered a collider brought back.

    before, after: the states at the start and the end of the step; pinned particles keep their
        place. points: from `probes`. radius: distance kept from every surface, half the cloth's
        thickness [m]; at least `THINNEST` is kept. links: springs to shorten where colliders made
        them too long; then colliders come again, `rounds` times in all. threads: None for as many
        as there are processors.
    """
    dt = after.time - before.time
    if not dt > 0:
        raise OptionError(f"collision over a step of {dt} s: the time must grow")
    start, solved, speeds = (
        np.array(a, float, order="C") for a in (before.positions, after.positions, after.velocities)
    )
    now = Moved(start, solved.copy(), speeds.copy(), np.zeros(start.shape[:2], np.bool_))
    inv_mass, busy = np.array(cloth.inv_mass, float), np.ones(len(start), np.bool_)
    skins = [
        Skin(max(radius, THINNEST), float(c.restitution), float(c.friction)) for c in colliders
    ]
    frames = [frame_between(c.path(before.time), c.path(after.time)) for c in colliders]

    def work(first: int, last: int) -> None:
        for number in range(rounds):
            for collider, frame, skin in zip(colliders, frames, skins, strict=True):
                collide_all(
                    first, last, collider.packed, frame, skin, points, inv_mass, now, busy, dt
                )
            if number + 1 < rounds and links is not None:
                shorten_all(first, last, now.x, links, busy)
        settle_all(first, last, now, solved, speeds, dt)

    run_blocks(work, len(start), 1, thread_count(threads))
    dtype = after.positions.dtype
    return replace(after, positions=now.x.astype(dtype), velocities=now.v.astype(dtype))


def frame_between(start: Pose, end: Pose) -> Frame:
    return Frame(
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
    frame: Frame,
    skin: Skin,
    points: Probes,
    inv_mass: Array,
    now: Moved,
    busy: NDArray[np.bool_],
    dt: float,
) -> None:
    """Cloths first..last of a batch; each is one thread's alone, so threads change no bit."""
    for cloth in range(first, last):
        if busy[cloth]:
            here = Moved(now.start[cloth], now.x[cloth], now.v[cloth], now.bounced[cloth])
            collide_one(shape, frame, skin, points, inv_mass, here, dt)


@kernel
def collide_one(
    shape: Field,
    frame: Frame,
    skin: Skin,
    points: Probes,
    inv_mass: Array,
    now: Moved,
    dt: float,
) -> None:
    """One cloth: now holds [N, 3]."""
    for m in range(len(points.particles)):
        particles, weights = points.particles[m], points.weights[m]
        give = softness(particles, weights, inv_mass)
        if give == 0.0:
            continue
        a = blend(now.start, particles, weights)
        b = blend(now.x, particles, weights)
        u = blend(now.v, particles, weights)
        touch, end, velocity = meet(shape, frame, skin, a, b, u, dt)
        if touch == MISSED:
            continue
        share(now.x, particles, weights, inv_mass, give, subtract(end, b))
        share(now.v, particles, weights, inv_mass, give, subtract(velocity, u))
        for corner in range(3):
            if touch == BOUNCED and weights[corner] > 0.0:
                now.bounced[particles[corner]] = True


@entry_point
def shorten_all(
    first: int, last: int, x: Array, links: Attachments, busy: NDArray[np.bool_]
) -> None:
    """Shorten each link that is too long; cloths without one are done."""
    for cloth in range(first, last):
        if busy[cloth]:
            busy[cloth] = shorten_one(x[cloth], links)


@kernel
def shorten_one(x: Array, links: Attachments) -> bool:
    """Whether there was a link to shorten."""
    found = False
    for s in range(len(links.longest)):
        i, j = links.pairs[s, 0], links.pairs[s, 1]
        arm = subtract(row(x, j), row(x, i))
        length = norm(arm)
        if length > links.longest[s]:
            found = True
            part = 1 - links.longest[s] / length
            for axis in range(3):
                x[i, axis] += links.share_i[s] * part * arm[axis]
                x[j, axis] -= links.share_j[s] * part * arm[axis]
    return found


@entry_point
def settle_all(first: int, last: int, now: Moved, solved: Array, speeds: Array, dt: float) -> None:
    """Particles that were moved here and did not bounce are as fast as they are seen to be. Or a
    cloth that its solver pulls into a surface at every step would keep the speed of that pull. No
    more speed comes of it than there was before, or than an impact gave."""
    for cloth in range(first, last):
        x, v, start = now.x[cloth], now.v[cloth], now.start[cloth]
        for i in range(len(x)):
            if now.bounced[cloth, i] or same(x, solved[cloth], i):
                continue
            seen = scale(1 / dt, subtract(row(x, i), row(start, i)))
            most = max(norm(row(speeds[cloth], i)), norm(row(v, i)))
            length = norm(seen)
            part = most / length if length > most else 1.0
            for axis in range(3):
                v[i, axis] = part * seen[axis]


@kernel
def same(x: Array, y: Array, i: int) -> bool:
    return bool(x[i, 0] == y[i, 0] and x[i, 1] == y[i, 1] and x[i, 2] == y[i, 2])


@kernel
def softness(particles: NDArray[np.int32], weights: Array, inv_mass: Array) -> float:
    """Inverse of the mass [1/kg] that a push on the point meets; 0 if all its particles are
    pinned."""
    total = 0.0
    for corner in range(3):
        total += weights[corner] * weights[corner] * inv_mass[particles[corner]]
    return total


@kernel
def blend(rows: Array, particles: NDArray[np.int32], weights: Array) -> Vector:
    """Weighted sum of three rows of an array [N, 3]."""
    total = (0.0, 0.0, 0.0)
    for corner in range(3):
        i = particles[corner]
        total = along(total, weights[corner], (rows[i, 0], rows[i, 1], rows[i, 2]))
    return total


@kernel
def share(
    rows: Array,
    particles: NDArray[np.int32],
    weights: Array,
    inv_mass: Array,
    give: float,
    change: Vector,
) -> None:
    """Change the particles so that their weighted sum changes by `change`, momentum kept."""
    for corner in range(3):
        i = particles[corner]
        part = weights[corner] * inv_mass[i] / give
        for axis in range(3):
            rows[i, axis] += part * change[axis]
