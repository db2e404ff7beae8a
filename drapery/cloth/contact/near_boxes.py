"""What of a cloth is so near a box that it may touch it in a step.

The bounds of each two neighbouring bands of the cloth are compared with those of the box. In what
is left, each particle has a code of the planes about the box beyond which it lies; what lies beyond
one plane as a whole cannot touch (Cohen and Sutherland; Newman, Sproull, "Principles of Interactive
Computer Graphics", 1979, section 5.1). Functions that are called often take arrays, not the tuples
that hold them: a call copies the whole tuple.
"""

import numpy as np
from numpy.typing import NDArray

from drapery.cloth.colliders.vectors import Vector, add, dot, rotated_back, row, subtract
from drapery.cloth.contact.box_data import TOUCH, BoxContact, Candidates
from drapery.cloth.contact.box_frame import (
    CHANGED,
    DISTANCE,
    END,
    MOVED,
    SOLVED,
    START,
    TRAVEL,
    TURN,
    end_of,
    measure,
)
from drapery.cloth.contact.geometry import (
    bounds_of,
    grown,
    has_end,
    higher,
    lower,
    overlap,
    put,
    read,
)
from drapery.jit import borrowing_kernel
from drapery.mesh import Array

Marks = NDArray[np.uint8]
Numbers = NDArray[np.int32]
Counts = NDArray[np.int64]
LISTED, MEASURED = 1, 2
"""The marks of a particle: it is listed; its distance from the box is needed."""
ITSELF, PAIR = 1, 2
"""The marks of a band: it is near together with one of its neighbours; with the next one."""


@borrowing_kernel
def whole_margin(contact: BoxContact) -> float:
    """The distance [m] beyond the radius within which everything is looked at."""
    return 2.0 * contact.radius + contact.reach


@borrowing_kernel
def find_boxes(x0: Array, x: Array, contact: BoxContact, margin: float, near: Candidates) -> bool:
    """List what is within a margin [m] beyond the radius; returns whether there is anything.

    Nothing is listed if nothing touches any box now: then no contact can move anything. Otherwise
    what is near other boxes is listed too, because contact may move cloth to them.
    """
    bands, bounds, close = contact.bands, near.bounds, near.close
    for band in range(len(close)):
        low, high = bounds_of(x0, x, bands[band, 0], bands[band + 1, 0])
        put(bounds, band, 0, low)
        put(bounds, band, 3, high)
    for i in range(len(x)):
        near.listed[i] = 0
    found = touched = False
    for k in range(len(contact.halves)):
        near.counts[k, 0] = near.counts[k, 1] = near.counts[k, 2] = 0
        low, high = swept_extent(contact, k)
        low, high = grown(low, 0.5 * TOUCH), grown(high, -0.5 * TOUCH)
        touched = touched or find_close(bounds, close, low, high)
    if not touched:
        return False
    for k in range(len(contact.halves)):
        low, high = swept_extent(contact, k)
        low, high = grown(low, -margin), grown(high, margin)
        if find_close(bounds, close, low, high):
            mark_particles(x0, x, bands, low, high, close, near.codes, near.marks)
            find_edges(
                contact.edges, bands, close, near.codes, near.marks, near.edges, near.counts, k
            )
            find_faces(
                contact.triangles, bands, close, near.codes, near.marks, near.faces, near.counts, k
            )
            measure_marked(x0, x, contact, k, near)
            choose_edges(contact, k, near)
            choose_faces(contact, k, near)
            list_particles(x, contact, k, near)
            found = found or near.counts[k, 0] > 0
    return found


@borrowing_kernel
def swept_extent(contact: BoxContact, k: int) -> tuple[Vector, Vector]:
    """The lowest and the highest coordinates of what a box keeps free at the start or the end of
    the step."""
    low, high = extent_of(contact, contact.starts, k)
    low1, high1 = extent_of(contact, contact.ends, k)
    return lower(low, low1), higher(high, high1)


@borrowing_kernel
def find_close(bounds: Array, close: Marks, low: Vector, high: Vector) -> bool:
    """Mark the bands that may, each with the next one, overlap an upright box; whether any does.

    The last band stands alone.
    """
    found, last = False, len(close) - 1
    for band in range(last + 1):
        close[band] = 0
    for band in range(last + 1):
        after = min(band + 1, last)
        first = lower(read(bounds, band, 0), read(bounds, after, 0))
        end = higher(read(bounds, band, 3), read(bounds, after, 3))
        if overlap(first, end, low, high):
            close[band] = PAIR + ITSELF
            close[after] |= ITSELF
            found = True
    return found


@borrowing_kernel
def extent_of(contact: BoxContact, poses: Array, k: int) -> tuple[Vector, Vector]:
    """The lowest and the highest coordinates of what a box keeps free in one of its poses."""
    pose, half = poses[k], row(contact.halves, k)
    x = abs(pose[3]) * half[0] + abs(pose[4]) * half[1] + abs(pose[5]) * half[2]
    y = abs(pose[6]) * half[0] + abs(pose[7]) * half[1] + abs(pose[8]) * half[2]
    z = abs(pose[9]) * half[0] + abs(pose[10]) * half[1] + abs(pose[11]) * half[2]
    centre, extent = row(poses, k), grown((x, y, z), contact.radius)
    return subtract(centre, extent), add(centre, extent)


@borrowing_kernel
def mark_particles(
    x0: Array,
    x: Array,
    bands: Numbers,
    low: Vector,
    high: Vector,
    close: Marks,
    codes: Marks,
    marks: Marks,
) -> None:
    """Set the codes of the particles of close bands, and list those that no plane separates from
    what the box reaches, from low to high, at the start and at the end of the step."""
    for band in range(len(close)):
        if close[band]:
            for i in range(bands[band, 0], bands[band + 1, 0]):
                a, b = row(x0, i), row(x, i)
                codes[i] = outcode(b, low, high)
                marks[i] = LISTED * overlap(lower(a, b), higher(a, b), low, high)


@borrowing_kernel
def outcode(place: Vector, low: Vector, high: Vector) -> int:
    """A bit for each of the six planes about an upright box: whether a place is beyond it."""
    return (
        (place[0] < low[0])
        + 2 * (place[0] > high[0])
        + 4 * (place[1] < low[1])
        + 8 * (place[1] > high[1])
        + 16 * (place[2] < low[2])
        + 32 * (place[2] > high[2])
    )


@borrowing_kernel
def find_edges(
    edges: Numbers,
    bands: Numbers,
    close: Marks,
    codes: Marks,
    marks: Marks,
    out: Numbers,
    counts: Counts,
    k: int,
) -> None:
    """List the edges of which no plane about box k separates both ends, and mark the ends."""
    found = 0
    for band in range(len(close)):
        if close[band] & PAIR:
            for e in range(bands[band, 1], bands[band + 1, 1]):
                i, j = edges[e, 0], edges[e, 1]
                if codes[i] & codes[j] == 0:
                    out[k, found] = e
                    marks[i] |= MEASURED
                    marks[j] |= MEASURED
                    found += 1
    counts[k, 1] = found


@borrowing_kernel
def find_faces(
    triangles: Numbers,
    bands: Numbers,
    close: Marks,
    codes: Marks,
    marks: Marks,
    out: Numbers,
    counts: Counts,
    k: int,
) -> None:
    """The same for faces."""
    found = 0
    for band in range(len(close)):
        if close[band] & PAIR:
            for t in range(bands[band, 2], bands[band + 1, 2]):
                i, j, m = triangles[t, 0], triangles[t, 1], triangles[t, 2]
                if codes[i] & codes[j] & codes[m] == 0:
                    out[k, found] = t
                    marks[i] |= MEASURED
                    marks[j] |= MEASURED
                    marks[m] |= MEASURED
                    found += 1
    counts[k, 2] = found


@borrowing_kernel
def measure_marked(x0: Array, x: Array, contact: BoxContact, k: int, near: Candidates) -> None:
    """Set the places relative to box k, and the distances, of marked particles."""
    turn0, centre0 = contact.starts[k, 3:].reshape(3, 3), row(contact.starts, k)
    turn, centre = contact.ends[k, 3:].reshape(3, 3), row(contact.ends, k)
    half, frame, bands = row(contact.halves, k), near.frames[k], contact.bands
    close, marks = near.close, near.marks
    for band in range(len(close)):
        if close[band]:
            for i in range(bands[band, 0], bands[band + 1, 0]):
                if marks[i]:
                    put(frame, i, START, rotated_back(turn0, subtract(row(x0, i), centre0)))
                    put(frame, i, END, rotated_back(turn, subtract(row(x, i), centre)))
                    measure(half, frame, i)
                    frame[i, MOVED] = frame[i, CHANGED] = 0.0


@borrowing_kernel
def choose_edges(contact: BoxContact, k: int, near: Candidates) -> None:
    """Keep the edges that may touch box k, and list their ends."""
    found, edges, marks, frame = 0, near.edges, near.marks, near.frames[k]
    ends, radius = contact.edges, contact.radius
    for n in range(near.counts[k, 1]):
        e = edges[k, n]
        i, j = ends[e, 0], ends[e, 1]
        if may_touch(radius, frame, i, j):
            edges[k, found] = e
            marks[i] |= LISTED
            marks[j] |= LISTED
            found += 1
    near.counts[k, 1] = found


@borrowing_kernel
def choose_faces(contact: BoxContact, k: int, near: Candidates) -> None:
    """Keep the faces inside which a corner of box k may touch, and list their particles."""
    found, faces, marks, frame = 0, near.faces, near.marks, near.frames[k]
    half, radius, triangles = row(contact.halves, k), contact.radius, contact.triangles
    for n in range(near.counts[k, 2]):
        t = faces[k, n]
        i, j, m = triangles[t, 0], triangles[t, 1], triangles[t, 2]
        if near_corner(half, radius, frame, i, j, m):
            faces[k, found] = t
            marks[i] |= LISTED
            marks[j] |= LISTED
            marks[m] |= LISTED
            found += 1
    near.counts[k, 2] = found


@borrowing_kernel
def list_particles(x: Array, contact: BoxContact, k: int, near: Candidates) -> None:
    """List the particles that are marked for it, in order, and begin their tracks."""
    close, bands, marks, tracks = near.close, contact.bands, near.marks, near.tracks
    found, particles, listed = 0, near.particles, near.listed
    for band in range(len(close)):
        if close[band]:
            for i in range(bands[band, 0], bands[band + 1, 0]):
                if marks[i] & LISTED:
                    particles[k, found] = i
                    listed[i] = 1
                    put(tracks, i, SOLVED, row(x, i))
                    tracks[i, TRAVEL] = tracks[i, TURN] = 0.0
                    found += 1
    near.counts[k, 0] = found


@borrowing_kernel
def may_touch(radius: float, frame: Array, i: int, j: int) -> bool:
    """Whether an edge may come within the radius [m], contacts of the radius included."""
    along = subtract(end_of(frame, j), end_of(frame, i))
    total = frame[i, DISTANCE] + frame[j, DISTANCE] - 3.0 * radius
    near: bool = total < 0.0 or total * total < dot(along, along)
    return near


@borrowing_kernel
def near_corner(half: Vector, radius: float, frame: Array, i: int, j: int, m: int) -> bool:
    """Whether a corner of the box may come near the inside of a face."""
    a, b, c, margin = end_of(frame, i), end_of(frame, j), end_of(frame, m), 2.0 * radius
    # Upright first: few faces are near an end of a pole.
    return (
        spans_end(half[1], margin, a[1], b[1], c[1])
        and spans_end(half[0], margin, a[0], b[0], c[0])
        and spans_end(half[2], margin, a[2], b[2], c[2])
    )


@borrowing_kernel
def spans_end(half: float, margin: float, a: float, b: float, c: float) -> bool:
    """Whether -half or half is within a margin of what lies between three numbers."""
    return has_end(min(a, min(b, c)) - margin, max(a, max(b, c)) + margin, half)
