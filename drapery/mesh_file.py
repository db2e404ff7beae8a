"""3-D files that a user names: triangles, and how their parts look."""

import logging
import warnings
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from io import BytesIO
from pathlib import Path
from typing import Any

import numpy as np

from drapery.arrays import Triangles
from drapery.errors import OptionError, counted
from drapery.mesh import Array
from drapery.mesh_headers import CHECKS, MAX_PARTS, MeshLimits
from drapery.user_files import read_user_file, shown_path

MESH_ENDINGS = tuple(CHECKS)
"""How the names of 3-D files end."""
MAX_BYTES = 256 << 20
"""The largest 3-D file that a program reads as cloth or collider [bytes]."""
MAX_FACES = 2_000_000
"""The most triangles of such a file."""

# The loggers of trimesh's modules lie below this one. A handler keeps Python from writing what they
# say to standard error.
_LOG = logging.getLogger("trimesh")
_LOG.addHandler(logging.NullHandler())

MAX_UV = 10_000
"""The largest texture coordinate; a texture repeats after 1."""


@dataclass(frozen=True, eq=False)
class FilePart:
    """A part of a file, moved to its place in it.

    positions: [N, 3], in the file's unit. triangles: [T, 3]. uvs: [N, 2], v upwards, or None.
    visual: trimesh's description of its colours.
    """

    positions: Array
    triangles: Triangles
    uvs: Array | None
    visual: Any


def read_mesh_file(
    path: str | Path, max_bytes: int = MAX_BYTES, max_faces: int = MAX_FACES
) -> list[FilePart]:
    """The parts of a .glb, .obj, .ply or .stl file, at least one; each has a triangle.

    Nothing but the file is read: no other file that it names, and no address. Raises OptionError
    that names the file for one that cannot be read, is broken, or exceeds a bound.
    """
    path = Path(path)
    name = f"mesh {shown_path(path)}"
    ending = path.suffix.lower()
    if ending not in CHECKS:
        raise OptionError(f"{name} is no 3-D file that is read; use {', '.join(CHECKS)}")
    data = read_user_file(path, max_bytes, name=name, shorter="simplify it")
    limits = MeshLimits(name, max_faces)
    checked = CHECKS[ending](data, limits)
    try:
        with _quiet():
            parts = [*_parts(checked, ending)]
    except Exception:  # trimesh's readers raise errors of many types
        raise OptionError(f"{name} cannot be read; export it again, with faces") from None
    if not parts:
        raise OptionError(f"{name} has no triangles; export it with faces")
    limits.check_faces(sum(len(part.triangles) for part in parts))
    for part in parts:
        check_triangles(part.positions, part.triangles, name)
        uvs = part.uvs
        if uvs is not None and not (
            uvs.shape == (len(part.positions), 2) and (np.abs(uvs) <= MAX_UV).all()
        ):
            raise limits.refuse(f"has texture coordinates that are no numbers up to {MAX_UV}")
    return parts


def joined(parts: Sequence[FilePart]) -> tuple[Array, Triangles]:
    """The positions [N, 3] and triangles [T, 3] of all parts as one."""
    starts = np.cumsum([0, *(len(part.positions) for part in parts)])
    triangles = [part.triangles + start for part, start in zip(parts, starts, strict=False)]
    return np.concatenate([part.positions for part in parts]), np.concatenate(triangles)


def check_triangles(positions: Array, triangles: Triangles, name: str) -> None:
    """Raise OptionError that says what is wrong with a mesh, how large it is, and what helps.

    positions: [N, 3]. triangles: indices [T, 3], of any whole type. name: of the mesh in messages.
    """
    count = len(positions)
    if not len(triangles):
        raise OptionError(f"{name} has no triangles; give one with faces")
    vertices = counted(count, "vertex", "vertices")
    low, high = int(triangles.min()), int(triangles.max())
    if low < 0 or high >= count:
        remedy = "they count from 0"
        if (low, high) == (1, count):
            remedy = "they count from 0: subtract 1 from each"
        elif low < 0:
            remedy = "they count from 0, and none counts from the end"
        raise OptionError(
            f"{name} has {vertices}, and its triangles name {low} to {high}; {remedy}"
        )
    wrong = ~np.isfinite(positions).all(axis=1)
    if wrong.any():
        raise OptionError(
            f"{name} has {vertices}, and the positions of {int(wrong.sum())} are no finite"
            f" numbers, first at vertex {int(wrong.argmax())}; positions must be finite"
        )


def _parts(data: bytes, ending: str) -> Iterator[FilePart]:
    import trimesh

    scene: Any = trimesh.load(
        BytesIO(data), file_type=ending[1:], force="scene", process=False, resolver=None
    )
    nodes = [scene.graph[node] for node in scene.graph.nodes_geometry]
    if len(nodes) > MAX_PARTS:
        raise ValueError(f"it has over {MAX_PARTS} parts")
    for matrix, name in nodes:
        part = scene.geometry[name]
        if not hasattr(part, "faces") or not len(part.faces):
            raise ValueError("a part has no triangles; leave that part out")
        uvs = getattr(part.visual, "uv", None)
        yield FilePart(
            _moved(np.asarray(part.vertices, float), np.asarray(matrix, float)),
            np.asarray(part.faces),
            None if uvs is None else np.asarray(uvs, float)[:, :2],
            part.visual,
        )


def _moved(points: Array, matrix: Array) -> Array:
    if np.array_equal(matrix, np.eye(4)):
        return points
    # einsum adds in a fixed order; BLAS may not.
    turned: Array = np.einsum("ij,nj->ni", matrix[:3, :3], points)
    return turned + matrix[:3, 3]


@contextmanager
def _quiet() -> Iterator[None]:
    """Without the library's log and NumPy's warnings: what is wrong is raised."""
    before, _LOG.propagate = _LOG.propagate, False
    try:
        with warnings.catch_warnings(action="ignore"), np.errstate(all="ignore"):
            yield
    finally:
        _LOG.propagate = before
