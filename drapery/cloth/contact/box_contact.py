"""Contact of one cloth with boxes, as kernels.

A contact pushes the nearest point of the cloth out to the radius, shared by inverse mass (Bridson,
Fedkiw, Anderson 2002, section 7), and friction shortens its motion along the box by at most the
coefficient times the push (Macklin et al., "Unified particle physics", 2014). Passes over all
contacts repeat; what they leave in a box, `box_guard` takes out.
"""

from drapery.cloth.colliders.vectors import Vector, add_scaled, dot, norm, row, scale, subtract
from drapery.cloth.contact.box_data import HELD, MET, TOUCH, BoxContact, Candidates
from drapery.cloth.contact.box_depths import (
    corner_of,
    depth_at_pin,
    edge_depth,
    edge_radius,
    face_depth,
    face_of,
    face_radius,
    near_face,
    particle_depth,
)
from drapery.cloth.contact.box_frame import (
    CHANGED,
    END,
    MOVED,
    NOW,
    SOLVED,
    START,
    blend,
    end_of,
    enter_frame,
    leave_frame,
    measure,
    reset_tracks,
)
from drapery.cloth.contact.box_guard import guard_boxes
from drapery.cloth.contact.geometry import put, read
from drapery.cloth.contact.near_boxes import find_boxes, whole_margin
from drapery.jit import borrowing_kernel
from drapery.mesh import Array

PASSES = 6
"""The most passes over all contacts in a step."""
TOLERANCE = 0.02
"""A pass whose deepest contact is shallower than this part of the radius is the last one."""
CLOSE, FARTHER = 0.5, 1.5
"""At first only what is within this many times the radius, beyond the radius, is looked at, or
within this multiple of how far contact moved a particle in the step before."""
GUARDED = 0.25
"""Particles may return to their start only if the last pass found a contact that is deeper than
this part of the radius."""
AMPLIFIED = 4.0
"""A contact moves no particle by more than this many times its depth."""


@borrowing_kernel
def meet_boxes(x0: Array, x: Array, contact: BoxContact, near: Candidates) -> int:
    """Resolve the contacts of one cloth in one step; returns whether there was any: 0, `MET`, or
    `HELD` where particles returned to their start.

    x0, x: places at the start and the end of the step [m], [N, 3]; x is changed.
    near: arrays to work in.
    """
    find_boxes(x0, x, contact, whole_margin(contact), near)
    met, _longest = solve_boxes(x0, x, contact, near)
    return met


@borrowing_kernel
def meet_close_boxes(x0: Array, x: Array, contact: BoxContact, near: Candidates) -> int:
    """`meet_boxes`, which first looks only at what is close to a box.

    If contact moves a particle farther than that, it starts again and looks farther. So the result
    is the same.
    """
    whole = whole_margin(contact)
    margin = max(CLOSE * contact.radius, FARTHER * near.longest[0])
    while margin < whole:
        reset_tracks(near)
        if not find_boxes(x0, x, contact, margin, near):
            return 0
        met, near.longest[0] = solve_boxes(x0, x, contact, near)
        if near.longest[0] < margin:
            return met
        for i in range(len(x)):
            if near.listed[i]:
                put(x, i, 0, read(near.tracks, i, SOLVED))
        margin = max(2.0 * margin, FARTHER * near.longest[0])
    near.longest[0] = contact.radius
    reset_tracks(near)
    return meet_boxes(x0, x, contact, near)


@borrowing_kernel
def solve_boxes(x0: Array, x: Array, contact: BoxContact, near: Candidates) -> tuple[int, float]:
    """Resolve the contacts with what was found near; whether there was any, see `meet_boxes`, and
    the longest path of a particle [m].

    After the first pass, what did not change since it was last tested is not tested again.
    """
    met, deepest, longest, boxes = 0, 0.0, 0.0, len(contact.halves)
    for number in range(PASSES):
        deepest = 0.0
        for k in range(boxes):
            if near.counts[k, 0] > 0:
                turn = 1 + number * boxes + k
                enter_frame(x0, x, contact, k, near, max(1, turn - boxes), turn)
                deepest = max(deepest, solve_box(contact, k, near, turn if number > 0 else 0))
                longest = max(longest, leave_frame(x, contact, k, near, turn))
        met = MET if deepest > 0.0 else met
        if deepest <= TOLERANCE * contact.radius:
            break
    if deepest > GUARDED * contact.radius:
        returned = guard_boxes(x0, x, contact, near)
        longest, met = max(longest, returned), HELD if returned > 0.0 else met
    return met, longest


@borrowing_kernel
def solve_box(contact: BoxContact, k: int, near: Candidates, since: int) -> float:
    """One pass over the contacts with one box of what changed in turn `since` or later; returns the
    depth of the deepest [m]."""
    half, deepest, frame = row(contact.halves, k), 0.0, near.frames[k]
    w, friction, radius = contact.inv_mass, contact.friction[k], contact.radius
    particles, edges, faces = near.particles[k], near.edges[k], near.faces[k]
    ends, triangles = contact.edges, contact.triangles
    for n in range(near.counts[k, 0]):
        i = particles[n]
        if frame[i, CHANGED] >= since:
            depth, normal = particle_depth(half, radius, frame, i)
            if depth > TOUCH and push(
                half, w, friction, frame, (i, i, i), (1.0, 0.0, 0.0), depth, normal
            ):
                deepest = max(deepest, depth)
    for n in range(near.counts[k, 1]):
        i, j = ends[edges[n], 0], ends[edges[n], 1]
        if max(frame[i, CHANGED], frame[j, CHANGED]) >= since:
            kept = edge_radius(w, radius, frame, i, j)
            part, depth, normal = edge_depth(half, kept, frame, i, j)
            weights = (1.0 - part, part, 0.0)
            if depth > TOUCH and w[i] * w[j] == 0.0:
                depth = depth_at_pin(half, kept, frame, (i, j, j), weights, depth)
            if depth > TOUCH and push(half, w, friction, frame, (i, j, j), weights, depth, normal):
                deepest = max(deepest, depth)
    for n in range(near.counts[k, 2]):
        i, j, m = face_of(triangles, faces[n])
        if max(frame[i, CHANGED], frame[j, CHANGED], frame[m, CHANGED]) >= since:
            deepest = max(deepest, solve_face(half, w, friction, radius, frame, (i, j, m)))
    return deepest


@borrowing_kernel
def solve_face(
    half: Vector,
    w: Array,
    friction: float,
    radius: float,
    frame: Array,
    face: tuple[int, int, int],
) -> float:
    """Push a face off the corners of a box; returns the depth of the deepest contact [m]."""
    deepest, kept = 0.0, face_radius(half, w, radius, frame, face)
    for number in range(8):
        corner = corner_of(half, number)
        if near_face(frame, face, kept, corner):
            weights, depth, normal = face_depth(half, kept, frame, face, corner)
            if depth > TOUCH and w[face[0]] * w[face[1]] * w[face[2]] == 0.0:
                depth = depth_at_pin(half, kept, frame, face, weights, depth)
            if depth > TOUCH and push(half, w, friction, frame, face, weights, depth, normal):
                deepest = max(deepest, depth)
    return deepest


@borrowing_kernel
def push(
    half: Vector,
    w: Array,
    friction: float,
    frame: Array,
    ends: tuple[int, int, int],
    weights: Vector,
    depth: float,
    normal: Vector,
) -> bool:
    """Move a point of the cloth by the depth [m] along the normal, with friction; returns whether
    it can be moved."""
    shares = (weights[0] * w[ends[0]], weights[1] * w[ends[1]], weights[2] * w[ends[2]])
    total = dot(shares, weights)
    if total == 0.0:
        return False
    motion = subtract(blend(frame, END, ends, weights), blend(frame, START, ends, weights))
    slide = add_scaled(motion, -dot(motion, normal), normal)
    length, held = norm(slide), friction * depth
    back = 1.0 if length <= held else held / length
    change = add_scaled(scale(depth, normal), -back, slide)
    size = norm(change)
    shift(half, frame, ends[0], shares[0] / total, change, size)
    shift(half, frame, ends[1], shares[1] / total, change, size)
    shift(half, frame, ends[2], shares[2] / total, change, size)
    return True


@borrowing_kernel
def shift(half: Vector, frame: Array, i: int, part: float, change: Vector, size: float) -> None:
    """Move particle i by a part of a change of a size [m]."""
    if part > 0.0:
        part = min(part, AMPLIFIED)
        put(frame, i, END, add_scaled(end_of(frame, i), part, change))
        measure(half, frame, i)
        frame[i, MOVED] += part * size
        frame[i, CHANGED] = NOW
