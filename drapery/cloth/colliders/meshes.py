"""Triangle meshes as colliders: from arrays, files and height maps."""

from pathlib import Path

import numpy as np
from numpy.typing import ArrayLike, NDArray

from drapery.arrays import Triangles
from drapery.cloth.colliders.shapes import MAX_TRIANGLES, TriangleMesh, sixfold_volumes
from drapery.errors import OptionError
from drapery.mesh import Array, face_normals
from drapery.mesh_file import joined, read_mesh_file


def mesh_collider(vertices: ArrayLike, triangles: ArrayLike) -> TriangleMesh:
    """A collider from a triangle mesh.

    Vertices at the same position are merged, triangles without area are removed, and closed parts
    that are inside out are reversed.

    vertices: [m], shape [V, 3].
    triangles: vertex indices, shape [T, 3].

    Raises OptionError for arrays of wrong shape, indices out of range and numbers that are not
    finite.
    """
    points, faces = _checked(np.asarray(vertices, float), np.asarray(triangles))
    points, faces = _welded(points, faces)
    part = _parts(faces, len(points))
    solid = _closed(faces, part)
    inside_out = solid & (sixfold_volumes(points, faces, part) < 0)
    faces[inside_out[part]] = faces[inside_out[part]][:, ::-1]
    return TriangleMesh(points, faces, part, solid)


def load_mesh(path: str | Path, scale: float = 1.0) -> TriangleMesh:
    """A collider from a file of a mesh.

    path: a .glb, .obj, .ply or .stl file.
    scale: metres in one unit of the file.

    Raises OptionError for a file that cannot be read.
    """
    points, faces = joined(read_mesh_file(path, max_faces=MAX_TRIANGLES))
    try:
        return mesh_collider(points * scale, faces)
    except OptionError as error:
        raise OptionError(f"{path}: {error}") from None


def height_collider(heights: ArrayLike, cell: float = 1.0, depth: float = 1.0) -> TriangleMesh:
    """Solid ground under a height map.

    heights: height of the ground [m] at x = column · cell, z = row · cell; shape [R, C].
    cell: distance between neighbouring heights [m].
    depth: thickness of the ground below its lowest point [m].

    Raises OptionError for other shapes and numbers that are not finite.
    """
    surface = np.asarray(heights, float)
    if surface.ndim != 2 or min(surface.shape) < 2 or not np.isfinite(surface).all():
        raise OptionError(f"heights of shape {surface.shape}: give finite numbers, 2 x 2 or more")
    if not (cell > 0 and depth > 0):
        raise OptionError(f"cell {cell} m, depth {depth} m: give lengths above 0")
    rows, columns = surface.shape
    z, x = np.meshgrid(np.arange(rows) * cell, np.arange(columns) * cell, indexing="ij")
    top = np.stack([x, surface, z], axis=-1).reshape(-1, 3)
    base = top.copy()
    base[:, 1] = surface.min() - depth
    return mesh_collider(np.vstack([top, base]), _ground_faces(rows, columns))


def _ground_faces(rows: int, columns: int) -> Triangles:
    """Top, base and the wall around them; the base's vertices follow the top's."""
    index = np.arange(rows * columns).reshape(rows, columns)
    a, b, c, d = index[:-1, :-1], index[:-1, 1:], index[1:, 1:], index[1:, :-1]
    top = np.concatenate([np.stack(f, axis=-1).reshape(-1, 3) for f in ((a, d, c), (a, c, b))])
    rim = np.concatenate([index[0], index[1:, -1], index[-1, -2::-1], index[-2:0:-1, 0]])
    after, under = np.roll(rim, -1), rows * columns
    wall = np.concatenate(
        [np.stack([rim, after, after + under], 1), np.stack([rim, after + under, rim + under], 1)]
    )
    return np.concatenate([top, top[:, ::-1] + under, wall]).astype(np.int32)


def _checked(vertices: Array, triangles: NDArray[np.integer]) -> tuple[Array, Triangles]:
    if vertices.ndim != 2 or vertices.shape[1] != 3 or not np.isfinite(vertices).all():
        raise OptionError(f"mesh vertices of shape {vertices.shape}: give finite numbers [V, 3]")
    if triangles.ndim != 2 or triangles.shape[1] != 3 or not len(triangles):
        raise OptionError(f"mesh triangles of shape {triangles.shape}: give indices [T, 3]")
    if len(triangles) > MAX_TRIANGLES:
        raise OptionError(f"mesh of {len(triangles)} triangles: {MAX_TRIANGLES} is the most")
    if not np.issubdtype(triangles.dtype, np.integer):
        raise OptionError(f"mesh triangles of type {triangles.dtype}: give whole numbers")
    if triangles.min() < 0 or triangles.max() >= len(vertices):
        raise OptionError(f"mesh triangles: an index is outside 0 to {len(vertices) - 1}")
    return vertices, triangles.astype(np.int32)


def _welded(vertices: Array, triangles: Triangles) -> tuple[Array, Triangles]:
    points, place = np.unique(vertices, axis=0, return_inverse=True)
    faces = place.reshape(-1)[triangles].astype(np.int32)
    area = np.linalg.norm(face_normals(points, faces), axis=-1)
    faces = np.ascontiguousarray(faces[area > 0])
    if not len(faces):
        raise OptionError("mesh: no triangle has any area")
    return points, faces


def _parts(triangles: Triangles, count: int) -> NDArray[np.int32]:
    from scipy.sparse import coo_array
    from scipy.sparse.csgraph import connected_components

    ends = np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]]])
    graph = coo_array((np.ones(len(ends)), (ends[:, 0], ends[:, 1])), shape=(count, count))
    label = connected_components(graph, directed=False)[1][triangles[:, 0]]
    return np.unique(label, return_inverse=True)[1].astype(np.int32)


def _closed(triangles: Triangles, part: NDArray[np.int32]) -> NDArray[np.bool_]:
    """Whether each edge of a part occurs exactly once in each direction, [P]."""
    half_edges = np.concatenate([triangles[:, [i, (i + 1) % 3]] for i in range(3)]).astype(np.int64)
    count = int(triangles.max()) + 1
    there, uses = np.unique(half_edges @ np.array([count, 1]), return_counts=True)
    back = np.isin(half_edges @ np.array([1, count]), there[uses == 1])
    once = np.isin(half_edges @ np.array([count, 1]), there[uses == 1])
    open_edges = np.bincount(np.tile(part, 3)[~(back & once)], minlength=int(part.max()) + 1)
    closed: NDArray[np.bool_] = open_edges == 0
    return closed
