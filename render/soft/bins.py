"""Sorts triangles into the tiles of the picture that they touch: a counting sort in two passes.

The triangles are divided into parts; each part is first counted, then entered. The parts follow one
another in every tile, so each tile has its triangles in drawing order for any number of threads. A
record holds all data that coverage needs: reading them from the vertices again would be slow.
"""

from typing import Any

from drapery.jit import entry_point

TILE_BITS = 6
TILE = 1 << TILE_BITS
"""Side of a tile [samples]: its depth keys and colours, 12 bytes a sample, stay in cache."""
LANES = 8
"""Samples in a group; groups are tested without a branch, for SIMD instructions."""
STRIDE = TILE + LANES
"""Samples in a row of a tile with those of the last group that lie outside."""

ID_BITS = 24
ID_MASK = (1 << ID_BITS) - 1
RECORD = 10
"""Numbers of a record: x, y of three corners, three depths, alpha mode above triangle number."""


@entry_point
def sort_into_tiles(
    first: Any,
    last: Any,
    vertices: Any,
    triangles: Any,
    triangle_material: Any,
    materials: Any,
    tiles: Any,
    cursor: Any,
    records: Any,
) -> Any:
    """Count triangles first..last for some tiles, or enter them if `records` is not empty.

    vertices, triangles, triangle_material, materials: see `draw_tiles`.
    tiles: number across and down the picture, then the first tile of the range and its end.
    cursor: one for each tile of the range; it is increased by one for each entry.
    records: the records, entered at the cursors, shape [E, RECORD]; empty to count only.
    """
    tiles_x, tiles_y, first_tile, end_tile = tiles
    for t in range(first, last):
        a, b, c = triangles[t, 0], triangles[t, 1], triangles[t, 2]
        ax, bx, cx = vertices[a].x, vertices[b].x, vertices[c].x
        ay, by, cy = vertices[a].y, vertices[b].y, vertices[c].y
        # The samples within the triangle's bounds; most small triangles have none.
        left = max((min(ax, bx, cx) + 255) >> 8, 0)
        right = min(max(ax, bx, cx) >> 8, (tiles_x << TILE_BITS) - 1)
        top = max((min(ay, by, cy) + 255) >> 8, 0)
        bottom = min(max(ay, by, cy) >> 8, (tiles_y << TILE_BITS) - 1)
        if left > right or top > bottom:
            continue
        for row in range(top >> TILE_BITS, (bottom >> TILE_BITS) + 1):
            for column in range(left >> TILE_BITS, (right >> TILE_BITS) + 1):
                tile = row * tiles_x + column
                if tile < first_tile or tile >= end_tile:
                    continue
                entry = cursor[tile - first_tile]
                cursor[tile - first_tile] = entry + 1
                if len(records):
                    records[entry, 0], records[entry, 1] = ax, ay
                    records[entry, 2], records[entry, 3] = bx, by
                    records[entry, 4], records[entry, 5] = cx, cy
                    records[entry, 6] = vertices[a].depth
                    records[entry, 7] = vertices[b].depth
                    records[entry, 8] = vertices[c].depth
                    records[entry, 9] = materials[triangle_material[t], 2] << ID_BITS | t
