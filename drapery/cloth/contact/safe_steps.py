"""Displacements of particles shortened so that no pair of parts crosses in a step.

A pair whose parts move relative to each other by less than their distance at the start cannot
cross, as in offset geometric contact (Chen et al., SIGGRAPH 2025). For the others additive
continuous collision detection (Li, Kaufman, Jiang, "Codimensional incremental potential contact",
2021, section 5) finds how far they may move.
"""

from drapery.cloth.colliders.vectors import add_scaled, norm, row, scale, subtract
from drapery.cloth.contact.geometry import put
from drapery.cloth.contact.pair_distance import distance_of
from drapery.cloth.contact.touching_pairs import TouchingPairs, longest_relative, moved
from drapery.jit import kernel
from drapery.mesh import Array

MARGIN, CLOSE = 0.1, 0.02
"""Pairs that would cross stop at this part of their distance at the start, within CLOSE of it."""
LEAST = 2e-5
"""Pairs that would cross stop at this distance beside [m], or at half of that at the start: single
precision cannot hold less between particles some metres from the origin."""
CAREFUL = 0.9
"""Advances are shorter than they might be by this factor."""
ADVANCES = 64
"""The most advances of a pair in a step; one that needs more stops there."""


@kernel
def shorten_unsafe(x0: Array, x: Array, pairs: TouchingPairs, w: Array, stop: bool) -> bool:
    """Shorten the displacements of pairs that would cross, to 0 if they shall stop; returns whether
    there was any."""
    found = False
    for n in range(len(pairs.ends)):
        i, j, k, m = pairs.ends[n, 0], pairs.ends[n, 1], pairs.ends[n, 2], pairs.ends[n, 3]
        if w[i] + w[j] + w[k] + w[m] == 0.0:
            continue  # nothing can keep pins apart
        if longest_relative(x0, x, i, j, k, m, pairs.edges[n]) < CAREFUL * pairs.starts[n]:
            continue
        part = safe_part(x0, x, i, j, k, m, pairs.edges[n], pairs.starts[n])
        if part < 1.0:
            found = True
            part = 0.0 if stop else CAREFUL * part
            shorten(x0, x, w, i, part)
            shorten(x0, x, w, j, part)
            shorten(x0, x, w, k, part)
            shorten(x0, x, w, m, part)
    return found


@kernel
def shorten(x0: Array, x: Array, w: Array, i: int, part: float) -> None:
    """Shorten the displacement of a free particle to a part of it."""
    if w[i] > 0.0:
        put(x, i, 0, add_scaled(row(x0, i), part, moved(x0, x, i)))


@kernel
def safe_part(
    x0: Array, x: Array, i: int, j: int, k: int, m: int, edges: int, start: float
) -> float:
    """The part of the step after which a pair is as near as MARGIN times its distance at the start;
    1 if it never is. Each advance is less than the distance, so it cannot miss a contact."""
    a, b, c, d = row(x0, i), row(x0, j), row(x0, k), row(x0, m)
    u, v, p, q = moved(x0, x, i), moved(x0, x, j), moved(x0, x, k), moved(x0, x, m)
    mean = scale(0.25, add_scaled(add_scaled(add_scaled(u, 1.0, v), 1.0, p), 1.0, q))
    u, v, p, q = subtract(u, mean), subtract(v, mean), subtract(p, mean), subtract(q, mean)
    if edges:
        speed = max(norm(u), norm(v)) + max(norm(p), norm(q))
    else:
        speed = norm(u) + max(norm(v), max(norm(p), norm(q)))
    part, length, least = 0.0, start, MARGIN * start + min(0.5 * start, LEAST)
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
