"""The end of contact with boxes: no part of the cloth stays in one.

A particle that still makes an edge or a face of the cloth cross a box returns to its place at the
start of the step. The start is free of penetration, so this ends without one, whatever the contacts
could not solve.
"""

from drapery.cloth.colliders.vectors import Vector, norm, row, subtract
from drapery.cloth.contact.box_data import BoxContact, Candidates
from drapery.cloth.contact.box_depths import (
    corner_of,
    edge_depth,
    edge_radius,
    face_depth,
    face_of,
    face_radius,
    near_face,
    passes,
)
from drapery.cloth.contact.box_frame import (
    DISTANCE,
    END,
    MOVED,
    end_of,
    enter_frame,
    leave_frame,
    measure,
    start_of,
)
from drapery.cloth.contact.geometry import put
from drapery.jit import borrowing_kernel
from drapery.mesh import Array

GUARDS = 16
"""The most rounds in which particles return to their places at the start of the step: over what is
in one box, and over all boxes."""
SKIN = 2e-5
"""Parts that end nearer to a box than this [m] return too, since rounding to single precision could
let them touch it; at most half the distance that the cloth keeps."""
SAME = 1e-12
"""A particle that is nearer to its start than this [m] is there: frames of boxes round."""


@borrowing_kernel
def guard_boxes(x0: Array, x: Array, contact: BoxContact, near: Candidates) -> float:
    """Return particles to their start until no part of the cloth is in a box; returns the longest
    path of a particle [m].

    An edge of which one end returned because of one box may cross another, so all are looked at
    until none returns a particle.
    """
    longest, boxes = 0.0, len(contact.halves)
    for _ in range(GUARDS):
        returned = False
        for k in range(boxes):
            if near.counts[k, 0] > 0:
                enter_frame(x0, x, contact, k, near, -1, 0)
                for _ in range(GUARDS):
                    if not return_some(contact, k, near.frames[k], near):
                        break
                    returned = True
                longest = max(longest, leave_frame(x, contact, k, near, 0))
        if boxes == 1 or not returned:
            break
    return longest


@borrowing_kernel
def return_some(contact: BoxContact, k: int, frame: Array, near: Candidates) -> bool:
    """Return the particles of edges and faces that are inside the box; whether any was moved."""
    half, skin, found = row(contact.halves, k), min(SKIN, 0.5 * contact.radius), False
    for n in range(near.counts[k, 0]):
        i = near.particles[k, n]
        if frame[i, DISTANCE] < skin:
            found = to_start(half, contact.inv_mass, frame, i) or found
    for n in range(near.counts[k, 1]):
        i, j = contact.edges[near.edges[k, n], 0], contact.edges[near.edges[k, n], 1]
        kept = edge_radius(contact.inv_mass, skin, frame, i, j)
        _part, depth, _normal = edge_depth(half, kept, frame, i, j)
        if depth > 0.0 or edge_enters(half, kept, frame, i, j):
            found = to_start(half, contact.inv_mass, frame, i) or found
            found = to_start(half, contact.inv_mass, frame, j) or found
    for n in range(near.counts[k, 2]):
        face = face_of(contact.triangles, near.faces[k, n])
        kept = face_radius(half, contact.inv_mass, skin, frame, face)
        for number in range(8):
            corner = corner_of(half, number)
            if not near_face(frame, face, kept, corner):
                continue
            _weights, depth, _normal = face_depth(half, kept, frame, face, corner)
            if depth > 0.0:
                for i in face:
                    found = to_start(half, contact.inv_mass, frame, i) or found
    return found


@borrowing_kernel
def begins_inside(x0: Array, x: Array, contact: BoxContact, near: Candidates) -> bool:
    """Whether a part of the cloth is in a box at the start of the step."""
    for k in range(len(contact.halves)):
        if near.counts[k, 0] > 0:
            enter_frame(x0, x, contact, k, near, -1, 0)
            half, frame = row(contact.halves, k), near.frames[k]
            for n in range(near.counts[k, 0]):
                i = near.particles[k, n]
                put(frame, i, END, start_of(frame, i))
                measure(half, frame, i)
            if is_inside(contact, k, frame, near):
                return True
    return False


@borrowing_kernel
def is_inside(contact: BoxContact, k: int, frame: Array, near: Candidates) -> bool:
    """Whether a free particle, or a part of an edge that no pin holds there, is in the box."""
    half, w = row(contact.halves, k), contact.inv_mass
    for n in range(near.counts[k, 0]):
        i = near.particles[k, n]
        if w[i] > 0.0 and frame[i, DISTANCE] < 0.0:
            return True
    for n in range(near.counts[k, 1]):
        i, j = contact.edges[near.edges[k, n], 0], contact.edges[near.edges[k, n], 1]
        _part, depth, _normal = edge_depth(half, edge_radius(w, 0.0, frame, i, j), frame, i, j)
        if depth > 0.0:
            return True
    return False


@borrowing_kernel
def edge_enters(half: Vector, kept: float, frame: Array, i: int, j: int) -> bool:
    """Whether an edge that began outside the box ends within it, with sides `kept` farther out [m].

    That is exact, while the search for the nearest point of an edge ends within 0.1 mm of it. A
    distance below 0 is never kept.
    """
    whole = (half[0] + kept, half[1] + kept, half[2] + kept)
    start, end = start_of(frame, i), end_of(frame, i)
    return (
        kept >= 0.0
        and passes(whole, end, subtract(end_of(frame, j), end))
        and not passes(half, start, subtract(start_of(frame, j), start))
    )


@borrowing_kernel
def to_start(half: Vector, w: Array, frame: Array, i: int) -> bool:
    """Return a free particle to its start; whether that moved it."""
    start = start_of(frame, i)
    way = norm(subtract(end_of(frame, i), start))
    if w[i] == 0.0 or way < SAME:
        return False
    put(frame, i, END, start)
    measure(half, frame, i)
    frame[i, MOVED] += way
    return True
