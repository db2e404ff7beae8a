"""The rasteriser: tiles are covered, shaded, and put into the picture; see `coverage`."""

from typing import Any

import numpy as np

from drapery.jit import entry_point, kernel
from drapery.render.soft.bins import ID_BITS, ID_MASK, TILE, TILE_BITS
from drapery.render.soft.blending import FULL_LIGHT, OPAQUE_BITS, lay_over, lit, resolve, tinted
from drapery.render.soft.cast import cast_shadows
from drapery.render.soft.coverage import BLEND, LANES, LAYER, STRIDE, cover_tile, weights_at


@kernel
def _reach(low: Any, high: Any, count: Any) -> Any:
    """The first and last of `count` texels that a triangle with these bounds of u or v reaches.

    A sample on the edge of a triangle must not show a neighbouring part of the sheet.
    """
    first = min(max(np.int64(low * count + 1e-3), 0), count - 1)
    last = min(max(np.int64(np.ceil(high * count - 1e-3)) - 1, first), count - 1)
    return first, last


@kernel
def _shade_tile(
    layer: Any,
    bounds: Any,
    x0: Any,
    y0: Any,
    vertices: Any,
    triangles: Any,
    triangle_material: Any,
    tables: Any,
    tint: Any,
    receivers: Any,
    shadows: Any,
    grid: Any,
    keys: Any,
    colours: Any,
    scratch: Any,
) -> Any:
    """Colour the visible samples of the tile at x0, y0, one run of the same triangle after another.

    layer: start of the keys; 0 for solid triangles, LAYER for one that blends.
    receivers, shadows: see `draw_tiles`. grid: samples along a pixel's side.
    scratch: u, v, light, place in the atlas and colour of each sample of a run, then those of
        `cast_shadows`.
    The layers are composited first and lit once at the end. Each step is a separate loop over whole
    groups of samples, so that it can be vectorised.
    """
    materials, layers, atlas, wide = tables
    (u, v, light, place, shown), dusk = scratch
    left, right, top, bottom = bounds
    for row in range(top, bottom + 1):
        start = layer + row * STRIDE
        last = left - 1
        while last < right:
            x = last + 1
            seen = keys[np.uint64(start + x)] & ID_MASK
            last = x
            while last < right and keys[np.uint64(start + last + 1)] & ID_MASK == seen:
                last += 1
            if seen == 0:
                continue

            t = seen - 1
            a, b, c = (
                vertices[triangles[t, 0]],
                vertices[triangles[t, 1]],
                vertices[triangles[t, 2]],
            )
            wa, wb, wc, da, db, dc = weights_at(t, x0 + x, y0 + row, vertices, triangles)
            w0, dw = wa + wb + wc, da + db + dc
            u0, du = wa * a.u + wb * b.u + wc * c.u, da * a.u + db * b.u + dc * c.u
            v0, dv = wa * a.v + wb * b.v + wc * c.v, da * a.v + db * b.v + dc * c.v
            s0 = (wa * a.shade + wb * b.shade + wc * c.shade) * FULL_LIGHT
            ds = (da * a.shade + db * b.shade + dc * c.shade) * FULL_LIGHT
            u_low, u_high = min(a.u, b.u, c.u), max(a.u, b.u, c.u)
            v_low, v_high = min(a.v, b.v, c.v), max(a.v, b.v, c.v)

            material = triangle_material[t]
            lowest = materials[material, 0]
            end = lowest + materials[material, 1]
            solid = np.uint32(OPAQUE_BITS if materials[material, 2] != BLEND else 0)
            across, down = np.float64(layers[lowest, 2]), np.float64(layers[lowest, 3])
            i_first, i_last = _reach(u_low, u_high, layers[lowest, 2])
            j_first, j_last = _reach(v_low, v_high, layers[lowest, 3])
            i_low, i_high = np.float64(i_first), np.float64(i_last)
            j_low, j_high = np.float64(j_first), np.float64(j_last)
            origin = layers[lowest, 1] * wide + layers[lowest, 0]
            count = last - x + 1
            whole = ((count - 1) // LANES + 1) * LANES
            for k in range(whole):
                at = np.float64(k)
                w = 1.0 / (w0 + at * dw)
                su, sv = (u0 + at * du) * w, (v0 + at * dv) * w
                u[np.uint64(k)], v[np.uint64(k)] = su, sv
                light[np.uint64(k)] = np.int32((s0 + at * ds) * w)
                i = np.int32(min(max(su * across, i_low), i_high))
                j = np.int32(min(max(sv * down, j_low), j_high))
                place[np.uint64(k)] = origin + j * wide + i
            if len(receivers) and materials[material, 3] and shadows[0][t]:
                weights = wa, wb, wc, da, db, dc
                cast_shadows(
                    t,
                    x0 + x,
                    y0 + row,
                    count,
                    weights,
                    triangles,
                    receivers,
                    shadows[1],
                    grid,
                    light,
                    dusk,
                )
            for k in range(count):
                shown[np.uint64(k)] = atlas[np.uint64(place[np.uint64(k)])] | solid

            red, green, blue = layers[lowest, 4], layers[lowest, 5], layers[lowest, 6]
            if red & green & blue != 255:
                for k in range(count):
                    shown[k] = tinted(np.int64(shown[k]), red, green, blue)
            for upper in range(lowest + 1, end):
                red, green, blue = layers[upper, 4], layers[upper, 5], layers[upper, 6]
                i_first, i_last = _reach(u_low, u_high, layers[upper, 2])
                j_first, j_last = _reach(v_low, v_high, layers[upper, 3])
                origin = layers[upper, 1] * wide + layers[upper, 0]
                for k in range(count):
                    column = min(max(np.int64(u[k] * layers[upper, 2]), i_first), i_last)
                    line = min(max(np.int64(v[k] * layers[upper, 3]), j_first), j_last)
                    texel = np.int64(atlas[np.uint64(origin + line * wide + column)])
                    texel = tinted(texel, red, green, blue)
                    shown[k] = lay_over(texel, np.int64(shown[k]))
            if materials[material, 3]:
                for k in range(whole):
                    colour = np.int64(shown[np.uint64(k)])
                    shown[np.uint64(k)] = lit(colour, np.int64(light[np.uint64(k)]), tint)
            at = row * TILE + x
            if layer:
                for k in range(count):
                    shown[k] = lay_over(np.int64(shown[k]), np.int64(colours[at + k]))
            for k in range(count):
                colours[np.uint64(at + k)] = shown[np.uint64(k)]


@entry_point
def draw_tiles(
    part: Any,
    parts: Any,
    tiles_x: Any,
    first: Any,
    starts: Any,
    records: Any,
    mesh: Any,
    tables: Any,
    tint: Any,
    receivers: Any,
    shadows: Any,
    background: Any,
    grid: Any,
    size: Any,
    picture: Any,
) -> Any:
    """Draw every parts-th tile, beginning with number `part`.

    tiles_x: tiles across; first: the tile of number 0, counted row by row.
    starts, records: the triangles of tile i are records[starts[i] : starts[i + 1]]; those that
        blend come last and are drawn in their order.
    mesh: vertices [V] of VERTEX, triangles [T, 3], triangle_material [T].
    tables: materials [L, 4]: first layer, count, alpha mode, lit; layers [C, 7]: x, y, width,
        height in the atlas, and tint; atlas [H * W], one uint32 a texel; W.
    tint: the light's colour, three factors in units of 1 / FULL_LIGHT, int64.
    receivers: where the vertices lie on the shadow map: x, y [samples], depth, and the brightness
        in shadow; shape [V, 4], float32, or empty for a light that casts no shadows.
    shadows: which triangles may lie in shadow, shape [T]; and the map's depths, its side and the
        distance of the places compared; see `ShadowMap`.
    background: one uint32, 0xAABBGGRR, as all colours here.
    grid: samples along a pixel's side.
    size: of the picture [pixels]; picture: shape [H * W], uint32, filled with the background.
    """
    across, down = size
    vertices, triangles, triangle_material = mesh
    keys = np.empty(2 * LAYER, np.int64)
    colours = np.empty(TILE * TILE, np.uint32)
    scratch = (
        np.empty(STRIDE),
        np.empty(STRIDE),
        np.empty(STRIDE, np.int32),
        np.empty(STRIDE, np.int32),
        np.zeros(STRIDE, np.uint32),
    )
    dusk = (
        np.empty(STRIDE),
        np.empty(STRIDE),
        np.empty(STRIDE, np.int32),
        np.empty(STRIDE, np.int32),
    )
    for tile in range(part, len(starts) - 1, parts):
        column, line = (first + tile) % tiles_x, (first + tile) // tiles_x
        x0, y0 = column << TILE_BITS, line << TILE_BITS
        px, py = x0 // grid, y0 // grid
        width, height = min(TILE // grid, across - px), min(TILE // grid, down - py)
        if starts[tile] == starts[tile + 1]:
            continue
        colours[:] = background
        keys[:LAYER] = 0
        entry, end = starts[tile], starts[tile + 1]
        layer = 0
        while entry < end:
            # All solid triangles at once, then the ones that blend, one by one.
            until = entry
            while until < end and records[until, 9] >> ID_BITS != BLEND:
                until += 1
            if until == entry:
                until, layer = entry + 1, LAYER
            bounds = cover_tile(
                entry, until, x0, y0, records, vertices, triangles, triangle_material, tables, keys
            )
            _shade_tile(
                layer,
                bounds,
                x0,
                y0,
                vertices,
                triangles,
                triangle_material,
                tables,
                tint,
                receivers,
                shadows,
                grid,
                keys,
                colours,
                (scratch, dusk),
            )
            entry = until
        resolve(colours, px, py, width, height, across, grid, picture)
