"""Triangle meshes as plain arrays. The last axis is the vector, every earlier axis a batch."""

import math
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from drapery.arrays import Triangles, UVs, Vectors
from drapery.errors import OptionError

Array = NDArray[np.floating[Any]]


@dataclass(frozen=True, eq=False)
class Mesh:
    """A textured surface, or a batch of surfaces that share their triangles and UVs.

    positions: vertex positions [m], shape [..., V, 3]; y up, right-handed.
    normals: unit vertex normals, shape [..., V, 3].
    triangles: vertex indices, shape [T, 3], int32; counter-clockwise seen from outside.
    uvs: texture coordinates, shape [V, 2], as fractions of the sheet; (0, 0) is its top left
        corner and v grows downwards, as in an image and in glTF.
    """

    positions: Vectors
    normals: Vectors
    triangles: Triangles
    uvs: UVs


def make_mesh(positions: ArrayLike, triangles: ArrayLike, uvs: ArrayLike | None = None) -> Mesh:
    """A mesh with the vertex normals of its positions.

    positions: [m], shape [..., V, 3]; other types than float32 become float64.
    triangles: vertex indices, shape [T, 3], counter-clockwise seen from outside.
    uvs: shape [V, 2]; None is (0, 0) everywhere, for a plain colour.
    Raises OptionError for other shapes, for indices outside the vertices, and for positions that
    are not finite numbers.
    """
    points, corners = np.asarray(positions), np.asarray(triangles)
    points = points if points.dtype == np.float32 else points.astype(np.float64)
    if points.ndim < 2 or points.shape[-1] != 3 or not np.isfinite(points).all():
        raise OptionError(f"positions of shape {points.shape}: use [..., V, 3] of finite numbers")
    count = points.shape[-2]
    if corners.ndim != 2 or corners.shape[1] != 3 or not np.issubdtype(corners.dtype, np.integer):
        raise OptionError(
            f"triangles of shape {corners.shape} and type {corners.dtype}: use [T, 3] of integers"
        )
    if corners.size and not (corners.min() >= 0 and corners.max() < count):
        raise OptionError(f"triangles name vertices outside the {count} positions; use 0 to V - 1")
    places = np.zeros((count, 2)) if uvs is None else np.asarray(uvs, np.float64)
    if places.shape != (count, 2):
        raise OptionError(f"uvs of shape {places.shape}: use ({count}, 2), one for each position")
    faces = corners.astype(np.int32)
    return Mesh(points, vertex_normals(points, faces), faces, places)


def grid_surface(rows: int, columns: int) -> tuple[Triangles, UVs]:
    """The triangles of a grid of points, row by row from the top left, and their UVs.

    Two a cell, counter-clockwise seen from +z: shape [2 (rows - 1) (columns - 1), 3]. The UVs are
    0..1 from the top left: shape [rows * columns, 2].
    """
    across, down = np.meshgrid(np.linspace(0, 1, columns), np.linspace(0, 1, rows))
    index = np.arange(rows * columns, dtype=np.int32).reshape(rows, columns)
    a, b, c, d = index[:-1, :-1], index[1:, :-1], index[1:, 1:], index[:-1, 1:]
    lower = np.stack([a, b, c], axis=-1).reshape(-1, 3)
    upper = np.stack([a, c, d], axis=-1).reshape(-1, 3)
    triangles = np.stack([lower, upper], axis=1).reshape(-1, 3)
    return triangles, np.stack([across, down], axis=-1).reshape(-1, 2)


def face_normals(positions: Vectors, triangles: Triangles) -> Vectors:
    """Triangle normals, shape [..., T, 3], with length twice the triangle's area [m²].

    positions: [m], shape [..., V, 3].
    triangles: vertex indices, shape [T, 3].
    """
    a, b, c = (positions[..., triangles[:, corner], :] for corner in range(3))
    return np.cross(b - a, c - a)


def vertex_normals(positions: Vectors, triangles: Triangles) -> Vectors:
    """Unit normals, shape [..., V, 3]: the average of the faces at a vertex, weighted by area.

    A vertex without area around it gets (0, 0, 1), never NaN.

    positions: [m], shape [..., V, 3].
    triangles: vertex indices, shape [T, 3].
    """
    return normals_around(positions, triangles, faces_around(triangles, positions.shape[-2]))


def normals_around(positions: Array, triangles: Triangles, around: NDArray[np.intp]) -> Array:
    """The same for triangles whose `faces_around` are known."""
    points = _planes(positions)
    a, b, c = ([plane[triangles[:, corner]] for plane in points] for corner in range(3))
    faces = _cross(
        [q - p for p, q in zip(a, b, strict=True)], [q - p for p, q in zip(a, c, strict=True)]
    )
    sums = [_sum_of_rows(plane, around) for plane in faces]
    lengths = np.sqrt(sums[0] * sums[0] + sums[1] * sums[1] + sums[2] * sums[2])
    flat = lengths < np.finfo(positions.dtype).tiny ** 0.5
    safe = np.where(flat, 1, lengths)
    unit = [np.where(flat, z, plane / safe) for plane, z in zip(sums, (0, 0, 1), strict=True)]
    by_vertex = np.stack(unit, axis=-1).reshape(positions.shape[-2], *positions.shape[:-2], 3)
    return np.ascontiguousarray(np.moveaxis(by_vertex, 0, -2))


def _planes(positions: Array) -> list[Array]:
    """x, y and z of [..., V, 3], each [V, batch], so that a loop runs over a whole batch."""
    *batch, count, _ = positions.shape
    shape = count, math.prod(batch)
    return [np.moveaxis(positions[..., axis], -1, 0).reshape(shape) for axis in range(3)]


def _cross(u: list[Array], v: list[Array]) -> list[Array]:
    return [
        u[1] * v[2] - u[2] * v[1],
        u[2] * v[0] - u[0] * v[2],
        u[0] * v[1] - u[1] * v[0],
    ]


def faces_around(triangles: Triangles, count: int) -> NDArray[np.intp]:
    """The triangles at each vertex, shape [V, D] for the largest degree D; unused entries are T."""
    corners = triangles.T.reshape(-1)
    order = np.argsort(corners, kind="stable")
    degrees = np.bincount(corners, minlength=count)
    place = np.arange(len(order)) - (np.cumsum(degrees) - degrees)[corners[order]]
    around = np.full((count, max(1, int(degrees.max(initial=0)))), len(triangles))
    around[corners[order], place] = order % max(1, len(triangles))
    return around


def _sum_of_rows(rows: Array, around: NDArray[np.intp]) -> Array:
    """Sums of the rows [T, batch] named for each vertex, added in their order."""
    padded = np.concatenate([rows, np.zeros_like(rows, shape=(1, rows.shape[1]))])
    total: Array = padded[around[:, 0]]
    for column in around.T[1:]:
        total = total + padded[column]
    return total
