"""The rasteriser: the visible triangle at each sample of a tile, and its colour.

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

from drapery.jit import entry_point, kernel
from drapery.render.soft.bins import ID_BITS, ID_MASK, TILE, TILE_BITS
from drapery.render.soft.projection import NEAREST

KEY_BITS = 31
KEY_SCALE = 1 << KEY_BITS
"""Units of a key in one unit of depth; the lowest ID_BITS bits hold the triangle's number."""

LANES = 8
"""Samples in a group; groups are tested without a branch, for SIMD instructions."""

STRIDE = TILE + LANES
LAYER = TILE * STRIDE
"""Keys of a tile: one layer for solid triangles, one for a triangle that blends."""

OPAQUE, CUTOUT, BLEND = 0, 1, 2
OPAQUE_BITS = 0xFF000000
CHANNELS = 0x00FF00FF
HALVES = 0x00010001
"""Two channels of a colour, eight bits apart, and one unit of each."""

FLAT_AREA = 1e-3
LARGE = 131072.0
"""Triangles of a smaller area, and in larger rectangles, are not tested as a whole [samples^2]."""

TAPS = 4
TAPS_MIDDLE = 1.5
"""Places of the shadow map along one side of the square that is compared, and their middle."""

LIGHT_BITS = 24
FULL_LIGHT = 1 << LIGHT_BITS
"""Light is multiplied in integers, which is faster than converting colours to floats and back."""


@kernel
def _edge(ax: Any, ay: Any, bx: Any, by: Any) -> Any:
    """The edge function from a to b: its steps to the right and down by one sample, and its value
    at the tile's first sample, less one if the edge belongs to the neighbouring triangle."""
    right = -(by - ay) << 8
    down = (bx - ax) << 8
    value = (by - ay) * ax - (bx - ax) * ay
    owned = by < ay or (by == ay and bx < ax)
    return right, down, value - (not owned)


@kernel
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


@kernel
def _lay_over(top: Any, below: Any) -> Any:
    """Straight-alpha colours, one over the other, in 8 bits as the game blends."""
    a, d = top >> 24, below >> 24
    if a == 255 or a == 0:
        return top if a else below
    if d == 255:
        rest = 255 - a
        red = (a * (top & 255) + rest * (below & 255) + 127) // 255
        green = (a * ((top >> 8) & 255) + rest * ((below >> 8) & 255) + 127) // 255
        blue = (a * ((top >> 16) & 255) + rest * ((below >> 16) & 255) + 127) // 255
        return OPAQUE_BITS | blue << 16 | green << 8 | red
    share, rest = 255 * a, d * (255 - a)
    total = share + rest
    half = total >> 1
    red = (share * (top & 255) + rest * (below & 255) + half) // total
    green = (share * ((top >> 8) & 255) + rest * ((below >> 8) & 255) + half) // total
    blue = (share * ((top >> 16) & 255) + rest * ((below >> 16) & 255) + half) // total
    return ((total + 127) // 255) << 24 | blue << 16 | green << 8 | red


@kernel
def _tinted(texel: Any, red: Any, green: Any, blue: Any) -> Any:
    """round(texel * tint / 255) for each channel; the alpha is kept."""
    r = ((texel & 255) * red + 127) // 255
    g = (((texel >> 8) & 255) * green + 127) // 255
    b = (((texel >> 16) & 255) * blue + 127) // 255
    return (texel & OPAQUE_BITS) | b << 16 | g << 8 | r


@kernel
def _lit(colour: Any, light: Any, tint: Any) -> Any:
    """round(colour * light * tint) for each channel; light and tint in units of 1 / FULL_LIGHT."""
    half = FULL_LIGHT >> 1
    r = ((colour & 255) * (light * tint[0] >> LIGHT_BITS) + half) >> LIGHT_BITS
    g = (((colour >> 8) & 255) * (light * tint[1] >> LIGHT_BITS) + half) >> LIGHT_BITS
    b = (((colour >> 16) & 255) * (light * tint[2] >> LIGHT_BITS) + half) >> LIGHT_BITS
    return (colour & OPAQUE_BITS) | b << 16 | g << 8 | r


@kernel
def _reach(low: Any, high: Any, count: Any) -> Any:
    """The first and last of `count` texels that a triangle with these bounds of u or v reaches.

    A sample on the edge of a triangle must not show a neighbouring part of the sheet.
    """
    first = min(max(np.int64(low * count + 1e-3), 0), count - 1)
    last = min(max(np.int64(np.ceil(high * count - 1e-3)) - 1, first), count - 1)
    return first, last


@kernel
def _cover_tile(
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
                    outside = (ab + k * right_ab) | (bc + k * right_bc) | (ca + k * right_ca)
                    key = ((depth + k * step_right) & ~ID_MASK) | (t + 1)
                    keys[at] = max(keys[at], key if outside >= 0 else np.int64(0))
                continue
            for k in range(count):
                at = np.uint64(start + k)
                outside = (ab + k * right_ab) | (bc + k * right_bc) | (ca + k * right_ca)
                key = ((depth + k * step_right) & ~ID_MASK) | (t + 1)
                if mode == BLEND:
                    shown = outside >= 0 and key | ID_MASK >= keys[at]
                    keys[at + np.uint64(LAYER)] = key if shown else np.int64(0)
                elif outside >= 0 and key > keys[at]:
                    layer = materials[triangle_material[t], 0]
                    u, v = _uv_at(t, x0 + left + k, y0 + row, vertices, triangles)
                    i = min(max(np.int64(u * layers[layer, 2]), 0), layers[layer, 2] - 1)
                    j = min(max(np.int64(v * layers[layer, 3]), 0), layers[layer, 3] - 1)
                    if atlas[(layers[layer, 1] + j) * wide + layers[layer, 0] + i] >> 31:
                        keys[at] = key
    return edge_left, edge_right, edge_top, edge_bottom


@kernel
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
    _cover_tile(entry, end, x0, y0, records, vertices, triangles, triangle_material, tables, keys)
    return x0, y0


@kernel
def _weights(t: Any, x: Any, y: Any, vertices: Any, triangles: Any) -> Any:
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


@kernel
def _uv_at(t: Any, x: Any, y: Any, vertices: Any, triangles: Any) -> Any:
    """Texture coordinates of triangle t at one sample."""
    a, b, c = vertices[triangles[t, 0]], vertices[triangles[t, 1]], vertices[triangles[t, 2]]
    wa, wb, wc, _, _, _ = _weights(t, x, y, vertices, triangles)
    w = 1.0 / (wa + wb + wc)
    return (wa * a.u + wb * b.u + wc * c.u) * w, (wa * a.v + wb * b.v + wc * c.v) * w


@kernel
def _sunlit(place: Any, column: Any, line: Any, grid: Any, shadows: Any) -> Any:
    """The share 0..1 of places around a place of the shadow map that the light reaches.

    column, line: which of the pixel's samples it is, 0..grid - 1. There are TAPS x TAPS places for
    each pixel, and each of its samples compares its own share of them.
    """
    (x, y, depth), (depths, side, spread) = place, shadows
    lit = 0
    for j in range(line, TAPS, grid):
        down = min(max(np.int64(y + (j - TAPS_MIDDLE) * spread), 0), side - 1)
        for i in range(column, TAPS, grid):
            across = min(max(np.int64(x + (i - TAPS_MIDDLE) * spread), 0), side - 1)
            lit += depths[np.uint64(down * side + across)] <= depth
    return np.float64(lit * (grid * grid)) / (TAPS * TAPS)


@kernel
def _cast(
    t: Any,
    x: Any,
    y: Any,
    count: Any,
    weights: Any,
    triangles: Any,
    receivers: Any,
    shadows: Any,
    grid: Any,
    light: Any,
    scratch: Any,
) -> Any:
    """Darken the light of a run of `count` samples of triangle t from x, y on, where it lies in
    shadow.

    weights: as `_weights` gives them. scratch: place, depth and darkness of each sample.
    """
    _, side, _ = shadows
    across, down, deep, dark = scratch
    wa, wb, wc, da, db, dc = weights
    a, b, c = triangles[t, 0], triangles[t, 1], triangles[t, 2]
    w0, dw = wa + wb + wc, da + db + dc
    x0 = wa * receivers[a, 0] + wb * receivers[b, 0] + wc * receivers[c, 0]
    dx = da * receivers[a, 0] + db * receivers[b, 0] + dc * receivers[c, 0]
    y0 = wa * receivers[a, 1] + wb * receivers[b, 1] + wc * receivers[c, 1]
    dy = da * receivers[a, 1] + db * receivers[b, 1] + dc * receivers[c, 1]
    z0 = wa * receivers[a, 2] + wb * receivers[b, 2] + wc * receivers[c, 2]
    dz = da * receivers[a, 2] + db * receivers[b, 2] + dc * receivers[c, 2]
    s0 = (wa * receivers[a, 3] + wb * receivers[b, 3] + wc * receivers[c, 3]) * FULL_LIGHT
    ds = (da * receivers[a, 3] + db * receivers[b, 3] + dc * receivers[c, 3]) * FULL_LIGHT
    highest = np.float64(side - 1)
    for k in range(((count - 1) // LANES + 1) * LANES):
        at = np.float64(k)
        w = 1.0 / (w0 + at * dw)
        column = min(max((x0 + at * dx) * w, 0.0), highest)
        line = min(max((y0 + at * dy) * w, 0.0), highest)
        across[np.uint64(k)], down[np.uint64(k)] = column, line
        deep[np.uint64(k)] = np.int32((z0 + at * dz) * w)
        dark[np.uint64(k)] = np.int32((s0 + at * ds) * w)
    for k in range(count):
        more = light[np.uint64(k)] - dark[np.uint64(k)]
        if more > 0:
            place = across[np.uint64(k)], down[np.uint64(k)], deep[np.uint64(k)]
            share = _sunlit(place, (x + k) % grid, y % grid, grid, shadows)
            light[np.uint64(k)] = dark[np.uint64(k)] + np.int32(more * share)


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
    scratch: u, v, light, place in the atlas and colour of each sample of a run, then `_cast`'s.
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
            wa, wb, wc, da, db, dc = _weights(t, x0 + x, y0 + row, vertices, triangles)
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
                _cast(
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
                    shown[k] = _tinted(np.int64(shown[k]), red, green, blue)
            for upper in range(lowest + 1, end):
                red, green, blue = layers[upper, 4], layers[upper, 5], layers[upper, 6]
                i_first, i_last = _reach(u_low, u_high, layers[upper, 2])
                j_first, j_last = _reach(v_low, v_high, layers[upper, 3])
                origin = layers[upper, 1] * wide + layers[upper, 0]
                for k in range(count):
                    column = min(max(np.int64(u[k] * layers[upper, 2]), i_first), i_last)
                    line = min(max(np.int64(v[k] * layers[upper, 3]), j_first), j_last)
                    texel = np.int64(atlas[np.uint64(origin + line * wide + column)])
                    texel = _tinted(texel, red, green, blue)
                    shown[k] = _lay_over(texel, np.int64(shown[k]))
            if materials[material, 3]:
                for k in range(whole):
                    colour = np.int64(shown[np.uint64(k)])
                    shown[np.uint64(k)] = _lit(colour, np.int64(light[np.uint64(k)]), tint)
            at = row * TILE + x
            if layer:
                for k in range(count):
                    shown[k] = _lay_over(np.int64(shown[k]), np.int64(colours[at + k]))
            for k in range(count):
                colours[np.uint64(at + k)] = shown[np.uint64(k)]


@kernel
def _resolve(
    colours: Any, x0: Any, y0: Any, width: Any, height: Any, across: Any, grid: Any, picture: Any
) -> Any:
    """Put a tile into the picture: grid x grid samples are averaged to a pixel, weighted by their
    opacity.

    Where all samples are opaque, which most are, the weights are equal: two channels at once are
    added in one number and divided by a power of two, which rounds as `_mean` does.
    """
    shift = np.uint32(4 if grid == 4 else 2)
    half = np.uint32(HALVES << (shift - np.uint32(1)))
    for row in range(height):
        start = (y0 + row) * across + x0
        if grid == 1:
            for column in range(width):
                picture[np.uint64(start + column)] = colours[np.uint64(row * TILE + column)]
            continue
        for column in range(width):
            corner = np.uint64(row * grid * TILE + column * grid)
            opaque = np.uint32(OPAQUE_BITS)
            low = high = half
            for line in range(grid):
                for place in range(grid):
                    colour = colours[corner + np.uint64(line * TILE + place)]
                    opaque &= colour
                    low += colour & np.uint32(CHANNELS)
                    high += (colour >> np.uint32(8)) & np.uint32(CHANNELS)
            at = np.uint64(start + column)
            if opaque == np.uint32(OPAQUE_BITS):
                low = (low >> shift) & np.uint32(CHANNELS)
                picture[at] = low | ((high >> shift) & np.uint32(CHANNELS)) << np.uint32(8)
            else:
                picture[at] = _mean(colours, np.int64(corner), grid)


@kernel
def _mean(colours: Any, corner: Any, grid: Any) -> Any:
    """The average of grid x grid samples from a corner, weighted by their opacity."""
    alpha = red = green = blue = np.int64(0)
    for line in range(grid):
        for place in range(grid):
            colour = np.int64(colours[corner + line * TILE + place])
            weight = colour >> 24
            alpha += weight
            red += weight * (colour & 255)
            green += weight * ((colour >> 8) & 255)
            blue += weight * ((colour >> 16) & 255)
    if alpha == 0:
        return np.int64(0)
    half, count = alpha >> 1, grid * grid
    red, green, blue = (red + half) // alpha, (green + half) // alpha, (blue + half) // alpha
    return (alpha + (count >> 1)) // count << 24 | blue << 16 | green << 8 | red


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
            bounds = _cover_tile(
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
        _resolve(colours, px, py, width, height, across, grid, picture)


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
                depths[(y0 + row) * across + x0 + k] = keys[row * STRIDE + k] >> KEY_BITS


@entry_point
def find_shaded(
    vertices: Any, triangles: Any, receivers: Any, depths: Any, side: Any, spread: Any, shaded: Any
) -> Any:
    """Find the triangles that may lie in shadow, as most are wholly lit or turned away.

    depths, side, spread: see `ShadowMap`. shaded: the result, shape [T], bool. All else: see
    `draw_tiles`.
    """
    reach = TAPS_MIDDLE * spread
    for t in range(len(triangles)):
        a, b, c = triangles[t, 0], triangles[t, 1], triangles[t, 2]
        more = max(
            vertices[a].shade - receivers[a, 3],
            vertices[b].shade - receivers[b, 3],
            vertices[c].shade - receivers[c, 3],
        )
        shaded[t] = more > 0 and not _is_lit(a, b, c, receivers, depths, side, reach)


@kernel
def _is_lit(a: Any, b: Any, c: Any, receivers: Any, depths: Any, side: Any, reach: Any) -> Any:
    """Whether nothing within reach of a triangle on the shadow map is nearer than its plane there.

    reach: of the places that a sample compares, across and down.
    """
    radius = np.int64(np.ceil(reach))
    ax, ay, az = receivers[a, 0], receivers[a, 1], receivers[a, 2]
    bx, by, bz = receivers[b, 0] - ax, receivers[b, 1] - ay, receivers[b, 2] - az
    cx, cy, cz = receivers[c, 0] - ax, receivers[c, 1] - ay, receivers[c, 2] - az
    left = np.int64(ax + min(bx, cx, np.float32(0))) - radius
    right = np.int64(ax + max(bx, cx, np.float32(0))) + radius
    top = np.int64(ay + min(by, cy, np.float32(0))) - radius
    bottom = np.int64(ay + max(by, cy, np.float32(0))) + radius
    area = np.float64(bx * cy - by * cx)
    is_outside = left < 0 or top < 0 or right >= side or bottom >= side
    if is_outside or abs(area) < FLAT_AREA or (right - left) * (bottom - top) > LARGE:
        return False
    along = (bz * cy - cz * by) / area
    down = (cz * bx - bz * cx) / area
    # The least depth of the plane at any place that compares itself with the sample.
    slack = (reach + 0.5) * (abs(along) + abs(down))
    lowest = az + min(bz, cz, np.float32(0))
    first = az + (left + 0.5 - ax) * along + (top + 0.5 - ay) * down - slack
    for row in range(bottom - top + 1):
        start, at = first + row * down, np.uint64((top + row) * side + left)
        is_near = False
        for k in range(right - left + 1):
            depth = max(start + k * along, lowest)
            is_near |= depths[at + np.uint64(k)] > depth
        if is_near:
            return False
    return True
