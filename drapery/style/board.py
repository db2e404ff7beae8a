"""Cloth as the game shows it: a stiff board below its top edge."""

import numpy as np

from drapery.elementary import cos, sin
from drapery.mesh import Array, Mesh
from drapery.style.extrusion import extrude
from drapery.style.uv_mapping import UVMapping


def stiff_board(size: tuple[float, float], thickness: float, uv_mapping: UVMapping) -> Mesh:
    """A board of this width and height [m]; its top edge runs along x through the origin."""
    left, bottom = -size[0] / 2, -size[1]
    right = -left
    corners = np.array([[left, 0, 0], [right, 0, 0], [left, bottom, 0], [right, bottom, 0]])
    thin = Mesh(
        corners,
        np.broadcast_to([0.0, 0.0, 1.0], (4, 3)),
        np.array([[0, 2, 1], [1, 2, 3]], np.int32),
        np.array([[0.0, 0.0], [1, 0], [0, 1], [1, 1]]),
    )
    return extrude(thin, thickness, uv_mapping)


def tilted(mesh: Mesh, angle: float) -> Mesh:
    """The mesh turned about the x axis [radians]; a negative angle lifts its foot to the front."""
    cosine, sine = cos(angle), sin(angle)
    matrix = np.array([[1, 0, 0], [0, cosine, -sine], [0, sine, cosine]])
    # einsum adds in a fixed order; BLAS may not.
    positions = np.einsum("ij,...j->...i", matrix, mesh.positions)
    normals = np.einsum("ij,...j->...i", matrix, mesh.normals)
    return Mesh(positions, normals, mesh.triangles, mesh.uvs)


def moved(mesh: Mesh, offset: Array) -> Mesh:
    """The mesh moved [m]."""
    return Mesh(mesh.positions + offset, mesh.normals, mesh.triangles, mesh.uvs)
