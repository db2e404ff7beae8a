"""Vertices from the world to the raster: one loop over all vertices of a model.

Corners are snapped to 1/256 pixel, as llvmpipe and most graphics cards do.
"""

from typing import Any

import numpy as np

from drapery.jit import entry_point

BEHIND, BEYOND, ASIDE, BROKEN = 1, 2, 4, 8
"""Flags of a vertex: before the near plane, past the far plane, too far aside, not finite."""

NEAREST = 1 << 30
"""Depth at the near plane; 0 at the far plane."""

GUARD = float(1 << 21)
"""Corners at most this many pixels aside need no clipping: edge functions fit in 64 bits."""


VERTEX = np.dtype(
    [
        ("x", np.int32),
        ("y", np.int32),
        ("depth", np.int32),
        ("shade", np.float32),
        ("u", np.float32),
        ("v", np.float32),
        ("inv_w", np.float64),
    ],
    align=True,
)
"""A vertex on the picture: x to the right and y down from the centre of the top left sample
[1/256 sample], depth, brightness, texture coordinates, and 1 / w of clip space. One record, since
triangles read vertices in no particular order."""


@entry_point
def project(
    first: Any,
    last: Any,
    positions: Any,
    normals: Any,
    uvs: Any,
    matrix: Any,
    width: Any,
    height: Any,
    lights: Any,
    ambient: Any,
    diffuse: Any,
    vertices: Any,
    flags: Any,
) -> Any:
    """Project and light vertices first..last - 1; returns the union of their flags.

    positions, normals: shape [V, 3], float32; uvs: shape [V, 2], float32.
    matrix: world to clip space, shape [4, 4], float64.
    width, height: of the picture [samples].
    lights: unit vectors towards the lights, shape [L, 3]; ambient and diffuse as in `Light`.
    vertices: the results, shape [V] of VERTEX; flags: shape [V], uint8.
    """
    union = 0
    for v in range(first, last):
        x = np.float64(positions[v, 0])
        y = np.float64(positions[v, 1])
        z = np.float64(positions[v, 2])
        cx = matrix[0, 0] * x + matrix[0, 1] * y + matrix[0, 2] * z + matrix[0, 3]
        cy = matrix[1, 0] * x + matrix[1, 1] * y + matrix[1, 2] * z + matrix[1, 3]
        cz = matrix[2, 0] * x + matrix[2, 1] * y + matrix[2, 2] * z + matrix[2, 3]
        w = matrix[3, 0] * x + matrix[3, 1] * y + matrix[3, 2] * z + matrix[3, 3]
        nx, ny, nz = normals[v, 0], normals[v, 1], normals[v, 2]
        factor = np.float64(ambient)
        for light in range(len(lights)):
            facing = nx * lights[light, 0] + ny * lights[light, 1] + nz * lights[light, 2]
            factor += diffuse * max(facing, 0.0)
        inv_w = 1.0 / w
        across = (cx * inv_w * 0.5 + 0.5) * width
        up = (cy * inv_w * 0.5 + 0.5) * height

        flag = 0
        if not abs(cx) + abs(cy) + abs(cz) + abs(w) + abs(nx) + abs(ny) + abs(nz) < np.inf:
            flag = BROKEN
        else:
            if cz + w < 0 or w <= 0:
                flag |= BEHIND
            if cz > w:
                flag |= BEYOND
            if not abs(across) + abs(up) < GUARD:
                flag |= ASIDE
        vertex = vertices[v]
        vertex.shade = min(factor, 1.0)
        vertex.u = uvs[v, 0]
        vertex.v = uvs[v, 1]
        if flag == 0:
            # Snapped as in OpenGL, where rows count upwards, then flipped; less half a sample, so
            # that the centre of sample i is at i * 256.
            vertex.x = np.int32(np.rint(across * 256.0)) - 128
            vertex.y = (height - 1) * 256 - (np.int32(np.rint(up * 256.0)) - 128)
            vertex.depth = np.int32(np.rint((0.5 - 0.5 * (cz * inv_w)) * NEAREST))
            vertex.inv_w = inv_w
        flags[v] = flag
        union |= flag
    return union
