"""Cast shadows: the share of light that reaches the samples of a triangle; see `shadows`."""

from typing import Any

import numpy as np

from drapery.jit import borrowing_kernel, entry_point
from drapery.render.soft.bins import LANES
from drapery.render.soft.blending import FULL_LIGHT

FLAT_AREA = 1e-3
LARGE = 131072.0
"""Triangles of a smaller area, and in larger rectangles, are not tested as a whole [samples^2]."""

TAPS = 4
TAPS_MIDDLE = 1.5
"""Places of the shadow map along one side of the square that is compared, and their middle."""


@borrowing_kernel
def cast_shadows(
    t: Any,
    x: Any,
    y: Any,
    first: Any,
    count: Any,
    weights: Any,
    triangles: Any,
    receivers: Any,
    shadows: Any,
    grid: Any,
    light: Any,
    scratch: Any,
) -> Any:
    """Darken the light of a run of samples of triangle t from x, y on, where it lies in shadow.

    first, count: the run in `light`. weights: as `weights_at` gives them.
    scratch: place across and down the shadow map, depth, darkness, place in the map's array and
        how many places are lit, of each sample.
    There are TAPS x TAPS places for each pixel, and each of its samples compares its own share.
    """
    depths, side, spread = shadows
    across, down, deep, dark, place, free = scratch
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
    whole = ((count - 1) // LANES + 1) * LANES
    for k in range(whole):
        at = np.float64(k)
        w = 1.0 / (w0 + at * dw)
        across[np.uint64(k)] = min(max((x0 + at * dx) * w, 0.0), highest)
        down[np.uint64(k)] = min(max((y0 + at * dy) * w, 0.0), highest)
        deep[np.uint64(k)] = np.int32((z0 + at * dz) * w)
        dark[np.uint64(k)] = np.int32((s0 + at * ds) * w)
        free[np.uint64(k)] = 0
    last = np.int32(side - 1)
    for j in range(y & (grid - 1), TAPS, grid):
        below = (j - TAPS_MIDDLE) * spread
        for i in range(0, TAPS, grid):
            for k in range(whole):
                aside = (np.float64(i + ((x + k) & (grid - 1))) - TAPS_MIDDLE) * spread
                column = min(max(np.int32(across[np.uint64(k)] + aside), np.int32(0)), last)
                line = min(max(np.int32(down[np.uint64(k)] + below), np.int32(0)), last)
                place[np.uint64(k)] = line * side + column
            for k in range(count):
                free[np.uint64(k)] += depths[np.uint64(place[np.uint64(k)])] <= deep[np.uint64(k)]
    share = np.float64(grid * grid) / (TAPS * TAPS)
    for k in range(whole):
        lit, least = light[np.uint64(first + k)], dark[np.uint64(k)]
        more = np.float64(lit - least) * (np.float64(free[np.uint64(k)]) * share)
        light[np.uint64(first + k)] = least + np.int32(more) if lit > least else lit


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


@borrowing_kernel
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
