"""Coverage: the visible triangle at each sample of a tile.

Coverage is exact: corners are whole numbers of 1/256 sample, edge functions are 64-bit integers,
and a sample on an edge belongs to the triangle whose left or lower edge it is, so triangles that
share an edge cover each sample once. (This is OpenGL's top-left rule, whose rows count upwards:
llvmpipe covers the same samples.)

A sample stores one integer, the key: its depth in the upper bits and the number of its triangle in
the lower ones. The triangle with the greatest key is visible. At equal depth the triangle that is
drawn later wins, as under GL_LEQUAL, so the order of the work does not change the picture.

Perspective: with edge functions E_i, u = sum(E_i u_i / w_i) / sum(E_i / w_i); the area cancels.
"""

from typing import Any

import numpy as np

from drapery.jit import borrowing_kernel, entry_point
from drapery.render.soft.bins import ID_BITS, ID_MASK, LANES, STRIDE, TILE, TILE_BITS
from drapery.render.soft.projection import NEAREST
from drapery.render.soft.triangle_setup import texels_of

KEY_BITS = 31
KEY_SCALE = 1 << KEY_BITS
"""Units of a key in one unit of depth; the lowest ID_BITS bits hold the triangle's number."""

LAYER = TILE * STRIDE
"""Keys of a tile: one layer for solid triangles, one for a triangle that blends."""

OPAQUE, CUTOUT, BLEND = 0, 1, 2


@borrowing_kernel
def _edge(ax: Any, ay: Any, bx: Any, by: Any) -> Any:
    """The edge function from a to b: its steps to the right and down by one sample, and its value
    at the tile's first sample, less one if the edge belongs to the neighbouring triangle."""
    right = -(by - ay) << 8
    down = (bx - ax) << 8
    value = (by - ay) * ax - (bx - ax) * ay
    owned = by < ay or (by == ay and bx < ax)
    return right, down, value - (not owned)


@borrowing_kernel
def _depth_plane(
    ax: Any, ay: Any, za: Any, bx: Any, by: Any, zb: Any, cx: Any, cy: Any, zc: Any, area: Any
) -> Any:
    """The keys' depth at the tile's first sample, and its steps to the right and down.

    These integers may overflow outside the triangle; inside it they are correct.
    """
    scale = 1.0 / np.float64(area)
    right = ((zb - za) * (cy - ay) - (zc - za) * (by - ay)) * scale
    down = ((zc - za) * (bx - ax) - (zb - za) * (cx - ax)) * scale
    if max(abs(right), abs(down)) >= NEAREST:
        # Seen from its edge, so near and far are within 1/256 sample: any of its depths is correct.
        right = down = 0.0
    step_right, step_down = np.int64(right * KEY_SCALE), np.int64(down * KEY_SCALE)
    return za * KEY_SCALE - ax * step_right - ay * step_down, step_right << 8, step_down << 8


@borrowing_kernel
def cover_tile(
    first: Any,
    last: Any,
    x0: Any,
    y0: Any,
    records: Any,
    vertices: Any,
    triangles: Any,
    triangle_material: Any,
    tables: Any,
    keys: Any,
) -> Any:
    """Write the keys of records first..last - 1 in the tile at x0, y0.

    Returns the bounds of the samples tried: left, right, top, bottom.
    """
    materials, layers, atlas, wide = tables
    edge_left, edge_right, edge_top, edge_bottom = TILE, -1, TILE, -1
    for entry in range(first, last):
        ax, ay = np.int64(records[entry, 0]) - (x0 << 8), np.int64(records[entry, 1]) - (y0 << 8)
        bx, by = np.int64(records[entry, 2]) - (x0 << 8), np.int64(records[entry, 3]) - (y0 << 8)
        cx, cy = np.int64(records[entry, 4]) - (x0 << 8), np.int64(records[entry, 5]) - (y0 << 8)
        za, zb = np.int64(records[entry, 6]), np.int64(records[entry, 7])
        zc = np.int64(records[entry, 8])
        t = np.int64(records[entry, 9]) & ID_MASK
        mode = records[entry, 9] >> ID_BITS
        area = (bx - ax) * (cy - ay) - (by - ay) * (cx - ax)
        if area == 0:
            continue
        if area < 0:
            bx, by, zb, cx, cy, zc = cx, cy, zc, bx, by, zb
            area = -area
        right_ab, down_ab, at_ab = _edge(ax, ay, bx, by)
        right_bc, down_bc, at_bc = _edge(bx, by, cx, cy)
        right_ca, down_ca, at_ca = _edge(cx, cy, ax, ay)
        z, step_right, step_down = _depth_plane(ax, ay, za, bx, by, zb, cx, cy, zc, area)

        left = max((min(ax, bx, cx) + 255) >> 8, 0)
        right = min(max(ax, bx, cx) >> 8, TILE - 1)
        top = max((min(ay, by, cy) + 255) >> 8, 0)
        bottom = min(max(ay, by, cy) >> 8, TILE - 1)
        edge_left, edge_right = min(edge_left, left), max(edge_right, right)
        edge_top, edge_bottom = min(edge_top, top), max(edge_bottom, bottom)
        count = ((right - left) // LANES + 1) * LANES
        for row in range(top, bottom + 1):
            ab = at_ab + row * down_ab + left * right_ab
            bc = at_bc + row * down_bc + left * right_bc
            ca = at_ca + row * down_ca + left * right_ca
            depth = z + row * step_down + left * step_right
            start = row * STRIDE + left
            if mode == OPAQUE:
                for k in range(count):
                    at = np.uint64(start + k)
                    key = (depth & ~ID_MASK) | (t + 1)
                    keys[at] = max(keys[at], key if ab | bc | ca >= 0 else np.int64(0))
                    ab, bc, ca = ab + right_ab, bc + right_bc, ca + right_ca
                    depth += step_right
                continue
            layer = materials[triangle_material[t], 0]
            across, down = layers[layer, 2], layers[layer, 3]
            a, b, c = (
                vertices[triangles[t, 0]],
                vertices[triangles[t, 1]],
                vertices[triangles[t, 2]],
            )
            i_low, i_high = texels_of(a.u, b.u, c.u, across)
            j_low, j_high = texels_of(a.v, b.v, c.v, down)
            for k in range(count):
                at = np.uint64(start + k)
                outside = (ab + k * right_ab) | (bc + k * right_bc) | (ca + k * right_ca)
                key = ((depth + k * step_right) & ~ID_MASK) | (t + 1)
                if mode == BLEND:
                    shown = outside >= 0 and key | ID_MASK >= keys[at]
                    keys[at + np.uint64(LAYER)] = key if shown else np.int64(0)
                elif outside >= 0 and key > keys[at]:
                    u, v = _uv_at(t, x0 + left + k, y0 + row, vertices, triangles)
                    i = min(max(np.int64(u * across), i_low), i_high)
                    j = min(max(np.int64(v * down), j_low), j_high)
                    if atlas[(layers[layer, 1] + j) * wide + layers[layer, 0] + i] >> 31:
                        keys[at] = key
    return edge_left, edge_right, edge_top, edge_bottom


@borrowing_kernel
def cover_solid(
    tile: Any,
    tiles_x: Any,
    first: Any,
    starts: Any,
    records: Any,
    mesh: Any,
    tables: Any,
    keys: Any,
) -> Any:
    """Write the keys of a tile's triangles that do not blend; its first sample across and down.

    All parameters: see `draw_tiles`.
    """
    vertices, triangles, triangle_material = mesh
    column, line = (first + tile) % tiles_x, (first + tile) // tiles_x
    x0, y0 = column << TILE_BITS, line << TILE_BITS
    entry, end = starts[tile], starts[tile + 1]
    while end > entry and records[end - 1, 9] >> ID_BITS == BLEND:
        end -= 1
    keys[:LAYER] = 0
    cover_tile(entry, end, x0, y0, records, vertices, triangles, triangle_material, tables, keys)
    return x0, y0


@borrowing_kernel
def weights_at(t: Any, x: Any, y: Any, vertices: Any, triangles: Any) -> Any:
    """Edge functions over w of triangle t's corners at a sample, and their steps to the right."""
    a, b, c = vertices[triangles[t, 0]], vertices[triangles[t, 1]], vertices[triangles[t, 2]]
    ax, ay = np.int64(a.x) - (x << 8), np.int64(a.y) - (y << 8)
    bx, by = np.int64(b.x) - (x << 8), np.int64(b.y) - (y << 8)
    cx, cy = np.int64(c.x) - (x << 8), np.int64(c.y) - (y << 8)
    return (
        np.float64(bx * cy - by * cx) * a.inv_w,
        np.float64(cx * ay - cy * ax) * b.inv_w,
        np.float64(ax * by - ay * bx) * c.inv_w,
        np.float64((by - cy) << 8) * a.inv_w,
        np.float64((cy - ay) << 8) * b.inv_w,
        np.float64((ay - by) << 8) * c.inv_w,
    )


@borrowing_kernel
def _uv_at(t: Any, x: Any, y: Any, vertices: Any, triangles: Any) -> Any:
    """Texture coordinates of triangle t at one sample."""
    a, b, c = vertices[triangles[t, 0]], vertices[triangles[t, 1]], vertices[triangles[t, 2]]
    wa, wb, wc, _, _, _ = weights_at(t, x, y, vertices, triangles)
    w = 1.0 / (wa + wb + wc)
    return (wa * a.u + wb * b.u + wc * c.u) * w, (wa * a.v + wb * b.v + wc * c.v) * w


@entry_point
def depth_tiles(
    part: Any,
    parts: Any,
    tiles_x: Any,
    first: Any,
    starts: Any,
    records: Any,
    mesh: Any,
    tables: Any,
    depths: Any,
) -> Any:
    """Write the greatest depth at each sample of every parts-th tile, beginning with `part`.

    depths: shape [(TILE * tiles_x)^2], int32, filled with 0. All else: see `draw_tiles`.
    """
    keys = np.empty(2 * LAYER, np.int64)
    across = tiles_x << TILE_BITS
    for tile in range(part, len(starts) - 1, parts):
        if starts[tile] == starts[tile + 1]:
            continue
        x0, y0 = cover_solid(tile, tiles_x, first, starts, records, mesh, tables, keys)
        for row in range(TILE):
            for k in range(TILE):
                at = np.uint64((y0 + row) * across + x0 + k)
                depths[at] = keys[np.uint64(row * STRIDE + k)] >> KEY_BITS
