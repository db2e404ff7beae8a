"""Cloths in the shape of a triangle mesh."""

from os import PathLike
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from drapery.arrays import Triangles, UVs, Vectors
from drapery.cloth.bending import triangle_bending
from drapery.cloth.builders import (
    DEFAULT,
    MAX_PARTICLES,
    check_fabric,
    check_particles,
    check_size,
)
from drapery.cloth.checks import check_count
from drapery.cloth.cloth import FLEXION, STRUCTURAL, Cloth
from drapery.cloth.fabric import Fabric
from drapery.cloth.pins import Pins, pinned_particles
from drapery.elementary import cos, sin
from drapery.errors import OptionError, shown
from drapery.mesh import Array, face_normals
from drapery.mesh_file import check_triangles, joined, read_mesh_file

WELD = 1e-6
"""Vertices of a loaded mesh that are nearer than this fraction of its size become one particle."""


def from_triangles(
    positions: Vectors,
    triangles: Triangles,
    *,
    uvs: UVs | None = None,
    pins: Pins = "none",
    fabric: Fabric = DEFAULT,
) -> Cloth:
    """A cloth in the shape of a triangle mesh.

    Structural springs are its edges. Flexion springs join the two vertices opposite each inner edge
    and resist bending there. A particle has a third of the mass of its triangles.

    positions: at rest [m], shape [N, 3].
    triangles: particle indices, shape [T, 3].
    uvs: texture coordinates, shape [N, 2]; by default the x and y of the rest shape, scaled to
        0..1.
    pins: see `pinned_particles`.
    fabric: the material.

    Raises OptionError for arrays of wrong shape and indices out of range.
    """
    check_fabric(fabric)
    try:
        rest, faces = np.array(positions, float), np.array(triangles)
    except (TypeError, ValueError):
        raise OptionError(
            "positions [N, 3] and triangles [T, 3] must be arrays of numbers"
        ) from None
    _check_triangles(rest, faces)
    areas = np.linalg.norm(face_normals(rest, faces), axis=1) / 2
    masses = np.zeros(len(rest))
    np.add.at(masses, faces.ravel(), np.repeat(fabric.density * areas / 3, 3))
    if not (masses > 0).all():
        alone = int(np.argmin(masses > 0))
        raise OptionError(f"vertex {alone} belongs to no triangle with an area; remove it")
    inv_mass = 1.0 / masses
    inv_mass[pinned_particles(pins, rest, None)] = 0.0
    edges, bends = mesh_springs(faces)
    pairs = np.concatenate([edges, bends])
    kinds = np.repeat(np.array([STRUCTURAL, FLEXION], np.uint8), [len(edges), len(bends)])
    return Cloth(
        rest_positions=rest,
        inv_mass=inv_mass,
        spring_pairs=pairs,
        spring_length=np.linalg.norm(rest[pairs[:, 1]] - rest[pairs[:, 0]], axis=1),
        spring_stiffness=np.array(fabric.stiffness)[kinds],
        spring_kind=kinds,
        triangles=faces.astype(np.int32),
        uvs=flat_uvs(rest) if uvs is None else np.array(uvs, float),
        drag=fabric.drag,
        bending=triangle_bending(rest, faces, fabric.bending, fabric.damping),
    )


def _check_triangles(rest: Array, faces: NDArray[np.integer]) -> None:
    if rest.ndim != 2 or rest.shape[1] != 3 or not np.isfinite(rest).all():
        raise OptionError(f"positions of shape {rest.shape} must be finite numbers [N, 3]")
    check_particles("mesh", len(rest))
    if faces.ndim != 2 or faces.shape[1] != 3 or not np.issubdtype(faces.dtype, np.integer):
        raise OptionError(f"triangles of shape {faces.shape} must be whole numbers [T, 3]")
    if not faces.size or faces.min() < 0 or faces.max() >= len(rest):
        raise OptionError(f"triangles must use vertices 0 to {len(rest) - 1}, at least once")


def mesh_springs(
    faces: NDArray[np.integer],
) -> tuple[NDArray[np.int32], NDArray[np.int32]]:
    """Edges [E, 2], each once, and pairs of vertices opposite an inner edge [F, 2]."""
    corners = np.concatenate([np.roll(faces, -turn, axis=1) for turn in range(3)])
    ends = np.sort(corners[:, :2], axis=1)
    order = np.lexsort((ends[:, 1], ends[:, 0]))
    ends, opposite = ends[order], corners[order, 2]
    same = (ends[1:] == ends[:-1]).all(axis=1)
    edges = ends[np.concatenate([[True], ~same])]
    bends = np.stack([opposite[:-1][same], opposite[1:][same]], axis=1)
    bends = np.unique(np.sort(bends[bends[:, 0] != bends[:, 1]], axis=1), axis=0)
    known = set(map(tuple, edges.tolist()))
    new = np.array([tuple(pair) not in known for pair in bends.tolist()], bool)
    return edges.astype(np.int32), bends[new].reshape(-1, 2).astype(np.int32)


def flat_uvs(rest: Array) -> Array:
    """x to the right and y upwards as fractions of the sheet, (0, 0) top left, [N, 2]."""
    low, size = rest[:, :2].min(axis=0), np.ptp(rest[:, :2], axis=0)
    parts: Array = (rest[:, :2] - low) / np.where(size > 0, size, 1.0)
    return np.stack([parts[:, 0], 1.0 - parts[:, 1]], axis=1)


def from_mesh(mesh: Any, **options: Any) -> Cloth:
    """A cloth in the shape of a mesh.

    Vertices at one position, as at the seams of a texture, become one particle.

    mesh: a `trimesh.Trimesh`, or the path of a .glb, .obj, .ply or .stl file.
    options: those of `from_triangles` by name.

    Raises OptionError for a file that cannot be read, and as `from_triangles` does.
    """
    name = f"mesh {mesh}" if isinstance(mesh, str | PathLike) else "mesh"
    positions, faces, uv = _arrays(mesh, name)
    grain = WELD * float(np.ptp(positions, axis=0).max())
    cells = np.round(positions / max(grain, 1e-30)).astype(np.int64)
    _, first, number = np.unique(cells, axis=0, return_index=True, return_inverse=True)
    # Particles keep the order of the vertices they come from.
    rank = np.argsort(np.argsort(first))
    kept, faces = np.sort(first), rank[number.ravel()][faces]
    whole = np.array([len(set(face)) == 3 for face in faces.tolist()], bool)
    if uv is not None and "uvs" not in options and len(uv) == len(positions):
        # trimesh counts v upwards.
        options["uvs"] = np.asarray(uv, float)[kept, :2] * [1, -1] + [0, 1]
    if not whole.any():
        extent = " x ".join(f"{side:.4g}" for side in np.ptp(positions, axis=0))
        raise OptionError(f"{name} of {extent} has no triangle with an area; give one with faces")
    return from_triangles(positions[kept], faces[whole].reshape(-1, 3), **options)


def _arrays(mesh: Any, name: str) -> tuple[Array, NDArray[np.integer], Array | None]:
    """Positions [N, 3], triangles [T, 3] and texture coordinates [N, 2] of a mesh or a file."""
    if isinstance(mesh, str | PathLike):
        parts = read_mesh_file(Path(mesh))
        every = [part.uvs for part in parts if part.uvs is not None]
        return *joined(parts), np.concatenate(every) if len(every) == len(parts) else None
    if not (hasattr(mesh, "faces") and hasattr(mesh, "vertices")):
        raise OptionError(f"{shown(mesh)} is no mesh; give a trimesh.Trimesh or the path of a file")
    positions, faces = np.asarray(mesh.vertices, float), np.asarray(mesh.faces)
    check_triangles(positions, faces, name)
    return positions, faces, getattr(getattr(mesh, "visual", None), "uv", None)


def disc(
    rings: int,
    radius: float,
    *,
    pins: Pins = "none",
    fabric: Fabric = DEFAULT,
) -> Cloth:
    """A round cloth about the origin, level and facing up: particle 0, then rings of 6, 12, 18, ….

    rings: number of rings around particle 0.
    radius: [m], up to 1e6.
    pins: see `pinned_particles`.
    fabric: the material; its mass is shared by the particles.

    Raises OptionError for numbers out of range.
    """
    check_count("disc rings", rings, 1, MAX_PARTICLES)
    check_particles("disc", 1 + 3 * rings * (rings + 1))
    check_size("disc radius", radius)
    points, faces = [np.zeros((1, 3))], []
    for ring in range(1, rings + 1):
        turns = 2 * np.pi * np.arange(6 * ring) / (6 * ring)
        x, z = cos(turns), -sin(turns)
        points.append(radius * ring / rings * np.stack([x, 0 * x, z], axis=1))
        faces += _ring_faces(ring)
    rest = np.concatenate(points)
    uvs = 0.5 + 0.5 * rest[:, [0, 2]] / radius
    return from_triangles(rest, np.array(faces), uvs=uvs, pins=pins, fabric=fabric)


def _ring_faces(ring: int) -> list[tuple[int, int, int]]:
    """Triangles between ring - 1 and ring, counter-clockwise seen from above."""
    outer, inner = 1 + 3 * ring * (ring - 1), 1 + 3 * (ring - 1) * (ring - 2)
    count, before = 6 * ring, max(1, 6 * (ring - 1))
    if ring == 1:
        inner = 0
    faces = []
    for sector in range(6):
        for i in range(ring):
            a, b = sector * ring + i, sector * ring + i + 1
            c = inner + (sector * (ring - 1) + i) % before
            faces.append((c, outer + a, outer + b % count))
            if i < ring - 1:
                d = inner + (sector * (ring - 1) + i + 1) % before
                faces.append((c, outer + b % count, d))
    return faces
