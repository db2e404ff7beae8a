"""The rasteriser proper: triangles of a tile -> which is seen at each sample -> its colour.

Coverage is exact: corners are whole numbers of 1/256 pixel, edge functions are 64-bit integers,
and a sample on an edge belongs to the triangle whose left or lower edge it is, so that triangles
that share an edge cover each sample once. (That is the top-left rule in the rows of a GL, which
count upwards: llvmpipe covers the same samples.) A sample remembers one whole number, its depth above
the number of its triangle; the greatest is what is seen. Of equals in depth the triangle drawn
later wins, as under GL_LEQUAL, and no order of the work can change the picture.

Perspective: with edge functions E_i, u = sum(E_i u_i / w_i) / sum(E_i / w_i); the area cancels.
"""

import numpy as np
from numba import njit

from drapery.render.bins import TILE, TILE_BITS

ID_BITS = 24
ID_MASK = (1 << ID_BITS) - 1
DEPTH_SCALE = float(1 << 61)
"""Depth 0..1 as a whole number; what is below 2^ID_BITS of it gives way to the triangle."""

OPAQUE, CUTOUT, BLEND = 0, 1, 2

# Called by kernels only: without a door from Python each compiles in half the time.
_inner = njit(
    cache=True, error_model="numpy", nogil=True, no_cpython_wrapper=True, no_cfunc_wrapper=True
)


@_inner
def _floor_divide(value, step, inverse):
    """floor(value / step) for step > 0, bounded to just outside a tile.

    The quotient of two floats is off by less than one; the remainder puts it right.
    """
    guess = np.int64(np.floor(min(max(value * inverse, -TILE - 1.0), TILE + 1.0)))
    rest = value - guess * step
    if rest < 0:
        guess -= 1
    elif rest >= step:
        guess += 1
    return guess


@_inner
def _edge(ax, ay, bx, by):
    """The edge function from a to b: its steps to the right and down by one pixel, its value at
    the tile's first sample (less one where the edge is neither left nor lower), 1 / |step|."""
    right = -(by - ay) * 256
    down = (bx - ax) * 256
    value = (by - ay) * ax - (bx - ax) * ay
    owned = by < ay or (by == ay and bx < ax)
    return right, down, value - (not owned), 1.0 / max(abs(right), 1)


@_inner
def _narrow(lo, hi, right, value, inverse):
    """The part of lo..hi where value + x * right >= 0."""
    if right > 0:
        return max(lo, -_floor_divide(value, right, inverse)), hi
    if right < 0:
        return lo, min(hi, _floor_divide(value, -right, inverse))
    return (lo, hi) if value >= 0 else (1, 0)


@_inner
def _lay_over(top, below):
    """Straight-alpha colours, one over the other, in 8 bits as the game blends."""
    a, d = top >> 24, below >> 24
    if a == 255 or a == 0:
        return top if a else below
    share, rest, total = a, 255 - a, 255
    if d < 255:
        share, rest = 255 * a, d * (255 - a)
        total = share + rest
    half = total >> 1
    red = (share * (top & 255) + rest * (below & 255) + half) // total
    green = (share * ((top >> 8) & 255) + rest * ((below >> 8) & 255) + half) // total
    blue = (share * ((top >> 16) & 255) + rest * ((below >> 16) & 255) + half) // total
    alpha = 255 if d == 255 else (total + 127) // 255
    return alpha << 24 | blue << 16 | green << 8 | red


@_inner
def _tinted(texel, red, green, blue):
    """round(texel * tint / 255) for each channel; the alpha is kept."""
    r = ((texel & 255) * red + 127) // 255
    g = (((texel >> 8) & 255) * green + 127) // 255
    b = (((texel >> 16) & 255) * blue + 127) // 255
    return (texel & 0xFF000000) | b << 16 | g << 8 | r


@_inner
def _shade(t, x0, y0, x, last, row, mesh, worn, tint, u, v, light, colours):
    """Colours of the samples x..last in one row of the tile at x0, y0, wearing triangle t.

    All coats are laid over one another first and lit at the end, once. Returns nothing; writes
    colours[x..last], and u, v, light on the way.
    """
    triangles, triangle_look, corners, _depth, inv_w, uvs, shade = mesh
    look_coats, look_alpha, look_lit, coat_rects, coat_tints, atlas = worn
    a, b, c = triangles[t, 0], triangles[t, 1], triangles[t, 2]
    look = triangle_look[t]
    ax, ay = np.int64(corners[a, 0]) - (x0 << 8), np.int64(corners[a, 1]) - (y0 << 8)
    bx, by = np.int64(corners[b, 0]) - (x0 << 8), np.int64(corners[b, 1]) - (y0 << 8)
    cx, cy = np.int64(corners[c, 0]) - (x0 << 8), np.int64(corners[c, 1]) - (y0 << 8)
    px, py = np.int64(x) << 8, np.int64(row) << 8
    weight_a = np.float64((cx - bx) * (py - by) - (cy - by) * (px - bx)) * inv_w[a]
    weight_b = np.float64((ax - cx) * (py - cy) - (ay - cy) * (px - cx)) * inv_w[b]
    weight_c = np.float64((bx - ax) * (py - ay) - (by - ay) * (px - ax)) * inv_w[c]
    step_a = np.float64((by - cy) * 256) * inv_w[a]
    step_b = np.float64((cy - ay) * 256) * inv_w[b]
    step_c = np.float64((ay - by) * 256) * inv_w[c]
    ua, ub, uc = np.float64(uvs[a, 0]), np.float64(uvs[b, 0]), np.float64(uvs[c, 0])
    va, vb, vc = np.float64(uvs[a, 1]), np.float64(uvs[b, 1]), np.float64(uvs[c, 1])
    sa, sb, sc = np.float64(shade[a]), np.float64(shade[b]), np.float64(shade[c])
    w0, dw = weight_a + weight_b + weight_c, step_a + step_b + step_c
    u0, du = weight_a * ua + weight_b * ub + weight_c * uc, step_a * ua + step_b * ub + step_c * uc
    v0, dv = weight_a * va + weight_b * vb + weight_c * vc, step_a * va + step_b * vb + step_c * vc
    s0, ds = weight_a * sa + weight_b * sb + weight_c * sc, step_a * sa + step_b * sb + step_c * sc
    for k in range(last - x + 1):
        w = 1.0 / (w0 + k * dw)
        u[k] = (u0 + k * du) * w
        v[k] = (v0 + k * dv) * w
        light[k] = (s0 + k * ds) * w

    u_low, u_high = min(ua, ub, uc), max(ua, ub, uc)
    v_low, v_high = min(va, vb, vc), max(va, vb, vc)
    first = look_coats[look, 0]
    for coat in range(first, first + look_coats[look, 1]):
        left, top = coat_rects[coat, 0], coat_rects[coat, 1]
        across, down = coat_rects[coat, 2], coat_rects[coat, 3]
        # Only texels that the triangle really reaches: a sample on its very edge must not show
        # the neighbouring part of the sheet.
        i_low = min(max(np.int64(u_low * across + 1e-3), 0), across - 1)
        i_high = min(max(np.int64(np.ceil(u_high * across - 1e-3)) - 1, i_low), across - 1)
        j_low = min(max(np.int64(v_low * down + 1e-3), 0), down - 1)
        j_high = min(max(np.int64(np.ceil(v_high * down - 1e-3)) - 1, j_low), down - 1)
        red = np.int64(coat_tints[coat, 0])
        green = np.int64(coat_tints[coat, 1])
        blue = np.int64(coat_tints[coat, 2])
        plain = red == 255 and green == 255 and blue == 255
        for k in range(last - x + 1):
            i = min(max(np.int64(u[k] * across), i_low), i_high)
            j = min(max(np.int64(v[k] * down), j_low), j_high)
            texel = np.int64(atlas[top + j, left + i])
            if not plain:
                texel = _tinted(texel, red, green, blue)
            if coat > first:
                texel = _lay_over(texel, np.int64(colours[x + k]))
            elif look_alpha[look] == OPAQUE:
                texel |= 0xFF000000
            elif look_alpha[look] == CUTOUT:
                texel = (texel | 0xFF000000) if texel >> 31 else 0
            colours[x + k] = texel

    if look_lit[look]:
        for k in range(last - x + 1):
            colour = np.int64(colours[x + k])
            red = np.int64((colour & 255) * (light[k] * tint[0]) + 0.5)
            green = np.int64(((colour >> 8) & 255) * (light[k] * tint[1]) + 0.5)
            blue = np.int64(((colour >> 16) & 255) * (light[k] * tint[2]) + 0.5)
            colours[x + k] = (colour & 0xFF000000) | blue << 16 | green << 8 | red


@_inner
def _cover(t, x0, y0, mesh, worn, tint, u, v, light, line, keys, colours):
    """Draw triangle t into the tile at x0, y0: its keys, or if it blends, its colours."""
    triangles, triangle_look, corners, depth, _inv_w, _uvs, _shade_of = mesh
    a, b, c = triangles[t, 0], triangles[t, 1], triangles[t, 2]
    ax, ay = np.int64(corners[a, 0]) - (x0 << 8), np.int64(corners[a, 1]) - (y0 << 8)
    bx, by = np.int64(corners[b, 0]) - (x0 << 8), np.int64(corners[b, 1]) - (y0 << 8)
    cx, cy = np.int64(corners[c, 0]) - (x0 << 8), np.int64(corners[c, 1]) - (y0 << 8)
    area = (bx - ax) * (cy - ay) - (by - ay) * (cx - ax)
    if area == 0:
        return
    za, zb, zc = depth[a], depth[b], depth[c]
    if area < 0:
        bx, by, zb, cx, cy, zc = cx, cy, zc, bx, by, zb
        area = -area
    right_ab, down_ab, at_ab, inverse_ab = _edge(ax, ay, bx, by)
    right_bc, down_bc, at_bc, inverse_bc = _edge(bx, by, cx, cy)
    right_ca, down_ca, at_ca, inverse_ca = _edge(cx, cy, ax, ay)
    scale = 1.0 / np.float64(area)
    z_right = ((zb - za) * (cy - ay) - (zc - za) * (by - ay)) * scale
    z_down = ((zc - za) * (bx - ax) - (zb - za) * (cx - ax)) * scale
    z_step = np.int64(min(max(z_right * 256.0, -1.0), 1.0) * DEPTH_SCALE)

    left = max((min(ax, bx, cx) + 255) >> 8, 0)
    right = min(max(ax, bx, cx) >> 8, TILE - 1)
    mode = worn[1][triangle_look[t]]
    for row in range(max((min(ay, by, cy) + 255) >> 8, 0), min(max(ay, by, cy) >> 8, TILE - 1) + 1):
        lo, hi = _narrow(left, right, right_ab, at_ab + row * down_ab, inverse_ab)
        lo, hi = _narrow(lo, hi, right_bc, at_bc + row * down_bc, inverse_bc)
        lo, hi = _narrow(lo, hi, right_ca, at_ca + row * down_ca, inverse_ca)
        if lo > hi:
            continue
        z = za + z_right * ((lo << 8) - ax) + z_down * ((row << 8) - ay)
        z_lo = np.int64(min(max(z, 0.0), 1.0) * DEPTH_SCALE)
        if mode == OPAQUE:
            for x in range(lo, hi + 1):
                key = ((z_lo + (x - lo) * z_step) & ~ID_MASK) | (t + 1)
                keys[row, x] = max(keys[row, x], key)
            continue
        _shade(t, x0, y0, lo, hi, row, mesh, worn, tint, u, v, light, line)
        for x in range(lo, hi + 1):
            key = (z_lo + (x - lo) * z_step) | ID_MASK
            if mode == CUTOUT:
                if line[x] >> 31:
                    keys[row, x] = max(keys[row, x], (key & ~ID_MASK) | (t + 1))
            elif key >= keys[row, x]:
                colours[row, x] = _lay_over(np.int64(line[x]), np.int64(colours[row, x]))


@_inner
def _shade_seen(x0, y0, keys, mesh, worn, tint, u, v, light, colours):
    """Colour what is seen in the tile at x0, y0, one run of the same triangle after another."""
    for row in range(TILE):
        x = np.int64(0)
        while x < TILE:
            seen = np.int64((keys[row, x] & ID_MASK) - 1)
            last = x
            while last + 1 < TILE and (keys[row, last + 1] & ID_MASK) - 1 == seen:
                last += 1
            if seen >= 0:
                _shade(seen, x0, y0, x, last, row, mesh, worn, tint, u, v, light, colours[row])
            x = last + 1


@_inner
def _resolve(colours, x0, y0, grid, picture):
    """Average grid x grid samples to a pixel; each weighs as much as it is opaque."""
    height, width = picture.shape
    count = grid * grid
    for row in range(min(TILE // grid, height - y0)):
        for column in range(min(TILE // grid, width - x0)):
            if grid == 1:
                picture[y0 + row, x0 + column] = colours[row, column]
                continue
            alpha = red = green = blue = 0
            for sample in range(count):
                colour = np.int64(
                    colours[row * grid + sample // grid, column * grid + sample % grid]
                )
                alpha += colour >> 24
                red += (colour >> 24) * (colour & 255)
                green += (colour >> 24) * ((colour >> 8) & 255)
                blue += (colour >> 24) * ((colour >> 16) & 255)
            half, total = alpha >> 1, max(alpha, 1)
            red, green, blue = (
                (red + half) // total,
                (green + half) // total,
                (blue + half) // total,
            )
            alpha = (alpha + (count >> 1)) // count
            picture[y0 + row, x0 + column] = alpha << 24 | blue << 16 | green << 8 | red


@njit(cache=True, error_model="numpy", nogil=True)
def draw_tiles(
    worker,
    workers,
    tiles_x,
    top,
    starts,
    entries,
    opaque,
    mesh,
    worn,
    tint,
    background,
    grid,
    picture,
):
    """Draw every workers-th tile, beginning with number `worker`.

    tiles_x, top: tiles across; the row of tiles at which number 0 begins.
    starts, entries: the triangles of tile i are entries[starts[i] : starts[i + 1]].
    opaque: triangles from this number on blend; they are drawn last, in their order.
    mesh: triangles [T, 3], triangle_look [T], corners [V, 2], depth [V], inv_w [V], uvs [V, 2],
        brightness [V].
    worn: the arrays of a `Wardrobe`; its atlas as one uint32 a texel.
    tint: the light's colour, three factors.
    background: one uint32, 0xAABBGGRR, as all colours here.
    grid: samples along a pixel's side.
    picture: shape [H, W], uint32.
    """
    keys = np.empty((TILE, TILE), np.int64)
    colours = np.empty((TILE, TILE), np.uint32)
    u, v, light = np.empty(TILE), np.empty(TILE), np.empty(TILE)
    line = np.empty(TILE, np.uint32)
    for tile in range(worker, len(starts) - 1, workers):
        x0, y0 = (tile % tiles_x) << TILE_BITS, (tile // tiles_x + top) << TILE_BITS
        keys[:] = 0
        colours[:] = background
        shaded = False
        # One place that covers and one that shades: the compiler copies them for each call.
        for entry in range(starts[tile], starts[tile + 1] + 1):
            last = entry == starts[tile + 1]
            t = np.int64(0) if last else np.int64(entries[entry])
            if not shaded and (last or t >= opaque):
                _shade_seen(x0, y0, keys, mesh, worn, tint, u, v, light, colours)
                shaded = True
            if not last:
                _cover(t, x0, y0, mesh, worn, tint, u, v, light, line, keys, colours)
        _resolve(colours, x0 // grid, y0 // grid, grid, picture)
