"""The detail of a surface in the picture: small slopes and tones of its tile, and its gloss.

The light of a vertex changes with the normal. Two numbers of each vertex say by how much, along the
two axes of the texture, so that a sample multiplies its light by 1 + slope · these numbers (the
first order of Blinn, "Simulation of wrinkled surfaces", SIGGRAPH 1978). Slopes and tones of samples
are filtered from halved copies of the tile (Williams, "Pyramidal parametrics", SIGGRAPH 1983): what
is finer than a sample is the mean, which is flat.
"""

from typing import Any

import numpy as np

from drapery.jit import borrowing_kernel, entry_point
from drapery.render.detail import EDGE_LONG, EDGE_WIDE
from drapery.render.soft.bins import ID_MASK, LANES, STRIDE, TILE
from drapery.render.soft.blending import FULL_LIGHT, LIGHT_BITS, OPAQUE_BITS
from drapery.render.soft.triangle_setup import SLOTS, set_up, weights_of

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
GROUP = 4
"""Places that are found together."""
PLACES = TILE + LANES
"""The most places of a row whose details are found, from 1 on, and what is beyond the last one."""
ACROSS, DOWN, WHOLE, RIGHT, LOW, GLOSS, FUZZ = range(0, 7 * PLACES, PLACES)
"""Where terms of places begin: 1/256 texels of the tile, w, light for slopes, gloss and fuzz."""
COPY, FINER, LEVEL, MIX, EDGE, MATERIAL = range(0, 6 * PLACES, PLACES)
"""Where marks of places begin: the copy of the tile, its side as a power of two, and of a SETUP."""
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
    details: rows [L, 6] and finishes [L, 5]; see `MaterialTables`.
    lights: unit vectors towards the lights, [K, 3]. levels: ambient and diffuse light, [2].
    eye: the camera's place and 1, or in a parallel view the direction towards it and 0, [4].
    leaning: the result, [V, 4], float32, filled with 0: share of the light for a slope to the right
        and down the texture, gloss in full light, and the share of light that fuzz adds.
    """
    rows, finishes = details
    count = len(positions)
    axes, owner = np.zeros((count, 6)), np.full(count, -1, np.int32)
    for t in range(len(triangles)):
        material = triangle_material[np.uint64(t)]
        if rows[np.uint64(material), 0] >= 0:
            _add_axes(triangles[np.uint64(t)], material, positions, uvs, axes, owner)
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
            if gloss == 0.0:
                continue
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


@borrowing_kernel
def _add_axes(corners: Any, material: Any, positions: Any, uvs: Any, axes: Any, owner: Any) -> Any:
    """Add the directions to the right and down the texture of a triangle to its corners."""
    a, b, c = np.uint64(corners[0]), np.uint64(corners[1]), np.uint64(corners[2])
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


@borrowing_kernel
def _unit(x: Any, y: Any, z: Any) -> Any:
    length = max(np.sqrt(x * x + y * y + z * z), 1e-12)
    return x / length, y / length, z / length


@borrowing_kernel
def _flattened(x: Any, y: Any, z: Any, nx: Any, ny: Any, nz: Any) -> Any:
    """The unit vector along x, y, z in the plane of a unit normal."""
    off = x * nx + y * ny + z * nz
    return _unit(x - off * nx, y - off * ny, z - off * nz)


@borrowing_kernel
def add_details(
    x0: Any,
    y: Any,
    start: Any,
    count: Any,
    runs: Any,
    keys: Any,
    mesh: Any,
    tables: Any,
    details: Any,
    grid: Any,
    setups: Any,
    light: Any,
    shine: Any,
    scratch: Any,
) -> Any:
    """Change the light of a row's samples by the details that they show, and write their gloss.

    x0, y: the row's first sample in the picture. start: its key in `keys`. count, runs: as
        `_find_runs` of `tiles` gives them. mesh, tables, details: see `draw_tiles`.
    grid: samples along a pixel's side; those of a run in one pixel share the detail of the first.
    setups: of triangles, in which the copies of tiles are kept. shine: the result, of each sample
        in units of 1 / (1 << GLOSS_BITS).
    scratch: see `PLACES`, `COPY` and `_apply_details`; and the place of each sample, 0 for none.
    """
    vertices, triangles, triangle_material = mesh
    leaning, rows, tiles, edges = details
    terms, marks, numbers, owner = scratch
    steps, last = grid >> 1, 0
    for k in range(TILE):
        owner[np.uint64(k)] = 0
    for run in range(count):
        x, until = np.int64(runs[np.uint64(run)]), np.int64(runs[np.uint64(run + 1)])
        t = (keys[np.uint64(start + x)] & ID_MASK) - 1
        if t < 0:
            continue
        material = np.uint64(triangle_material[np.uint64(t)])
        if rows[material, 0] < 0:
            continue
        setup = setups[np.uint64(t & (SLOTS - 1))]
        if setup.triangle != t:
            set_up(t, mesh, tables, setup)
        if not setup.is_lit:
            continue
        if setup.level < 0:
            corners = triangles[np.uint64(t)]
            _find_copy(corners, rows[material], edges[material], vertices, leaning, grid, setup)
        first, past = x >> steps, ((until - 1) >> steps) + 1
        before = last + 1 - first
        for k in range(x, until):
            owner[np.uint64(k)] = before + (k >> steps)
        copy, finer = setup.copy, max(np.int64(rows[material, 1]) - setup.level, 0)
        level, mix, edge = setup.level, setup.mix, setup.edge
        across, down = rows[material, 2] * 256.0, rows[material, 3] * 256.0
        wa, wb, wc = weights_of(setup, x0 + x, y)
        w0, dw = wa + wb + wc, setup.dw
        u0, du = wa * setup.ua + wb * setup.ub + wc * setup.uc, setup.du
        v0, dv = wa * setup.va + wb * setup.vb + wc * setup.vc, setup.dv
        lean = setup.lean
        r0 = wa * lean[0, 0] + wb * lean[0, 1] + wc * lean[0, 2]
        s0 = wa * lean[1, 0] + wb * lean[1, 1] + wc * lean[1, 2]
        g0 = wa * lean[2, 0] + wb * lean[2, 1] + wc * lean[2, 2]
        f0 = wa * lean[3, 0] + wb * lean[3, 1] + wc * lean[3, 2]
        dr, ds, dg, df = lean[0, 3], lean[1, 3], lean[2, 3], lean[3, 3]
        # In whole groups, for vectors: what is beyond the run is overwritten by the next one.
        for k in range(((past - first - 1) // GROUP + 1) * GROUP):
            at = np.float64(max(np.int32(((first + k) << steps) - x), np.int32(0)))
            w = 1.0 / (w0 + at * dw)
            place = last + 1 + k
            terms[np.uint64(ACROSS + place)] = (u0 + at * du) * w * across
            terms[np.uint64(DOWN + place)] = (v0 + at * dv) * w * down
            terms[np.uint64(WHOLE + place)] = w
            terms[np.uint64(RIGHT + place)] = r0 + at * dr
            terms[np.uint64(LOW + place)] = s0 + at * ds
            terms[np.uint64(GLOSS + place)] = (g0 + at * dg) * w
            terms[np.uint64(FUZZ + place)] = (f0 + at * df) * w
            marks[np.uint64(COPY + place)] = copy
            marks[np.uint64(FINER + place)] = finer
            marks[np.uint64(LEVEL + place)] = level
            marks[np.uint64(MIX + place)] = mix
            marks[np.uint64(EDGE + place)] = edge
            marks[np.uint64(MATERIAL + place)] = material
        last = before + past - 1
    _read_texels(last, terms, marks, rows, tiles, edges, numbers)
    _apply_details(last, terms, numbers, owner, light, shine)


@borrowing_kernel
def _read_texels(
    last: Any, terms: Any, marks: Any, rows: Any, tiles: Any, edges: Any, numbers: Any
) -> Any:
    """Read the four numbers of the detail at the places of a row; see `add_details`.

    last: place of the row. numbers: the result, PLACES of each.
    """
    for place in range(1, last + 1):
        over = np.int64(terms[np.uint64(ACROSS + place)])
        under = np.int64(terms[np.uint64(DOWN + place)])
        copy, finer = marks[np.uint64(COPY + place)], marks[np.uint64(FINER + place)]
        level, mix = marks[np.uint64(LEVEL + place)], marks[np.uint64(MIX + place)]
        edge = marks[np.uint64(EDGE + place)]
        x, y = over >> level, under >> level
        texel = _smooth(tiles, copy, finer, finer, x, y)
        if mix > 0:
            after, coarser = copy + (1 << (2 * finer)), max(finer - 1, 0)
            next_texel = _smooth(tiles, after, coarser, coarser, x >> 1, y >> 1)
            texel = _between(texel, next_texel, mix)
        right, low = (texel & 255) - 128, ((texel >> 16) & 255) - 128
        tone, gloss = ((texel >> 32) & 255) - 128, (texel >> 48) & 255
        if edge >= 0:
            material = np.uint64(marks[np.uint64(MATERIAL + place)])
            bounds = edges[material, np.uint64(edge)]
            found = _beside_edge(tiles, rows[material], bounds, level, mix, over, under)
            own = found[3]
            right, low = (right * own >> 8) + found[0], (low * own >> 8) + found[1]
            tone, gloss = (tone * own >> 8) + found[2], 255 - ((255 - gloss) * own >> 8)
        numbers[np.uint64(place)] = right
        numbers[np.uint64(PLACES + place)] = low
        numbers[np.uint64(2 * PLACES + place)] = tone
        numbers[np.uint64(3 * PLACES + place)] = gloss


@borrowing_kernel
def _apply_details(last: Any, terms: Any, numbers: Any, owner: Any, light: Any, shine: Any) -> Any:
    """Change the light of a row's samples and write their gloss; see `add_details`.

    last: place of the row. numbers: see `_read_texels`.
    """
    for place in range((last // GROUP + 1) * GROUP):
        right, low = numbers[np.uint64(place)], numbers[np.uint64(PLACES + place)]
        tone, gloss = numbers[np.uint64(2 * PLACES + place)], numbers[np.uint64(3 * PLACES + place)]
        lean = terms[np.uint64(RIGHT + place)] * right + terms[np.uint64(LOW + place)] * low
        sloped, fuzz = lean * terms[np.uint64(WHOLE + place)], terms[np.uint64(FUZZ + place)]
        terms[np.uint64(FUZZ + place)] = 1.0 + (sloped + tone) * (1.0 / 128.0) + fuzz
        terms[np.uint64(GLOSS + place)] = terms[np.uint64(GLOSS + place)] * gloss * SHOWN
    for x in range(TILE):
        own, lit = np.int64(owner[np.uint64(x)]), light[np.uint64(x)]
        factor, share = terms[np.uint64(FUZZ + own)], terms[np.uint64(GLOSS + own)]
        bright = min(max(lit * factor, 0.0), np.float64(FULL_LIGHT))
        light[np.uint64(x)] = np.int32(bright) if own > 0 else lit
        shine[np.uint64(x)] = np.int32(share * bright) if own > 0 else 0


@borrowing_kernel
def _find_copy(
    corners: Any, row: Any, bounds: Any, vertices: Any, leaning: Any, grid: Any, setup: Any
) -> Any:
    """Find what the samples of a triangle share: the copy of its tile, and the edge that is near.

    corners: its vertices. row, bounds: of its material, see `DetailTables`.
    """
    a, b, c = np.uint64(corners[0]), np.uint64(corners[1]), np.uint64(corners[2])
    for part in range(4):
        one, two = np.float64(leaning[a, part]), np.float64(leaning[b, part])
        three = np.float64(leaning[c, part])
        setup.lean[part, 0], setup.lean[part, 1], setup.lean[part, 2] = one, two, three
        setup.lean[part, 3] = setup.da * one + setup.db * two + setup.dc * three
    bits, across, down = np.int64(row[1]), row[2], row[3]
    setup.level, setup.mix = _level(vertices[a], vertices[b], vertices[c], across, down, bits, grid)
    # All copies before: a geometric series.
    whole = 2 * bits + 2
    setup.copy = row[0] + ((1 << whole) - (1 << (whole - 2 * setup.level))) // 3
    setup.edge = -1
    if row[4] >= 0:
        reach, scale = _reach(row[5], setup.level), (across * 256.0, down * 256.0)
        setup.edge = _part_with_edge(vertices[a], vertices[b], vertices[c], bounds, scale, reach)


@borrowing_kernel
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


@borrowing_kernel
def _reach(width: Any, level: Any) -> Any:
    """How far from an edge its strip shows in the copies that are read [1/256 texel of the tile].

    width: of the strip at its own size. level: see `_level`. A place lies between two columns of
    the next copy, and both may have a part of what lies there.
    """
    return min(width + (3 << level), EDGE_WIDE) << 8


@borrowing_kernel
def _part_with_edge(a: Any, b: Any, c: Any, bounds: Any, scale: Any, reach: Any) -> Any:
    """The part of the texture on which a triangle comes near to an edge, or -1.

    bounds: see `DetailTables`, of one material. scale: 1/256 texels of the tile for a whole u, v.
    reach: see `_reach`.
    """
    part, most, near = 0, np.int64(0), False
    for number in range(2):
        one = _inset(a, bounds[number], scale)
        two, three = _inset(b, bounds[number], scale), _inset(c, bounds[number], scale)
        if number == 0 or one + two + three > most:
            part, most = number, one + two + three
            # Distances from straight edges are least at a corner of the triangle.
            near = min(one, two, three) < reach
    return part if near else -1


@borrowing_kernel
def _inset(corner: Any, bounds: Any, scale: Any) -> Any:
    """How far a corner lies inside of a part of the texture."""
    x, y = np.int64(corner.u * scale[0]), np.int64(corner.v * scale[1])
    return min(min(x - bounds[0], bounds[2] - x), min(y - bounds[1], bounds[3] - y))


@borrowing_kernel
def _beside_edge(tiles: Any, row: Any, bounds: Any, level: Any, mix: Any, x: Any, y: Any) -> Any:
    """What the strip of the nearest edge adds at a place [1/256 texel of the tile].

    row: of the material. bounds: of the part of the texture. level, mix: see `_level`.
    Returns slopes to the right and down, tone, and the share of the tile that shows [1/256].
    """
    left, right = x - bounds[0], bounds[2] - x
    top, bottom = y - bounds[1], bounds[3] - y
    beside, above = min(left, right), min(top, bottom)
    upright = beside <= above
    away, along = max(min(beside, above), 0), y if upright else x
    if away >= _reach(row[5], level):
        return np.int64(0), np.int64(0), np.int64(0), np.int64(256)
    first = np.int64(row[4]) if upright else np.int64(row[4]) + STRIP
    texel = _of_strip(tiles, first, level, away, along)
    if mix > 0:
        texel = _between(texel, _of_strip(tiles, first, level + 1, away, along), mix)
    inwards, onwards = (texel & 255) - 128, ((texel >> 16) & 255) - 128
    tone, own = ((texel >> 32) & 255) - 128, (texel >> 48) & 255
    own += own >> 7
    if upright:
        return inwards if left <= right else -inwards, onwards, tone, own
    return onwards, inwards if top <= bottom else -inwards, tone, own


@borrowing_kernel
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


@borrowing_kernel
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


@borrowing_kernel
def _between(one: Any, other: Any, share: Any) -> Any:
    """Four numbers in one, between those of two: share [1/256] of the other."""
    # What a negative difference borrows from the next number is added again by the sum.
    mixed = (one << 8) + (other - one) * share + HALF_OF_LANES
    return (mixed >> 8) & LANES_OF_BYTES


@borrowing_kernel
def add_gloss(row: Any, tint: Any, shine: Any, seen: Any, colours: Any) -> Any:
    """Lay the light's colour over the samples of a row of the tile, by their gloss.

    shine: see `add_details`. All else: see `_light_row` of `tiles`.
    """
    for x in range(TILE):
        share = np.int64(shine[np.uint64(x)])
        if share > 0 and seen[np.uint64(row * STRIDE + x)] != 0:
            at = np.uint64(row * TILE + x)
            colours[at] = glossy(np.int64(colours[at]), tint, share)


@borrowing_kernel
def glossy(colour: Any, tint: Any, share: Any) -> Any:
    """A colour with a share of the light laid over it, see `add_details`; its alpha stays."""
    red = _lighter(colour & 255, tint[0], share)
    green = _lighter((colour >> 8) & 255, tint[1], share)
    blue = _lighter((colour >> 16) & 255, tint[2], share)
    return colour & OPAQUE_BITS | blue << 16 | green << 8 | red


@borrowing_kernel
def _lighter(value: Any, tint: Any, share: Any) -> Any:
    """A channel of a colour with a share of the light laid over it."""
    full = 255 * np.int64(tint) >> LIGHT_BITS
    return value + (max(full - value, 0) * share >> GLOSS_BITS)
