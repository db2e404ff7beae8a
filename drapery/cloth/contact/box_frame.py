"""The particles of a cloth in the frame of a box, in which the box is upright and at rest.

The start of a step is taken to the frame of the box at its start, the end to that at its end. So
the motion of the box counts as motion of the cloth. (If a box rotates, the true path of a particle
in its frame is curved; the error is of second order in the angle of the rotation in a step.)
"""

import numpy as np

from drapery.cloth.colliders.primitives import cuboid_distance
from drapery.cloth.colliders.vectors import (
    Vector,
    add_scaled,
    cross,
    dot,
    norm,
    rotated,
    rotated_back,
    row,
    scale,
    subtract,
)
from drapery.cloth.contact.box_data import BoxContact, Candidates
from drapery.cloth.contact.geometry import put, read
from drapery.jit import borrowing_kernel
from drapery.mesh import Array

START, END, DISTANCE, OUTWARD, MOVED, CHANGED = 0, 3, 6, 7, 10, 11
"""The columns of a cloth in the frame of a box, [N, COLUMNS]: the place at the start and the end of
a step [m], the distance at the end [m] and its direction, how far contacts with the box moved the
particle since it entered the frame [m], and the turn in which these last changed."""
CARRIED, SOLVED, TRAVEL, TURN = 0, 1, 4, 5
"""The columns of a particle's track, [N, TRACK]: how far the boxes that moved it moved there [m],
where its solver left it, in the world [m], the length of its path since then [m], and the turn in
which a box last moved it. A turn is one pass over the contacts with one box."""
SMALL = 1e-6
"""Shorter rows of a blended rotation have no direction."""
NOW = np.inf
"""CHANGED of a particle that is being moved."""


@borrowing_kernel
def reset_tracks(near: Candidates) -> None:
    """Prepare for a step: no particle was moved."""
    for i in range(len(near.tracks)):
        near.tracks[i, CARRIED] = 0.0


@borrowing_kernel
def set_pose(out: Array, first: Array, second: Array, k: int, part: float) -> None:
    """Set the pose of box k at a part of a step, from 0 to 1, between two poses, all [K, 12].

    The rows of the rotation are blended and made orthonormal again. Where that is impossible, since
    a box makes half a turn in the step, it makes it at the end.
    """
    for n in range(12):
        out[k, n] = second[k, n] if part == 1.0 else first[k, n]
    if part == 0.0 or part == 1.0:
        return
    put(out, k, 0, blended(first, second, k, 0, part))
    x, y = blended(first, second, k, 3, part), blended(first, second, k, 6, part)
    along = norm(x)
    x = scale(1.0 / max(along, SMALL), x)
    y = add_scaled(y, -dot(x, y), x)
    across = norm(y)
    y = scale(1.0 / max(across, SMALL), y)
    if min(along, across) > SMALL:
        put(out, k, 3, x)
        put(out, k, 6, y)
        put(out, k, 9, cross(x, y))


@borrowing_kernel
def blended(first: Array, second: Array, k: int, at: int, part: float) -> Vector:
    """Three numbers of a row at a part of the way between two arrays."""
    a = read(first, k, at)
    return add_scaled(a, part, subtract(read(second, k, at), a))


@borrowing_kernel
def enter_frame(
    x0: Array, x: Array, contact: BoxContact, k: int, near: Candidates, since: int, turn: int
) -> None:
    """Set the places relative to a box, and the distances, of near particles that were moved in
    turn `since` or later."""
    turn0, centre0 = contact.starts[k, 3:].reshape(3, 3), row(contact.starts, k)
    turn1, centre1 = contact.ends[k, 3:].reshape(3, 3), row(contact.ends, k)
    half, frame = row(contact.halves, k), near.frames[k]
    for n in range(near.counts[k, 0]):
        i = near.particles[k, n]
        if near.tracks[i, TURN] >= since:
            put(frame, i, START, rotated_back(turn0, subtract(row(x0, i), centre0)))
            put(frame, i, END, rotated_back(turn1, subtract(row(x, i), centre1)))
            measure(half, frame, i)
            frame[i, MOVED] = 0.0
            frame[i, CHANGED] = turn


@borrowing_kernel
def leave_frame(x: Array, contact: BoxContact, k: int, near: Candidates, turn: int) -> float:
    """Write the new places of the particles that were moved; returns the longest path [m]."""
    longest = 0.0
    turn0, centre0 = contact.starts[k, 3:].reshape(3, 3), row(contact.starts, k)
    turn1, centre1 = contact.ends[k, 3:].reshape(3, 3), row(contact.ends, k)
    frame, tracks = near.frames[k], near.tracks
    for n in range(near.counts[k, 0]):
        i = near.particles[k, n]
        if frame[i, MOVED] > 0.0:
            place = add_scaled(centre1, 1.0, rotated(turn1, end_of(frame, i)))
            before = add_scaled(centre0, 1.0, rotated(turn0, end_of(frame, i)))
            tracks[i, CARRIED] = max(tracks[i, CARRIED], norm(subtract(place, before)))
            tracks[i, TRAVEL] += frame[i, MOVED]
            tracks[i, TURN] = turn
            longest = max(longest, tracks[i, TRAVEL])
            frame[i, MOVED] = 0.0
            put(x, i, 0, place)
    return longest


@borrowing_kernel
def start_of(frame: Array, i: int) -> Vector:
    return frame[i, 0], frame[i, 1], frame[i, 2]


@borrowing_kernel
def end_of(frame: Array, i: int) -> Vector:
    return frame[i, 3], frame[i, 4], frame[i, 5]


@borrowing_kernel
def outward_of(frame: Array, i: int) -> Vector:
    return frame[i, 7], frame[i, 8], frame[i, 9]


@borrowing_kernel
def measure(half: Vector, frame: Array, i: int) -> None:
    """Set the distance and the direction of particle i at its end."""
    frame[i, DISTANCE], outward = cuboid_distance(half, end_of(frame, i))
    put(frame, i, OUTWARD, outward)


@borrowing_kernel
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
