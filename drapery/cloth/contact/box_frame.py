"""The particles of a cloth in the frame of a box, in which the box is upright and at rest."""

from drapery.cloth.colliders.primitives import cuboid_distance
from drapery.cloth.colliders.vectors import Vector, add_scaled, rotated, rotated_back, row, subtract
from drapery.cloth.contact.box_data import BoxContact, Candidates
from drapery.cloth.contact.geometry import put
from drapery.jit import kernel
from drapery.mesh import Array

START, END, DISTANCE, OUTWARD, MOVED, COLUMNS = 0, 3, 6, 7, 10, 11
"""The columns of a cloth in the frame of a box, [N, COLUMNS]: the place at the start and the end of
a step [m], the distance at the end [m] and its direction (infinite and unknown for particles that
are not near), and whether the particle was moved. One array is passed on much faster than five."""


@kernel
def enter_frame(
    x0: Array, x: Array, contact: BoxContact, k: int, frame: Array, near: Candidates
) -> None:
    """Set the places of near particles relative to a box, and their distances."""
    turn, centre = contact.poses[k, 3:].reshape(3, 3), row(contact.poses, k)
    half = row(contact.halves, k)
    for n in range(near.counts[k, 0]):
        i = near.particles[k, n]
        put(frame, i, START, rotated_back(turn, subtract(row(x0, i), centre)))
        put(frame, i, END, rotated_back(turn, subtract(row(x, i), centre)))
        measure(half, frame, i)
        frame[i, MOVED] = 0.0


@kernel
def leave_frame(x: Array, contact: BoxContact, k: int, frame: Array, near: Candidates) -> None:
    """Write the new places of the particles that were moved."""
    turn, centre = contact.poses[k, 3:].reshape(3, 3), row(contact.poses, k)
    for n in range(near.counts[k, 0]):
        i = near.particles[k, n]
        if frame[i, MOVED] > 0.0:
            put(x, i, 0, add_scaled(centre, 1.0, rotated(turn, end_of(frame, i))))


@kernel
def start_of(frame: Array, i: int) -> Vector:
    return frame[i, 0], frame[i, 1], frame[i, 2]


@kernel
def end_of(frame: Array, i: int) -> Vector:
    return frame[i, 3], frame[i, 4], frame[i, 5]


@kernel
def outward_of(frame: Array, i: int) -> Vector:
    return frame[i, 7], frame[i, 8], frame[i, 9]


@kernel
def measure(half: Vector, frame: Array, i: int) -> None:
    """Set the distance and the direction of particle i at its end."""
    frame[i, DISTANCE], outward = cuboid_distance(half, end_of(frame, i))
    put(frame, i, OUTWARD, outward)


@kernel
def blend(frame: Array, first: int, face: tuple[int, int, int], weights: Vector) -> Vector:
    """The weighted sum of the places of three particles, at the start or the end of the step."""
    i, j, k = face
    return (
        weights[0] * frame[i, first] + weights[1] * frame[j, first] + weights[2] * frame[k, first],
        weights[0] * frame[i, first + 1]
        + weights[1] * frame[j, first + 1]
        + weights[2] * frame[k, first + 1],
        weights[0] * frame[i, first + 2]
        + weights[1] * frame[j, first + 2]
        + weights[2] * frame[k, first + 2],
    )
