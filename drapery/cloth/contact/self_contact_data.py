"""What contact of a cloth with itself needs, worked out once for each cloth."""

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from drapery.cloth.cloth import Cloth
from drapery.errors import OptionError
from drapery.mesh import Array

LEAF = 2
"""Faces of a leaf of the tree of faces, such as the two of a cell of a grid."""
CELLS = 1024
"""Cells of the Z-order curve along each axis."""
NARROW = 0.5
"""Parts of a cloth may be as near as this many times its shortest edge, however thick it is: else
the particles around one particle would push it."""


class SelfContact(NamedTuple):
    """What contact of a cloth with itself needs.

    thickness: least distance [m], see NARROW. rest: places at rest [m], [N, 3].
    inv_mass: [1/kg], [N].
    piece: number of the connected part of each particle, [N].
    particles [M], triangles [T, 3], edges: ends of each edge, [E, 2]; all in the order of the
    leaves, which are LEAF neighbouring faces each. A particle or an edge of several faces belongs
    to the leaf of one of them. begin: the first particle, face and edge of each leaf and the ends,
    [L + 1, 3].
    columns: particles of a row of a grid. nodes: the rectangle of cells
    of each node of the tree of `face_tree`: first row and column, then the last ones, [2 L, 4].
    levels: of the blocks of cells of `smoothness`, the number of the first one and how many
    there are down and across, [K, 3]; the last one is a block of all cells. These three are 0 or
    empty for other cloths.
    """

    thickness: float
    rest: Array
    inv_mass: Array
    piece: NDArray[np.int32]
    particles: NDArray[np.int32]
    triangles: NDArray[np.int32]
    edges: NDArray[np.int32]
    begin: NDArray[np.int32]
    columns: int
    nodes: NDArray[np.int32]
    levels: NDArray[np.int32]


NOT_ITSELF = SelfContact(
    0.0,
    np.zeros((0, 3)),
    np.zeros(0),
    np.zeros(0, np.int32),
    np.zeros(0, np.int32),
    np.zeros((0, 3), np.int32),
    np.zeros((0, 2), np.int32),
    np.zeros((1, 3), np.int32),
    0,
    np.zeros((0, 4), np.int32),
    np.zeros((0, 3), np.int32),
)
"""The contact of cloths that pass through themselves."""


def make_self_contact(cloth: Cloth, thickness: float) -> SelfContact:
    """What contact of a cloth with itself needs; thickness: least distance [m].

    Raises OptionError unless it is above 0.
    """
    if not 0 < thickness < np.inf:
        raise OptionError(
            f"self-collision thickness {thickness} is out of range; use a length above 0 [m]"
        )
    rest, count = np.ascontiguousarray(cloth.rest_positions, float), len(cloth.inv_mass)
    triangles = np.asarray(cloth.triangles, np.int32)
    sides = np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]])
    edges, number = np.unique(np.sort(sides, axis=1), axis=0, return_inverse=True)
    piece = _pieces(edges, count)
    lengths = np.sqrt(np.square(rest[edges[:, 0]] - rest[edges[:, 1]]).sum(axis=1))
    of_face = number.reshape(3, -1).T
    order = _leaf_order(rest, piece, edges, of_face, lengths)
    triangles = np.ascontiguousarray(triangles[order])
    starts = np.append(np.arange(0, len(triangles), LEAF), len(triangles))
    particles, first_particle = _in_leaves(triangles, count, starts)
    edge_order, first_edge = _in_leaves(of_face[order], len(edges), starts)
    columns, nodes, levels = _blocks_of(cloth, triangles)
    return SelfContact(
        min(float(thickness), float(NARROW * lengths.min(initial=np.inf))),
        rest,
        np.ascontiguousarray(cloth.inv_mass, float),
        piece,
        particles.astype(np.int32),
        triangles,
        np.ascontiguousarray(edges[edge_order], np.int32),
        np.stack([first_particle, starts, first_edge], axis=1).astype(np.int32),
        columns,
        nodes,
        levels,
    )


def _pieces(edges: NDArray[np.integer], count: int) -> NDArray[np.int32]:
    """The number of the connected part of each particle, in the order of their first particles.

    SciPy would do this too, but its import takes longer than to draw a picture.
    """
    first = np.arange(count)
    while (first[edges[:, 0]] != first[edges[:, 1]]).any():
        lower = first[edges].min(axis=1)
        np.minimum.at(first, first[edges[:, 0]], lower)
        np.minimum.at(first, first[edges[:, 1]], lower)
        first = first[first]
    return np.unique(first, return_inverse=True)[1].astype(np.int32)


def _blocks_of(
    cloth: Cloth, triangles: NDArray[np.int32]
) -> tuple[int, NDArray[np.int32], NDArray[np.int32]]:
    """The columns, nodes and levels of a `SelfContact`. triangles: in the order of the leaves."""
    rows, columns = cloth.grid_shape or (0, 0)
    none = 0, np.zeros((0, 4), np.int32), np.zeros((0, 3), np.int32)
    if min(rows, columns) < 2 or len(triangles) % LEAF:
        return none
    places = np.stack(np.divmod(triangles, columns), axis=-1)
    of_faces = places.min(axis=1).astype(np.int32)
    cells = of_faces[::LEAF]
    if (places.max(axis=1) != of_faces + 1).any() or (np.repeat(cells, LEAF, 0) != of_faces).any():
        return none  # the faces of a leaf are not those of a cell
    levels, first, down, across = [], 0, rows - 1, columns - 1
    while True:
        levels.append((first, down, across))
        if down == across == 1:
            return columns, _node_cells(cells), np.array(levels, np.int32)
        first, down, across = first + down * across, (down + 1) // 2, (across + 1) // 2


def _node_cells(cells: NDArray[np.int32]) -> NDArray[np.int32]:
    """The `nodes` of a `SelfContact`. cells: row and column of the cell of each leaf, [L, 2]."""
    count = 1 << (len(cells) - 1).bit_length()
    nodes = np.zeros((2 * count, 4), np.int32)
    nodes[count : count + len(cells)] = np.hstack([cells, cells])
    nodes[count + len(cells) :] = nodes[count]  # these leaves are empty
    while count > 1:
        children = nodes[count : 2 * count].reshape(-1, 2, 4)
        count //= 2
        nodes[count : 2 * count, :2] = children[..., :2].min(axis=1)
        nodes[count : 2 * count, 2:] = children[..., 2:].max(axis=1)
    return nodes


def _leaf_order(
    rest: Array,
    piece: NDArray[np.int32],
    edges: NDArray[np.int32],
    of_face: NDArray[np.intp],
    lengths: Array,
) -> NDArray[np.intp]:
    """The faces piece by piece, and in each along a Z-order curve through the middles of their
    longest edges. So the two faces of a cell of a grid, which share that edge, are neighbours.

    of_face: the three edges of each face, [T, 3]. lengths: of the edges [m].
    """
    longest = of_face[np.arange(len(of_face)), lengths[of_face].argmax(axis=1)]
    middles = rest[edges[longest]].mean(axis=1)
    middles -= middles.min(axis=0, initial=np.inf)
    cells = (middles / middles.max(initial=1e-9) * (CELLS - 1)).astype(np.int64)
    code = np.zeros(len(cells), np.int64)
    for bit in range(CELLS.bit_length() - 1):
        for axis in range(3):
            code |= (cells[:, axis] >> bit & 1) << (3 * bit + axis)
    order: NDArray[np.intp] = np.lexsort((code, piece[edges[longest, 0]]))
    return order


def _in_leaves(
    parts: NDArray[Any], count: int, starts: NDArray[np.intp]
) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
    """Particles or edges in the order of the first face that has them, and the number of the first
    one of each leaf. parts: of each face, [T, 3]. starts: the first face of each leaf."""
    owner = np.full(count, len(parts), np.intp)
    np.minimum.at(owner, parts.ravel(), np.repeat(np.arange(len(parts)), 3))
    order = np.argsort(owner, kind="stable")
    first: NDArray[np.intp] = np.searchsorted(owner[order], starts)
    return order[: first[-1]], first
