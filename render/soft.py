"""The rasteriser in plain numbers: no system package, and the same bits on every machine.

Stages: project the vertices, clip the few triangles that need it, put those that blend last, sort
triangles into tiles, draw the tiles. Every stage is shared out over threads in a way that cannot
change its result.
"""

from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from drapery.errors import OptionError
from drapery.mesh import Triangles
from drapery.render.bins import TILE, sort_into_tiles
from drapery.render.camera import Matrix, projection_matrix, view_matrix
from drapery.render.clip import clip
from drapery.render.drawlist import Float32, Topology, topology
from drapery.render.flatten import flattened
from drapery.render.frame import Frame
from drapery.render.light import Light
from drapery.render.project import BROKEN, project
from drapery.render.scene import Scene
from drapery.render.tiles import draw_tiles
from drapery.render.wardrobe import BLEND
from drapery.render.workers import share_out, worker_count

MAX_SIZE = 16384
"""The longest side of a picture [pixels]."""

MAX_ENTRIES = 1 << 25
"""Triangles in tiles at one time; more, and the picture is drawn in strips."""

FEW_VERTICES = 4096
"""Fewer are not worth a second thread."""


@dataclass(frozen=True, eq=False)
class Raster:
    """Vertices and triangles on the picture.

    corners: [1/256 sample] from the centre of the top left sample, shape [V, 2], int32.
    depth: 1 at the near plane, 0 at the far, shape [V].
    inv_w: 1 / w, shape [V].
    shade: brightness, shape [V], float32.
    flags: see `drapery.render.project`, shape [V], uint8.
    uvs, triangles, triangle_look: as in `Topology`.
    """

    corners: NDArray[np.int32]
    depth: NDArray[np.float64]
    inv_w: NDArray[np.float64]
    shade: Float32
    flags: NDArray[np.uint8]
    uvs: Float32
    triangles: Triangles
    triangle_look: NDArray[np.int32]


def draw_scene(scene: Scene, *, threads: int | None = None) -> Frame:
    """Draw a scene; the picture is the same to the bit for any number of threads.

    Raises OptionError for sizes, textures or meshes that cannot be drawn.
    """
    grid = _grid(scene)
    workers = threads or worker_count()
    constant = topology(scene.models)
    matrix = _clip_matrix(scene)
    raster, union = _project(scene, constant, matrix, grid, workers)
    if union:
        raster = _clipped(scene, constant, raster, matrix, grid)
    raster, opaque = _blends_last(raster, constant.wardrobe.look_alpha)
    picture = np.empty((scene.size[1], scene.size[0]), np.uint32)
    _draw(scene, constant, raster, opaque, grid, workers, picture)
    return Frame(picture.view(np.uint8).reshape(*picture.shape, 4))


def _grid(scene: Scene) -> int:
    """Samples along a pixel's side. Raises OptionError for sizes that cannot be drawn."""
    if not all(1 <= side <= MAX_SIZE for side in scene.size):
        width, height = scene.size
        raise OptionError(f"size {width}x{height} cannot be drawn; use 1 to {MAX_SIZE} pixels")
    if scene.samples not in (1, 4, 16):
        raise OptionError(f"samples {scene.samples} is not known; use 1, 4 or 16")
    return int(scene.samples**0.5)


def _clip_matrix(scene: Scene) -> Matrix:
    """World to clip space, summed in a fixed order."""
    width, height = scene.size
    eye, lens = view_matrix(scene.camera), projection_matrix(scene.camera, width / height)
    matrix = sum(lens[:, k, None] * eye[k] for k in range(4))
    if not np.isfinite(matrix).all():
        raise OptionError(
            "the camera's position, target and up must span a view; give it a target other than"
            " its position, and an up across its sight"
        )
    return np.asarray(matrix)


def _project(
    scene: Scene, constant: Topology, matrix: Matrix, grid: int, workers: int
) -> tuple[Raster, int]:
    total = int(constant.vertex_start[-1])
    raster = Raster(
        np.empty((total, 2), np.int32),
        np.empty(total),
        np.empty(total),
        np.empty(total, np.float32),
        np.empty(total, np.uint8),
        constant.uvs,
        constant.triangles,
        constant.triangle_look,
    )
    union = 0
    for number, model in enumerate(scene.models):
        part = slice(*constant.vertex_start[number : number + 2])
        flags = _project_model(
            _vertices(model.mesh.positions),
            _vertices(model.mesh.normals),
            matrix,
            (scene.size[0] * grid, scene.size[1] * grid),
            scene.light,
            tuple(array[part] for array in _moving(raster)),
            workers,
        )
        if flags & BROKEN:
            raise OptionError(
                f"model {number} has positions or normals that are not finite numbers;"
                " a simulation that blew up wants a smaller time step"
            )
        union |= flags
    return raster, union


def _vertices(points: NDArray[Any]) -> Float32:
    """Shape [V, 3], float32; a copy where the array may not be written, so that the kernels are
    compiled for one kind of array only."""
    return np.require(points.reshape(-1, 3), np.float32, ["C", "W"])


def _moving(raster: Raster) -> tuple[NDArray[Any], ...]:
    return raster.corners, raster.depth, raster.inv_w, raster.shade, raster.flags


def _project_model(
    positions: Float32,
    normals: Float32,
    matrix: Matrix,
    size: tuple[int, int],
    light: Light,
    arrays: tuple[NDArray[Any], ...],
    workers: int,
) -> int:
    share = _shares(len(positions), workers if len(positions) > FEW_VERTICES else 1)
    lights = light.unit_directions()

    def run(worker: int) -> int:
        first, last = share[worker : worker + 2]
        return int(
            project(
                first,
                last,
                positions,
                normals,
                matrix,
                *size,
                lights,
                light.ambient,
                light.diffuse,
                arrays,
            )
        )

    return int(np.bitwise_or.reduce(share_out(run, len(share) - 1)))


def _shares(count: int, workers: int) -> list[int]:
    """Bounds of the runs that the workers take, [workers + 1]."""
    return [count * worker // workers for worker in range(workers + 1)]


def _clipped(scene: Scene, constant: Topology, raster: Raster, matrix: Matrix, grid: int) -> Raster:
    """The raster with flagged triangles cut to what can be drawn, in the same drawing order."""
    flagged = raster.flags[raster.triangles].any(axis=1)
    (whole,), (cut,) = np.nonzero(~flagged), np.nonzero(flagged)
    used = raster.triangles[cut]
    positions = np.concatenate([m.mesh.positions.reshape(-1, 3) for m in scene.models])[used]
    points = positions.astype(np.float32).astype(np.float64)
    coordinates = sum(points[..., k, None] * matrix[:, k] for k in range(3)) + matrix[:, 3]
    attributes = [raster.uvs[used], raster.shade[used, None]]
    width, height = (side * grid for side in scene.size)
    pieces = clip(np.concatenate([coordinates, *attributes], axis=-1), cut, width, height)
    new = pieces.corners.reshape(-1, pieces.corners.shape[-1])
    source = np.concatenate([whole, pieces.source])
    order = np.argsort(source, kind="stable")
    numbers = len(raster.flags) + np.arange(len(new), dtype=np.int32).reshape(-1, 3)
    x, y, z, w = new[:, :4].T
    across = np.rint((x / w * 0.5 + 0.5) * width * 256).astype(np.int32) - 128
    up = np.rint((y / w * 0.5 + 0.5) * height * 256).astype(np.int32) - 128
    return Raster(
        np.concatenate([raster.corners, np.stack([across, (height - 1) * 256 - up], axis=1)]),
        np.concatenate([raster.depth, 0.5 - 0.5 * (z / w)]),
        np.concatenate([raster.inv_w, 1 / w]),
        np.concatenate([raster.shade, new[:, 6].astype(np.float32)]),
        raster.flags,
        np.concatenate([raster.uvs, new[:, 4:6].astype(np.float32)]),
        np.concatenate([raster.triangles[whole], numbers])[order],
        constant.triangle_look[source][order],
    )


def _blends_last(raster: Raster, look_alpha: NDArray[np.uint8]) -> tuple[Raster, int]:
    """Triangles that blend put behind the others, farthest first; and how many do not blend.

    A triangle's distance is that of its middle; equals keep their drawing order.
    """
    count = len(raster.triangles)
    if not (look_alpha == BLEND).any():
        return raster, count
    blends = look_alpha[raster.triangle_look] == BLEND
    (first,), (last,) = np.nonzero(~blends), np.nonzero(blends)
    nearness = raster.depth[raster.triangles[last]].sum(axis=1)
    order = np.concatenate([first, last[np.argsort(nearness, kind="stable")]])
    return (
        replace(
            raster,
            triangles=raster.triangles[order],
            triangle_look=raster.triangle_look[order],
        ),
        len(first),
    )


def _draw(
    scene: Scene,
    constant: Topology,
    raster: Raster,
    opaque: int,
    grid: int,
    workers: int,
    picture: NDArray[np.uint32],
) -> None:
    worn = flattened(constant.wardrobe)
    tables = (
        worn.look_coats,
        worn.look_alpha,
        worn.look_lit,
        worn.coat_rects,
        worn.coat_tints,
        worn.atlas.view(np.uint32)[..., 0],
    )
    mesh = (
        raster.triangles,
        raster.triangle_look,
        raster.corners,
        raster.depth,
        raster.inv_w,
        raster.uvs,
        raster.shade,
    )
    background = np.array(scene.background, np.uint8).view(np.uint32)[0]
    tint = np.array(scene.light.tint, np.float64)
    tiles_x, tiles_y = (-(-side * grid // TILE) for side in scene.size)
    strips = [(0, tiles_y)]
    while strips:
        top, rows = strips.pop()
        starts, entries = _tile_lists(raster, tiles_x, top, rows, workers)
        if entries is None:
            strips += [(top + rows // 2, rows - rows // 2), (top, rows // 2)]
            continue

        def run(worker: int, top: int = top, starts: Any = starts, entries: Any = entries) -> None:
            draw_tiles(
                worker,
                workers,
                tiles_x,
                top,
                starts,
                entries,
                opaque,
                mesh,
                tables,
                tint,
                background,
                grid,
                picture,
            )

        share_out(run, workers)


def _tile_lists(
    raster: Raster, tiles_x: int, top: int, rows: int, workers: int
) -> tuple[NDArray[np.int64], NDArray[np.int32] | None]:
    """The triangles of each tile in some rows of tiles: where each tile's begin, and they.

    Instead of lists too long for the memory, None; a single row of tiles is never too long.
    """
    count = len(raster.triangles)
    if count <= FEW_VERTICES:
        workers = 1
    share = _shares(count, workers)
    cursors = np.zeros((workers, rows * tiles_x), np.int64)

    def run(worker: int, entries: NDArray[np.int32], fill: bool) -> None:
        sort_into_tiles(
            *share[worker : worker + 2],
            raster.corners,
            raster.triangles,
            tiles_x,
            top,
            rows,
            cursors[worker],
            entries,
            fill,
        )

    share_out(lambda worker: run(worker, np.empty(0, np.int32), False), workers)
    ends = np.cumsum(cursors.T).reshape(cursors.T.shape).T
    total = int(ends[-1, -1])
    starts = np.concatenate([[0], ends[-1]])
    if total > MAX_ENTRIES and rows > 1:
        return starts, None
    entries = np.empty(total, np.int32)
    np.subtract(ends, cursors, out=cursors)
    share_out(lambda worker: run(worker, entries, True), workers)
    return starts, entries
