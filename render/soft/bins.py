"""Which triangles touch which tile of the picture: a counting sort in two passes.

The triangles are taken in runs, first counted, then entered; the runs follow one another in every
tile, so that each tile holds its triangles in drawing order however many threads there are. A
tile gets all that covering takes, side by side: gathering it again from the vertices would wait
for the memory at every triangle.
"""

from typing import Any

from drapery.jit import entry_point

TILE_BITS = 6
TILE = 1 << TILE_BITS
"""Side of a tile [samples]: its depth keys and colours, 12 bytes a sample, stay in cache."""

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
    """Count triangles first..last for some tiles, or if there is room, enter them.

    vertices, triangles, triangle_material, materials: see `draw_tiles`.
    tiles: across and down the picture, and the first and the last but one that are wanted.
    cursor: one for each wanted tile; counts up by one for each entry.
    records: where triangles are entered at the cursor, shape [E, RECORD]; if empty, none are.
    """
    tiles_x, tiles_y, first_tile, end_tile = tiles
    for t in range(first, last):
        a, b, c = triangles[t, 0], triangles[t, 1], triangles[t, 2]
        ax, bx, cx = vertices[a].x, vertices[b].x, vertices[c].x
        ay, by, cy = vertices[a].y, vertices[b].y, vertices[c].y
        # The samples within the triangle's bounds: most small ones hold none.
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
