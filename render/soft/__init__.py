"""The rasteriser on the processor: it needs no system package and draws the same bits everywhere.

Steps: project the vertices, clip the few triangles that need it, move those that blend to the end,
sort triangles into tiles, draw the tiles. Every step is divided among threads in a way that does
not change its result.
"""

from collections.abc import Callable, Iterator
from dataclasses import dataclass, field, replace
from functools import partial
from typing import Any

import numpy as np
from numpy.typing import NDArray

from drapery.arrays import Matrices, Triangles
from drapery.errors import OptionError
from drapery.mesh import Mesh
from drapery.render.buffers import Buffers
from drapery.render.camera import Camera, clip_matrix
from drapery.render.detail import DetailTables
from drapery.render.drawlist import DrawList, Float32, Topology, make_topology
from drapery.render.flatten import composite_layers
from drapery.render.frame import Frame
from drapery.render.light import UNLIT, Light
from drapery.render.materials import BLEND, MaterialTables, material_numbers
from drapery.render.relief import bake_normal_maps
from drapery.render.scene import Scene
from drapery.render.soft.bins import RECORD, TILE, sort_into_tiles
from drapery.render.soft.blending import FULL_LIGHT
from drapery.render.soft.cast import find_shaded
from drapery.render.soft.clipping import Corners, clip
from drapery.render.soft.coverage import depth_tiles
from drapery.render.soft.detail import lean_vertices
from drapery.render.soft.projection import BROKEN, NEAREST, VERTEX, project
from drapery.render.soft.shadows import (
    NO_RECEIVERS,
    NO_SHADOWS,
    ShadowLight,
    ShadowMap,
    shadow_light,
)
from drapery.render.soft.surface import surface_tiles
from drapery.render.soft.tiles import draw_tiles
from drapery.render.vectors import unit
from drapery.render.workers import run_parts, worker_count

MAX_SIZE = 16384
"""The longest side of a picture [pixels]."""

MAX_RECORDS = 1 << 22
"""The most triangles in tiles at one time, 160 MiB; with more the picture is drawn in parts."""

CLIPPED = 7
"""Numbers of a clipped corner before its receiver: clip coordinates, brightness and UVs."""

FEW = 4096
"""The least number of vertices or triangles in one part of the work."""

PARTS = 8
"""Parts of the work for each thread; see `run_parts`."""


@dataclass(frozen=True, eq=False)
class Raster:
    """Vertices and triangles on the picture.

    vertices: shape [V] of VERTEX.
    flags: see `drapery.render.soft.projection`, shape [V], uint8.
    triangles, triangle_material: as in `Topology`.
    receivers: more numbers of each vertex, shape [V, 4] or none: where it lies on the shadow map
        (see `draw_tiles`), or its normal and model while it is clipped.
    leaning: see `lean_vertices`, shape [V, 4], or none where no material has a detail.
    """

    vertices: NDArray[np.void]
    flags: NDArray[np.uint8]
    triangles: Triangles
    triangle_material: NDArray[np.int32]
    receivers: Float32 = field(default_factory=lambda: NO_RECEIVERS)
    leaning: Float32 = field(default_factory=lambda: NO_RECEIVERS)


@dataclass(frozen=True, eq=False)
class KernelTables:
    """A `MaterialTables` as the kernels read it; see `draw_tiles`."""

    materials: NDArray[np.int32]
    layers: NDArray[np.int32]
    atlas: NDArray[np.uint32]


TileRange = tuple[int, NDArray[np.int64], NDArray[np.int32]]
"""The first tile of a range, and the lists of all its tiles; see `_tile_lists`."""

SharedSurface = tuple[Raster, Topology, KernelTables, TileRange]
"""What the buffers of a picture share with it; see `_draw_surface`."""


def draw_scene(scene: Scene, *, threads: int | None = None) -> Frame:
    """Draw a scene; the picture has the same bits for any number of threads.

    Raises OptionError for sizes, textures or meshes that cannot be drawn.
    """
    return _draw_picture(scene, threads or worker_count())[0]


def draw_with_buffers(
    scene: Scene, *, threads: int | None = None
) -> tuple[Frame, Callable[[], Buffers]]:
    """The picture of `draw_scene`, and a function that gives what `draw_buffers` does.

    With one sample a pixel the buffers need no second projection and sorting of the triangles.
    Raises OptionError for sizes, textures or meshes that cannot be drawn.
    """
    workers = threads or worker_count()
    frame, shared = _draw_picture(scene, workers)
    if shared is None:
        return frame, partial(draw_buffers, scene, threads=workers)
    raster, constant, tables, tiles = shared

    def make_buffers() -> Buffers:
        owners = _owners(scene, constant)
        return _draw_surface(scene, raster, owners, constant, tables, tiles, workers)

    return frame, make_buffers


vars(draw_scene)["with_buffers"] = draw_with_buffers  # see `drapery.render.backends`


def _draw_picture(scene: Scene, workers: int) -> tuple[Frame, SharedSurface | None]:
    """The picture, and what its buffers share with it, if they can."""
    baked = bake_normal_maps(scene)
    is_shared = baked is scene and scene.samples == 1
    scene = baked
    grid = _grid(scene)
    constant = make_topology(scene.models)
    matrix = clip_matrix(scene.camera, scene.size)
    raster, union = _project(scene, constant, matrix, grid, workers)
    tables = _tables(composite_layers(constant.material_tables))
    shadows = NO_SHADOWS
    if scene.light.shadows and len(raster.vertices):
        raster, shadows = _shadowed(scene, constant, raster, tables, workers)
    details = constant.material_tables.details
    if len(details.tiles) and scene.light.directions:
        raster = replace(raster, leaning=_leaning(scene, constant))
    if union:
        raster = _clipped(scene, raster, matrix, grid)
    raster = _blends_last(raster, constant.material_tables.material_alpha)
    picture = np.full((scene.size[1], scene.size[0]), _background(scene), np.uint32)
    tiles = _draw(scene, tables, raster, shadows, details, grid, workers, picture)
    frame = Frame(picture.view(np.uint8).reshape(*picture.shape, 4))
    if not is_shared or union or tiles is None:
        return frame, None
    return frame, (raster, constant, tables, tiles)


def draw_buffers(scene: Scene, *, threads: int | None = None) -> Buffers:
    """Depth, normal, model and texture coordinates in the middle of each pixel of a scene.

    They have the same bits for any number of threads, and fit the picture of any backend.

    scene: what is drawn.
    threads: 1 or more; None uses every processor.

    Raises OptionError for sizes, textures or meshes that cannot be drawn.
    """
    scene = replace(scene, samples=1)
    grid, workers = _grid(scene), threads or worker_count()
    constant = make_topology(scene.models)
    matrix = clip_matrix(scene.camera, scene.size)
    raster, union = _project(scene, constant, matrix, grid, workers)
    owners = normals, models = _owners(scene, constant)
    if union:
        receivers = np.concatenate([normals, models[:, None]], axis=1, dtype=np.float32)
        raster = replace(raster, receivers=receivers)
        raster = _clipped(scene, raster, matrix, grid)
        owners = raster.receivers[:, :3].copy(), np.rint(raster.receivers[:, 3]).astype(np.int32)
    raster = _blends_last(raster, constant.material_tables.material_alpha)
    tables = _tables(composite_layers(constant.material_tables))
    return _draw_surface(scene, raster, owners, constant, tables, None, workers)


def _draw_surface(
    scene: Scene,
    raster: Raster,
    owners: tuple[Float32, NDArray[np.int32]],
    constant: Topology,
    tables: KernelTables,
    tiles: TileRange | None,
    workers: int,
) -> Buffers:
    """The buffers of a scene. owners: see `_owners`. tiles: the lists of all tiles, if known."""
    camera, mesh = scene.camera, (raster.vertices, raster.triangles, raster.triangle_material)
    lens = float(camera.near), float(camera.far), camera.height is not None
    found = Buffers.empty(scene.size)
    results = found.depth, found.normal, found.model, found.uv, found.material
    numbers = material_numbers(constant.material_tables)
    given = mesh, _kernel_tables(tables), *owners, numbers, lens, scene.size, results
    across, down = (-(-side // TILE) for side in scene.size)
    parts = PARTS * workers if workers > 1 else 1
    for lists in [tiles] if tiles else _tile_ranges(raster, tables, (across, down), workers):
        every = across, *lists, *given
        run_parts(partial(_surface_part, parts, every), parts, workers)
    return found


def _surface_part(parts: int, given: tuple[Any, ...], part: int) -> None:
    surface_tiles(part, parts, *given)


def _owners(scene: Scene, constant: Topology) -> tuple[Float32, NDArray[np.int32]]:
    """The normal at each vertex, shape [V, 3], and the number of its model, shape [V]."""
    none = np.zeros((0, 3), np.float32)
    parts = [_vectors(model.mesh.normals) for model in scene.models] or [none]
    # The normals of a crowd, which is one model, are not copied.
    normals = np.concatenate(parts) if len(parts) > 1 else parts[0]
    models = np.arange(len(scene.models), dtype=np.int32)
    return normals, models.repeat(np.diff(constant.vertex_start))


def _shadowed(
    scene: Scene, constant: Topology, raster: Raster, tables: KernelTables, workers: int
) -> tuple[Raster, ShadowMap]:
    """The raster with its vertices lit for shadows, and the map of the light that casts them."""
    positions, normals = (
        np.concatenate([_vectors(getattr(model.mesh, name)) for model in scene.models])
        for name in ("positions", "normals")
    )
    found = shadow_light(scene.light, scene.size, DrawList(positions, normals, constant))
    if found is None:
        return raster, NO_SHADOWS
    side = found.side
    seen = _project_points(positions, constant.uvs, found, workers)
    receivers = _project_points(found.lifted, constant.uvs, found, workers)
    raster.vertices["shade"] = found.bright
    # From the middle of the first sample to its corner, so that whole numbers are its index.
    places = [receivers[axis] / np.float32(256) + np.float32(0.5) for axis in ("x", "y")]
    shaded = np.stack([*places, receivers["depth"], found.dark], axis=-1, dtype=np.float32)
    casters = Raster(
        seen, raster.flags, constant.casters, constant.triangle_material[constant.casting]
    )
    depths = np.zeros(side * side, np.int32)
    _draw_depths(casters, tables, side, workers, depths)
    return replace(raster, receivers=shaded), ShadowMap(depths, side, found.spread)


def _leaning(scene: Scene, constant: Topology) -> Float32:
    """How the light of each vertex changes with its normal, and its gloss; see `lean_vertices`."""
    positions, normals = (
        np.concatenate([_vectors(getattr(model.mesh, name)) for model in scene.models])
        for name in ("positions", "normals")
    )
    light, details = scene.light, constant.material_tables.details
    found = np.zeros((len(positions), 4), np.float32)
    lean_vertices(
        positions,
        normals,
        constant.uvs,
        constant.triangles,
        constant.triangle_material,
        (details.rows, details.finishes),
        light.unit_directions(),
        np.array([light.ambient, light.diffuse], float),
        _eye(scene.camera),
        found,
    )
    return found


def _eye(camera: Camera) -> NDArray[np.float64]:
    """The camera's place and 1, or in a parallel view the direction towards it and 0."""
    place = np.array(camera.position, float)
    if camera.height is None:
        return np.append(place, 1.0)
    return np.append(unit(place - np.array(camera.target, float)), 0.0)


def _project_points(
    positions: Float32, uvs: Float32, light: ShadowLight, workers: int
) -> NDArray[np.void]:
    """Vertices as the light that casts shadows sees them."""
    vertices, flags = np.empty(len(positions), VERTEX), np.empty(len(positions), np.uint8)
    size = light.side, light.side
    matrix, arrays = clip_matrix(light.camera, size), (uvs, vertices, flags)
    _project_part(positions, positions, UNLIT, matrix, size, arrays, workers)
    return vertices


def _draw_depths(
    raster: Raster, tables: KernelTables, side: int, workers: int, depths: NDArray[np.int32]
) -> None:
    """Fill a shadow map; see `depth_tiles`."""
    tiles = side // TILE
    mesh = raster.vertices, raster.triangles, raster.triangle_material
    parts = PARTS * workers if workers > 1 else 1
    for lists in _tile_ranges(raster, tables, (tiles, tiles), workers):
        given = tiles, *lists, mesh, _kernel_tables(tables), depths
        run_parts(partial(_depth_part, parts, given), parts, workers)


def _depth_part(parts: int, given: tuple[Any, ...], part: int) -> None:
    depth_tiles(part, parts, *given)


def _tables(tables: MaterialTables) -> KernelTables:
    modes = np.stack([tables.material_alpha, tables.material_lit], axis=1)
    return KernelTables(
        np.concatenate([tables.material_layers, modes], axis=1, dtype=np.int32),
        np.concatenate([tables.layer_rects, tables.layer_tints], axis=1, dtype=np.int32),
        tables.atlas.view(np.uint32)[..., 0],
    )


def _grid(scene: Scene) -> int:
    """Samples along a pixel's side. Raises OptionError for sizes that cannot be drawn."""
    if not all(1 <= side <= MAX_SIZE for side in scene.size):
        width, height = scene.size
        raise OptionError(f"size {width}x{height} cannot be drawn; use 1 to {MAX_SIZE} pixels")
    if scene.samples not in (1, 4, 16):
        raise OptionError(f"samples {scene.samples} is not known; use 1, 4 or 16")
    return int(scene.samples**0.5)


def _background(scene: Scene) -> np.uint32:
    """The background as the kernels write it. Raises OptionError."""
    colour = np.array(scene.background)
    if colour.shape != (4,) or colour.min() < 0 or colour.max() > 255:
        raise OptionError(
            f"background {scene.background} is not a colour; use four numbers from 0 to 255"
        )
    packed: np.uint32 = colour.astype(np.uint8).view(np.uint32)[0]
    return packed


def _project(
    scene: Scene, constant: Topology, matrix: Matrices, grid: int, workers: int
) -> tuple[Raster, int]:
    """All vertices in picture coordinates, and the union of their flags."""
    total = int(constant.vertex_start[-1])
    vertices, flags = np.empty(total, VERTEX), np.empty(total, np.uint8)
    union = 0
    for number, model in enumerate(scene.models):
        part = slice(*constant.vertex_start[number : number + 2])
        arrays = constant.uvs[part], vertices[part], flags[part]
        found = _project_model(model.mesh, scene, matrix, grid, arrays, workers)
        if found & BROKEN:
            raise OptionError(
                f"model {number} has positions or normals that are not finite numbers;"
                " if a simulation diverged, use a smaller time step"
            )
        union |= found
    return Raster(vertices, flags, constant.triangles, constant.triangle_material), union


def _project_model(
    mesh: Mesh, scene: Scene, matrix: Matrices, grid: int, arrays: tuple[Any, ...], workers: int
) -> int:
    positions, normals = _vectors(mesh.positions), _vectors(mesh.normals)
    size = scene.size[0] * grid, scene.size[1] * grid
    return _project_part(positions, normals, scene.light, matrix, size, arrays, workers)


def _project_part(
    positions: Float32,
    normals: Float32,
    light: Light,
    matrix: Matrices,
    size: tuple[int, int],
    arrays: tuple[Any, ...],
    workers: int,
) -> int:
    """Project vertices into a picture of this size [samples]; the union of their flags.

    arrays: texture coordinates, then the results; see `project`.
    """
    uvs, vertices, flags = arrays
    share = _shares(len(positions), workers)
    lights = light.unit_directions()

    def run(part: int) -> int:
        union: int = project(
            share[part],
            share[part + 1],
            positions,
            normals,
            uvs,
            matrix,
            size[0],
            size[1],
            lights,
            float(light.ambient),
            float(light.diffuse),
            vertices,
            flags,
        )
        return union

    return int(np.bitwise_or.reduce(run_parts(run, len(share) - 1, workers)))


def _vectors(points: NDArray[Any]) -> Float32:
    """Points as [V, 3], float32; a read-only array is copied, so the kernels are compiled for one
    kind of array only."""
    return np.require(points.reshape(-1, 3), np.float32, ["C", "W"])


def _shares(count: int, workers: int) -> list[int]:
    """Bounds of the parts into which vertices or triangles are divided."""
    parts = max(1, min(PARTS * workers, -(-count // FEW))) if workers > 1 else 1
    return [count * part // parts for part in range(parts + 1)]


def _clipped(scene: Scene, raster: Raster, matrix: Matrices, grid: int) -> Raster:
    """The raster with flagged triangles clipped, in the same drawing order."""
    flagged = raster.flags[raster.triangles].any(axis=1)
    (whole,), (cut,) = np.nonzero(~flagged), np.nonzero(flagged)
    used = raster.triangles[cut]
    size = scene.size[0] * grid, scene.size[1] * grid
    clipped = clip(_clip_corners(scene, raster, matrix, used), cut, *size)
    corners = clipped.corners.reshape(-1, clipped.corners.shape[-1])
    new = _on_picture(corners[:, :CLIPPED], *size)
    numbers = len(raster.vertices) + np.arange(len(new), dtype=np.int32).reshape(-1, 3)
    source = np.concatenate([whole, clipped.source])
    order = np.argsort(source, kind="stable")
    return Raster(
        np.concatenate([raster.vertices, new]),
        raster.flags,
        np.concatenate([raster.triangles[whole], numbers])[order],
        raster.triangle_material[source][order],
        *_joined_attributes(raster, corners[:, CLIPPED:].astype(np.float32)),
    )


def _joined_attributes(raster: Raster, corners: Float32) -> Iterator[Float32]:
    """The receivers and the leaning of all vertices. corners: those of new ones side by side."""
    for known in (raster.receivers, raster.leaning):
        width = known.shape[1] if len(known) else 0
        yield np.concatenate([known, corners[:, :width]]) if width else known
        corners = corners[:, width:]


def _clip_corners(scene: Scene, raster: Raster, matrix: Matrices, used: Triangles) -> Corners:
    """Clip coordinates, brightness, UVs and what else vertices have, shape [K, 3, 7 to 15]."""
    positions = np.concatenate([_vectors(model.mesh.positions) for model in scene.models])[used]
    coordinates = sum(positions[..., k, None] * matrix[:, k] for k in range(3)) + matrix[:, 3]
    vertices = raster.vertices[used]
    attributes = [vertices[name][..., None] for name in ("shade", "u", "v")]
    attributes += [more[used] for more in (raster.receivers, raster.leaning) if len(more)]
    return np.concatenate([coordinates, *attributes], axis=-1)


def _on_picture(corners: Corners, width: int, height: int) -> NDArray[np.void]:
    """Clip coordinates and attributes [N, 7] converted to vertices [N]; see `project`."""
    x, y, z, w, *attributes = corners.T
    new = np.empty(len(corners), VERTEX)
    new["x"] = np.rint((x / w * 0.5 + 0.5) * width * 256).astype(np.int32) - 128
    up = np.rint((y / w * 0.5 + 0.5) * height * 256).astype(np.int32) - 128
    new["y"] = (height - 1) * 256 - up
    new["depth"] = np.clip(np.rint((0.5 - 0.5 * (z / w)) * NEAREST), 0, NEAREST)
    new["shade"], new["u"], new["v"] = attributes
    new["inv_w"] = 1 / w
    return new


def _blends_last(raster: Raster, material_alpha: NDArray[np.uint8]) -> Raster:
    """The raster with triangles that blend after the others, farthest first.

    The distance of a triangle is measured at its middle; the order is stable for equal distances.
    """
    if not (material_alpha == BLEND).any():
        return raster
    blends = material_alpha[raster.triangle_material] == BLEND
    (first,), (last,) = np.nonzero(~blends), np.nonzero(blends)
    nearness = raster.vertices["depth"][raster.triangles[last]].astype(np.int64).sum(axis=1)
    order = np.concatenate([first, last[np.argsort(nearness, kind="stable")]])
    return replace(
        raster, triangles=raster.triangles[order], triangle_material=raster.triangle_material[order]
    )


def _draw(
    scene: Scene,
    tables: KernelTables,
    raster: Raster,
    shadows: ShadowMap,
    details: DetailTables,
    grid: int,
    workers: int,
    picture: NDArray[np.uint32],
) -> TileRange | None:
    """Draw the picture; the lists of its tiles, if they fit in memory at one time."""
    constant = (
        (raster.vertices, raster.triangles, raster.triangle_material),
        _kernel_tables(tables),
        np.rint(np.array(scene.light.tint) * FULL_LIGHT).astype(np.int64),
        raster.receivers,
        _kernel_shadows(raster, shadows),
        (raster.leaning, details.rows, details.tiles, details.edges),
        _background(scene),
        grid,
        scene.size,
        picture.reshape(-1),
    )
    across, down = (-(-side * grid // TILE) for side in scene.size)
    parts = PARTS * workers if workers > 1 else 1
    count = 0
    for lists in _tile_ranges(raster, tables, (across, down), workers):
        run_parts(partial(_draw_part, parts, (across, *lists, *constant)), parts, workers)
        count += 1
    return lists if count == 1 else None


def _kernel_shadows(raster: Raster, shadows: ShadowMap) -> tuple[Any, ...]:
    shaded = np.zeros(len(raster.triangles) if len(raster.receivers) else 0, np.bool_)
    maps = shadows.depths, shadows.side, shadows.spread
    if len(shaded):
        find_shaded(raster.vertices, raster.triangles, raster.receivers, *maps, shaded)
    return shaded, maps


def _kernel_tables(tables: KernelTables) -> tuple[Any, ...]:
    return tables.materials, tables.layers, tables.atlas.reshape(-1), tables.atlas.shape[1]


def _tile_ranges(
    raster: Raster, tables: KernelTables, tiles: tuple[int, int], workers: int
) -> Iterator[TileRange]:
    """Sort triangles into tiles across and down, in as many ranges as fit in memory."""
    across, down = tiles
    ranges = [(0, across * down)]
    while ranges:
        first, end = ranges.pop()
        starts, records = _tile_lists(raster, tables.materials, (across, down, first, end), workers)
        if records is None:
            middle = (first + end) // 2
            ranges += [(middle, end), (first, middle)]
        else:
            yield first, starts, records


def _draw_part(parts: int, given: tuple[Any, ...], part: int) -> None:
    draw_tiles(part, parts, *given)


def _tile_lists(
    raster: Raster, materials: NDArray[np.int32], tiles: tuple[int, int, int, int], workers: int
) -> tuple[NDArray[np.int64], NDArray[np.int32] | None]:
    """The triangles of each tile of a range: the start of each tile's records, and the records.

    tiles: see `sort_into_tiles`. None if there are too many records for the memory; a single tile
    never has too many.
    """
    count = len(raster.triangles)
    share = _shares(count, workers)
    cursors = np.zeros((len(share) - 1, tiles[3] - tiles[2]), np.int64)

    def run(part: int, records: NDArray[np.int32]) -> None:
        sort_into_tiles(
            share[part],
            share[part + 1],
            raster.vertices,
            raster.triangles,
            raster.triangle_material,
            materials,
            tiles,
            cursors[part],
            records,
        )

    nothing = np.empty((0, RECORD), np.int32)
    run_parts(lambda part: run(part, nothing), len(cursors), workers)
    ends = np.cumsum(cursors.T).reshape(cursors.T.shape).T
    starts = np.concatenate([[0], ends[-1]])
    if starts[-1] > MAX_RECORDS and tiles[3] - tiles[2] > 1:
        return starts, None
    np.subtract(ends, cursors, out=cursors)
    records = np.empty((int(starts[-1]), RECORD), np.int32)
    if len(records):
        run_parts(lambda part: run(part, records), len(cursors), workers)
    return starts, records
