"""What contact of a cloth with itself needs, worked out once for each cloth."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from drapery.cloth.cloth import Cloth
from drapery.errors import OptionError
from drapery.mesh import Array

NARROW = 0.5
"""Parts of a cloth may be as near as this many times its shortest edge, however thick it is: else
the particles around one particle would push it."""


class SelfContact(NamedTuple):
    """What contact of a cloth with itself needs.

    thickness: least distance [m], see NARROW. rest: places at rest [m], [N, 3].
    inv_mass: [1/kg], [N].
    piece: number of the connected part of each particle, [N]. triangles: [T, 3]. edges: ends of
    each edge, [E, 2]. of_face: the three edges of each face, [T, 3]. owner: the face that answers
    for a particle, [N], and for an edge, [E], so that each pair is found once.
    rows, columns: of a grid, or 0.
    """

    thickness: float
    rest: Array
    inv_mass: Array
    piece: NDArray[np.int32]
    triangles: NDArray[np.int32]
    edges: NDArray[np.int32]
    of_face: NDArray[np.int32]
    particle_owner: NDArray[np.int32]
    edge_owner: NDArray[np.int32]
    rows: int
    columns: int


def make_self_contact(cloth: Cloth, thickness: float) -> SelfContact:
    """What contact of a cloth with itself needs; thickness: least distance [m].

    Raises OptionError unless it is above 0.
    """
    from scipy.sparse import coo_array
    from scipy.sparse.csgraph import connected_components

    if not 0 < thickness < np.inf:
        raise OptionError(
            f"self-collision thickness {thickness} is out of range; use a length above 0 [m]"
        )
    triangles = np.ascontiguousarray(cloth.triangles, np.int32)
    count = len(cloth.inv_mass)
    sides = np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]])
    edges, number = np.unique(np.sort(sides, axis=1), axis=0, return_inverse=True)
    of_face = number.reshape(3, -1).T.astype(np.int32)
    graph = coo_array((np.ones(len(edges)), (edges[:, 0], edges[:, 1])), shape=(count, count))
    piece = connected_components(graph, directed=False)[1]
    faces = np.arange(len(triangles), dtype=np.int32)
    rows, columns = cloth.grid_shape or (0, 0)
    ends = cloth.rest_positions[edges]
    shortest = np.sqrt(np.square(ends[:, 0] - ends[:, 1]).sum(axis=1)).min(initial=np.inf)
    return SelfContact(
        min(float(thickness), float(NARROW * shortest)),
        np.ascontiguousarray(cloth.rest_positions, float),
        np.ascontiguousarray(cloth.inv_mass, float),
        piece.astype(np.int32),
        triangles,
        np.ascontiguousarray(edges, np.int32),
        np.ascontiguousarray(of_face),
        _owners(triangles, faces, count),
        _owners(of_face, faces, len(edges)),
        rows,
        columns,
    )


def _owners(parts: NDArray[np.int32], faces: NDArray[np.int32], count: int) -> NDArray[np.int32]:
    """The first face of each part, -1 for parts of no face."""
    owner = np.full(count, len(faces), np.int32)
    np.minimum.at(owner, parts.ravel(), np.repeat(faces, 3))
    owner[owner == len(faces)] = -1
    return owner
