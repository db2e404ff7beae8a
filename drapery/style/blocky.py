"""Cloth that looks like low resolution: bends of few angles, and texels that stay level.

Both change the positions after the simulation and have no effect on it.
"""

import numpy as np

from drapery.mesh import Array, Mesh
from drapery.style.boxes import ModelBox, box_mesh, upright
from drapery.style.uv_mapping import BoxMapping


def stepped(sheet: Array, shape: tuple[int, int], steps: int) -> Array:
    """A grid below its top row as a chain of stiff boards at multiples of 90 / steps degrees.

    sheet: positions [m], shape [..., N, 3], row by row from the top. shape: its rows and columns.
    Each board keeps the distance of its two rows and starts at the end of the one above; the top
    row stays where it is.
    """
    rows = sheet.reshape(*sheet.shape[:-2], *shape, 3)
    middles = rows.mean(axis=-2)
    along = np.diff(middles, axis=-2)
    across = rows[..., :1, -1, :] - rows[..., :1, 0, :]
    side = across / np.linalg.norm(across, axis=-1, keepdims=True)
    front = np.cross(side, [0.0, 1.0, 0.0])
    lengths = np.linalg.norm(along, axis=-1)
    aside, ahead = (np.sum(along * axis, axis=-1) for axis in (side, front))
    lean = _snapped(np.arctan2(aside, np.hypot(along[..., 1], ahead)), steps)
    bend = _snapped(np.arctan2(ahead, -along[..., 1]), steps)
    down = np.array([0.0, -1.0, 0.0])
    turned = np.cos(bend)[..., None] * down + np.sin(bend)[..., None] * front
    boards = np.cos(lean)[..., None] * turned + np.sin(lean)[..., None] * side
    below = np.cumsum(lengths[..., None] * boards, axis=-2)
    offsets = np.concatenate([np.zeros_like(below[..., :1, :]), below], axis=-2)
    result: Array = (rows[..., :1, :, :] + offsets[..., None, :]).reshape(sheet.shape)
    return result


def pixelled(
    sheet: Array,
    shape: tuple[int, int],
    size: tuple[int, int],
    uv_mapping: BoxMapping,
    texel: float,
) -> Mesh:
    """A grid whose rows run along x as upright cubes, one for each texel, on a lattice of texels.

    A row of texels moves sideways and down as one, so that it has no holes; each texel moves
    forwards and backwards alone. A cube shows its texel of the back on its back, and its texel of
    the front on its other sides.

    sheet: positions [m], shape [N, 3]. shape: its rows and columns. size: texels across and down.
    uv_mapping: where front and back lie on the texture. texel: edge of a cube [m].
    """
    first = sheet[0] + np.array([texel / 2, -texel / 2, 0.0])
    column, row = np.meshgrid(np.arange(size[0]), np.arange(size[1]))
    lattice = first + np.stack([column, -row, 0 * row], axis=-1) * texel
    shift = _middles(sheet.reshape(*shape, 3), size) - lattice
    shift[..., :2] = shift[..., :2].mean(axis=1, keepdims=True)
    snapped = (lattice + np.round(shift / texel) * texel).reshape(-1, 3)
    cube = upright(box_mesh(ModelBox((-0.5, -0.5, -0.5), (1, 1, 1), (0, 0))), texel, (0, 0, 0))
    count = len(snapped)
    firsts = len(cube.positions) * np.arange(count, dtype=np.int32)[:, None, None]
    return Mesh(
        (snapped[:, None] + cube.positions).reshape(-1, 3),
        np.tile(cube.normals, (count, 1)),
        (cube.triangles + firsts).reshape(-1, 3),
        _texel_uvs(size, uv_mapping).reshape(-1, 2),
    )


def _snapped(angles: Array, steps: int) -> Array:
    quantum = np.pi / 2 / steps
    snapped: Array = np.round(angles / quantum) * quantum
    return snapped


def _middles(rows: Array, size: tuple[int, int]) -> Array:
    """The middles of the texels of a grid [R, C, 3], shape [size[1], size[0], 3]."""
    for axis, count in ((0, size[1]), (1, size[0])):
        at = (np.arange(count) + 0.5) / count * (rows.shape[axis] - 1)
        low = np.minimum(at.astype(int), rows.shape[axis] - 2)
        part = (at - low).reshape(-1, 1, 1) if axis == 0 else (at - low).reshape(1, -1, 1)
        rows = (1 - part) * rows.take(low, axis) + part * rows.take(low + 1, axis)
    return rows


def _texel_uvs(size: tuple[int, int], uv_mapping: BoxMapping) -> Array:
    """The 24 texture coordinates of each cube, shape [M, 24, 2]: the middle of one texel a face."""
    across, down = np.meshgrid(
        (np.arange(size[0]) + 0.5) / size[0], (np.arange(size[1]) + 0.5) / size[1]
    )
    uvs = np.stack([across, down], axis=-1).reshape(-1, 2)
    # The faces of a box: front, back, left, right, top, bottom, four corners each.
    faces = [uv_mapping.front(uvs), uv_mapping.back(uvs), *[uv_mapping.front(uvs)] * 4]
    return np.repeat(np.stack(faces, axis=1), 4, axis=1)
