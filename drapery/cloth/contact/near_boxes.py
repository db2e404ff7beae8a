"""What of a cloth is so near a box that it may touch it in a step."""

import numpy as np

from drapery.cloth.colliders.vectors import Vector, add, dot, row, subtract
from drapery.cloth.contact.box_data import BoxContact, Candidates
from drapery.cloth.contact.box_frame import DISTANCE, end_of, enter_frame
from drapery.cloth.contact.geometry import bounds_of, grown, has_end, higher, lower, overlap
from drapery.jit import kernel
from drapery.mesh import Array


@kernel
def find_boxes(x0: Array, x: Array, contact: BoxContact, frame: Array, near: Candidates) -> bool:
    """List what is near the boxes; returns whether there is anything."""
    low, high = bounds_of(x0, x)
    found = False
    for k in range(len(contact.halves)):
        find_near(x0, x, low, high, contact, k, frame, near)
        found = found or near.counts[k, 0] > 0
    return found


@kernel
def extent_of(contact: BoxContact, poses: Array, k: int) -> tuple[Vector, Vector]:
    """The lowest and the highest coordinates of what a box keeps free in one of its poses."""
    pose, half = poses[k], row(contact.halves, k)
    x = abs(pose[3]) * half[0] + abs(pose[4]) * half[1] + abs(pose[5]) * half[2]
    y = abs(pose[6]) * half[0] + abs(pose[7]) * half[1] + abs(pose[8]) * half[2]
    z = abs(pose[9]) * half[0] + abs(pose[10]) * half[1] + abs(pose[11]) * half[2]
    centre, extent = row(poses, k), grown((x, y, z), contact.radius)
    return subtract(centre, extent), add(centre, extent)


@kernel
def find_near(
    x0: Array,
    x: Array,
    low: Vector,
    high: Vector,
    contact: BoxContact,
    k: int,
    frame: Array,
    near: Candidates,
) -> None:
    """List what is so near a box that it may touch it in this step. low, high: of the cloth."""
    near.counts[k, 0] = near.counts[k, 1] = near.counts[k, 2] = 0
    first, last = extent_of(contact, contact.starts, k)
    first1, last1 = extent_of(contact, contact.ends, k)
    first, last = lower(first, first1), higher(last, last1)
    margin = 2.0 * contact.radius + contact.reach
    if not overlap(low, high, first, last):
        return
    first, last = grown(first, -margin), grown(last, margin)
    found = 0
    for i in range(len(x)):
        frame[i, DISTANCE] = np.inf
        a, b = row(x0, i), row(x, i)
        if overlap(lower(a, b), higher(a, b), first, last):
            frame[i, DISTANCE] = 0.0
            near.particles[k, found] = i
            found += 1
    near.counts[k, 0] = found
    if found == 0:
        return
    enter_frame(x0, x, contact, k, frame, near)
    found = 0
    for e in range(len(contact.edges)):
        i, j = contact.edges[e, 0], contact.edges[e, 1]
        if frame[i, DISTANCE] + frame[j, DISTANCE] < 2.0 * margin and may_touch(
            contact, frame, i, j
        ):
            near.edges[k, found] = e
            found += 1
    near.counts[k, 1] = found
    found = 0
    for t in range(len(contact.triangles)):
        if near_corner(contact, k, frame, t):
            near.faces[k, found] = t
            found += 1
    near.counts[k, 2] = found


@kernel
def may_touch(contact: BoxContact, frame: Array, i: int, j: int) -> bool:
    """Whether an edge may come within the radius, contacts of the radius included."""
    along = subtract(end_of(frame, j), end_of(frame, i))
    total = frame[i, DISTANCE] + frame[j, DISTANCE] - 3.0 * contact.radius
    near: bool = total < 0.0 or total * total < dot(along, along)
    return near


@kernel
def near_corner(contact: BoxContact, k: int, frame: Array, t: int) -> bool:
    """Whether a corner of the box may come near the inside of a face."""
    i, j, m = contact.triangles[t, 0], contact.triangles[t, 1], contact.triangles[t, 2]
    nearest = min(frame[i, DISTANCE], frame[j, DISTANCE], frame[m, DISTANCE])
    if max(frame[i, DISTANCE], frame[j, DISTANCE], frame[m, DISTANCE]) == np.inf:
        return False
    if nearest > 3.0 * contact.radius + contact.reach:
        return False
    a, b, c = end_of(frame, i), end_of(frame, j), end_of(frame, m)
    low, high = lower(a, lower(b, c)), higher(a, higher(b, c))
    margin = 2.0 * contact.radius
    low, high = grown(low, -margin), grown(high, margin)
    half = row(contact.halves, k)
    return (
        has_end(low[0], high[0], half[0])
        and has_end(low[1], high[1], half[1])
        and has_end(low[2], high[2], half[2])
    )
