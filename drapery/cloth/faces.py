"""What the wind presses on: a cloth's faces, and the few particles at which the wind is sampled."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from drapery.cloth.cloth import Cloth
from drapery.mesh import Array

SAMPLE_SPACING = 0.9
"""Most distance between samples of the wind on a grid [m]; gusts are wider."""


class Faces(NamedTuple):
    """F faces of four corners, the last two of a triangle's the same.

    corners: particles, [F, 4]. shares: of the face's force that each corner takes, [F, 4].
    controls: numbers of the wind samples around the face, [F, 4]; weights: theirs, [F, 4].
    """

    corners: NDArray[np.int32]
    shares: Array
    controls: NDArray[np.int32]
    weights: Array


def wind_faces(cloth: Cloth) -> tuple[Faces, NDArray[np.int32]]:
    """The faces, and the particles [C] at which the wind is sampled.

    A grid's cells are quads with the wind interpolated between a few particles; any other
    cloth has triangles with a sample at every particle.
    """
    if cloth.grid_shape is None:
        a, b, c = cloth.triangles.T
        corners = np.stack([a, b, c, a], axis=1)
        shares = np.tile([1 / 3, 1 / 3, 1 / 3, 0.0], (len(corners), 1))
        return Faces(corners, shares, corners, shares), np.arange(
            len(cloth.rest_positions), dtype=np.int32
        )
    return _grid_faces(cloth, *cloth.grid_shape)


def _grid_faces(cloth: Cloth, rows: int, columns: int) -> tuple[Faces, NDArray[np.int32]]:
    index = np.arange(rows * columns, dtype=np.int32).reshape(rows, columns)
    quads = [index[:-1, :-1], index[1:, :-1], index[1:, 1:], index[:-1, 1:]]
    corners = np.stack(quads, axis=-1).reshape(-1, 4)
    rest = cloth.rest_positions.reshape(rows, columns, 3)
    down = _samples(np.linalg.norm(rest[-1, 0] - rest[0, 0]), rows)
    across = _samples(np.linalg.norm(rest[0, -1] - rest[0, 0]), columns)
    above, low = _between(down, rows)
    left, right = _between(across, columns)
    size = len(across)
    controls = np.stack(
        [
            above[:, None] * size + left,
            (above + 1)[:, None] * size + left,
            (above + 1)[:, None] * size + left + 1,
            above[:, None] * size + left + 1,
        ],
        axis=-1,
    )
    weights = np.stack(
        [
            np.outer(1 - low, 1 - right),
            np.outer(low, 1 - right),
            np.outer(low, right),
            np.outer(1 - low, right),
        ],
        axis=-1,
    )
    shares = np.full((len(corners), 4), 0.25)
    samples = index[np.ix_(down, across)].ravel()
    flat_controls = controls.reshape(-1, 4).astype(np.int32)
    return Faces(corners, shares, flat_controls, weights.reshape(-1, 4)), samples


def _samples(length: float, count: int) -> NDArray[np.int64]:
    """Lines of a grid side [m] of `count` particles on which the wind is sampled."""
    pieces = min(count - 1, max(1, int(np.ceil(length / SAMPLE_SPACING))))
    return np.round(np.linspace(0, count - 1, pieces + 1)).astype(np.int64)


def _between(samples: NDArray[np.int64], count: int) -> tuple[NDArray[np.int64], Array]:
    """For the middle of each cell: the sample before it, and its share of the way to the next."""
    middles = np.arange(count - 1) + 0.5
    before = np.searchsorted(samples, middles) - 1
    return before, (middles - samples[before]) / (samples[before + 1] - samples[before])
