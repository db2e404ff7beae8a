"""The faces on which wind acts: the area of each particle, and the samples of the wind."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from drapery.cloth.cloth import Cloth
from drapery.mesh import Array

SAMPLE_SPACING = 1.25
"""Greatest distance between samples of the wind on a grid [m]; gusts are larger."""


class Faces(NamedTuple):
    """Each particle's part of the area of the faces around it, as a vector along their mean normal.

    The vector area of particle i is the sum of share · (b - a) x (d - c) over the sides
    (a, b, c, d) numbered begin[i] to begin[i + 1].
    sides: particles, [E, 4]. shares: [E]. begin: [N + 1].
    controls: indices of the wind samples around each particle, [N, 4]. weights: of those samples,
    [N, 4].
    """

    sides: NDArray[np.int32]
    shares: Array
    begin: NDArray[np.int64]
    controls: NDArray[np.int32]
    weights: Array


def wind_faces(cloth: Cloth) -> tuple[Faces, NDArray[np.int32]]:
    """The areas, and the particles [C] at which the wind is sampled.

    On a grid a particle's area spans the middles of the cells around it, and the wind is
    interpolated between a few particles; on any other cloth it is a third of the triangles
    around the particle, and the wind is sampled at every particle.
    """
    if cloth.grid_shape is not None:
        return _grid_faces(cloth, *cloth.grid_shape)
    count = len(cloth.rest_positions)
    corners = np.concatenate([np.roll(cloth.triangles, turn, axis=1) for turn in range(3)])
    corners = corners[np.argsort(corners[:, 0], kind="stable")]
    a, b, c = corners.T
    begin = np.searchsorted(a, np.arange(count + 1))
    sides = np.stack([a, b, a, c], axis=1)
    every = np.arange(count, dtype=np.int32)
    weights = np.tile([1.0, 0.0, 0.0, 0.0], (count, 1))
    shares = np.full(len(sides), 1 / 6)
    return Faces(sides, shares, begin, np.repeat(every[:, None], 4, axis=1), weights), every


def _grid_faces(cloth: Cloth, rows: int, columns: int) -> tuple[Faces, NDArray[np.int32]]:
    index = np.arange(rows * columns, dtype=np.int32).reshape(rows, columns)
    padded = np.pad(index, 1, mode="edge")
    left, right = padded[1:-1, :-2], padded[1:-1, 2:]
    above, below = padded[:-2, 1:-1], padded[2:, 1:-1]
    # Facing +z: from left to right, then upwards.
    sides = np.stack([left, right, below, above], axis=-1).reshape(-1, 4)
    rest = cloth.rest_positions.reshape(rows, columns, 3)
    down = _samples(_length(rest[-1, 0] - rest[0, 0]), rows)
    across = _samples(_length(rest[0, -1] - rest[0, 0]), columns)
    controls, weights = _bilinear(_between(down, rows), _between(across, columns), len(across))
    begin = np.arange(rows * columns + 1)
    shares = np.full(len(sides), 0.25)
    return Faces(sides, shares, begin, controls, weights), index[np.ix_(down, across)].ravel()


def _length(offset: Array) -> float:
    """The length [m] of a vector [3], summed without BLAS."""
    return float(np.sqrt(np.square(offset).sum()))


def _samples(length: float, count: int) -> NDArray[np.int64]:
    """Indices of the lines at which the wind is sampled, along a grid side of `length` [m]."""
    pieces = min(count - 1, max(1, int(np.ceil(length / SAMPLE_SPACING))))
    return np.round(np.linspace(0, count - 1, pieces + 1)).astype(np.int64)


def _between(samples: NDArray[np.int64], count: int) -> tuple[NDArray[np.int64], Array]:
    """For each of `count` lines: the sample at or before it, and the next one's weight."""
    lines = np.arange(count)
    before = np.minimum(np.searchsorted(samples, lines, side="right"), len(samples) - 1) - 1
    return before, (lines - samples[before]) / (samples[before + 1] - samples[before])


def _bilinear(
    down: tuple[NDArray[np.int64], Array], across: tuple[NDArray[np.int64], Array], width: int
) -> tuple[NDArray[np.int32], Array]:
    """The four samples around each particle of a grid, and their weights, [N, 4] each."""
    (above, low), (left, right) = down, across
    first = above[:, None] * width + left
    controls = np.stack([first, first + 1, first + width, first + width + 1], axis=-1)
    parts = [(1 - low, 1 - right), (1 - low, right), (low, 1 - right), (low, right)]
    weights = np.stack([np.outer(a, b) for a, b in parts], axis=-1)
    return controls.reshape(-1, 4).astype(np.int32), weights.reshape(-1, 4)
