"""The second layer of a skin: only its visible texels, flat or as small boxes with walls around.

What is not visible is not there, so it casts no shadow on the skin below.
"""

import numpy as np
from numpy.typing import NDArray

from drapery.mesh import Array, Mesh
from drapery.style.boxes import BOTTOM, ModelBox, Side, box_mesh, box_sides
from drapery.style.uv_mapping import box_mapping

REVERSED = np.array([1.0, -1.0, -1.0])
"""From axes of the model, whose y and z are reversed, to those of the world."""
FINEST = 1 << 16
"""Places of a box are compared as multiples of 1 / FINEST of its sides."""

Visible = NDArray[np.bool_]


def layer_meshes(
    box: ModelBox, visible: Visible, walls: bool, sheet: tuple[int, int] = (64, 64)
) -> list[Mesh]:
    """The visible texels of a box that is `grown`, and walls from them down to the box itself.

    A wall stands where a visible texel has a neighbour that is not, also around the edges of the
    box, and has the colour of its texel. visible: of the whole texture, shape [H, W].
    sheet: width and height of the texture [texels]. The meshes are like those of `box_mesh`;
    there is none where nothing is visible.
    """
    height, width = visible.shape
    sides = []
    for side in box_sides(box_mapping(box.offset, box.size, sheet)):
        corners = np.rint(np.array(side[4]) * ((width, height) * 2)).astype(int)
        left, top, right, bottom = corners.tolist()
        sides.append((side, np.array([left, top]), visible[top:bottom, left:right]))
    if not any(shown.any() for _, _, shown in sides):
        return []
    if all(shown.all() for _, _, shown in sides):
        return [box_mesh(box, sheet)]
    extent = np.array([width, height])
    found = [_flat(box, [(side, at / extent, shown, extent) for side, at, shown in sides])]
    return [*found, *_all_walls(box, sides, extent)] if walls else found


def _flat(box: ModelBox, sides: list[tuple[Side, Array, Visible, Array]]) -> Mesh:
    """A square for each visible texel. All of a box are split alike, so that no gaps open."""
    points, uvs, normals, triangles = [], [], [], []
    for number, (side, corner, shown, extent) in enumerate(sides):
        start, right, down = (np.array(each, np.float64) for each in side[:3])
        rows, columns = np.nonzero(shown)
        at = np.stack([columns, rows], axis=-1)[:, None] + np.array(
            [[0, 0], [1, 0], [0, 1], [1, 1]]
        )
        share = at / np.array(shown.shape[::-1])
        points.append(start + share[..., :1] * right + share[..., 1:] * down)
        uvs.append(corner + at / extent)
        normals.append(np.broadcast_to(np.array(side[3], np.float64), points[-1].shape))
        order = np.array([0, 2, 1, 1, 2, 3])
        triangles.append(np.broadcast_to(order[::-1] if number == BOTTOM else order, (len(at), 6)))
    corners, order = np.concatenate(points), np.concatenate(triangles)
    first = np.array(box.corner, np.float64) - box.grown
    return Mesh(
        (first + corners * (np.array(box.size, np.float64) + 2 * box.grown)).reshape(-1, 3),
        np.concatenate(normals).reshape(-1, 3),
        (order + 4 * np.arange(len(order))[:, None]).reshape(-1, 3).astype(np.int32),
        np.concatenate(uvs).reshape(-1, 2),
    )


def _all_walls(
    box: ModelBox, sides: list[tuple[Side, Array, Visible]], extent: Array
) -> list[Mesh]:
    ends, texels, outward, inward = [], [], [], []
    for side, corner, shown in sides:
        for place, texel, facing in _borders(side, shown):
            ends.append(place)
            texels.append((texel + corner + 0.5) / extent)
            outward.append(np.broadcast_to(facing, (len(place), 3)))
            inward.append(np.broadcast_to(-np.array(side[3]) * REVERSED, (len(place), 3)))
    places = np.concatenate(ends)
    alone = _without_twin(places)
    if not alone.any():
        return []
    rest = (np.concatenate(each)[alone] for each in (texels, outward, inward))
    return [_walls(box, places[alone], *rest)]


def _borders(side: Side, shown: Visible) -> list[tuple[Array, NDArray[np.intp], Array]]:
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
            facing: Array = sign * along * REVERSED
            found.append((np.stack(ends, axis=1), texel, facing))
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
