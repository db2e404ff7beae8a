"""Scenes divided into meshes for 3-D files: one atlas, and the positions of each frame.

A 3-D file has one texture for a surface, so the layers are composited first.
"""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from drapery.arrays import Texels, Triangles
from drapery.errors import OptionError
from drapery.mesh import Array
from drapery.render.drawlist import DrawList, Float32, Topology, draw_list
from drapery.render.flatten import composite_layers
from drapery.render.materials import ALPHA_CODES, MaterialTables
from drapery.render.scene import Alpha, RiggedModel, Scene

MAX_NUMBERS = 1 << 27
"""The most coordinates of a 3-D file's frames; half a GiB."""


@dataclass(frozen=True, eq=False)
class MeshPart:
    """The triangles of one model with the same alpha mode and lighting.

    positions, normals: [m], shape [F, V, 3]; F is 1 if the part does not move.
    triangles: shape [T, 3]. uvs: fractions of the atlas, v downwards, shape [V, 2].
    closed: whether it has an inside, so that nobody sees the back of a triangle.
    skin: the bones that move it; None for meshes without bones.
    """

    name: str
    positions: Float32
    normals: Float32
    triangles: Triangles
    uvs: Float32
    alpha: Alpha
    lit: bool
    closed: bool = False
    skin: "MeshSkin | None" = None


@dataclass(frozen=True, eq=False)
class MeshSkin:
    """The bones of a part. member: of each vertex, shape [V], int32.

    bones: their names. joints: at rest [m], shape [B, 3]. positions, normals: of the part before
    bones move it, shape [V, 3]. places, rotations: of the bones in each frame, shape [F, B, 3] and
    [F, B, 3, 3]: a vertex x at rest is at rotation x + place.
    """

    bones: tuple[str, ...]
    joints: Array
    member: NDArray[np.int32]
    positions: Float32
    normals: Float32
    places: Array
    rotations: Array


@dataclass(frozen=True, eq=False)
class MeshParts:
    """The contents of a 3-D file. frames: number of frames. atlas: the texture of all parts."""

    parts: tuple[MeshPart, ...]
    atlas: Texels
    frames: int


def take_apart(scenes: Iterable[Scene]) -> MeshParts:
    """The parts of an animation's scenes, whose models may differ only in their positions.

    Raises OptionError if they differ otherwise, and if there is nothing or too much to write.
    """
    first: DrawList | None = None
    positions, normals = [], []
    rigged: dict[int, list[RiggedModel]] = {}
    names: list[str] = []
    for number, scene in enumerate(scenes):
        names = names or [model.name for model in scene.models]
        for place, model in enumerate(scene.models):
            if isinstance(model, RiggedModel):
                rigged.setdefault(place, []).append(model)
        drawing = draw_list(scene.models)
        first = first or drawing
        if not _same(first.topology, drawing.topology):
            raise OptionError(f"frame {number} has other meshes than frame 0; animate one scene")
        positions.append(drawing.positions)
        normals.append(drawing.normals)
        if len(positions) * drawing.positions.size > MAX_NUMBERS:
            raise OptionError(
                f"{number + 1} frames of {len(drawing.positions)} vertices are too much for a 3-D"
                " file; use fewer frames, or a coarser grid"
            )
    if first is None or not len(first.topology.triangles):
        raise OptionError("there is no mesh to write")
    moments = np.stack(positions), np.stack(normals)
    if not all(np.isfinite(values).all() for values in moments):
        raise OptionError("the meshes have positions or normals that are not finite numbers")
    return _parts(first.topology, *moments, rigged, names)


def _same(one: Topology, other: Topology) -> bool:
    return one is other or all(
        np.array_equal(getattr(one, name), getattr(other, name))
        for name in ("triangles", "uvs", "triangle_material", "vertex_start")
    )


def _parts(
    topology: Topology,
    positions: Float32,
    normals: Float32,
    rigged: Mapping[int, Sequence[RiggedModel]],
    names: Sequence[str],
) -> MeshParts:
    material_tables = composite_layers(topology.material_tables)
    if (material_tables.material_layers[:, 1] > 1).any():
        raise OptionError(
            "a 3-D file takes one texture for a surface, and these layers' sizes do not divide one"
            " another, or are too many; draw them as one texture"
        )
    uvs = _atlas_uvs(topology, material_tables)
    parts: list[MeshPart] = []
    for number, (start, end) in enumerate(_spans(topology.vertex_start)):
        inside = (topology.triangles[:, 0] >= start) & (topology.triangles[:, 0] < end)
        for alpha, code in ALPHA_CODES.items():
            for lit in (True, False):
                alike = (material_tables.material_alpha == code) & (
                    material_tables.material_lit == lit
                )
                chosen = topology.triangles[inside & alike[topology.triangle_material]]
                if len(chosen):
                    name = _name(names[number], number, alpha, lit, [each.name for each in parts])
                    part = _part(name, positions, normals, chosen, uvs, alpha, lit)
                    if number in rigged:
                        used = np.unique(chosen) - start
                        part = replace(part, skin=_skin(rigged[number], used))
                    parts.append(part)
    return MeshParts(tuple(parts), material_tables.atlas, len(positions))


def _skin(models: Sequence[RiggedModel], used: NDArray[np.int64]) -> MeshSkin:
    """The bones of the vertices that a part uses, of a model in all frames."""
    rig = models[0].rig
    return MeshSkin(
        rig.bones,
        rig.joints,
        rig.member[used],
        rig.rest.positions[used].astype(np.float32),
        rig.rest.normals[used].astype(np.float32),
        np.stack([model.places for model in models]),
        np.stack([model.rotations for model in models]),
    )


def _name(given: str, number: int, alpha: Alpha, lit: bool, taken: Sequence[str]) -> str:
    """The model's name, or one by its number, with what tells its part from those before it."""
    name = given or f"part_{number}"
    for ending in (f"_{alpha}", "_lit" if lit else "_unlit", f"_{number}"):
        if name in taken:
            name += ending
    return name


def _is_closed(positions: Float32, triangles: Triangles) -> bool:
    """Whether each edge has a triangle on either side, and they face outwards.

    positions: [m], shape [V, 3]; vertices in the same place are one.
    """
    places, vertex = np.unique(positions, axis=0, return_inverse=True)
    corners = vertex.ravel()[triangles]
    start, end = corners.ravel(), np.roll(corners, -1, axis=1).ravel()
    there, back = np.sort(start * len(places) + end), np.sort(end * len(places) + start)
    a, b, c = np.moveaxis((positions - positions.mean(axis=0))[triangles].astype(float), 1, 0)
    return bool(np.array_equal(there, back) and (a * np.cross(b, c)).sum() > 0)


def _spans(starts: NDArray[np.int64]) -> Sequence[tuple[int, int]]:
    return list(zip(starts[:-1].tolist(), starts[1:].tolist(), strict=True))


def _part(
    name: str,
    positions: Float32,
    normals: Float32,
    triangles: Triangles,
    uvs: Float32,
    alpha: Alpha,
    lit: bool,
) -> MeshPart:
    """One part with only the vertices that it uses; if all frames are equal, one is stored."""
    used, numbers = np.unique(triangles, return_inverse=True)
    moving, turning = positions[:, used], normals[:, used]
    if (moving == moving[:1]).all() and (turning == turning[:1]).all():
        moving, turning = moving[:1], turning[:1]
    own = numbers.reshape(triangles.shape).astype(np.int32)
    closed = _is_closed(positions[0, used], own)
    return MeshPart(name, moving, turning, own, uvs[used], alpha, lit, closed)


def _atlas_uvs(topology: Topology, material_tables: MaterialTables) -> Float32:
    """UVs as fractions of the whole atlas, shape [V, 2]."""
    vertex_material = np.zeros(len(topology.uvs), np.int32)
    vertex_material[topology.triangles] = topology.triangle_material[:, None]
    rects = material_tables.layer_rects[material_tables.material_layers[vertex_material, 0]]
    height, width = material_tables.atlas.shape[:2]
    texels = rects[:, :2] + np.clip(topology.uvs, 0, 1) * rects[:, 2:]
    uvs: Float32 = (texels / [width, height]).astype(np.float32)
    return uvs
