"""The boxes that a cloth meets, as the kernels of contact read them; planes are large boxes."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from drapery.cloth.colliders.collider import Collider
from drapery.cloth.colliders.pose import Path, Pose, TablePath, at_rest
from drapery.cloth.colliders.shapes import Box, Plane, Shape
from drapery.cloth.contact.self_contact_data import NOT_ITSELF, SelfContact
from drapery.cloth.lanes import time_blocks
from drapery.mesh import Array

REACH = 1.5
"""No edge of a cloth is longer than this many times its longest edge at rest."""
FAR = 1e3
"""Half the size of the box that stands for a plane [m]."""
COLUMNS, TRACK = 12, 6
"""Numbers of a particle in the frame of a box and in its track; see `box_frame`."""
MET, HELD = 1, 2
"""What contact did to a cloth in a step: moved parts of it at most, or kept parts where they were,
since they would have crossed a box or other parts."""
TOUCH = 1e-7
"""Distances [m] below which a contact is exact."""


class BoxContact(NamedTuple):
    """The boxes that a cloth meets, and what their kernels need of the cloth.

    starts, ends: place [m] and rotation of each box at the start and the end of a step, [K, 12].
    halves: half its edge lengths [m], [K, 3]. friction: [K].
    radius: distance that the cloth keeps [m].
    reach: no edge of the cloth is longer [m]. edges: [E, 2]. triangles: [T, 3]. inv_mass: [1/kg],
    [N]. bands: see `bands_of`, [B + 1, 3].
    """

    starts: Array
    ends: Array
    halves: Array
    friction: Array
    radius: float
    reach: float
    edges: NDArray[np.int32]
    triangles: NDArray[np.int32]
    inv_mass: Array
    bands: NDArray[np.int32]


NO_CONTACT = BoxContact(
    np.zeros((0, 12)),
    np.zeros((0, 12)),
    np.zeros((0, 3)),
    np.zeros(0),
    0.0,
    0.0,
    np.zeros((0, 2), np.int32),
    np.zeros((0, 3), np.int32),
    np.zeros(0),
    np.zeros((1, 3), np.int32),
)
"""The contact of cloths that meet nothing."""


@dataclass(frozen=True, eq=False)
class BoxColliders:
    """Colliders that are boxes or planes, and what contact with them needs of a cloth.

    contact: with the boxes in their own frames. paths: of each box. itself: what contact of the
    cloth with itself needs, if that is resolved along with it.
    """

    contact: BoxContact
    paths: tuple[Path, ...]
    itself: SelfContact = NOT_ITSELF

    def poses(self, times: Sequence[float]) -> Array:
        """Place [m] and rotation of each box at some times [s], [T, K, 12]; one entry for all times
        where no box moves."""
        if all(path is at_rest for path in self.paths):
            return self.contact.ends[None]
        parts = time_blocks(np.array(times, float))
        return np.concatenate([self._poses_at(part) for part in parts])

    def step(self, start: float, end: float) -> BoxContact:
        """The contact in a step from one time to another [s]."""
        poses = self.poses((start, end))
        return self.contact._replace(starts=poses[0], ends=poses[-1])

    def _poses_at(self, times: Array) -> Array:
        poses = np.repeat(self.contact.ends[None], len(times), axis=0)
        for number, (path, rest) in enumerate(zip(self.paths, self.contact.ends, strict=True)):
            if path is not at_rest:
                moved = _path_at(path, times)
                turn, own = moved[:, 3:].reshape(-1, 3, 3), rest[3:].reshape(3, 3)
                # Sums in a fixed order; BLAS may not add in one.
                poses[:, number, :3] = (turn * rest[:3]).sum(axis=2) + moved[:, :3]
                poses[:, number, 3:] = (turn[..., None] * own).sum(axis=2).reshape(-1, 9)
        return poses


def _path_at(path: Path, times: Array) -> Array:
    """Place [m] and rotation matrix of a path at T times [s], shape [T, 12]."""
    if isinstance(path, TablePath):
        return path.at(times)
    poses = (path(float(time)) for time in times)
    return np.array([np.append(pose.position, pose.rotation) for pose in poses], float)


NOTHING = BoxColliders(NO_CONTACT, ())
"""No colliders at all."""


def box_colliders(
    inv_mass: Array,
    triangles: NDArray[np.int32],
    rest: Array,
    colliders: Sequence[Collider],
    radius: float,
) -> BoxColliders:
    """Colliders whose shapes are a Box or a Plane and which do not bounce.

    inv_mass: [1/kg], [N]. triangles: [T, 3]. rest: places at rest [m], [N, 3]. radius: distance
    that the cloth keeps [m].
    """
    pairs = np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]])
    # `np.unique` without an index would import numpy.ma.
    edges = np.unique(np.sort(pairs, axis=1), axis=0, return_index=True)[0].astype(np.int32)
    lengths = np.sqrt(np.square(rest[edges[:, 0]] - rest[edges[:, 1]]).sum(axis=1))
    rests, halves = zip(*(_box_of(collider.shape) for collider in colliders), strict=True)
    poses = np.stack([np.append(pose.position, pose.rotation) for pose in rests])
    faces = np.ascontiguousarray(triangles, np.int32)
    contact = BoxContact(
        poses,
        poses,
        np.stack(halves),
        np.array([collider.friction for collider in colliders], float),
        radius,
        REACH * float(lengths.max(initial=0.0)),
        edges,
        faces,
        np.ascontiguousarray(inv_mass, float),
        bands_of(len(inv_mass), edges, faces),
    )
    return BoxColliders(contact, tuple(collider.path for collider in colliders))


def _box_of(shape: Shape) -> tuple[Pose, Array]:
    """The place and rotation of a box, and half its edge lengths [m]; a plane is a large box."""
    if isinstance(shape, Box):
        return Pose(np.asarray(shape.centre, float), np.asarray(shape.rotation, float)), (
            np.asarray(shape.size, float) / 2
        )
    assert isinstance(shape, Plane)
    normal = np.asarray(shape.normal, float)
    normal = normal / np.sqrt(np.square(normal).sum())
    side = np.eye(3)[np.argmin(np.abs(normal))]
    first = side - (side * normal).sum() * normal
    first /= np.sqrt(np.square(first).sum())
    rotation = np.stack([first, normal, np.cross(first, normal)], axis=1)
    centre = np.asarray(shape.point, float) - FAR * normal
    return Pose(centre, rotation), np.full(3, FAR)


def bands_of(
    particles: int, edges: NDArray[np.int32], triangles: NDArray[np.int32]
) -> NDArray[np.int32]:
    """Bands of consecutive particles, such as the rows of a grid, of which no edge joins others
    than neighbours: the first particle, edge and face of each band and the ends, [B + 1, 3].

    An edge or a face belongs to the band of its first particle.
    edges: [E, 2], sorted by their first particle. triangles: [T, 3].
    """
    span = int((edges[:, 1] - edges[:, 0]).max()) if len(edges) else particles + 1
    first = triangles.min(axis=1) if len(triangles) else np.zeros(0, np.int32)
    for size in (min(max(1, span - 1), particles), span, particles):
        band = edges // size
        if (band[:, 1] - band[:, 0] <= 1).all() and (np.diff(first // size) >= 0).all():
            break
    begin = np.arange(0, particles, size)
    numbers = np.arange(len(begin))
    starts = np.stack(
        [
            begin,
            np.searchsorted(edges[:, 0] // size, numbers),
            np.searchsorted(first // size, numbers),
        ],
        axis=1,
    )
    ends = np.array([[particles, len(edges), len(triangles)]])
    return np.concatenate([starts, ends]).astype(np.int32)


class Candidates(NamedTuple):
    """What of a cloth is near each box during a step: numbers of particles [K, N], edges [K, E] and
    faces [K, T], and how many there are, [K, 3].

    bounds: of each band, lowest and highest coordinates [m], [B, 6]. close: whether a band and the
    next are near a box, [B]. codes, marks: of each particle and one box, see `near_boxes`, [N].
    listed: whether a particle is near any box, [N]. frames, tracks: see `box_frame`, of shape
    [K, N, COLUMNS] and [N, TRACK]. longest: how far contact last moved a particle [m], [1], which
    only the time of the next step depends on.
    """

    particles: NDArray[np.int32]
    edges: NDArray[np.int32]
    faces: NDArray[np.int32]
    counts: NDArray[np.int64]
    bounds: Array
    close: NDArray[np.uint8]
    codes: NDArray[np.uint8]
    marks: NDArray[np.uint8]
    listed: NDArray[np.uint8]
    frames: Array
    tracks: Array
    longest: Array


def candidate_arrays(contact: BoxContact) -> Candidates:
    """Arrays for the cloth and the boxes of a contact."""
    boxes, particles, bands = len(contact.halves), len(contact.inv_mass), len(contact.bands) - 1
    return Candidates(
        np.empty((boxes, particles), np.int32),
        np.empty((boxes, len(contact.edges)), np.int32),
        np.empty((boxes, len(contact.triangles)), np.int32),
        np.zeros((boxes, 3), np.int64),
        np.empty((bands, 6)),
        np.zeros(bands, np.uint8),
        np.zeros(particles, np.uint8),
        np.zeros(particles, np.uint8),
        np.zeros(particles, np.uint8),
        np.zeros((boxes, particles, COLUMNS)),
        np.zeros((particles, TRACK)),
        np.full(1, contact.radius),
    )
