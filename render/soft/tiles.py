"""The rasteriser: tiles are covered, shaded, and put into the picture; see `coverage`."""

from typing import Any

import numpy as np

from drapery.jit import borrowing_kernel, entry_point
from drapery.render.soft.bins import ID_BITS, ID_MASK, LANES, STRIDE, TILE, TILE_BITS
from drapery.render.soft.blending import (
    FULL_LIGHT,
    OPAQUE_BITS,
    UNLIT,
    factors_of,
    lay_over,
    lit,
    resolve,
    tinted,
)
from drapery.render.soft.cast import cast_shadows
from drapery.render.soft.coverage import BLEND, LAYER, cover_tile
from drapery.render.soft.detail import PLACES, add_details, add_gloss, glossy
from drapery.render.soft.triangle_setup import SETUP, SLOTS, set_up, texels_of, weights_of


@borrowing_kernel
def _find_runs(keys: Any, start: Any, left: Any, right: Any, runs: Any) -> Any:
    """The number of runs of one triangle, or none, among the samples left..right of a row.

    start: the row's keys. runs: the first sample of each run, then the end of the last one.
    There is no branch, because no processor predicts where a run ends.
    """
    count, last = 0, np.int64(-1)
    for x in range(left, right + 1):
        seen = keys[np.uint64(start + x)] & ID_MASK
        runs[np.uint64(count)] = x
        count += seen != last
        last = seen
    runs[np.uint64(count)] = right + 1
    return count


@borrowing_kernel
def _lay_layers(
    material: Any,
    first: Any,
    count: Any,
    lines: Any,
    tables: Any,
    setup: Any,
    place: Any,
    shown: Any,
) -> Any:
    """Tint the lowest layer of a run in `shown` and lay the others over it.

    material: its first layer and their number. first, count: the run in `place` and `shown`.
    lines: 1 / w, u and v over w, each at the first sample and its step to the right.
    """
    (_, layers, atlas, wide), (w0, dw, u0, du, v0, dv) = tables, lines
    lowest = material[0]
    red, green, blue = layers[lowest, 4], layers[lowest, 5], layers[lowest, 6]
    if red & green & blue != 255:
        for k in range(first, first + count):
            shown[k] = tinted(np.int64(shown[k]), red, green, blue)
    for upper in range(lowest + 1, lowest + material[1]):
        across, down = layers[upper, 2], layers[upper, 3]
        origin = layers[upper, 1] * wide + layers[upper, 0]
        red, green, blue = layers[upper, 4], layers[upper, 5], layers[upper, 6]
        if across != layers[lowest, 2] or down != layers[lowest, 3]:
            i_low, i_high = texels_of(setup.ua, setup.ub, setup.uc, across)
            j_low, j_high = texels_of(setup.va, setup.vb, setup.vc, down)
            for k in range(count):
                w = 1.0 / (w0 + k * dw)
                i = min(max(np.int64((u0 + k * du) * w * across), i_low), i_high)
                j = min(max(np.int64((v0 + k * dv) * w * down), j_low), j_high)
                texel = tinted(np.int64(atlas[origin + j * wide + i]), red, green, blue)
                shown[first + k] = lay_over(texel, np.int64(shown[first + k]))
            continue
        # A layer of the same size is a fixed distance away.
        away = origin - setup.origin
        for k in range(first, first + count):
            texel = np.int64(atlas[np.uint64(place[np.uint64(k)] + away)])
            texel = tinted(texel, red, green, blue)
            shown[np.uint64(k)] = lay_over(texel, np.int64(shown[np.uint64(k)]))


@borrowing_kernel
def _light_row(row: Any, shown: Any, light: Any, tint: Any, seen: Any, colours: Any) -> Any:
    """Light the colours of a row's samples that a solid triangle covers.

    shown, light: of each sample. seen: the keys of the tile.
    """
    is_white = tint[0] == FULL_LIGHT and tint[1] == FULL_LIGHT and tint[2] == FULL_LIGHT
    for x in range(TILE if is_white else 0):
        # The loop without a tint takes half the time.
        bright = light[np.uint64(x)]
        factor = np.uint32(bright)
        colour = lit(shown[np.uint64(x)], bright, (factor, factor, factor))
        at, is_seen = np.uint64(row * TILE + x), seen[np.uint64(row * STRIDE + x)] != 0
        colours[at] = colour if is_seen else colours[at]
    for x in range(0 if is_white else TILE):
        bright = light[np.uint64(x)]
        colour = lit(shown[np.uint64(x)], bright, factors_of(bright, tint))
        at, is_seen = np.uint64(row * TILE + x), seen[np.uint64(row * STRIDE + x)] != 0
        colours[at] = colour if is_seen else colours[at]


@borrowing_kernel
def _blend_row(
    row: Any,
    left: Any,
    right: Any,
    shown: Any,
    light: Any,
    shine: Any,
    tint: Any,
    seen: Any,
    colours: Any,
) -> Any:
    """Lay the samples left..right of a triangle that blends over the colours of a row.

    shine: their gloss, see `add_details`.
    """
    for x in range(left, right + 1):
        share = np.int64(shine[x])
        if seen[LAYER + row * STRIDE + x]:
            colour = np.int64(lit(shown[x], light[x], factors_of(light[x], tint)))
            if share > 0:
                colour = glossy(colour, tint, share)
            colours[row * TILE + x] = lay_over(colour, np.int64(colours[row * TILE + x]))


@borrowing_kernel
def _shade_tile(
    layer: Any,
    bounds: Any,
    x0: Any,
    y0: Any,
    mesh: Any,
    tables: Any,
    tint: Any,
    receivers: Any,
    shadows: Any,
    details: Any,
    grid: Any,
    keys: Any,
    colours: Any,
    scratch: Any,
) -> Any:
    """Colour the visible samples of the tile at x0, y0, one run of the same triangle after another.

    layer: start of the keys; 0 for solid triangles, LAYER for one that blends.
    tint: see `lit`. receivers, shadows, details: see `draw_tiles`. grid: samples along a pixel's
        side.
    scratch: setups of triangles; of each sample of a row the runs, light, place in the atlas,
        colour and gloss; then the scratch of `cast_shadows` and of `add_details`.
    The layers of a run are composited first, and a row is lit once at the end. A loop goes over
    whole groups of samples, so that it can be vectorised: what is beyond a run is overwritten by
    the next one, or not seen.
    """
    _, triangles, triangle_material = mesh
    materials, _, atlas, wide = tables
    setups, (runs, light, place, shown, shine), dusk, places = scratch
    is_detailed = len(details[0]) > 0
    solid = np.uint32(0 if layer else OPAQUE_BITS)
    left, right, top, bottom = bounds
    for row in range(top, bottom + 1):
        start = layer + row * STRIDE
        found = _find_runs(keys, start, left, right, runs)
        for run in range(found):
            x, until = np.int64(runs[np.uint64(run)]), np.int64(runs[np.uint64(run + 1)])
            t = (keys[np.uint64(start + x)] & ID_MASK) - 1
            if t < 0:
                continue
            count = until - x
            setup = setups[t & (SLOTS - 1)]
            if setup.triangle != t:
                set_up(t, mesh, tables, setup)
            wa, wb, wc = weights_of(setup, x0 + x, y0 + row)
            w0, dw = wa + wb + wc, setup.dw
            u0, du = wa * setup.ua + wb * setup.ub + wc * setup.uc, setup.du
            v0, dv = wa * setup.va + wb * setup.vb + wc * setup.vc, setup.dv
            s0, ds = (wa * setup.sa + wb * setup.sb + wc * setup.sc) * FULL_LIGHT, setup.ds
            origin, across, down = setup.origin, setup.across, setup.down
            i_low, i_high, j_low, j_high = setup.i_low, setup.i_high, setup.j_low, setup.j_high
            whole = ((count - 1) // LANES + 1) * LANES
            for k in range(whole):
                at = np.float64(k)
                w = 1.0 / (w0 + at * dw)
                u, v = (u0 + at * du) * w, (v0 + at * dv) * w
                # In this order, what is beyond the run and not a number still is a texel.
                i = np.int32(min(i_high, max(i_low, u * across)))
                j = np.int32(min(j_high, max(j_low, v * down)))
                place[np.uint64(x + k)] = origin + j * wide + i
                light[np.uint64(x + k)] = np.int32((s0 + at * ds) * w)
            for k in range(x, x + whole):
                shown[np.uint64(k)] = atlas[np.uint64(place[np.uint64(k)])] | solid
            if not setup.is_plain:
                lines = w0, dw, u0, du, v0, dv
                _lay_layers(
                    materials[triangle_material[t]], x, count, lines, tables, setup, place, shown
                )
            if not setup.is_lit:
                light[x:until] = UNLIT
            elif len(receivers) and shadows[0][t]:
                weights = wa, wb, wc, setup.da, setup.db, setup.dc
                cast_shadows(
                    t,
                    x0 + x,
                    y0 + row,
                    x,
                    count,
                    weights,
                    triangles,
                    receivers,
                    shadows[1],
                    grid,
                    light,
                    dusk,
                )
        if is_detailed:
            add_details(
                x0,
                y0 + row,
                start,
                found,
                runs,
                keys,
                mesh,
                tables,
                details,
                grid,
                setups,
                light,
                shine,
                places,
            )
        if layer:
            _blend_row(row, left, right, shown, light, shine, tint, keys, colours)
        else:
            _light_row(row, shown, light, tint, keys, colours)
            if is_detailed:
                add_gloss(row, tint, shine, keys, colours)


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
    details: Any,
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
    details: how vertices lean, see `lean_vertices`, empty where no material has a detail; the rows,
        tiles and edges of materials, see `DetailTables`.
    background: one uint32, 0xAABBGGRR, as all colours here.
    grid: samples along a pixel's side.
    size: of the picture [pixels]; picture: shape [H * W], uint32, filled with the background.
    """
    across, down = size
    vertices, triangles, triangle_material = mesh
    factors = np.uint32(tint[0]), np.uint32(tint[1]), np.uint32(tint[2])
    keys = np.empty(2 * LAYER, np.int64)
    colours = np.empty(TILE * TILE, np.uint32)
    sums = np.empty(2 * STRIDE, np.uint32)
    setups = np.empty(SLOTS, SETUP)
    for slot in range(SLOTS):
        setups[slot].triangle = -1
    scratch = (
        setups,
        (
            np.empty(STRIDE, np.int32),
            np.zeros(STRIDE, np.int32),
            np.zeros(STRIDE, np.int32),
            np.zeros(STRIDE, np.uint32),
            np.zeros(STRIDE, np.int32),
        ),
        (
            np.empty(STRIDE),
            np.empty(STRIDE),
            np.empty(STRIDE, np.int32),
            np.empty(STRIDE, np.int32),
            np.empty(STRIDE, np.int32),
            np.empty(STRIDE, np.int32),
        ),
        (
            np.zeros(7 * PLACES),
            np.zeros(6 * PLACES, np.int64),
            np.zeros(4 * PLACES, np.int32),
            np.zeros(TILE, np.int32),
        ),
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
                mesh,
                tables,
                factors,
                receivers,
                shadows,
                details,
                grid,
                keys,
                colours,
                scratch,
            )
            entry = until
        resolve(colours, px, py, width, height, across, grid, picture, sums)
