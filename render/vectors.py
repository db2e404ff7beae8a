"""Products of vectors with sums in a fixed order.

numpy computes matrix products by BLAS, whose kernels round differently on different processors.
Numbers that affect a picture are computed here instead, so they have the same bits everywhere.
"""

import numpy as np

from drapery.mesh import Array


def dots(first: Array, second: Array) -> Array:
    """Scalar products along the last axis of 3; shapes [..., 3] broadcast to shape [...]."""
    products = first * second
    total: Array = products[..., 0] + products[..., 1] + products[..., 2]
    return total


def unit(vectors: Array) -> Array:
    """Vectors of length 1, shape [..., 3]; a zero vector stays 0."""
    lengths = np.sqrt(dots(vectors, vectors))[..., None]
    scaled: Array = vectors / np.where(lengths > 0, lengths, 1)
    return scaled


def cross(first: Array, second: Array) -> Array:
    """The vector product of two vectors, shape [3]; `np.cross` takes ten times as long for one."""
    a, b, c = map(float, first)
    x, y, z = map(float, second)
    return np.array([b * z - c * y, c * x - a * z, a * y - b * x])
