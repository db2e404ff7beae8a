"""Contact at the end of each step inside the kernels of all solvers.

A solver moves the cloth without regard to boxes. Then, still in the same compiled loop, registers
of cloths, or of particles of one cloth, are compared with the bounds of the boxes. A cloth that may
touch one, or that meets itself, is copied to an array [N, 3], its contacts are resolved, and the
next step starts from there. The kernels call `resolve` by its address, so it is compiled once for
all of them.
"""

from functools import cache
from typing import Any, NamedTuple

import numpy as np

from drapery.cloth import simd
from drapery.cloth.colliders.vectors import Vector, norm, row, scale, subtract
from drapery.cloth.contact.box_data import (
    NO_CONTACT,
    TOUCH,
    BoxContact,
    Candidates,
    candidate_arrays,
)
from drapery.cloth.contact.box_frame import CARRIED, reset_tracks
from drapery.cloth.contact.geometry import grown, put
from drapery.cloth.contact.near_boxes import swept_extent
from drapery.cloth.contact.self_contact import meet_one
from drapery.cloth.contact.self_contact_data import NOT_ITSELF, SelfContact
from drapery.cloth.kernels import load_lanes
from drapery.cloth.sheet_kernels import lane_of
from drapery.cloth.simd import fill, lane_count, load, maximum, minimum, store
from drapery.jit import address_of, call_by_address, entry_point, kernel
from drapery.mesh import Array

ROUNDING = 2.0**-22
"""More than the relative error of a number in single precision."""


class ContactWork(NamedTuple):
    """start, end: places of one cloth at the start and the end of a step [m], [N, 3]; N is 0
    without contact. extents: the lowest and the highest coordinates of what each box keeps free
    [m], [K, 6]. near: see `Candidates`."""

    start: Array
    end: Array
    extents: Array
    near: Candidates


def contact_work(contact: BoxContact, itself: SelfContact = NOT_ITSELF) -> ContactWork:
    """Arrays for the contact of one cloth at a time."""
    particles = max(contact.inv_mass.size if len(contact.halves) > 0 else 0, itself.inv_mass.size)
    return ContactWork(
        np.empty((particles, 3)),
        np.empty((particles, 3)),
        np.empty((len(contact.halves), 6)),
        candidate_arrays(contact),
    )


@kernel
def contact_at(boxes: Any, poses: Any, turn: Any) -> BoxContact:
    """The contact in step number `turn`. poses: of the boxes before the first step and after each,
    [T, K, 12]."""
    last = len(poses) - 1
    return BoxContact(
        poses[min(turn, last)],
        poses[min(turn + 1, last)],
        boxes.halves,
        boxes.friction,
        boxes.radius,
        boxes.reach,
        boxes.edges,
        boxes.triangles,
        boxes.inv_mass,
        boxes.bands,
    )


@entry_point
def resolve(work: Any, boxes: Any, itself: Any, poses: Any, turn: Any) -> bool:
    """Resolve the contacts of a cloth with boxes and with itself in step number `turn`, which ends
    at work.end; see `contact_at`. Returns whether it had any."""
    reset_tracks(work.near)
    contact = contact_at(boxes, poses, turn)
    return bool(meet_one(work.start, work.end, itself, contact, work.near))


EXAMPLE = (contact_work(NO_CONTACT), NO_CONTACT, NOT_ITSELF, NO_CONTACT.ends[None], 0)
_resolve_at = call_by_address(bool, EXAMPLE)


@cache
def resolve_address() -> int:
    """Where `resolve` is in memory."""
    return address_of(resolve, EXAMPLE)


@kernel
def meets_itself(batch: Any) -> bool:
    """Whether contact of each cloth with itself is resolved."""
    return len(batch.itself.triangles) > 0


@kernel
def begin_lanes(y: Any, batch: Any) -> Any:
    """The places of a block of lanes y [3N, L] before the first step; empty without contact."""
    before = simd.empty_lanes(y.shape[0] if batch.work.end.shape[0] > 0 else 0, y.shape[1], y)
    load_lanes(before, y, 0)
    return before


@kernel
def meet_lanes(y: Any, u: Any, before: Any, batch: Any, start: Any, turn: Any, dt: Any) -> None:
    """Resolve the contacts of a block y, u [3N, L] at the end of step number `turn` of dt [s].

    before: the places at its start, which become those at its end.
    """
    if before.shape[0] == 0:
        return
    work, lanes = batch.work, lane_count(y)
    set_extents(batch, turn)
    gaps = simd.empty_lanes(1, lanes, y)
    for first in range(0, min(y.shape[1], batch.cloths - start), lanes):
        if not meets_itself(batch):
            store(gaps, 0, 0, gap_of_lanes(before, y, work.extents, batch.contact.bands, first))
        for cloth in range(first, min(first + lanes, batch.cloths - start)):
            if meets_itself(batch) or gaps[0, cloth - first] < 0:
                for i in range(work.end.shape[0]):
                    for axis in range(3):
                        work.start[i, axis] = before[3 * i + axis, cloth]
                        work.end[i, axis] = y[3 * i + axis, cloth]
                met = work, batch.contact, batch.itself, batch.poses, turn
                if _resolve_at(batch.resolve, met):
                    for i in range(work.end.shape[0]):
                        place = y[3 * i, cloth], y[3 * i + 1, cloth], y[3 * i + 2, cloth]
                        if has_moved(work, i, place):
                            solved = u[3 * i, cloth], u[3 * i + 1, cloth], u[3 * i + 2, cloth]
                            speed = limited_speed(work, i, solved, dt)
                            for axis in range(3):
                                y[3 * i + axis, cloth] = work.end[i, axis]
                                u[3 * i + axis, cloth] = speed[axis]
    load_lanes(before, y, 0)


@kernel
def begin_plane(y: Any, batch: Any, sheet: Any) -> Any:
    """The same for one cloth as a plane of lanes, y [3, lanes]."""
    before = simd.empty_lanes(3, sheet.plane if batch.work.end.shape[0] > 0 else 0, y)
    load_lanes(before, y, 0)
    return before


@kernel
def meet_plane(y: Any, u: Any, before: Any, batch: Any, turn: Any, dt: Any, sheet: Any) -> None:
    """Resolve the contacts of a plane y, u [3, lanes] at the end of step `turn` of dt [s]."""
    work = batch.work
    if before.shape[1] == 0:
        return
    set_extents(batch, turn)
    if meets_itself(batch) or near_plane(before, y, work.extents, sheet):
        for r in range(sheet.rows):
            for c in range(sheet.columns):
                i, lane = r * sheet.columns + c, r * sheet.width + c
                for axis in range(3):
                    work.start[i, axis] = before[axis, lane]
                    work.end[i, axis] = y[axis, lane]
        if _resolve_at(batch.resolve, (work, batch.contact, batch.itself, batch.poses, turn)):
            for i in range(work.end.shape[0]):
                lane = lane_of(i, sheet)
                if has_moved(work, i, (y[0, lane], y[1, lane], y[2, lane])):
                    speed = limited_speed(work, i, (u[0, lane], u[1, lane], u[2, lane]), dt)
                    for axis in range(3):
                        y[axis, lane] = work.end[i, axis]
                        u[axis, lane] = speed[axis]
    load_lanes(before, y, 0)


@kernel
def set_extents(batch: Any, turn: Any) -> None:
    """Set the bounds of the boxes in step number `turn`, less what is not yet a contact."""
    contact = contact_at(batch.contact, batch.poses, turn)
    for k in range(len(contact.halves)):
        low, high = swept_extent(contact, k)
        put(batch.work.extents, k, 0, grown(low, 0.5 * TOUCH))
        put(batch.work.extents, k, 3, grown(high, -0.5 * TOUCH))


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
def has_moved(work: Any, i: Any, solved: Any) -> bool:
    """Whether contact moved a particle from where its solver left it."""
    end = row(work.end, i)
    return bool(end[0] != solved[0] or end[1] != solved[1] or end[2] != solved[2])


@kernel
def limited_speed(work: Any, i: Any, speed: Any, dt: Any) -> Vector:
    """The velocity of a particle that contact moved: of its motion over the step, at most as fast
    as its solver left it, at `speed`, or as the boxes that moved it. Otherwise a cloth that its
    solver pulls into a surface at every step would keep the speed of that pull."""
    seen = scale(1.0 / np.float64(dt), subtract(row(work.end, i), row(work.start, i)))
    own = norm((np.float64(speed[0]), np.float64(speed[1]), np.float64(speed[2])))
    carried = work.near.tracks[i, CARRIED] if i < len(work.near.tracks) else 0.0
    limit, length = max(own, carried / dt), norm(seen)
    return scale(limit / length if length > limit else 1.0, seen)
