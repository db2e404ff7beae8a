"""A scene's models merged into one list of triangles with one atlas.

The constant part (triangles, UVs, materials, atlas) is prepared once for all pictures that use
it; only positions and normals are read for each picture. A batch of meshes becomes one long mesh,
so thousands of banners need no more calls than one.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from drapery.arrays import Floats, Integers, Mask, Triangles, UVs, Vectors
from drapery.errors import OptionError
from drapery.mesh import Array
from drapery.render.identity_cache import IdentityCache
from drapery.render.light import Light
from drapery.render.materials import BLEND, MaterialTables, make_material_tables
from drapery.render.scene import Model

Float32 = NDArray[np.float32]

MAX_TRIANGLES = (1 << 24) - 2
"""The most triangles of one picture; the rasteriser stores a triangle's number in 24 bits."""


@dataclass(frozen=True, eq=False)
class Topology:
    """The constant part of a draw list.

    uvs: fractions of the sprite, shape [V, 2]; (0, 0) is its top left corner.
    triangles: vertex indices into the merged list, shape [T, 3], int32.
    triangle_material: index of the material in the tables, shape [T], int32.
    vertex_start: index of the first vertex of each model, shape [M + 1].
    material_tables: the materials, their layers and textures.
    """

    uvs: UVs
    triangles: Triangles
    triangle_material: Integers
    vertex_start: Integers
    material_tables: MaterialTables

    @cached_property
    def casting(self) -> Mask:
        """Which triangles cast shadows, shape [T]: lit ones that do not blend."""
        tables = self.material_tables
        casting: NDArray[np.bool_] = tables.material_lit & (tables.material_alpha != BLEND)
        return casting[self.triangle_material]

    @cached_property
    def casters(self) -> Triangles:
        """The triangles that cast shadows."""
        return self.triangles[self.casting]

    @cached_property
    def lit_vertices(self) -> Mask:
        """Which vertices belong to triangles that light falls on, shape [V]."""
        lit = np.zeros(len(self.uvs), np.bool_)
        lit[self.triangles[self.material_tables.material_lit[self.triangle_material]]] = True
        return lit

    @cached_property
    def transmission(self) -> Floats:
        """The share of light that shines through the surface at each vertex, 0..1, shape [V]."""
        through = np.zeros(len(self.uvs), np.float32)
        shares = self.material_tables.material_transmission[self.triangle_material]
        some = shares > 0
        through[self.triangles[some]] = shares[some, None]
        return through


@dataclass(frozen=True, eq=False)
class DrawList:
    """Everything to be drawn, in drawing order.

    positions: [m], shape [V, 3], float32.
    normals: unit vectors, shape [V, 3], float32.
    topology: triangles, UVs and materials.
    """

    positions: Vectors
    normals: Vectors
    topology: Topology

    def brightness(self, light: Light) -> Floats:
        """The factor by which light multiplies the colour at each vertex, shape [V]."""
        lit = np.zeros(len(self.positions), np.bool_)
        for triangles, shines in self._by_light():
            lit[triangles] = shines
        return np.where(lit, light.brightness(self.normals), np.float32(1))

    def _by_light(self) -> list[tuple[Triangles, bool]]:
        shines = self.topology.material_tables.material_lit[self.topology.triangle_material]
        return [(self.topology.triangles[shines == lit], lit) for lit in (False, True)]


_cache: IdentityCache[Topology] = IdentityCache()


def draw_list(models: Sequence[Model]) -> DrawList:
    """Merge models into one list, reusing the constant part of recent lists.

    Raises OptionError, naming the model, for arrays that do not fit together.
    """
    constant = make_topology(models)
    return DrawList(
        _joined([model.mesh.positions for model in models]),
        _joined([model.mesh.normals for model in models]),
        constant,
    )


def make_topology(models: Sequence[Model]) -> Topology:
    """The constant part of the models' draw list; see `draw_list`."""
    tables = make_material_tables([each for model in models for each in model.materials])
    arrays = tuple(
        part
        for model in models
        for part in (model.mesh.triangles, model.mesh.uvs, model.material_index)
    )
    shapes = [
        (model.mesh.positions.shape, model.mesh.normals.shape, len(model.materials))
        for model in models
    ]
    return _cache.get((*arrays, tables), shapes, lambda: _merge(models, tables))


def _merge(models: Sequence[Model], tables: MaterialTables) -> Topology:
    for number, model in enumerate(models):
        _check(number, model)
    vertices = [model.mesh.positions.size // 3 for model in models]
    starts = np.cumsum([0, *vertices], dtype=np.int64)
    _check_count(sum(_batch(model) * len(model.mesh.triangles) for model in models))
    first_material = np.cumsum([0, *(len(model.materials) for model in models)])
    empty = np.zeros((0, 3), np.int32)
    return Topology(
        np.concatenate([np.zeros((0, 2), np.float32), *(_uvs(model) for model in models)]),
        np.concatenate(
            [empty, *(_triangles(m, int(s)) for m, s in zip(models, starts, strict=False))]
        ),
        np.concatenate(
            [empty[:, 0], *(_materials(m, f) for m, f in zip(models, first_material, strict=False))]
        ),
        starts,
        tables,
    )


def _batch(model: Model) -> int:
    """The number of copies of the mesh."""
    return 1 if model.mesh.positions.ndim == 2 else len(model.mesh.positions)


def _uvs(model: Model) -> Float32:
    return np.tile(np.asarray(model.mesh.uvs, np.float32), (_batch(model), 1))


def _triangles(model: Model, start: int) -> Triangles:
    """Vertex indices of all copies, shape [B * T, 3]."""
    offsets = start + np.arange(_batch(model)) * model.mesh.positions.shape[-2]
    numbers: Triangles = (model.mesh.triangles + offsets[:, None, None]).astype(np.int32)
    return numbers.reshape(-1, 3)


def _materials(model: Model, first: int) -> NDArray[np.int32]:
    index = (
        model.material_index
        if model.material_index is not None
        else np.zeros(_batch(model), np.int32)
    )
    return np.repeat(index + first, len(model.mesh.triangles)).astype(np.int32)


def _joined(parts: list[Array]) -> Float32:
    """Vertices of all models, shape [V, 3]; the float32 array of a single model is not copied."""
    flat = [np.asarray(part, np.float32).reshape(-1, 3) for part in parts]
    if len(flat) == 1:
        return flat[0]
    return np.concatenate([np.zeros((0, 3), np.float32), *flat])


def _check_count(triangles: int) -> None:
    if triangles > MAX_TRIANGLES:
        raise OptionError(
            f"the scene has {triangles} triangles; one picture takes at most {MAX_TRIANGLES}:"
            " draw fewer models, or coarser ones"
        )


def _check(number: int, model: Model) -> None:
    """Raise OptionError for a model that would make a kernel read outside an array."""
    mesh = model.mesh
    if mesh.positions.ndim not in (2, 3) or mesh.positions.shape[-1] != 3:
        _refuse(number, "positions", mesh.positions, "[V, 3] or [B, V, 3]")
    if mesh.normals.shape != mesh.positions.shape:
        _refuse(number, "normals", mesh.normals, f"{mesh.positions.shape} as its positions")
    vertices = mesh.positions.shape[-2]
    if mesh.uvs.shape != (vertices, 2) or not np.isfinite(mesh.uvs).all():
        _refuse(number, "uvs", mesh.uvs, f"({vertices}, 2), all finite")
    if mesh.triangles.ndim != 2 or mesh.triangles.shape[1] != 3:
        _refuse(number, "triangles", mesh.triangles, "[T, 3]")
    if not _all_within(mesh.triangles, vertices):
        raise OptionError(
            f"model {number}: its triangles name vertices outside 0..{vertices - 1};"
            " give indices of its positions"
        )
    index = model.material_index
    if index is not None and index.shape != (_batch(model),):
        _refuse(number, "material_index", index, f"({_batch(model)},)")
    if not _all_within(np.zeros(1, np.int32) if index is None else index, len(model.materials)):
        raise OptionError(
            f"model {number}: material_index names materials outside its {len(model.materials)};"
            " give indices of its materials"
        )


def _all_within(index: NDArray[Any], count: int) -> bool:
    return index.size == 0 or (int(index.min()) >= 0 and int(index.max()) < count)


def _refuse(number: int, name: str, array: NDArray[Any], wanted: str) -> None:
    raise OptionError(f"model {number}: {name} have shape {array.shape}; use {wanted}")
