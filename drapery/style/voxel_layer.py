"""The second layer of a skin as small boxes: the flat layer, and walls around visible texels."""

import numpy as np
from numpy.typing import NDArray

from drapery.mesh import Array, Mesh
from drapery.style.boxes import ModelBox, Side, box_sides
from drapery.style.uv_mapping import box_mapping

REVERSED = np.array([1.0, -1.0, -1.0])
"""From axes of the model, whose y and z are reversed, to those of the world."""
FINEST = 1 << 16
"""Places of a box are compared as multiples of 1 / FINEST of its sides."""

Visible = NDArray[np.bool_]


def layer_walls(box: ModelBox, visible: Visible, sheet: tuple[int, int] = (64, 64)) -> Mesh | None:
    """Walls of the visible texels of a box that is `grown`, from there down to the box itself.

    A wall stands where a visible texel has a neighbour that is not, also around the edges of the
    box, and has the colour of its texel. visible: of the whole texture, shape [H, W].
    sheet: width and height of the texture [texels]. The mesh is like that of `box_mesh`; None
    where there is no wall.
    """
    height, width = visible.shape
    ends, texels, outward, inward = [], [], [], []
    for side in box_sides(box_mapping(box.offset, box.size, sheet)):
        left, top, right, bottom = (
            round(share * extent)
            for share, extent in zip(side[4], (width, height) * 2, strict=True)
        )
        for place, texel, facing in _borders(side, visible[top:bottom, left:right]):
            ends.append(place)
            texels.append((texel + np.array([left, top]) + 0.5) / np.array([width, height]))
            outward.append(np.broadcast_to(facing, (len(place), 3)))
            inward.append(np.broadcast_to(-np.array(side[3]) * REVERSED, (len(place), 3)))
    places = np.concatenate(ends)
    alone = _without_twin(places)
    if not alone.any():
        return None
    return _walls(
        box, places[alone], *(np.concatenate(each)[alone] for each in (texels, outward, inward))
    )


def _borders(side: Side, shown: Visible) -> list[tuple[Array, Array, Array]]:
    """Where visible texels of a side end: both ends of each border in fractions of the box, shape
    [N, 2, 3], the column and row of its texel, shape [N, 2], and the direction it faces [3]."""
    start, right, down = (np.array(each, np.float64) for each in side[:3])
    found = []
    for along, across, cells in ((right, down, shown), (down, right, shown.T)):
        padded = np.pad(cells, ((0, 0), (1, 1)))
        for step, sign in ((0, -1), (1, 1)):
            # Cells whose neighbour on one side is not visible.
            rows, columns = np.nonzero(cells & ~padded[:, 2 * step : 2 * step + cells.shape[1]])
            share = (columns + step)[:, None] / cells.shape[1]
            ends = [
                start + share * along + (rows + n)[:, None] / len(cells) * across for n in (0, 1)
            ]
            texel = np.stack([columns, rows] if along is right else [rows, columns], axis=-1)
            found.append((np.stack(ends, axis=1), texel, sign * along * REVERSED))
    return found


def _without_twin(places: Array) -> Visible:
    """Which borders no other side has too: where two sides meet, no wall stands between them."""
    middles = np.round(places.mean(axis=1) * FINEST).astype(np.int64)
    _, number, count = np.unique(middles, axis=0, return_inverse=True, return_counts=True)
    alone: Visible = count[number.reshape(-1)] == 1
    return alone


def _walls(box: ModelBox, places: Array, texels: Array, outward: Array, inward: Array) -> Mesh:
    corner = np.array(box.corner, np.float64) - box.grown
    outer = corner + places * (np.array(box.size, np.float64) + 2 * box.grown)
    inner = outer + box.grown * inward[:, None]
    corners = np.concatenate([outer, inner], axis=1)
    u, v = (corners[:, 1] - corners[:, 0]) * REVERSED, (corners[:, 2] - corners[:, 0]) * REVERSED
    faces_out = (np.cross(u, v) * outward).sum(axis=1) > 0
    order = np.where(faces_out[:, None], [0, 1, 2, 2, 1, 3], [0, 2, 1, 1, 2, 3])
    triangles = (order + 4 * np.arange(len(order))[:, None]).reshape(-1, 3).astype(np.int32)
    return Mesh(
        corners.reshape(-1, 3),
        np.repeat(outward, 4, axis=0),
        triangles,
        np.repeat(texels, 4, axis=0),
    )
