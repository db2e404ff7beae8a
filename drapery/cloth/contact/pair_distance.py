"""The nearest points of a particle and a face, or of two edges."""

from drapery.cloth.colliders.vectors import (
    Vector,
    add_scaled,
    dot,
    norm,
    row,
    scale,
    subtract,
)
from drapery.jit import borrowing_kernel
from drapery.mesh import Array


@borrowing_kernel
def nearest(
    x: Array, i: int, j: int, k: int, m: int, edges: int
) -> tuple[tuple[float, float, float, float], Vector]:
    """Weights of the nearest points of a pair (for the first part positive, for the second
    negative), and the vector between them."""
    a, b, c, d = row(x, i), row(x, j), row(x, k), row(x, m)
    if edges:
        s, t = nearest_of_segments(a, b, c, d)
        p = add_scaled(a, s, subtract(b, a))
        q = add_scaled(c, t, subtract(d, c))
        return (1.0 - s, s, t - 1.0, -t), subtract(p, q)
    u, v, w = nearest_of_face(b, c, d, a)
    q = add_scaled(add_scaled(scale(u, b), v, c), w, d)
    return (1.0, -u, -v, -w), subtract(a, q)


@borrowing_kernel
def gap_along(direction: Vector, x: Array, i: int, j: int, k: int, m: int, edges: int) -> float:
    """How far the parts of a pair are from each other along a direction of length 1 [m]; never more
    than their distance, and below 0 where they overlap."""
    a, b = dot(row(x, i), direction), dot(row(x, j), direction)
    c, d = dot(row(x, k), direction), dot(row(x, m), direction)
    return gap_of(a, b, c, d, edges)


@borrowing_kernel
def gap_of(a: float, b: float, c: float, d: float, edges: int) -> float:
    """The gap between two edges from a to b and from c to d, or a particle at a and a face from b
    over c to d, on a line."""
    return min(a, b) - max(c, d) if edges else a - max(b, max(c, d))


@borrowing_kernel
def nearest_of_segments(a: Vector, b: Vector, c: Vector, d: Vector) -> tuple[float, float]:
    """The parts of two segments at which they are nearest (Ericson 2005, section 5.1.9)."""
    d1, d2, r = subtract(b, a), subtract(d, c), subtract(a, c)
    aa, ee, f = dot(d1, d1), dot(d2, d2), dot(d2, r)
    cc, bb = dot(d1, r), dot(d1, d2)
    if aa <= 0.0 or ee <= 0.0:
        return 0.0, min(max(f / ee, 0.0), 1.0) if ee > 0.0 else 0.0
    denominator = aa * ee - bb * bb
    s = 0.5
    if denominator > 1e-12 * aa * ee:
        s = min(max((bb * f - cc * ee) / denominator, 0.0), 1.0)
    t = (bb * s + f) / ee
    if t < 0.0:
        return min(max(-cc / aa, 0.0), 1.0), 0.0
    if t > 1.0:
        return min(max((bb - cc) / aa, 0.0), 1.0), 1.0
    return s, t


@borrowing_kernel
def nearest_of_face(a: Vector, b: Vector, c: Vector, p: Vector) -> Vector:
    """Barycentric weights of the nearest point of a triangle (Ericson 2005, section 5.1.5), which
    may be a segment or a point: contact can press two of its corners into one place."""
    ab, ac, ap = subtract(b, a), subtract(c, a), subtract(p, a)
    d1, d2 = dot(ab, ap), dot(ac, ap)
    if d1 <= 0 and d2 <= 0:
        return 1.0, 0.0, 0.0
    bp = subtract(p, b)
    d3, d4 = dot(ab, bp), dot(ac, bp)
    if d3 >= 0 and d4 <= d3:
        return 0.0, 1.0, 0.0
    vc = d1 * d4 - d3 * d2
    if vc <= 0 and d1 >= 0 and d3 <= 0 and d1 > d3:
        v = d1 / (d1 - d3)
        return 1.0 - v, v, 0.0
    cp = subtract(p, c)
    d5, d6 = dot(ab, cp), dot(ac, cp)
    if d6 >= 0 and d5 <= d6:
        return 0.0, 0.0, 1.0
    vb = d5 * d2 - d1 * d6
    if vb <= 0 and d2 >= 0 and d6 <= 0:
        w = d2 / (d2 - d6)
        return 1.0 - w, 0.0, w
    va = d3 * d6 - d5 * d4
    if va <= 0 and d4 >= d3 and d5 >= d6:
        w = (d4 - d3) / ((d4 - d3) + (d5 - d6))
        return 0.0, 1.0 - w, w
    inverse = 1 / max(va + vb + vc, 1e-300)
    return va * inverse, vb * inverse, vc * inverse


@borrowing_kernel
def distance_of(a: Vector, b: Vector, c: Vector, d: Vector, edges: int) -> float:
    """The distance [m] of two edges ab and cd, or of a particle a and a face bcd."""
    if edges:
        s, t = nearest_of_segments(a, b, c, d)
        p, q = add_scaled(a, s, subtract(b, a)), add_scaled(c, t, subtract(d, c))
        return norm(subtract(p, q))
    u, v, w = nearest_of_face(b, c, d, a)
    return norm(subtract(a, add_scaled(add_scaled(scale(u, b), v, c), w, d)))
