"""Contact at the end of each step inside the kernels of all solvers.

A solver moves the cloth without regard to boxes. Then, still in the same compiled loop, each
cloth is copied to an array [N, 3], its contacts are resolved, and the next step starts from there.
The kernels call `resolve` by its address, so it is compiled once for all of them.
"""

from functools import cache
from typing import Any, NamedTuple

import numpy as np

from drapery.cloth.colliders.vectors import norm, row, scale, subtract
from drapery.cloth.contact.box_contact import solve_boxes
from drapery.cloth.contact.box_data import NO_CONTACT, BoxContact, Candidates, candidate_arrays
from drapery.cloth.contact.box_frame import CARRIED, COLUMNS, reset_frame
from drapery.cloth.contact.geometry import put
from drapery.cloth.contact.near_boxes import find_boxes
from drapery.cloth.sheet_kernels import lane_of
from drapery.jit import address_of, call_by_address, entry_point, kernel
from drapery.mesh import Array


class ContactWork(NamedTuple):
    """starts: places of each cloth of a block at the start of a step [m], [C, N, 3]; C is 0
    without contact. solved, end: of one cloth at its end, as its solver left it and as contact
    does [m], [N, 3]. speeds: its velocities [m/s], [N, 3]. frame: see `box_frame`. near: see
    `Candidates`."""

    starts: Array
    solved: Array
    end: Array
    speeds: Array
    frame: Array
    near: Candidates


def contact_work(cloths: int, contact: BoxContact) -> ContactWork:
    """Arrays for the contact of so many cloths at a time."""
    meets = len(contact.halves) > 0
    particles = contact.inv_mass.size if meets else 0
    return ContactWork(
        np.empty((cloths if meets else 0, particles, 3)),
        np.empty((particles, 3)),
        np.empty((particles, 3)),
        np.empty((particles, 3)),
        np.empty((particles, COLUMNS)),
        candidate_arrays(contact),
    )


@entry_point
def resolve(cloth: Any, work: Any, boxes: Any, poses: Any, turn: Any, dt: Any) -> bool:
    """Resolve the contacts of cloth number `cloth` of the block in step number `turn` of dt [s],
    which ends at work.end with work.speeds. poses: of the boxes before the first step and after
    each, [T, K, 12]. Returns whether it had any."""
    start, last = work.starts[cloth], len(poses) - 1
    contact = BoxContact(
        poses[min(turn, last)],
        poses[min(turn + 1, last)],
        boxes.halves,
        boxes.friction,
        boxes.radius,
        boxes.reach,
        boxes.edges,
        boxes.triangles,
        boxes.inv_mass,
    )
    reset_frame(work.frame)
    if not find_boxes(start, work.end, contact, work.frame, work.near):
        return False
    for i in range(len(start)):  # a slice would compile numba's messages about shapes, for seconds
        put(work.solved, i, 0, row(work.end, i))
    met = solve_boxes(start, work.end, contact, work.frame, work.near)
    if met:
        for i in range(len(start)):
            limit_speed(work, start, i, dt)
    return bool(met)


EXAMPLE = (0, contact_work(0, NO_CONTACT), NO_CONTACT, NO_CONTACT.ends[None], 0, 0.0)
_resolve_at = call_by_address(bool, EXAMPLE)


@cache
def resolve_address() -> int:
    """Where `resolve` is in memory."""
    return address_of(resolve, EXAMPLE)


@kernel
def begin_lanes(y: Any, batch: Any, start: Any) -> None:
    """Note the places of a block of lanes y [3N, L] before the first step."""
    starts = batch.work.starts
    for cloth in range(min(starts.shape[0], batch.cloths - start)):
        for i in range(starts.shape[1]):
            for axis in range(3):
                starts[cloth, i, axis] = y[3 * i + axis, cloth]


@kernel
def meet_lanes(y: Any, u: Any, batch: Any, start: Any, turn: Any, dt: Any) -> None:
    """Resolve the contacts of a block y, u [3N, L] at the end of step number `turn` of dt [s]."""
    work = batch.work
    for cloth in range(min(work.starts.shape[0], batch.cloths - start)):
        for i in range(work.end.shape[0]):
            for axis in range(3):
                work.end[i, axis] = y[3 * i + axis, cloth]
                work.speeds[i, axis] = u[3 * i + axis, cloth]
        arguments = cloth, work, batch.contact, batch.poses, turn, np.float64(dt)
        met = _resolve_at(batch.resolve, arguments)
        for i in range(work.end.shape[0]):
            for axis in range(3):
                if met:
                    y[3 * i + axis, cloth] = work.end[i, axis]
                    u[3 * i + axis, cloth] = work.speeds[i, axis]
                work.starts[cloth, i, axis] = y[3 * i + axis, cloth]


@kernel
def begin_plane(y: Any, batch: Any, sheet: Any) -> None:
    """The same for one cloth as a plane of lanes, y [3, lanes]."""
    starts = batch.work.starts
    if starts.shape[0] > 0:
        for i in range(starts.shape[1]):
            for axis in range(3):
                starts[0, i, axis] = y[axis, lane_of(i, sheet)]


@kernel
def meet_plane(y: Any, u: Any, batch: Any, turn: Any, dt: Any, sheet: Any) -> None:
    """Resolve the contacts of a plane y, u [3, lanes] at the end of step `turn` of dt [s]."""
    work = batch.work
    if work.starts.shape[0] == 0:
        return
    for i in range(work.end.shape[0]):
        for axis in range(3):
            work.end[i, axis] = y[axis, lane_of(i, sheet)]
            work.speeds[i, axis] = u[axis, lane_of(i, sheet)]
    met = _resolve_at(batch.resolve, (0, work, batch.contact, batch.poses, turn, np.float64(dt)))
    for i in range(work.end.shape[0]):
        lane = lane_of(i, sheet)
        for axis in range(3):
            if met:
                y[axis, lane] = work.end[i, axis]
                u[axis, lane] = work.speeds[i, axis]
            work.starts[0, i, axis] = y[axis, lane]


@kernel
def limit_speed(work: Any, start: Any, i: Any, dt: Any) -> None:
    """Give a particle that contact moved the velocity of its motion over the step, at most as fast
    as before or as the boxes that moved it. Otherwise a cloth that its solver pulls into a surface
    at every step would keep the speed of that pull."""
    end, solved = row(work.end, i), row(work.solved, i)
    if end[0] == solved[0] and end[1] == solved[1] and end[2] == solved[2]:
        return
    seen = scale(1.0 / dt, subtract(end, row(start, i)))
    limit, length = max(norm(row(work.speeds, i)), work.frame[i, CARRIED] / dt), norm(seen)
    part = limit / length if length > limit else 1.0
    for axis in range(3):
        work.speeds[i, axis] = part * seen[axis]
