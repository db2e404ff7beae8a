"""Triangle setup: what all samples of a triangle share."""

from typing import Any

import numpy as np

from drapery.jit import borrowing_kernel
from drapery.render.soft.blending import FULL_LIGHT

SLOTS = 256
"""Triangles whose setup is kept, a power of two: most are met again in the next row of the tile."""

_INTEGERS = "triangle origin a0 ax ay b0 bx by c0 cx cy level mix copy edge"
_FLOATS = (
    "inv_wa inv_wb inv_wc ua ub uc va vb vc sa sb sc da db dc dw du dv ds"
    " across i_low i_high down j_low j_high"
)
SETUP = np.dtype(
    [
        *((name, np.int64) for name in _INTEGERS.split()),
        *((name, np.float64) for name in _FLOATS.split()),
        ("lean", np.float64, (4, 4)),
        ("is_lit", np.bool_),
        ("is_plain", np.bool_),
    ],
    align=True,
)
"""One triangle.

triangle: its number, -1 for none. origin: place of its lowest layer in the atlas.
a0, ax, ay: the edge function opposite corner a at the picture's first sample, and its steps to the
    right and down; b and c alike.
inv_wa, ua, va, sa: 1 / w, u, v and brightness of corner a. da: step to the right of the edge
    function over w. dw, du, dv, ds: of 1 / w, and of u, v and light over w.
across, down: texels of the lowest layer; i_low, i_high, j_low, j_high: those that may be seen.
level, mix: of the detail, -1 where they are not known yet; see `add_details`. copy: the first texel
    of the tile's copy. edge: the part of the texture at whose edge it lies, -1 for none.
lean: each number of `lean_vertices` at the corners, and its step to the right over w.
is_plain: whether that layer is the only one and has no tint.
"""


@borrowing_kernel
def set_up(t: Any, mesh: Any, tables: Any, setup: Any) -> Any:
    """Prepare triangle t. mesh, tables: see `draw_tiles`; setup: the result, a SETUP."""
    vertices, triangles, triangle_material = mesh
    materials, layers, _, wide = tables
    a, b, c = vertices[triangles[t, 0]], vertices[triangles[t, 1]], vertices[triangles[t, 2]]
    ax, ay = np.int64(a.x), np.int64(a.y)
    bx, by = np.int64(b.x), np.int64(b.y)
    cx, cy = np.int64(c.x), np.int64(c.y)
    setup.a0, setup.ax, setup.ay = bx * cy - by * cx, (by - cy) << 8, (cx - bx) << 8
    setup.b0, setup.bx, setup.by = cx * ay - cy * ax, (cy - ay) << 8, (ax - cx) << 8
    setup.c0, setup.cx, setup.cy = ax * by - ay * bx, (ay - by) << 8, (bx - ax) << 8
    setup.inv_wa, setup.inv_wb, setup.inv_wc = a.inv_w, b.inv_w, c.inv_w
    setup.ua, setup.ub, setup.uc = a.u, b.u, c.u
    setup.va, setup.vb, setup.vc = a.v, b.v, c.v
    setup.sa, setup.sb, setup.sc = a.shade, b.shade, c.shade
    da, db, dc = setup.ax * a.inv_w, setup.bx * b.inv_w, setup.cx * c.inv_w
    setup.da, setup.db, setup.dc = da, db, dc
    setup.dw = da + db + dc
    setup.du = da * a.u + db * b.u + dc * c.u
    setup.dv = da * a.v + db * b.v + dc * c.v
    setup.ds = (da * a.shade + db * b.shade + dc * c.shade) * FULL_LIGHT
    material = triangle_material[t]
    lowest = materials[material, 0]
    left, top = layers[lowest, 0], layers[lowest, 1]
    across, down = layers[lowest, 2], layers[lowest, 3]
    red, green, blue = layers[lowest, 4], layers[lowest, 5], layers[lowest, 6]
    setup.triangle, setup.origin, setup.level = t, top * wide + left, -1
    setup.across, setup.down = across, down
    setup.i_low, setup.i_high = texels_of(a.u, b.u, c.u, across)
    setup.j_low, setup.j_high = texels_of(a.v, b.v, c.v, down)
    setup.is_lit = materials[material, 3] != 0
    setup.is_plain = materials[material, 1] == 1 and red & green & blue == 255


@borrowing_kernel
def texels_of(a: Any, b: Any, c: Any, count: Any) -> Any:
    """The first and last of `count` texels that a triangle with these u or v at its corners shows.

    A sample on the edge of a triangle must not show a neighbouring part of the sheet.
    """
    first = min(max(np.int64(min(a, b, c) * count + 1e-3), 0), count - 1)
    last = min(max(np.int64(np.ceil(max(a, b, c) * count - 1e-3)) - 1, first), count - 1)
    return first, last


@borrowing_kernel
def weights_of(setup: Any, x: Any, y: Any) -> Any:
    """Edge functions over w of a triangle's corners at a sample, as `weights_at` gives them."""
    return (
        np.float64(setup.a0 + x * setup.ax + y * setup.ay) * setup.inv_wa,
        np.float64(setup.b0 + x * setup.bx + y * setup.by) * setup.inv_wb,
        np.float64(setup.c0 + x * setup.cx + y * setup.cy) * setup.inv_wc,
    )
