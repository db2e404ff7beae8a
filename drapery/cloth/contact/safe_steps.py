"""Displacements of particles shortened so that no pair of parts crosses in a step.

A pair whose parts move relative to each other by less than their distance at the start cannot
cross, as in offset geometric contact (Chen et al., SIGGRAPH 2025). For the others additive
continuous collision detection (Li, Kaufman, Jiang, "Codimensional incremental potential contact",
2021, section 5) finds how far they may move.
"""

import numpy as np
from numpy.typing import NDArray

from drapery.cloth.colliders.vectors import Vector, add_scaled, dot, norm, row, scale, subtract
from drapery.cloth.contact.geometry import put
from drapery.cloth.contact.pair_distance import distance_of, gap_along
from drapery.cloth.contact.touching_pairs import TouchingPairs, moved
from drapery.jit import borrowing_kernel
from drapery.mesh import Array

MARGIN, CLOSE = 0.1, 0.02
"""Pairs that would cross stop at this part of their distance at the start, within CLOSE of it."""
LEAST = 2e-5
"""Pairs stop at this distance [m], and those that are nearer come no nearer: single precision
cannot hold much less between particles some metres from the origin, so rounding could let them
cross. It is at most half the thickness."""
HOLD = 0.8
"""Pairs stop at this part of the thickness too, or of their distance at the start if that is less:
else cloths that fall onto each other are pressed together, and all of them meet all others."""
CAREFUL = 0.9
"""Advances are shorter than they might be by this factor."""
ADVANCES = 64
"""The most advances of a pair in a step; one that needs more stops there."""


@borrowing_kernel
def shorten_unsafe(
    x0: Array,
    x: Array,
    pairs: TouchingPairs,
    w: Array,
    thickness: float,
    changed: NDArray[np.int32],
    turn: int,
    stop: bool,
) -> bool:
    """Shorten the displacements of pairs that would come nearer than they may, to 0 if `stop` is
    True; returns whether there was any.

    thickness: see `least_distance` [m].
    changed: the last turn in which each particle was moved, [N]; it is set. turn: 0 at first,
    then 1, 2, ...; only pairs of which a particle was moved since the turn before are tested again.
    """
    found, ends, offsets = False, pairs.ends, pairs.offsets
    for n in range(len(ends)):
        i, j, k, m, edges = ends[n, 0], ends[n, 1], ends[n, 2], ends[n, 3], ends[n, 4]
        if max(max(changed[i], changed[j]), max(changed[k], changed[m])) < turn - 1:
            continue
        start = offsets[n, 3]
        # Along one direction the gap is a concave function of time, so it is least at an end.
        gap = gap_along(row(offsets, n), x, i, j, k, m, edges)
        least = least_distance(start, thickness)
        if gap > least + CLOSE * start and start > 0.0:
            continue
        if w[i] + w[j] + w[k] + w[m] == 0.0:
            continue  # nothing can keep pins apart
        if longest_relative(x0, x, i, j, k, m, edges) <= start - least:
            continue
        part = safe_part(x0, x, i, j, k, m, edges, start, least)
        if part < 1.0:
            found = True
            part = 0.0 if stop else CAREFUL * part
            for end in range(4):
                shorten(x0, x, w, ends[n, end], part)
                changed[ends[n, end]] = turn
    return found


@borrowing_kernel
def least_distance(start: float, thickness: float) -> float:
    """The distance at which a pair stops that was `start` apart [m]."""
    nearest = min(start, LEAST, 0.5 * thickness)
    return max(MARGIN * start, HOLD * min(start, thickness), nearest)


@borrowing_kernel
def shorten(x0: Array, x: Array, w: Array, i: int, part: float) -> None:
    """Shorten the displacement of a free particle to a part of it."""
    if w[i] > 0.0:
        put(x, i, 0, add_scaled(row(x0, i), part, moved(x0, x, i)))


@borrowing_kernel
def safe_part(
    x0: Array,
    x: Array,
    i: int,
    j: int,
    k: int,
    m: int,
    edges: int,
    start: float,
    least: float,
) -> float:
    """The part of the step after which a pair is as near as the least distance; 1 if it never is.
    Each advance is less than the distance, so it cannot miss a contact. start: distance at the
    start [m]."""
    a, b, c, d = row(x0, i), row(x0, j), row(x0, k), row(x0, m)
    u, v, p, q = moved(x0, x, i), moved(x0, x, j), moved(x0, x, k), moved(x0, x, m)
    mean = scale(0.25, add_scaled(add_scaled(add_scaled(u, 1.0, v), 1.0, p), 1.0, q))
    u, v, p, q = subtract(u, mean), subtract(v, mean), subtract(p, mean), subtract(q, mean)
    if edges:
        speed = max(norm(u), norm(v)) + max(norm(p), norm(q))
    else:
        speed = norm(u) + max(norm(v), max(norm(p), norm(q)))
    part, length = 0.0, start
    for _ in range(ADVANCES):
        advance = CAREFUL * (length - least) / speed
        part += advance
        if part >= 1.0:
            return 1.0
        a1, b1 = add_scaled(a, part, u), add_scaled(b, part, v)
        c1, d1 = add_scaled(c, part, p), add_scaled(d, part, q)
        length = distance_of(a1, b1, c1, d1, edges)
        if length - least <= CLOSE * start:
            return part - advance
    return part


@borrowing_kernel
def longest_relative(x0: Array, x: Array, i: int, j: int, k: int, m: int, edges: int) -> float:
    """The longest displacement [m] of a particle of one part relative to one of the other."""
    a, b, c, d = moved(x0, x, i), moved(x0, x, j), moved(x0, x, k), moved(x0, x, m)
    most = max(square(a, c), square(a, d))
    most = max(most, max(square(b, c), square(b, d)) if edges else square(a, b))
    return float(np.sqrt(most))


@borrowing_kernel
def square(a: Vector, b: Vector) -> float:
    offset = subtract(a, b)
    return dot(offset, offset)
