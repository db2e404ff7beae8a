"""The visible surface at each pixel: its depth, normal, texture coordinates and model."""

from typing import Any

import numpy as np

from drapery.jit import entry_point
from drapery.render.soft.bins import ID_MASK, STRIDE, TILE
from drapery.render.soft.coverage import KEY_BITS, LAYER, cover_solid, weights_at
from drapery.render.soft.projection import NEAREST


@entry_point
def surface_tiles(
    part: Any,
    parts: Any,
    tiles_x: Any,
    first: Any,
    starts: Any,
    records: Any,
    mesh: Any,
    tables: Any,
    directions: Any,
    owners: Any,
    numbers: Any,
    lens: Any,
    size: Any,
    buffers: Any,
) -> Any:
    """Write the surface at the pixels of every parts-th tile, beginning with number `part`.

    directions: the normal at each vertex, shape [V, 3], float32.
    owners: the number of its model, shape [V], int32.
    numbers: of the materials, see `Buffers`, shape [L], int32.
    lens: near plane, far plane [m], and whether the picture is orthographic.
    size: of the picture [pixels]. buffers: the results, `depth`, `normal`, `model`, `uv` and
    `material` as in `Buffers`, filled with those of the background. All else: see `draw_tiles`.
    """
    vertices, triangles, triangle_material = mesh
    (near, far, flat), (across, down) = lens, size
    depths, normals, models, uvs, materials = buffers
    keys = np.empty(2 * LAYER, np.int64)
    for tile in range(part, len(starts) - 1, parts):
        if starts[tile] == starts[tile + 1]:
            continue
        x0, y0 = cover_solid(tile, tiles_x, first, starts, records, mesh, tables, keys)
        for row in range(min(TILE, down - y0)):
            for k in range(min(TILE, across - x0)):
                key = keys[row * STRIDE + k]
                if key == 0:
                    continue
                t = (key & ID_MASK) - 1
                wa, wb, wc, _, _, _ = weights_at(t, x0 + k, y0 + row, vertices, triangles)
                w = 1.0 / (wa + wb + wc)
                i, j, m = triangles[t, 0], triangles[t, 1], triangles[t, 2]
                a, b, c = vertices[i], vertices[j], vertices[m]
                nearness = (key >> KEY_BITS) / NEAREST
                y, x = y0 + row, x0 + k
                if flat:
                    depths[y, x] = near + (1.0 - nearness) * (far - near)
                else:
                    depths[y, x] = near * far / (near + nearness * (far - near))
                nx = (wa * directions[i, 0] + wb * directions[j, 0] + wc * directions[m, 0]) * w
                ny = (wa * directions[i, 1] + wb * directions[j, 1] + wc * directions[m, 1]) * w
                nz = (wa * directions[i, 2] + wb * directions[j, 2] + wc * directions[m, 2]) * w
                length = max(np.sqrt(nx * nx + ny * ny + nz * nz), 1e-12)
                normals[y, x, 0] = nx / length
                normals[y, x, 1] = ny / length
                normals[y, x, 2] = nz / length
                models[y, x] = owners[i]
                materials[y, x] = numbers[triangle_material[t]]
                uvs[y, x, 0] = (wa * a.u + wb * b.u + wc * c.u) * w
                uvs[y, x, 1] = (wa * a.v + wb * b.v + wc * c.v) * w
