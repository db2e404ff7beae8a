"""Contact at the end of each step inside the kernels of all solvers.

A solver moves the cloth without regard to boxes. Then, still in the same compiled loop, registers
of cloths, or of particles of one cloth, are compared with the bounds of the boxes. A cloth that may
touch one, or that meets itself, is copied to an array [N, 3], its contacts are resolved, its strain
is limited (see `drapery.cloth.strain`), and the next step starts from there. The kernels call
`resolve` by its address, so it is compiled once for all of them.
"""

from typing import Any, NamedTuple

import numpy as np

from drapery.cloth import simd
from drapery.cloth.colliders.vectors import Vector, dot, norm, row, scale, subtract
from drapery.cloth.contact.box_contact import meet_close_boxes
from drapery.cloth.contact.box_data import (
    HELD,
    MET,
    NO_CONTACT,
    TOUCH,
    BoxContact,
    Candidates,
    candidate_arrays,
)
from drapery.cloth.contact.box_frame import CARRIED, reset_tracks, set_pose
from drapery.cloth.contact.geometry import grown, put
from drapery.cloth.contact.near_boxes import swept_extent
from drapery.cloth.contact.self_contact import meet_one
from drapery.cloth.contact.self_contact_data import NOT_ITSELF, SelfContact
from drapery.cloth.contact.touching_pairs import TouchingPairs, room_for_pairs
from drapery.cloth.contact.velocities import moved_velocity
from drapery.cloth.kernels import load_lanes
from drapery.cloth.sheet_kernels import lane_of
from drapery.cloth.simd import fill, lane_count, load, maximum, minimum, store
from drapery.cloth.strain import (
    NEVER,
    StrainLimit,
    call_limit,
    excess_of_lanes,
    go_back,
    is_long,
    longest_square,
    note_longest,
    plane_is_long,
    shorten_long,
)
from drapery.jit import call_by_address, entry_point, kernel
from drapery.mesh import Array

ROUNDING = 2.0**-22
"""More than the relative error of a number in single precision."""
STRETCH = 1.25
"""A step in which contact makes an edge longer than its solver left it by this factor, or keeps
parts of the cloth where they were, is made again with more contacts: the solver would tear at what
contact holds, more from step to step."""
MOST_CONTACTS = 32
"""How often contacts are then resolved at most, in every substep or in some of them. (Those of
`xpbd` are in every substep.)"""
STRAIN_ROUNDS = 6
"""How often contact is resolved again after springs that are too long were shortened."""
LOOSE_ROUNDS = 24
"""How often it is resolved anew, without the friction of boxes, where springs are still too long:
friction holds particles where their springs would have to slide them along a box."""
FREE = 1.0
"""Cloth that boxes move at the start of a step by more than this part of the distance that it keeps
does not go back there."""
TORN, LONG = 3, 4
"""What `resolve` returns beside `MET` and `HELD`: the step must be made again; a spring is still
too long."""


class ContactWork(NamedTuple):
    """start, end: places of one cloth at the start and the end of a step [m], [N, 3]. solved: where
    its solver left it at the end, [N, 3]. starts, ends: poses of the boxes, [K, 12]. extents: the
    lowest and the highest coordinates of what each box keeps free [m], [K, 6]. near: see
    `Candidates`. pairs: room for those that touch, see `TouchingPairs`."""

    start: Array
    end: Array
    solved: Array
    starts: Array
    ends: Array
    extents: Array
    near: Candidates
    pairs: TouchingPairs


def contact_work(
    contact: BoxContact, particles: int = 0, itself: SelfContact = NOT_ITSELF
) -> ContactWork:
    """Arrays for the contact of one cloth at a time."""
    return ContactWork(
        np.empty((particles, 3)),
        np.empty((particles, 3)),
        np.empty((particles, 3)),
        np.empty((len(contact.halves), 12)),
        np.empty((len(contact.halves), 12)),
        np.empty((len(contact.halves), 6)),
        candidate_arrays(contact),
        room_for_pairs(itself),
    )


@kernel
def contact_of(boxes: Any, work: Any) -> BoxContact:
    """The contact with boxes at the poses in `work`."""
    return with_boxes(boxes, work.starts, work.ends, boxes.friction)


@kernel
def with_boxes(contact: Any, starts: Any, ends: Any, friction: Any) -> BoxContact:
    """The same contact with the first boxes, as many as there are poses, [K, 12], and another
    friction of each, [K]."""
    return BoxContact(
        starts,
        ends,
        contact.halves[: len(friction)],
        friction,
        contact.radius,
        contact.reach,
        contact.edges,
        contact.triangles,
        contact.inv_mass,
        contact.bands,
    )


@entry_point
def resolve(work: Any, boxes: Any, itself: Any, limit: Any, careful: int) -> int:
    """Resolve the contacts of a cloth with boxes and with itself between work.start and work.end,
    then limit its strain. Returns 0 if it had neither, else `MET`, `HELD` or `LONG`; or, unless
    careful is 1, `TORN` where the step has to be made again."""
    reset_tracks(work.near)
    contact = contact_of(boxes, work)
    met = meet_one(work.start, work.end, itself, contact, work.near, work.pairs)
    if careful == 0 and is_torn(work, boxes, itself, met):
        return TORN
    if not is_long(work.end, limit):
        return met
    if is_held(work, itself, contact, limit, STRAIN_ROUNDS):
        return MET
    if len(boxes.halves) > 0:
        best, least = work.end.copy(), longest_square(work.end, limit)
        put_all(work.end, work.solved)
        if is_held(work, itself, without_friction(contact), limit, LOOSE_ROUNDS):
            return MET
        if longest_square(work.end, limit) > least:
            put_all(work.end, best)
    if boxes_move(work) or not begins_free(work, contact):
        # Between boxes that move towards each other is no free place: cloth enters them. It leaves
        # a box that it is in only as far as its springs allow.
        free = without_boxes(contact)
        if is_held(work, itself, free, limit, STRAIN_ROUNDS):
            return MET
        put_all(work.end, work.solved)
        if is_held(work, itself, free, limit, STRAIN_ROUNDS):
            return MET
        if go_back(work.start, work.end, limit):
            meet_one(work.start, work.end, itself, free, work.near, work.pairs)
    elif go_back(work.start, work.end, limit):
        meet_one(work.start, work.end, itself, contact, work.near, work.pairs)
    return LONG if is_long(work.end, limit) else MET


@kernel
def is_held(work: Any, itself: Any, contact: Any, limit: Any, rounds: int) -> bool:
    """Shorten springs that are too long and resolve contact again, in turns; returns whether no
    spring is too long in the end."""
    for _ in range(rounds):
        shorten_long(work.end, limit)
        meet_one(work.start, work.end, itself, contact, work.near, work.pairs)
        if not is_long(work.end, limit):
            return True
    return False


@kernel
def put_all(out: Any, x: Any) -> None:
    """Copy the places of one cloth, [N, 3]."""
    for i in range(len(x)):
        put(out, i, 0, row(x, i))


@kernel
def without_friction(contact: Any) -> BoxContact:
    """The same boxes, along which cloth slides freely."""
    return with_boxes(contact, contact.starts, contact.ends, np.zeros(len(contact.friction)))


@kernel
def without_boxes(contact: Any) -> BoxContact:
    """No boxes, for the same cloth."""
    return with_boxes(contact, contact.starts[:0], contact.ends[:0], contact.friction[:0])


@kernel
def begins_free(work: Any, contact: Any) -> bool:
    """Whether boxes leave the cloth nearly where it is at the start of a step, see FREE."""
    if len(contact.halves) == 0:
        return True
    x, far = work.start.copy(), 0.0
    meet_close_boxes(work.start, x, contact, work.near)
    for i in range(len(x)):
        far = max(far, norm(subtract(row(x, i), row(work.start, i))))
    return bool(far <= FREE * contact.radius)


@kernel
def boxes_move(work: Any) -> bool:
    """Whether a box has another pose at the end of a step than at its start."""
    for k in range(work.starts.shape[0]):
        for n in range(12):
            if work.starts[k, n] != work.ends[k, n]:
                return True
    return False


def resolve_block(
    start: Array,
    x: Array,
    block: tuple[int, int],
    boxes: BoxContact,
    itself: SelfContact,
    limit: StrainLimit = NEVER,
) -> tuple[Array, bool]:
    """Resolve the contacts of cloths first..last = block with boxes and with themselves, then limit
    their strain: what `resolve` does for one.

    start, x: places at the start and the end of a step [m], [B, N, 3]; x is changed.
    Returns how far the boxes that moved a particle moved there [m], [last - first, N], and whether
    a spring is still too long.
    """
    work, long = contact_work(boxes, x.shape[1], itself), False
    work.starts[:], work.ends[:] = boxes.starts, boxes.ends
    carried = np.zeros((block[1] - block[0], x.shape[1]))
    for cloth in range(*block):
        work.start[:], work.end[:], work.solved[:] = start[cloth], x[cloth], x[cloth]
        long = resolve(work, boxes, itself, limit, 1) == LONG or long
        x[cloth] = work.end
        if len(boxes.halves):
            carried[cloth - block[0]] = work.near.tracks[:, CARRIED]
    return carried, long


EXAMPLE = (contact_work(NO_CONTACT), NO_CONTACT, NOT_ITSELF, NEVER, 0)
_resolve_at = call_by_address(int, EXAMPLE)


@kernel
def meets_itself(batch: Any) -> bool:
    """Whether contact of each cloth with itself is resolved."""
    return len(batch.itself.triangles) > 0


@kernel
def meets_any(batch: Any) -> bool:
    """Whether each cloth meets boxes or itself."""
    return len(batch.contact.halves) > 0 or meets_itself(batch)


@kernel
def begin_lanes(y: Any, u: Any, batch: Any) -> Any:
    """What contact keeps of a block of lanes y, u [3N, L], [3N, L]: the places and velocities at
    the start of a step, 3N rows each; the places and velocities at its end in lanes whose step is
    not made again, 3N rows each; 1 in lanes whose step may be or is, 0 in others. Empty without
    contact. The rows do not depend on the substeps: whoever asks for a step again can have it."""
    rows = 4 * y.shape[0] + 1 if meets_any(batch) else 0
    before = simd.empty_lanes(rows, y.shape[1], y)
    if rows > 0:
        for lane in range(y.shape[1]):
            before[rows - 1, lane] = 1
        keep_lanes(before, y, u)
    return before


@kernel
def keep_lanes(before: Any, y: Any, u: Any) -> None:
    """Keep the places and velocities at the start of a step."""
    rows = y.shape[0]
    load_lanes(before[:rows], y, 0)
    load_lanes(before[rows : 2 * rows], u, 0)


@entry_point
def meet_lanes(
    y: Any, u: Any, before: Any, batch: Any, start: Any, when: Any, dt: Any, careful: Any
) -> Any:
    """Resolve the contacts of a block y, u [3N, L] that moved for dt [s]; returns 1 if the whole
    step has to be made again, with more contacts, else 0. Then y and u are at its start again.

    before: see `begin_lanes`. when: see `place_boxes`. careful: the step is not made again, since
    that is being done, in lanes with a 1, or since it has no substeps.
    """
    rows, lanes, again = y.shape[0], lane_count(y), False
    gaps, long = simd.empty_lanes(1, lanes, y), simd.empty_lanes(1, lanes, y)
    if before.shape[0] == 0:
        for first in range(0, min(y.shape[1], batch.cloths - start), lanes):
            excess_of_lanes(long, y, batch.limit.pairs, batch.squares, first)
            for cloth in range(first, min(first + lanes, batch.cloths - start)):
                if long[0, cloth - first] > 0:
                    limit_lane(y, u, batch, start, cloth, when[0], dt)
        return 0
    place_boxes(batch, when)
    for first in range(0, min(y.shape[1], batch.cloths - start), lanes):
        if not meets_itself(batch):
            extents, bands = batch.work.extents, batch.contact.bands
            store(gaps, 0, 0, gap_of_lanes(before, y, extents, bands, first))
            excess_of_lanes(long, y, batch.limit.pairs, batch.squares, first)
        for cloth in range(first, min(first + lanes, batch.cloths - start)):
            at = cloth - first
            near = meets_itself(batch) or gaps[0, at] < 0 or long[0, at] > 0
            if careful:
                if near and before[4 * rows, cloth] > 0:
                    meet_lane(y, u, before, batch, start, cloth, when[0], dt, 1)
            else:
                held = near and meet_lane(y, u, before, batch, start, cloth, when[0], dt, 0)
                before[4 * rows, cloth] = held
                again = again or held
    if again:
        for row in range(rows):
            for lane in range(y.shape[1]):
                before[2 * rows + row, lane] = y[row, lane]
                before[3 * rows + row, lane] = u[row, lane]
                y[row, lane] = before[row, lane]
                u[row, lane] = before[rows + row, lane]
        return 1
    if careful and when[2] == 1.0:
        for row in range(rows):
            for lane in range(y.shape[1]):
                if before[4 * rows, lane] == 0:
                    y[row, lane] = before[2 * rows + row, lane]
                    u[row, lane] = before[3 * rows + row, lane]
    keep_lanes(before, y, u)
    return 0


_meet_lanes_at = call_by_address(int)


def meeting_example(y: Array, batch: Any) -> tuple[Any, ...]:
    """Arguments of `meet_lanes` of the types of those that `meet_substep` gives it."""
    return y, y, y, batch, 0, (0, 0.0, 1.0), 0.0, True


@kernel
def meet_substep(
    y: Any,
    u: Any,
    before: Any,
    batch: Any,
    start: Any,
    turn: Any,
    substeps: Any,
    h: Any,
    again: Any,
) -> Any:
    """Resolve the contacts of a block after substep number `turn` of h [s], counted over all steps,
    if any are due: at the end of a step, and in between where it is made again. Returns the number
    of the next substep, and whether its step is being made again."""
    passed, when, careful = contact_due(turn, substeps, again)
    if passed > 0:
        given = y, u, before, batch, start, when, np.float64(h * passed), careful
        if _meet_lanes_at(batch.meet_lanes, given) == 1:
            return turn // substeps * substeps, True
    return turn + 1, again and (turn + 1) % substeps > 0


@kernel
def contact_due(turn: Any, substeps: Any, again: Any) -> Any:
    """How many substeps have passed since contacts were resolved before, 0 if none are due now;
    the `when` of `place_boxes`; and whether the step cannot be made again."""
    step, done = turn // substeps, turn % substeps + 1
    each = -(-substeps // MOST_CONTACTS) if again else substeps
    since = (done - 1) // each * each
    due = done % each == 0 or done == substeps
    # A step of one substep cannot have more contacts.
    careful = again or substeps == 1
    return (done - since) * due, (step, since / substeps, done / substeps), careful


@kernel
def meet_lane(
    y: Any,
    u: Any,
    before: Any,
    batch: Any,
    start: Any,
    cloth: Any,
    step: Any,
    dt: Any,
    careful: Any,
) -> Any:
    """Resolve the contacts of one lane; returns whether its step has to be made again."""
    work = batch.work
    for i in range(work.end.shape[0]):
        for axis in range(3):
            work.start[i, axis] = before[3 * i + axis, cloth]
            work.end[i, axis] = work.solved[i, axis] = y[3 * i + axis, cloth]
    given = work, batch.contact, batch.itself, batch.limit, careful
    met = _resolve_at(batch.resolve, given)
    if met == TORN:
        return True
    note_strain(batch, start + cloth, step, met)
    take_lane(y, u, batch, cloth, dt, met)
    return False


@kernel
def limit_lane(y: Any, u: Any, batch: Any, start: Any, cloth: Any, step: Any, dt: Any) -> None:
    """Limit the strain of one lane that meets nothing."""
    work = batch.work
    for i in range(work.end.shape[0]):
        for axis in range(3):
            work.end[i, axis] = work.solved[i, axis] = y[3 * i + axis, cloth]
            work.start[i, axis] = work.solved[i, axis] - dt * u[3 * i + axis, cloth]
    met = call_limit(batch.limit_strain, (work.start, work.end, batch.limit))
    note_strain(batch, start + cloth, step, LONG)
    take_lane(y, u, batch, cloth, dt, met)


@kernel
def take_lane(y: Any, u: Any, batch: Any, cloth: Any, dt: Any, met: Any) -> None:
    """Take the places in batch.work into one lane, and velocities that fit them."""
    work = batch.work
    for i in range(work.end.shape[0] if met else 0):
        if row(work.end, i) != row(work.solved, i):
            solved = u[3 * i, cloth], u[3 * i + 1, cloth], u[3 * i + 2, cloth]
            speed = velocity_after(work, i, solved, dt)
            for axis in range(3):
                y[3 * i + axis, cloth] = work.end[i, axis]
                u[3 * i + axis, cloth] = speed[axis]


@kernel
def note_strain(batch: Any, cloth: Any, step: Any, met: Any) -> None:
    """Note how far a spring of a cloth is over its limit, if it was not held in a step. met: of
    `resolve`."""
    if met == LONG:
        note_longest(batch.strains[:, cloth], batch.work.end, batch.limit, step)


@kernel
def begin_plane(y: Any, u: Any, batch: Any, sheet: Any) -> Any:
    """What contact keeps of one cloth as a plane of lanes: its places and velocities before the
    first step, [6, lanes]."""
    before = simd.empty_lanes(6, sheet.plane if meets_any(batch) else 0, y)
    keep_plane(before, y, u)
    return before


@kernel
def keep_plane(before: Any, y: Any, u: Any) -> None:
    """Keep the places and velocities at the start of a step."""
    load_lanes(before[:3], y, 0)
    load_lanes(before[3:], u, 0)


@kernel
def meet_plane(
    y: Any,
    u: Any,
    before: Any,
    batch: Any,
    cloth: Any,
    when: Any,
    dt: Any,
    sheet: Any,
    careful: Any,
) -> Any:
    """The same as `meet_lanes` for a plane y, u [3, lanes] of a cloth."""
    work, meets = batch.work, before.shape[1] > 0
    if meets:
        place_boxes(batch, when)
    near = meets and (meets_itself(batch) or near_plane(before, y, work.extents, sheet))
    if near or plane_is_long(y, batch.squares, sheet):
        for i in range(work.end.shape[0]):
            lane = lane_of(i, sheet)
            for axis in range(3):
                work.end[i, axis] = work.solved[i, axis] = y[axis, lane]
                way = y[axis, lane] - dt * u[axis, lane]
                work.start[i, axis] = before[axis, lane] if meets else way
        if meets:
            asked = work, batch.contact, batch.itself, batch.limit, np.int64(careful)
            met = _resolve_at(batch.resolve, asked)
            if met == TORN:
                for axis in range(3):
                    for lane in range(before.shape[1]):
                        y[axis, lane] = before[axis, lane]
                        u[axis, lane] = before[3 + axis, lane]
                return True
        else:
            given = work.start, work.end, batch.limit
            met = LONG * call_limit(batch.limit_strain, given)
        note_strain(batch, cloth, when[0], met)
        for i in range(work.end.shape[0] if met else 0):
            lane = lane_of(i, sheet)
            if row(work.end, i) != row(work.solved, i):
                speed = velocity_after(work, i, (u[0, lane], u[1, lane], u[2, lane]), dt)
                for axis in range(3):
                    y[axis, lane] = work.end[i, axis]
                    u[axis, lane] = speed[axis]
    if meets:
        keep_plane(before, y, u)
    return False


@kernel
def meet_plane_substep(
    y: Any,
    u: Any,
    before: Any,
    batch: Any,
    cloth: Any,
    turn: Any,
    substeps: Any,
    h: Any,
    sheet: Any,
    again: Any,
) -> Any:
    """The same as `meet_substep` for a plane y, u [3, lanes] of a cloth."""
    passed, when, careful = contact_due(turn, substeps, again)
    if passed > 0 and meet_plane(y, u, before, batch, cloth, when, h * passed, sheet, careful):
        return turn // substeps * substeps, True
    return turn + 1, again and (turn + 1) % substeps > 0


@kernel
def is_torn(work: Any, boxes: Any, itself: Any, met: Any) -> bool:
    """Whether contact held parts of the cloth or stretched it, see STRETCH. met: of `meet_one`."""
    if met == MET:
        edges = itself.edges if len(itself.triangles) > 0 else boxes.edges
        for n in range(len(edges)):
            i, j = edges[n, 0], edges[n, 1]
            solved = subtract(row(work.solved, i), row(work.solved, j))
            offset = subtract(row(work.end, i), row(work.end, j))
            if dot(offset, offset) > STRETCH * STRETCH * dot(solved, solved):
                return True
    return bool(met == HELD)


@kernel
def place_boxes(batch: Any, when: Any) -> None:
    """Set the poses of the boxes, and the bounds of what they keep free, less what is not yet a
    contact. when: the number of a step, and the parts of it at which the cloth moves on from a
    contact and at which it meets the next, from 0 to 1."""
    step, begin, end = when
    work, last = batch.work, len(batch.poses) - 1
    first, second = batch.poses[min(step, last)], batch.poses[min(step + 1, last)]
    for k in range(len(batch.contact.halves)):
        set_pose(work.starts, first, second, k, begin)
        set_pose(work.ends, first, second, k, end)
    contact = contact_of(batch.contact, work)
    for k in range(len(contact.halves)):
        low, high = swept_extent(contact, k)
        put(work.extents, k, 0, grown(low, 0.5 * TOUCH))
        put(work.extents, k, 3, grown(high, -0.5 * TOUCH))


@kernel
def gap_of_lanes(x0: Any, x: Any, extents: Any, bands: Any, lane: Any) -> Any:
    """The least gap [m] between any box and two neighbouring bands, in each lane of a register;
    below 0 where the bounds of the two overlap."""
    low, high = bounds_of_lanes(x0, x, bands[0, 0], bands[1, 0], lane)
    least = gap_to_boxes(low, high, extents, x)
    for band in range(1, len(bands) - 1):
        low1, high1 = bounds_of_lanes(x0, x, bands[band, 0], bands[band + 1, 0], lane)
        first = minimum(low[0], low1[0]), minimum(low[1], low1[1]), minimum(low[2], low1[2])
        last = maximum(high[0], high1[0]), maximum(high[1], high1[1]), maximum(high[2], high1[2])
        least = minimum(least, gap_to_boxes(first, last, extents, x))
        low, high = low1, high1
    return least


@kernel
def bounds_of_lanes(x0: Any, x: Any, first: Any, last: Any, lane: Any) -> Any:
    """The bounds of particles first..last of cloths at the start and the end of a step."""
    x_low = y_low = z_low = fill(x.dtype.type(np.inf))
    x_high = y_high = z_high = fill(x.dtype.type(-np.inf))
    for row_of in range(3 * first, 3 * last, 3):
        a, b = load(x0, row_of, lane), load(x, row_of, lane)
        x_low, x_high = minimum(x_low, minimum(a, b)), maximum(x_high, maximum(a, b))
        a, b = load(x0, row_of + 1, lane), load(x, row_of + 1, lane)
        y_low, y_high = minimum(y_low, minimum(a, b)), maximum(y_high, maximum(a, b))
        a, b = load(x0, row_of + 2, lane), load(x, row_of + 2, lane)
        z_low, z_high = minimum(z_low, minimum(a, b)), maximum(z_high, maximum(a, b))
    return (x_low, y_low, z_low), (x_high, y_high, z_high)


@kernel
def gap_to_boxes(low: Any, high: Any, extents: Any, like: Any) -> Any:
    """The least gap [m] between bounds and any of the boxes; the sign is exact."""
    least = fill(like.dtype.type(np.inf))
    for k in range(len(extents)):
        gap = fill(like.dtype.type(-np.inf))
        for axis in range(3):
            gap = maximum(gap, not_above(like, extents[k, axis]) - high[axis])
            gap = maximum(gap, low[axis] + not_above(like, -extents[k, 3 + axis]))
        least = minimum(least, gap)
    return least


@kernel
def not_above(like: Any, value: Any) -> Any:
    """A number of an array's type that is not above a value, and less by a few roundings."""
    return like.dtype.type(value - abs(value) * ROUNDING)


@kernel
def near_plane(x0: Any, x: Any, extents: Any, sheet: Any) -> bool:
    """Whether the bounds of a cloth as a plane of lanes overlap those of a box."""
    lanes = lane_count(x)
    x_low = y_low = z_low = fill(x.dtype.type(np.inf))
    x_high = y_high = z_high = fill(x.dtype.type(-np.inf))
    for r in range(sheet.rows):
        for c in range(0, sheet.columns, lanes):
            # The last register of a row begins in the one before: what follows is not cloth.
            n = r * sheet.width + min(c, sheet.columns - lanes)
            a, b = load(x0, 0, n), load(x, 0, n)
            x_low, x_high = minimum(x_low, minimum(a, b)), maximum(x_high, maximum(a, b))
            a, b = load(x0, 1, n), load(x, 1, n)
            y_low, y_high = minimum(y_low, minimum(a, b)), maximum(y_high, maximum(a, b))
            a, b = load(x0, 2, n), load(x, 2, n)
            z_low, z_high = minimum(z_low, minimum(a, b)), maximum(z_high, maximum(a, b))
    ends = simd.empty_lanes(6, lanes, x)
    store(ends, 0, 0, x_low)
    store(ends, 1, 0, y_low)
    store(ends, 2, 0, z_low)
    store(ends, 3, 0, x_high)
    store(ends, 4, 0, y_high)
    store(ends, 5, 0, z_high)
    for axis in range(3):
        for lane in range(lanes):
            ends[axis, 0] = min(ends[axis, 0], ends[axis, lane])
            ends[3 + axis, 0] = max(ends[3 + axis, 0], ends[3 + axis, lane])
    for k in range(len(extents)):
        apart = False
        for axis in range(3):
            apart = apart or ends[axis, 0] > extents[k, 3 + axis]
            apart = apart or ends[3 + axis, 0] < extents[k, axis]
        if not apart:
            return True
    return False


@kernel
def velocity_after(work: Any, i: Any, solved: Any, dt: Any) -> Vector:
    """The velocity of a particle that contact moved in dt [s]: at most as fast as its solver left
    it, with the velocity `solved`, or as the boxes that moved it."""
    seen = scale(1.0 / np.float64(dt), subtract(row(work.end, i), row(work.start, i)))
    own = norm((np.float64(solved[0]), np.float64(solved[1]), np.float64(solved[2])))
    carried = work.near.tracks[i, CARRIED] if i < len(work.near.tracks) else 0.0
    return moved_velocity(seen, max(own, carried / dt))
