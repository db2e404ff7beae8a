"""The built-in shapes of colliders, in the shape's frame. A collider's path moves them."""

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from drapery.arrays import Integers, Mask, Matrices, Triangles, Vectors
from drapery.cloth.colliders.user_defined import SignedDistance
from drapery.errors import OptionError
from drapery.mesh import Array

MAX_CELLS = 1 << 24
MAX_TRIANGLES = 1_000_000


@dataclass(frozen=True, eq=False)
class Sphere:
    """A ball.

    centre: [m], shape [3].
    radius: [m], above 0.

    Raises OptionError for a centre that is not finite and a radius not above 0.
    """

    centre: Vectors
    radius: float

    def __post_init__(self) -> None:
        _points("Sphere centre", self.centre, (3,))
        _lengths("Sphere radius", self.radius)


@dataclass(frozen=True, eq=False)
class Capsule:
    """All points within a distance of a segment.

    start: one end of the segment [m], shape [3].
    end: its other end [m], shape [3].
    radius: the distance [m].

    Raises OptionError for ends that are not finite and a radius not above 0.
    """

    start: Vectors
    end: Vectors
    radius: float

    def __post_init__(self) -> None:
        _points("Capsule start", self.start, (3,))
        _points("Capsule end", self.end, (3,))
        _lengths("Capsule radius", self.radius)


@dataclass(frozen=True, eq=False)
class Box:
    """A box of any rotation.

    centre: [m], shape [3].
    size: the three edge lengths [m], shape [3].
    rotation: of the box about its centre, a matrix of shape [3, 3].

    Raises OptionError for sizes not above 0 and other matrices.
    """

    centre: Vectors
    size: Vectors
    rotation: Matrices = field(default_factory=lambda: np.eye(3))

    def __post_init__(self) -> None:
        _points("Box centre", self.centre, (3,))
        _points("Box size", self.size, (3,))
        _lengths("Box size", self.size)
        _rotation("Box rotation", self.rotation)


@dataclass(frozen=True, eq=False)
class Plane:
    """A half-space: solid below a plane.

    point: any point of the plane [m], shape [3].
    normal: points to free space, shape [3], of any length above 0.

    Raises OptionError for a normal without a direction and numbers that are not finite.
    """

    point: Vectors
    normal: Vectors

    def __post_init__(self) -> None:
        _points("Plane point", self.point, (3,))
        _points("Plane normal", self.normal, (3,))
        _lengths("Plane normal", float(np.sqrt(np.square(np.asarray(self.normal, float)).sum())))


@dataclass(frozen=True, eq=False)
class Voxels:
    """Cubes of one size on a grid: part of a world of blocks, or a creature made of blocks.

    cells: integer cell coordinates, shape [M, 3]; cell (i, j, k) fills [i, i+1] x [j, j+1] x [k,
        k+1] times `size`. Faces between two filled cells never touch a cloth.
    size: edge length [m].

    Raises OptionError for coordinates that are not integers and a size not above 0.
    """

    cells: Integers
    size: float = 1.0

    def __post_init__(self) -> None:
        cells = np.asarray(self.cells)
        if cells.ndim != 2 or cells.shape[1] != 3 or not len(cells):
            raise OptionError(f"Voxels cells of shape {cells.shape}: give whole numbers [M, 3]")
        if not np.issubdtype(cells.dtype, np.integer):
            raise OptionError(f"Voxels cells of type {cells.dtype}: give whole numbers")
        extent = cells.max(axis=0).astype(float) - cells.min(axis=0) + 1
        if extent.prod() > MAX_CELLS:
            raise OptionError(
                f"Voxels spanning {extent.astype(int)} cells: split them; use at most {MAX_CELLS}"
            )
        _lengths("Voxels size", self.size)


@dataclass(frozen=True, eq=False)
class TriangleMesh:
    """A triangle surface; `mesh_collider`, `height_collider` and `load_mesh` make it.

    Connected parts that are closed are solid, and overlapping parts form a union; open parts are
    sheets that stop a cloth on both sides.

    vertices: [m], shape [V, 3]; no two equal.
    triangles: vertex indices, shape [T, 3], int32; counter-clockwise seen from outside.
    part: number of the connected part of each triangle, shape [T].
    solid: whether each part is closed, shape [P].
    """

    vertices: Vectors
    triangles: Triangles
    part: Integers
    solid: Mask


Shape = Sphere | Capsule | Box | Plane | Voxels | TriangleMesh | SignedDistance
"""What a collider can be; a SignedDistance is any object of your own with a distance that
numba compiles."""


def sixfold_volumes(vertices: Array, triangles: Triangles, part: NDArray[np.int32]) -> Array:
    """Six times the signed volume [m³] of every part, shape [P]; negative when inside out."""
    a, b, c = (vertices[triangles[:, i]] - vertices.mean(axis=0) for i in range(3))
    volumes = np.zeros(int(part.max()) + 1)
    np.add.at(volumes, part, np.einsum("ij,ij->i", a, np.cross(b, c)))
    return volumes


def _points(what: str, value: Array, shape: tuple[int, ...]) -> None:
    array = np.asarray(value, float)
    if array.shape != shape or not np.isfinite(array).all():
        raise OptionError(f"{what} {value}: give {shape[-1]} finite numbers")


def _lengths(what: str, value: Array | float) -> None:
    array = np.asarray(value, float)
    if not (np.isfinite(array).all() and (array > 0).all()):
        raise OptionError(f"{what} {value}: give lengths above 0")


def _rotation(what: str, value: Array) -> None:
    _points(what, np.ravel(value), (9,))
    matrix = np.asarray(value, float)
    product = np.einsum("ij,kj->ik", matrix, matrix)  # in a fixed order; BLAS may not be
    if not np.allclose(product, np.eye(3), atol=1e-9) or np.linalg.det(matrix) < 0:
        raise OptionError(f"{what}: give an orthonormal right-handed matrix [3, 3]")
