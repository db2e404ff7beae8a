"""How much of the sky vertices see: the kernel of ambient occlusion."""

from typing import Any

import numpy as np

from drapery.jit import entry_point, kernel

FAR = -1e30

LEAST_FACING = 0.1
"""Cosine below which a direction is too far aside to tell anything."""


@entry_point
def occlude(
    positions: Any,
    normals: Any,
    triangles: Any,
    centre: Any,
    cell: Any,
    side: Any,
    directions: Any,
    coarse: Any,
    skipped: Any,
    openness: Any,
) -> Any:
    """Measure from each direction which vertices other surfaces cover.

    Points spread evenly over all triangles are entered in a map of the highest point at each place,
    as seen from the direction. A vertex that lies below the map is covered, fully at a depth of
    one cell. The result is the share of directions that are free, weighted by the cosine to the
    normal.

    positions, normals: [V, 3], float32. triangles: those that cover others, [T, 3].
    centre: of the maps [m]. cell: width of a sample of the maps [m]. side: their samples.
    directions: unit axes right, up and towards the direction, [K, 3, 3].
    coarse: vertices of triangles with a side longer than this [m] stay free.
    skipped: vertices that stay free, which may be anywhere, [V], bool; it is changed.
    openness: the result, [V], float32, 1 where nothing covers the vertex.
    """
    count = len(positions)
    points = _points_on(positions, triangles, centre, cell, side, coarse, skipped)
    lifted = np.empty((3, count))
    for v in range(count):
        for axis in range(3):
            lifted[axis, v] = positions[v, axis] + normals[v, axis] * cell - centre[axis]
    shown, weight = np.zeros(count), np.zeros(count)
    heights = np.empty(side * side)
    place, high = np.empty(points.shape[1], np.int32), np.empty(points.shape[1])
    across, down, above = np.empty(count), np.empty(count), np.empty(count)
    inverse, middle = 1.0 / cell, side * 0.5
    for k in range(len(directions)):
        rx, ry, rz = directions[k, 0, 0], directions[k, 0, 1], directions[k, 0, 2]
        ux, uy, uz = directions[k, 1, 0], directions[k, 1, 1], directions[k, 1, 2]
        dx, dy, dz = directions[k, 2, 0], directions[k, 2, 1], directions[k, 2, 2]
        heights[:] = FAR
        for i in range(points.shape[1]):
            x, y, z = points[0, i], points[1, i], points[2, i]
            column = np.int32((x * rx + y * ry + z * rz) * inverse + middle)
            line = np.int32((x * ux + y * uy + z * uz) * inverse + middle)
            place[i] = line * np.int32(side) + column
            high[i] = x * dx + y * dy + z * dz
        for i in range(points.shape[1]):
            at = np.uint64(place[i])
            heights[at] = max(heights[at], high[i])
        for v in range(count):
            x, y, z = lifted[0, v], lifted[1, v], lifted[2, v]
            across[v] = (x * rx + y * ry + z * rz) * inverse + (middle - 0.5)
            down[v] = (x * ux + y * uy + z * uz) * inverse + (middle - 0.5)
            above[v] = (x * dx + y * dy + z * dz) * inverse + 1.0
        for v in range(count):
            facing = normals[v, 0] * dx + normals[v, 1] * dy + normals[v, 2] * dz
            if facing < LEAST_FACING or skipped[v]:
                continue
            left, top = np.int64(across[v]), np.int64(down[v])
            p, q, at = across[v] - left, down[v] - top, np.uint64(top * side + left)
            upper = (1 - p) * _covered(heights[at], inverse, above[v])
            upper += p * _covered(heights[at + np.uint64(1)], inverse, above[v])
            under = at + np.uint64(side)
            lower = (1 - p) * _covered(heights[under], inverse, above[v])
            lower += p * _covered(heights[under + np.uint64(1)], inverse, above[v])
            weight[v] += facing
            shown[v] += facing * (1.0 - (1 - q) * upper - q * lower)
    for v in range(count):
        if weight[v] > 0.0:
            openness[v] = shown[v] / weight[v]


@kernel
def _covered(height: Any, inverse: Any, above: Any) -> Any:
    """How far a place is below a height, 0..1; one cell deep is wholly."""
    return min(max(height * inverse - above, 0.0), 1.0)


@kernel
def _points_on(
    positions: Any,
    triangles: Any,
    centre: Any,
    cell: Any,
    side: Any,
    coarse: Any,
    skipped: Any,
) -> Any:
    """Points at most about a cell apart on all triangles, from the centre, shape [3, P].

    skipped: set for the vertices of triangles with a side longer than `coarse`.
    """
    pieces = np.empty(len(triangles), np.int64)
    total = 0
    for t in range(len(triangles)):
        longest = 0.0
        for corner in range(3):
            a, b = triangles[t, corner], triangles[t, (corner + 1) % 3]
            square = 0.0
            for axis in range(3):
                step = np.float64(positions[a, axis]) - np.float64(positions[b, axis])
                square += step * step
            longest = max(longest, np.sqrt(square))
        pieces[t] = min(np.int64(longest / cell) + 1, side)
        total += pieces[t] * (pieces[t] + 1) // 2
        if longest > coarse:
            for corner in range(3):
                skipped[triangles[t, corner]] = True
    points = np.empty((3, total))
    at = 0
    for t in range(len(triangles)):
        a, b, c = triangles[t, 0], triangles[t, 1], triangles[t, 2]
        part = 1.0 / pieces[t]
        for i in range(pieces[t]):
            for j in range(pieces[t] - i):
                p, q = (i + 1 / 3) * part, (j + 1 / 3) * part
                for axis in range(3):
                    corner = positions[a, axis]
                    along = p * (positions[b, axis] - corner) + q * (positions[c, axis] - corner)
                    points[axis, at] = corner + along - centre[axis]
                at += 1
    return points
