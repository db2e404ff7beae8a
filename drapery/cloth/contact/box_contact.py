"""Contact of one cloth with boxes, as kernels.

A contact pushes the nearest point of the cloth out to the radius, shared by inverse mass (Bridson,
Fedkiw, Anderson 2002, section 7), and friction shortens its motion along the box by at most the
coefficient times the push (Macklin et al., "Unified particle physics", 2014). Passes over all
contacts repeat; what they leave in a box, `box_guard` takes out.
"""

from drapery.cloth.colliders.vectors import Vector, add_scaled, dot, norm, row, scale, subtract
from drapery.cloth.contact.box_data import BoxContact, Candidates
from drapery.cloth.contact.box_depths import (
    edge_depth,
    edge_radius,
    face_depth,
    face_of,
    face_radius,
    particle_depth,
)
from drapery.cloth.contact.box_frame import (
    END,
    MOVED,
    START,
    blend,
    end_of,
    enter_frame,
    leave_frame,
    measure,
)
from drapery.cloth.contact.box_guard import guard_boxes
from drapery.cloth.contact.geometry import put
from drapery.cloth.contact.near_boxes import find_boxes
from drapery.jit import kernel
from drapery.mesh import Array

PASSES = 6
"""The most passes over all contacts in a step."""
TOLERANCE = 0.02
"""A pass whose deepest contact is shallower than this part of the radius is the last one."""
TOUCH = 1e-7
"""Distances [m] below which a contact is exact."""
GUARDED = 0.25
"""Particles may return to their start only if the last pass found a contact that is deeper than
this part of the radius."""
AMPLIFIED = 4.0
"""A contact moves no particle by more than this many times its depth."""


@kernel
def meet_boxes(x0: Array, x: Array, contact: BoxContact, frame: Array, near: Candidates) -> bool:
    """Resolve the contacts of one cloth in one step; returns whether there was any.

    x0, x: places at the start and the end of the step [m], [N, 3]; x is changed.
    frame, near: arrays to work in.
    """
    find_boxes(x0, x, contact, frame, near)
    return solve_boxes(x0, x, contact, frame, near)


@kernel
def solve_boxes(x0: Array, x: Array, contact: BoxContact, frame: Array, near: Candidates) -> bool:
    """`meet_boxes` for what was found near."""
    met, deepest = False, 0.0
    for _ in range(PASSES):
        deepest = 0.0
        for k in range(len(contact.halves)):
            if near.counts[k, 0] > 0:
                enter_frame(x0, x, contact, k, frame, near)
                deepest = max(deepest, solve_box(contact, k, frame, near))
                leave_frame(x, contact, k, frame, near)
        met = met or deepest > 0.0
        if deepest <= TOLERANCE * contact.radius:
            break
    if deepest > GUARDED * contact.radius:
        guard_boxes(x0, x, contact, frame, near)
    return met


@kernel
def solve_box(contact: BoxContact, k: int, frame: Array, near: Candidates) -> float:
    """One pass over the contacts with one box; returns the depth of the deepest [m]."""
    half, deepest = row(contact.halves, k), 0.0
    w, friction, radius = contact.inv_mass, contact.friction[k], contact.radius
    particles, edges, faces = near.particles[k], near.edges[k], near.faces[k]
    for n in range(near.counts[k, 0]):
        i = particles[n]
        depth, normal = particle_depth(half, radius, frame, i)
        if depth > TOUCH and push(
            half, w, friction, frame, (i, i, i), (1.0, 0.0, 0.0), depth, normal
        ):
            deepest = max(deepest, depth)
    for n in range(near.counts[k, 1]):
        i, j = contact.edges[edges[n], 0], contact.edges[edges[n], 1]
        kept = edge_radius(w, radius, frame, i, j)
        part, depth, normal = edge_depth(half, kept, frame, i, j)
        weights = (1.0 - part, part, 0.0)
        if depth > TOUCH and push(half, w, friction, frame, (i, j, j), weights, depth, normal):
            deepest = max(deepest, depth)
    for n in range(near.counts[k, 2]):
        face = face_of(contact, faces[n])
        kept = face_radius(half, w, radius, frame, face)
        for corner in range(8):
            weights, depth, normal = face_depth(half, kept, frame, face, corner)
            if depth > TOUCH and push(half, w, friction, frame, face, weights, depth, normal):
                deepest = max(deepest, depth)
    return deepest


@kernel
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
    shift(half, frame, ends[0], shares[0] / total, change)
    shift(half, frame, ends[1], shares[1] / total, change)
    shift(half, frame, ends[2], shares[2] / total, change)
    return True


@kernel
def shift(half: Vector, frame: Array, i: int, part: float, change: Vector) -> None:
    """Move particle i by a part of a change."""
    if part > 0.0:
        place = add_scaled(end_of(frame, i), min(part, AMPLIFIED), change)
        put(frame, i, END, place)
        measure(half, frame, i)
        frame[i, MOVED] = 1.0
