"""Contact at the end of each step inside the kernels of all solvers.

A solver moves the cloth without regard to boxes. Then, still in the same compiled loop, each
cloth is copied to an array [N, 3], its contacts are resolved, and the next step starts from there.
"""

from typing import Any, NamedTuple

import numpy as np

from drapery.cloth.box_contact import COLUMNS, Candidates, empty_candidates, meet_boxes
from drapery.cloth.colliders.vectors import norm, row, scale, subtract
from drapery.cloth.sheet_kernels import lane_of
from drapery.jit import kernel
from drapery.mesh import Array


class ContactWork(NamedTuple):
    """starts: places of each cloth of a block at the start of a step [m], [C, N, 3]; C is 0
    without contact. end: of one cloth at its end [m], [N, 3]. speeds: its velocities [m/s], [N, 3].
    frame, near: see `box_contact`."""

    starts: Array
    end: Array
    speeds: Array
    frame: Array
    near: Candidates


@kernel
def contact_work(cloths: Any, contact: Any) -> Any:
    """Arrays for the contact of so many cloths."""
    meets = contact.halves.shape[0] > 0
    particles = contact.inv_mass.size if meets else 0
    return ContactWork(
        np.empty((cloths if meets else 0, particles, 3)),
        np.empty((particles, 3)),
        np.empty((particles, 3)),
        np.empty((particles, COLUMNS)),
        empty_candidates(contact),
    )


@kernel
def begin_lanes(y: Any, batch: Any, start: Any) -> Any:
    """The arrays for a block of lanes y [3N, L], with its places before the first step."""
    work = contact_work(max(0, min(y.shape[1], batch.cloths - start)), batch.contact)
    for cloth in range(work.starts.shape[0]):
        for i in range(work.starts.shape[1]):
            for axis in range(3):
                work.starts[cloth, i, axis] = y[3 * i + axis, cloth]
    return work


@kernel
def meet_lanes(y: Any, u: Any, work: Any, batch: Any, dt: Any) -> None:
    """Resolve the contacts of a block y, u [3N, L] at the end of a step of dt [s]."""
    for cloth in range(work.starts.shape[0]):
        start = work.starts[cloth]
        for i in range(start.shape[0]):
            for axis in range(3):
                work.end[i, axis] = y[3 * i + axis, cloth]
                work.speeds[i, axis] = u[3 * i + axis, cloth]
        met = meet_boxes(start, work.end, batch.contact, work.frame, work.near)
        for i in range(start.shape[0]):
            if met:
                limit_speed(
                    work, start, i, dt, y[3 * i, cloth], y[3 * i + 1, cloth], y[3 * i + 2, cloth]
                )
            for axis in range(3):
                if met:
                    y[3 * i + axis, cloth] = work.end[i, axis]
                    u[3 * i + axis, cloth] = work.speeds[i, axis]
                start[i, axis] = y[3 * i + axis, cloth]


@kernel
def begin_plane(y: Any, batch: Any, sheet: Any) -> Any:
    """The same for one cloth as a plane of lanes, y [3, lanes]."""
    work = contact_work(1, batch.contact)
    for i in range(work.starts.shape[1]):
        for axis in range(3):
            work.starts[0, i, axis] = y[axis, lane_of(i, sheet)]
    return work


@kernel
def meet_plane(y: Any, u: Any, work: Any, batch: Any, dt: Any, sheet: Any) -> None:
    """Resolve the contacts of a plane y, u [3, lanes] at the end of a step of dt [s]."""
    if work.starts.shape[0] == 0:
        return
    start = work.starts[0]
    for i in range(start.shape[0]):
        for axis in range(3):
            work.end[i, axis] = y[axis, lane_of(i, sheet)]
            work.speeds[i, axis] = u[axis, lane_of(i, sheet)]
    met = meet_boxes(start, work.end, batch.contact, work.frame, work.near)
    for i in range(start.shape[0]):
        lane = lane_of(i, sheet)
        if met:
            limit_speed(work, start, i, dt, y[0, lane], y[1, lane], y[2, lane])
        for axis in range(3):
            if met:
                y[axis, lane] = work.end[i, axis]
                u[axis, lane] = work.speeds[i, axis]
            start[i, axis] = y[axis, lane]


@kernel
def limit_speed(work: Any, start: Any, i: Any, dt: Any, x: Any, y: Any, z: Any) -> None:
    """Give a particle that contact moved from (x, y, z) the velocity of its motion over the step,
    at most as fast as before. Otherwise a cloth that its solver pulls into a surface at every step
    would keep the speed of that pull."""
    end = row(work.end, i)
    if end[0] == x and end[1] == y and end[2] == z:
        return
    seen = scale(1.0 / dt, subtract(end, row(start, i)))
    limit, length = norm(row(work.speeds, i)), norm(seen)
    part = limit / length if length > limit else 1.0
    for axis in range(3):
        work.speeds[i, axis] = part * seen[axis]
