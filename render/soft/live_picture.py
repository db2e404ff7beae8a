"""A scene in which one model moves, drawn by one kernel: `draw_scene` for hosts without Python."""

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from drapery.arrays import Triangles
from drapery.errors import OptionError
from drapery.jit import entry_point
from drapery.mesh import Array
from drapery.render.camera import clip_matrix
from drapery.render.drawlist import Float32, make_topology
from drapery.render.materials import BLEND
from drapery.render.relief import bake_normal_maps
from drapery.render.scene import Scene
from drapery.render.soft import (
    _background,
    _grid,
    _kernel_tables,
    _tables,
    _vectors,
)
from drapery.render.soft.bins import RECORD, TILE, sort_into_tiles
from drapery.render.soft.blending import FULL_LIGHT
from drapery.render.soft.projection import VERTEX, project
from drapery.render.soft.shadows import NO_RECEIVERS, NO_SHADOWS
from drapery.render.soft.tiles import draw_tiles

__all__ = ["LivePicture", "draw_live", "make_live_picture"]


class LivePicture(NamedTuple):
    """What `draw_live` reads and writes; see `project` and `draw_tiles`.

    first: the first vertex that moves. size: of the picture [pixels], grid: samples along a
    pixel's side. levels: ambient and diffuse light, [2]. tint: of the light, [3].
    materials, layers, atlas: see `draw_tiles`; the host may replace them. The last rows of layers
    are spare: zeros that no material uses.
    vertices, flags: scratch for V vertices. picture: 0xAABBGGRR, [height * width].
    """

    first: int
    positions: Float32
    normals: Float32
    uvs: Float32
    triangles: Triangles
    triangle_material: NDArray[np.int32]
    materials: NDArray[np.int32]
    layers: NDArray[np.int32]
    atlas: NDArray[np.uint32]
    wide: int
    matrix: Array
    lights: Array
    levels: Array
    tint: NDArray[np.int64]
    background: np.uint32
    grid: int
    size: tuple[int, int]
    receivers: Float32
    shaded: NDArray[np.bool_]
    depths: NDArray[np.int32]
    vertices: NDArray[np.void]
    flags: NDArray[np.uint8]
    picture: NDArray[np.uint32]


def make_live_picture(scene: Scene, moving: int, spare: int = 0) -> LivePicture:
    """A picture of a scene in which the model of this number moves.

    spare: rows of `LivePicture.layers` that the host may fill.
    Raises OptionError for cast shadows and for materials that blend.
    """
    scene = bake_normal_maps(scene)
    grid, constant = _grid(scene), make_topology(scene.models)
    if scene.light.shadows:
        raise OptionError("cast shadows need Python; use light game or flat")
    if len(constant.material_tables.details.tiles):
        raise OptionError("the finish of a fabric needs Python; use finish plain")
    if (constant.material_tables.material_alpha == BLEND).any():
        raise OptionError("translucent materials, such as a shadow, need Python; leave them out")
    positions, normals = (
        np.concatenate([_vectors(getattr(model.mesh, name)) for model in scene.models])
        for name in ("positions", "normals")
    )
    # The layers of a material stay apart, so that a host can exchange them.
    materials, layers, atlas, wide = _kernel_tables(_tables(constant.material_tables))
    width, height = scene.size
    return LivePicture(
        int(constant.vertex_start[moving]),
        positions,
        normals,
        constant.uvs,
        constant.triangles,
        constant.triangle_material,
        materials,
        np.concatenate([layers, np.zeros((spare, layers.shape[1]), np.int32)]),
        atlas.copy(),
        wide,
        clip_matrix(scene.camera, scene.size),
        scene.light.unit_directions(),
        np.array([scene.light.ambient, scene.light.diffuse], float),
        np.rint(np.array(scene.light.tint) * FULL_LIGHT).astype(np.int64),
        _background(scene),
        grid,
        (width, height),
        NO_RECEIVERS,
        np.zeros(0, np.bool_),
        NO_SHADOWS.depths,
        np.zeros(len(positions), VERTEX),
        np.zeros(len(positions), np.uint8),
        np.zeros(width * height, np.uint32),
    )


@entry_point
def draw_live(positions: Any, normals: Any, live: Any) -> Any:
    """Draw the picture with the moving model at positions [m] and with normals, [N, 3] each.

    Returns 0, or the flags of vertices that are out of the picture's bounds; see `projection`.
    """
    for v in range(positions.shape[0]):
        for axis in range(3):
            live.positions[live.first + v, axis] = positions[v, axis]
            live.normals[live.first + v, axis] = normals[v, axis]
    across, down = live.size
    union = project(
        0,
        live.positions.shape[0],
        live.positions,
        live.normals,
        live.uvs,
        live.matrix,
        across * live.grid,
        down * live.grid,
        live.lights,
        live.levels[0],
        live.levels[1],
        live.vertices,
        live.flags,
    )
    if union:
        return union
    for pixel in range(live.picture.size):
        live.picture[pixel] = live.background
    tiles_x = (across * live.grid + TILE - 1) // TILE
    tiles_y = (down * live.grid + TILE - 1) // TILE
    tiles = tiles_x, tiles_y, 0, tiles_x * tiles_y
    mesh = live.vertices, live.triangles, live.triangle_material
    starts = np.zeros(tiles_x * tiles_y + 1, np.int64)
    cursor = np.zeros(tiles_x * tiles_y, np.int64)
    count = live.triangles.shape[0]
    nothing = np.empty((0, RECORD), np.int32)
    sort_into_tiles(0, count, *mesh, live.materials, tiles, cursor, nothing)
    for tile in range(cursor.size):
        starts[tile + 1] = starts[tile] + cursor[tile]
        cursor[tile] = starts[tile]
    records = np.empty((starts[cursor.size], RECORD), np.int32)
    if records.shape[0] > 0:
        sort_into_tiles(0, count, *mesh, live.materials, tiles, cursor, records)
    draw_tiles(
        0,
        1,
        tiles_x,
        0,
        starts,
        records,
        mesh,
        (live.materials, live.layers, live.atlas, live.wide),
        live.tint,
        live.receivers,
        (live.shaded, (live.depths, 0, 0.0)),
        (
            np.empty((0, 4), np.float32),
            np.empty((0, 6), np.int32),
            np.empty(0, np.int64),
            np.empty((0, 2, 4), np.int64),
        ),
        live.background,
        live.grid,
        live.size,
        live.picture,
    )
    return 0
