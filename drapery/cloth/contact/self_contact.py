"""Contact of a cloth with itself, or of several cloths that are sewn into one without seams.

Pairs of parts that come near each other in a step (`touching_pairs`) and are nearer than the
thickness are pushed apart, shared by inverse mass, with friction (Bridson, Fedkiw, Anderson 2002).
At the end the step is made safe (`safe_steps`). So a cloth that does not cross itself at the start
of a step never does.
"""

import numpy as np
from numpy.typing import NDArray

from drapery.cloth.colliders.vectors import add_scaled, dot, norm, row, scale, subtract
from drapery.cloth.contact.box_contact import meet_boxes, meet_close_boxes
from drapery.cloth.contact.box_data import HELD, MET, BoxContact, Candidates
from drapery.cloth.contact.box_guard import begins_inside, guard_boxes
from drapery.cloth.contact.geometry import put
from drapery.cloth.contact.near_boxes import find_boxes, whole_margin
from drapery.cloth.contact.pair_distance import gap_along, nearest
from drapery.cloth.contact.safe_steps import shorten_unsafe
from drapery.cloth.contact.self_contact_data import SelfContact
from drapery.cloth.contact.smoothness import Windows, is_all_smooth, stay_smooth, windows_of
from drapery.cloth.contact.touching_pairs import REACH, TouchingPairs, find_pairs, moved
from drapery.jit import borrowing_kernel, kernel
from drapery.mesh import Array

PASSES = 4
"""The most passes over all pairs in a step."""
NEAR = 1.25
"""Passes look at the pairs that are nearer than this many times the thickness before the first."""
ROUNDS = 3
"""How often contacts with itself and with boxes take turns in a step."""
TOLERANCE = 0.02
"""A pass whose deepest contact is shallower than this part of the thickness is the last one."""
GUARDS = 24
"""The most rounds in which displacements are shortened; then the cloth rests for one step."""
STOPPED = 0.5
"""Where particles were stopped, pairs that may come within this many times the thickness are made
safe."""
AT_REST = 0.75
"""Parts of one cloth may be as near as this many times their distance at rest."""
FRICTION = 0.3
"""Coulomb's coefficient between cloths: wool on wool has 0.3 to 0.5."""


@kernel
def meet_one(
    x0: Array,
    x: Array,
    contact: SelfContact,
    boxes: BoxContact,
    near: Candidates,
    room: TouchingPairs,
) -> int:
    """Resolve the contacts of one cloth with itself and with boxes; returns 0, `MET` or `HELD`, see
    `box_data`.

    x0, x: places at the start and the end of a step [m], [N, 3]; x is changed.
    """
    met = meet_close_boxes(x0, x, boxes, near) if len(boxes.halves) > 0 else 0
    if len(contact.triangles) == 0:
        return met
    return max(meet_itself(x0, x, contact, boxes, near, room), met)


@kernel
def meet_itself(
    x0: Array,
    x: Array,
    contact: SelfContact,
    boxes: BoxContact,
    near: Candidates,
    room: TouchingPairs,
) -> int:
    """Resolve the contacts of one cloth with itself, after those with boxes; returns the same as
    `meet_one`. If there is none, nothing is changed."""
    windows = windows_of(x, contact)
    if is_all_smooth(windows, contact.levels):
        return 0
    pairs = find_pairs(x0, x, contact, windows, REACH * contact.thickness, False, room)
    if len(pairs.ends) == 0:
        return 0
    wanted, meets_boxes, met = x.copy(), len(boxes.halves) > 0, MET
    active, pushed = np.empty(len(pairs.ends), np.int32), False
    for _ in range(ROUNDS):
        count = list_near(x, pairs, NEAR * contact.thickness, active)
        for _ in range(PASSES):
            deepest = push_pairs(x0, x, pairs, active[:count], contact)
            pushed = pushed or deepest > 0.0
            if deepest < TOLERANCE * contact.thickness:
                break
        again = meet_boxes(x0, x, boxes, near) if pushed and meets_boxes else 0
        met = max(met, again)
        if not again:
            break
    for i in range(len(x)):
        change = subtract(row(x, i), row(wanted, i))
        length, limit = norm(change), 0.5 * (REACH - 1.0) * contact.thickness
        if length > limit:
            put(x, i, 0, add_scaled(row(wanted, i), limit / length, change))
    if make_safe(x0, x, wanted, pairs, contact, boxes, near, pushed):
        met = HELD
    elif not pushed:
        return met
    stopped = farthest(x, wanted) >= 0.5 * REACH * contact.thickness
    if stopped or not stay_smooth(windows, windows_of(x, contact), contact.levels):
        # Parts that were stopped may be in the way of others, or out of place beside others, of
        # which no pair is known.
        every = Windows(windows.tangents, windows.known[:0])
        pairs = find_pairs(x0, x, contact, every, STOPPED * contact.thickness, True, room)
        if make_safe(x0, x, wanted, pairs, contact, boxes, near, True):
            met = HELD
    return met


@borrowing_kernel
def farthest(x: Array, y: Array) -> float:
    """The longest distance [m] between the places of a particle in two arrays, [N, 3]."""
    longest = 0.0
    for i in range(len(x)):
        longest = max(longest, norm(subtract(row(x, i), row(y, i))))
    return longest


@borrowing_kernel
def list_near(x: Array, pairs: TouchingPairs, limit: float, active: NDArray[np.int32]) -> int:
    """List the numbers of the pairs that may be nearer than a limit [m], or have crossed; returns
    how many there are."""
    count, ends = 0, pairs.ends
    for n in range(len(ends)):
        i, j, k, m, edges = ends[n, 0], ends[n, 1], ends[n, 2], ends[n, 3], ends[n, 4]
        active[count] = n
        count += gap_along(row(pairs.offsets, n), x, i, j, k, m, edges) < limit
    return count


@borrowing_kernel
def push_pairs(
    x0: Array, x: Array, pairs: TouchingPairs, active: NDArray[np.int32], contact: SelfContact
) -> float:
    """Push apart the active pairs that are too near, one after another; returns the deepest [m]."""
    w, deepest, ends = contact.inv_mass, 0.0, pairs.ends
    for n in active:
        i, j, k, m, edges = ends[n, 0], ends[n, 1], ends[n, 2], ends[n, 3], ends[n, 4]
        normal, limit = row(pairs.offsets, n), contact.thickness
        if gap_along(normal, x, i, j, k, m, edges) >= limit:
            continue
        weights, offset = nearest(x, i, j, k, m, edges)
        length = norm(offset)
        # A pair that has crossed in this step goes back to the side of its start.
        crossed = dot(offset, normal) < 0.0
        if length >= limit and not crossed:
            continue
        if contact.piece[i] == contact.piece[k]:
            _weights, at_rest = nearest(contact.rest, i, j, k, m, edges)
            limit = min(limit, AT_REST * norm(at_rest))
        depth = limit - length
        if crossed:
            depth = limit + length
        elif length > 0.0:
            normal = scale(1.0 / length, offset)
        total = weights[0] * weights[0] * w[i] + weights[1] * weights[1] * w[j]
        total += weights[2] * weights[2] * w[k] + weights[3] * weights[3] * w[m]
        if depth <= 1e-7 or total == 0.0:
            continue
        slide = scale(weights[0], moved(x0, x, i))
        slide = add_scaled(slide, weights[1], moved(x0, x, j))
        slide = add_scaled(slide, weights[2], moved(x0, x, k))
        slide = add_scaled(slide, weights[3], moved(x0, x, m))
        slide = add_scaled(slide, -dot(slide, normal), normal)
        held, along = FRICTION * depth, norm(slide)
        back = 1.0 if along <= held else held / along
        change = add_scaled(scale(depth, normal), -back, slide)
        put(x, i, 0, add_scaled(row(x, i), weights[0] * w[i] / total, change))
        put(x, j, 0, add_scaled(row(x, j), weights[1] * w[j] / total, change))
        put(x, k, 0, add_scaled(row(x, k), weights[2] * w[k] / total, change))
        put(x, m, 0, add_scaled(row(x, m), weights[3] * w[m] / total, change))
        deepest = max(deepest, depth)
    return deepest


@kernel
def make_safe(
    x0: Array,
    x: Array,
    wanted: Array,
    pairs: TouchingPairs,
    contact: SelfContact,
    boxes: BoxContact,
    near: Candidates,
    pushed: bool,
) -> bool:
    """Shorten displacements until no pair can have crossed and no part of the cloth is in a box;
    returns whether any was shortened.

    pushed: whether the cloth was moved since it met the boxes. wanted: where these left it; cloth
    that began the step in a box goes there, since it would not come out if it were held.
    """
    w, changed = contact.inv_mass, np.full(len(x), -1, np.int32)
    any_found = any_returned = False
    for turn in range(GUARDS):
        stop = turn >= GUARDS // 2
        found = shorten_unsafe(x0, x, pairs, w, contact.thickness, changed, turn, stop)
        if len(boxes.halves) > 0 and (pushed or found or any_found):
            if not any_found:  # what was near before the cloth was moved may not be all
                find_boxes(x0, x, boxes, whole_margin(boxes), near)
            before = x.copy()
            guard_boxes(x0, x, boxes, near)
            returned = False
            for i in range(len(x)):
                if row(x, i) != row(before, i):
                    returned, changed[i] = True, turn
            if returned and not any_returned and begins_inside(x0, x, boxes, near):
                for i in range(len(x)):  # a slice would compile numba's messages about shapes
                    put(x, i, 0, row(wanted, i))
                return True
            found, any_returned = found or returned, any_returned or returned
        if not found:
            return any_found
        any_found = True
    for i in range(len(x)):
        if w[i] > 0.0:
            put(x, i, 0, row(x0, i))
    return True
