"""Triangle meshes as plain arrays. The last axis is the vector, every earlier axis a batch."""

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.floating[Any]]
Triangles = NDArray[np.int32]


@dataclass(frozen=True, eq=False)
class Mesh:
    """A textured surface, or a batch of surfaces that share their triangles and UVs.

    positions: vertex positions [m], shape [..., V, 3]; y up, right-handed.
    normals: unit vertex normals, shape [..., V, 3].
    triangles: vertex indices, shape [T, 3], int32; counter-clockwise seen from outside.
    uvs: texture coordinates, shape [V, 2], as fractions of the sheet; (0, 0) is its top left
        corner and v grows downwards, as in an image and in glTF.
    """

    positions: Array
    normals: Array
    triangles: Triangles
    uvs: Array


def face_normals(positions: Array, triangles: Triangles) -> Array:
    """Triangle normals, shape [..., T, 3], with length twice the triangle's area [m²]."""
    a, b, c = (positions[..., triangles[:, corner], :] for corner in range(3))
    return np.cross(b - a, c - a)


def vertex_normals(positions: Array, triangles: Triangles) -> Array:
    """Unit normals, shape [..., V, 3]: the average of the faces at a vertex, weighted by area.

    A vertex without area around it gets (0, 0, 1), never NaN.
    """
    faces = face_normals(positions, triangles)
    by_vertex = np.zeros((positions.shape[-2], *positions.shape[:-2], 3), positions.dtype)
    for corner in range(3):
        # np.add.at adds in index order, so the same input gives the same bits.
        np.add.at(by_vertex, triangles[:, corner], np.moveaxis(faces, -2, 0))
    sums = np.moveaxis(by_vertex, 0, -2)
    lengths = np.linalg.norm(sums, axis=-1, keepdims=True)
    flat = lengths < np.finfo(positions.dtype).tiny ** 0.5
    return np.where(flat, np.array([0, 0, 1], positions.dtype), sums / np.where(flat, 1, lengths))
