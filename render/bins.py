"""Which triangles touch which tile of the picture: a counting sort in two passes.

Every worker takes one run of triangles, first counting, then filling; the runs follow one
another in every tile, so that each tile holds its triangles in drawing order however many
workers there are.
"""

from numba import njit

TILE_BITS = 6
TILE = 1 << TILE_BITS
"""Side of a tile [samples]: its depth keys and colours, 12 bytes a sample, stay in cache."""


@njit(cache=True, error_model="numpy", nogil=True)
def sort_into_tiles(first, last, corners, triangles, tiles_x, top, rows, cursor, entries, fill):
    """Count, or enter, triangles first..last for the tiles of some rows.

    corners: [1/256 pixel], shape [V, 2]; triangles: shape [T, 3].
    tiles_x: tiles across; top, rows: the first row of tiles, and how many.
    cursor: shape [rows * tiles_x]; counts up by one for each entry.
    entries: where triangle numbers are entered at the cursor if `fill`.
    """
    for t in range(first, last):
        a, b, c = triangles[t, 0], triangles[t, 1], triangles[t, 2]
        ax, bx, cx = corners[a, 0], corners[b, 0], corners[c, 0]
        ay, by, cy = corners[a, 1], corners[b, 1], corners[c, 1]
        # The pixels whose centres lie in the triangle's bounds: most small ones hold none.
        left = max((min(ax, bx, cx) + 255) >> 8, 0)
        right = min(max(ax, bx, cx) >> 8, (tiles_x << TILE_BITS) - 1)
        upper = max((min(ay, by, cy) + 255) >> 8, top << TILE_BITS)
        lower = min(max(ay, by, cy) >> 8, ((top + rows) << TILE_BITS) - 1)
        if left > right or upper > lower:
            continue
        for row in range((upper >> TILE_BITS) - top, (lower >> TILE_BITS) - top + 1):
            for column in range(left >> TILE_BITS, (right >> TILE_BITS) + 1):
                tile = row * tiles_x + column
                if fill:
                    entries[cursor[tile]] = t
                cursor[tile] += 1
