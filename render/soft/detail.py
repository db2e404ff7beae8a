"""The detail of a surface in the picture: small slopes and tones of its tile, and its gloss.

The light of a vertex changes with the normal. Two numbers of each vertex say by how much, along the
two axes of the texture, so that a sample multiplies its light by 1 + slope · these numbers (the
first order of Blinn, "Simulation of wrinkled surfaces", SIGGRAPH 1978). Slopes and tones of samples
are filtered from halved copies of the tile (Williams, "Pyramidal parametrics", SIGGRAPH 1983): what
is finer than a sample is the mean, which is flat.
"""

from typing import Any

import numpy as np

from drapery.jit import entry_point, kernel
from drapery.render.detail import EDGE_LONG, EDGE_WIDE
from drapery.render.soft.bins import STRIDE, TILE
from drapery.render.soft.blending import FULL_LIGHT, LIGHT_BITS, OPAQUE_BITS

LANES_OF_BYTES = 0x00FF00FF00FF00FF
HALF_OF_LANES = 0x0080008000800080
"""Four numbers of 8 bits in one of 64, each with room for a product, and one half of each."""

LEAST_LIGHT = 0.15
"""Darker vertices count as lit so much where the light is divided by itself."""
UPWARD = 0.35
"""How much of the ambient light comes from above."""
GLOSS_BITS = 16
SHARP = 3.0
"""Twice the texels of a tile in a sample from which on its next copy is mixed in, where the mean of
several samples is drawn."""
WIDE_BITS, LONG_BITS = EDGE_WIDE.bit_length() - 1, EDGE_LONG.bit_length() - 1
"""The sides of a strip are these powers of two."""
STRIP = sum(EDGE_WIDE * EDGE_LONG >> 2 * k for k in range(WIDE_BITS + 1)) + EDGE_LONG // EDGE_WIDE
"""Texels of a strip with its copies."""
SHOWN = (1 << GLOSS_BITS) / (255.0 * FULL_LIGHT)
"""Gloss in units of 1 / (1 << GLOSS_BITS), for a share of 255 in full light."""


@entry_point
def lean_vertices(
    positions: Any,
    normals: Any,
    uvs: Any,
    triangles: Any,
    triangle_material: Any,
    details: Any,
    lights: Any,
    levels: Any,
    eye: Any,
    leaning: Any,
) -> Any:
    """Write how the light of each vertex changes with its normal, and its gloss.

    positions, normals: [V, 3], uvs: [V, 2], float32. triangles, triangle_material: see `Topology`.
    details: rows [L, 4] and finishes [L, 5]; see `MaterialTables`.
    lights: unit vectors towards the lights, [K, 3]. levels: ambient and diffuse light, [2].
    eye: the camera's place and 1, or in a parallel view the direction towards it and 0, [4].
    leaning: the result, [V, 4], float32, filled with 0: share of the light for a slope to the right
        and down the texture, gloss in full light, and the share of light that fuzz adds.
    """
    rows, finishes = details
    count = len(positions)
    axes, owner = np.zeros((count, 6)), np.full(count, -1, np.int32)
    for t in range(len(triangles)):
        if rows[triangle_material[t], 0] >= 0:
            _add_axes(triangles[t], triangle_material[t], positions, uvs, axes, owner)
    for v in range(count):
        if owner[v] < 0:
            continue
        nx, ny, nz = np.float64(normals[v, 0]), np.float64(normals[v, 1]), np.float64(normals[v, 2])
        vx, vy, vz = _unit(
            eye[0] - eye[3] * positions[v, 0],
            eye[1] - eye[3] * positions[v, 1],
            eye[2] - eye[3] * positions[v, 2],
        )
        rx, ry, rz = _flattened(axes[v, 0], axes[v, 1], axes[v, 2], nx, ny, nz)
        dx, dy, dz = _flattened(axes[v, 3], axes[v, 4], axes[v, 5], nx, ny, nz)
        finish = finishes[owner[v]]
        gloss, across, along, fuzz = finish[0], finish[1], finish[2], finish[3]
        shade = levels[0]
        right, down, shine = levels[0] * UPWARD * ry, levels[0] * UPWARD * dy, 0.0
        for k in range(len(lights)):
            lx, ly, lz = lights[k, 0], lights[k, 1], lights[k, 2]
            facing = nx * lx + ny * ly + nz * lz
            shade += levels[1] * max(facing, 0.0)
            # A surface that is turned away is lit on its slopes up to a small angle.
            share = levels[1] * min(max(4.0 * facing + 0.5, 0.0), 1.0)
            right += share * (rx * lx + ry * ly + rz * lz)
            down += share * (dx * lx + dy * ly + dz * lz)
            hx, hy, hz = _unit(lx + vx, ly + vy, lz + vz)
            half = max(nx * hx + ny * hy + nz * hz, 0.0)
            beside_right, beside_down = rx * hx + ry * hy + rz * hz, dx * hx + dy * hy + dz * hz
            lobe = (1.0 - across - along) * half * half
            lobe += across * (1.0 - beside_right * beside_right)
            lobe += along * (1.0 - beside_down * beside_down)
            for _ in range(np.int64(finish[4])):
                lobe *= lobe
            shine += min(max(3.0 * facing, 0.0), 1.0) * lobe
        rim = 1.0 - min(abs(nx * vx + ny * vy + nz * vz), 1.0)
        scale = 1.0 / max(min(shade, 1.0), LEAST_LIGHT)
        leaning[v, 0] = right * scale
        leaning[v, 1] = down * scale
        leaning[v, 2] = min(gloss * shine, 1.0)
        leaning[v, 3] = fuzz * rim * rim * rim


@kernel
def _add_axes(corners: Any, material: Any, positions: Any, uvs: Any, axes: Any, owner: Any) -> Any:
    """Add the directions to the right and down the texture of a triangle to its corners."""
    a, b, c = corners[0], corners[1], corners[2]
    u1, v1 = np.float64(uvs[b, 0] - uvs[a, 0]), np.float64(uvs[b, 1] - uvs[a, 1])
    u2, v2 = np.float64(uvs[c, 0] - uvs[a, 0]), np.float64(uvs[c, 1] - uvs[a, 1])
    area = u1 * v2 - u2 * v1
    sign = 1.0 if area > 0.0 else -1.0
    owner[a] = owner[b] = owner[c] = material
    for axis in range(3):
        one = np.float64(positions[b, axis] - positions[a, axis])
        two = np.float64(positions[c, axis] - positions[a, axis])
        right, down = sign * (one * v2 - two * v1), sign * (two * u1 - one * u2)
        for corner in (a, b, c):
            axes[corner, axis] += right
            axes[corner, 3 + axis] += down


@kernel
def _unit(x: Any, y: Any, z: Any) -> Any:
    length = max(np.sqrt(x * x + y * y + z * z), 1e-12)
    return x / length, y / length, z / length


@kernel
def _flattened(x: Any, y: Any, z: Any, nx: Any, ny: Any, nz: Any) -> Any:
    """The unit vector along x, y, z in the plane of a unit normal."""
    off = x * nx + y * ny + z * nz
    return _unit(x - off * nx, y - off * ny, z - off * nz)


@kernel
def add_detail(
    t: Any,
    first: Any,
    count: Any,
    lines: Any,
    weights: Any,
    mesh: Any,
    details: Any,
    grid: Any,
    setup: Any,
    light: Any,
    shine: Any,
) -> Any:
    """Change the light of a run of samples of triangle t by its detail, and write their gloss.

    first, count: the run in `light` and `shine`. lines: 1 / w, u and v over w, each at the first
    sample and its step to the right. weights: as `weights_at` gives them. mesh, details: see
    `draw_tiles`. grid: samples along a pixel's side; they share the detail of the first in a row.
    setup: of the triangle, in which the copy of the tile is kept. shine: of each sample in units of
    1 / (1 << GLOSS_BITS).
    """
    vertices, triangles, triangle_material = mesh
    leaning, rows, tiles, edges = details
    a, b, c = triangles[t, 0], triangles[t, 1], triangles[t, 2]
    row = rows[triangle_material[t]]
    start, bits, across, down = np.int64(row[0]), np.int64(row[1]), row[2], row[3]
    if setup.level < 0:
        found = _level(vertices[a], vertices[b], vertices[c], across, down, bits, grid)
        setup.level, setup.mix = found
        setup.edge = -1
        if row[4] >= 0:
            bounds, scale = edges[triangle_material[t]], (across * 256.0, down * 256.0)
            setup.edge = _part_with_edge(vertices[a], vertices[b], vertices[c], bounds, scale)
    level, mix, edge = setup.level, setup.mix, setup.edge
    for k in range(level):
        start += 1 << (2 * (bits - k))
    finer = max(bits - level, 0)
    coarser = max(finer - 1, 0)
    after = start + (1 << (2 * finer))
    (w0, dw, u0, du, v0, dv), (wa, wb, wc, da, db, dc) = lines, weights
    r0 = wa * leaning[a, 0] + wb * leaning[b, 0] + wc * leaning[c, 0]
    dr = da * leaning[a, 0] + db * leaning[b, 0] + dc * leaning[c, 0]
    s0 = wa * leaning[a, 1] + wb * leaning[b, 1] + wc * leaning[c, 1]
    ds = da * leaning[a, 1] + db * leaning[b, 1] + dc * leaning[c, 1]
    g0 = wa * leaning[a, 2] + wb * leaning[b, 2] + wc * leaning[c, 2]
    dg = da * leaning[a, 2] + db * leaning[b, 2] + dc * leaning[c, 2]
    f0 = wa * leaning[a, 3] + wb * leaning[b, 3] + wc * leaning[c, 3]
    df = da * leaning[a, 3] + db * leaning[b, 3] + dc * leaning[c, 3]
    across, down = across * 256.0, down * 256.0
    factor, shown = 1.0, 0.0
    for k in range(count):
        if k == 0 or (first + k) & (grid - 1) == 0:
            at = np.float64(k)
            w = 1.0 / (w0 + at * dw)
            over, under = np.int64((u0 + at * du) * w * across), np.int64((v0 + at * dv) * w * down)
            x, y = over >> level, under >> level
            texel = _smooth(tiles, start, finer, finer, x, y)
            if mix > 0:
                next_texel = _smooth(tiles, after, coarser, coarser, x >> 1, y >> 1)
                texel = _between(texel, next_texel, mix)
            right, low = (texel & 255) - 128, ((texel >> 16) & 255) - 128
            tone, gloss = ((texel >> 32) & 255) - 128, (texel >> 48) & 255
            if edge >= 0:
                strips, bounds = np.int64(row[4]), edges[triangle_material[t], edge]
                found = _beside_edge(tiles, strips, bounds, level, mix, over, under)
                own = found[3]
                right, low = (right * own >> 8) + found[0], (low * own >> 8) + found[1]
                tone, gloss = (tone * own >> 8) + found[2], 255 - ((255 - gloss) * own >> 8)
            sloped = ((r0 + at * dr) * right + (s0 + at * ds) * low) * w
            factor = 1.0 + (sloped + tone) * (1.0 / 128.0) + (f0 + at * df) * w
            shown = (g0 + at * dg) * w * gloss * SHOWN
        place = np.uint64(first + k)
        bright = min(max(light[place] * factor, 0.0), np.float64(FULL_LIGHT))
        light[place] = np.int32(bright)
        shine[place] = np.int32(shown * bright)


@kernel
def _level(a: Any, b: Any, c: Any, across: Any, down: Any, bits: Any, grid: Any) -> Any:
    """The copy of a tile for the samples of a triangle, and the share of the next one [1/256].

    across, down: texels of the tile for a whole u and v. bits: of its side.
    """
    x1, y1 = (b.x - a.x) / 256.0, (b.y - a.y) / 256.0
    x2, y2 = (c.x - a.x) / 256.0, (c.y - a.y) / 256.0
    u1, v1 = np.float64(b.u - a.u) * across, np.float64(b.v - a.v) * down
    u2, v2 = np.float64(c.u - a.u) * across, np.float64(c.v - a.v) * down
    area = max(abs(x1 * y2 - x2 * y1), 1e-6)
    ux, vx = u1 * y2 - u2 * y1, v1 * y2 - v2 * y1
    uy, vy = u2 * x1 - u1 * x2, v2 * x1 - v1 * x2
    size = np.sqrt(max((ux * ux + vx * vx) * (grid * grid), uy * uy + vy * vy)) / area
    level = 0
    while size > 2.0 and level < bits:
        size *= 0.5
        level += 1
    mix = size - 1.0 if grid == 1 else 2.0 * size - SHARP
    return level, np.int64(min(max(mix, 0.0), 1.0) * 256.0)


@kernel
def _part_with_edge(a: Any, b: Any, c: Any, bounds: Any, scale: Any) -> Any:
    """The part of the texture on which a triangle comes near to an edge, or -1.

    bounds: see `DetailTables`, of one material. scale: 1/256 texels of the tile for a whole u, v.
    """
    part, most, near = 0, np.int64(0), False
    for number in range(2):
        one = _inset(a, bounds[number], scale)
        two, three = _inset(b, bounds[number], scale), _inset(c, bounds[number], scale)
        if number == 0 or one + two + three > most:
            part, most = number, one + two + three
            # Distances from straight edges are least at a corner of the triangle.
            near = min(one, two, three) < EDGE_WIDE << 8
    return part if near else -1


@kernel
def _inset(corner: Any, bounds: Any, scale: Any) -> Any:
    """How far a corner lies inside of a part of the texture."""
    x, y = np.int64(corner.u * scale[0]), np.int64(corner.v * scale[1])
    return min(min(x - bounds[0], bounds[2] - x), min(y - bounds[1], bounds[3] - y))


@kernel
def _beside_edge(tiles: Any, strips: Any, bounds: Any, level: Any, mix: Any, x: Any, y: Any) -> Any:
    """What the strip of the nearest edge adds at a place [1/256 texel of the tile].

    strips: their first texel. bounds: of the part of the texture. level, mix: see `_level`.
    Returns slopes to the right and down, tone, and the share of the tile that shows [1/256].
    """
    left, right = x - bounds[0], bounds[2] - x
    top, bottom = y - bounds[1], bounds[3] - y
    beside, above = min(left, right), min(top, bottom)
    upright = beside <= above
    away, along = max(min(beside, above), 0), y if upright else x
    if away >= EDGE_WIDE << 8:
        return np.int64(0), np.int64(0), np.int64(0), np.int64(256)
    first = strips if upright else strips + STRIP
    texel = _of_strip(tiles, first, level, away, along)
    if mix > 0:
        texel = _between(texel, _of_strip(tiles, first, level + 1, away, along), mix)
    inwards, onwards = (texel & 255) - 128, ((texel >> 16) & 255) - 128
    tone, own = ((texel >> 32) & 255) - 128, (texel >> 48) & 255
    own += own >> 7
    if upright:
        return inwards if left <= right else -inwards, onwards, tone, own
    return onwards, inwards if top <= bottom else -inwards, tone, own


@kernel
def _of_strip(tiles: Any, first: Any, level: Any, away: Any, along: Any) -> Any:
    """The four numbers of a copy of a strip, between its texels; see `_beside_edge`."""
    level = min(level, WIDE_BITS)
    wide, long = WIDE_BITS - level, LONG_BITS - level
    # All copies before: a geometric series.
    whole = WIDE_BITS + LONG_BITS + 2
    start = first + ((1 << whole) - (1 << (whole - 2 * level))) // 3
    # Not beyond the middle of the first and last column, since a strip repeats only along the edge.
    x = max(min(away >> level, (1 << (wide + 8)) - 129), 128)
    return _smooth(tiles, start, wide, long, x, along >> level)


@kernel
def _smooth(tiles: Any, start: Any, wide: Any, high: Any, x: Any, y: Any) -> Any:
    """The four numbers of a tile at a place [1/256 texel], between its texels.

    wide, high: its sides are these powers of two.
    """
    mask, rows = (1 << wide) - 1, (1 << high) - 1
    x, y = x - 128, y - 128
    i, j = x >> 8, (y >> 8) & rows
    left, right = i & mask, (i + 1) & mask
    upper, lower = start + (j << wide), start + (((j + 1) & rows) << wide)
    top = _between(tiles[np.uint64(upper + left)], tiles[np.uint64(upper + right)], x & 255)
    below = _between(tiles[np.uint64(lower + left)], tiles[np.uint64(lower + right)], x & 255)
    return _between(top, below, y & 255)


@kernel
def _between(one: Any, other: Any, share: Any) -> Any:
    """Four numbers in one, between those of two: share [1/256] of the other."""
    # What a negative difference borrows from the next number is added again by the sum.
    mixed = (one << 8) + (other - one) * share + HALF_OF_LANES
    return (mixed >> 8) & LANES_OF_BYTES


@kernel
def add_gloss(row: Any, tint: Any, shine: Any, seen: Any, colours: Any) -> Any:
    """Lay the light's colour over the samples of a row of the tile, by their gloss.

    shine: see `add_detail`; it is filled with 0 for the next row. All else: see `_light_row` of
    `tiles`.
    """
    for x in range(TILE):
        share = np.int64(shine[np.uint64(x)])
        shine[np.uint64(x)] = 0
        if share > 0 and seen[np.uint64(row * STRIDE + x)] != 0:
            at = np.uint64(row * TILE + x)
            colours[at] = glossy(np.int64(colours[at]), tint, share)


@kernel
def glossy(colour: Any, tint: Any, share: Any) -> Any:
    """A colour with a share of the light laid over it; its alpha stays. share: see `add_detail`."""
    red = _lighter(colour & 255, tint[0], share)
    green = _lighter((colour >> 8) & 255, tint[1], share)
    blue = _lighter((colour >> 16) & 255, tint[2], share)
    return colour & OPAQUE_BITS | blue << 16 | green << 8 | red


@kernel
def _lighter(value: Any, tint: Any, share: Any) -> Any:
    """A channel of a colour with a share of the light laid over it."""
    full = 255 * np.int64(tint) >> LIGHT_BITS
    return value + (max(full - value, 0) * share >> GLOSS_BITS)
