"""Flat normals: every triangle lit as the plane that it is."""

import numpy as np

from drapery.mesh import Mesh, face_normals


def faceted(mesh: Mesh) -> Mesh:
    """The mesh with corners of its own for each triangle, all with the triangle's normal.

    Positions are [..., 3 T, 3] afterwards. A triangle without area gets the normal (0, 0, 1).
    """
    corners = mesh.triangles.reshape(-1)
    faces = face_normals(mesh.positions, mesh.triangles)
    lengths = np.sqrt((faces * faces).sum(axis=-1, keepdims=True))
    unit = np.where(lengths > 0, faces / np.where(lengths > 0, lengths, 1), (0, 0, 1))
    return Mesh(
        mesh.positions[..., corners, :],
        unit.astype(mesh.normals.dtype).repeat(3, axis=-2),
        np.arange(len(corners), dtype=np.int32).reshape(-1, 3),
        mesh.uvs[corners],
    )
