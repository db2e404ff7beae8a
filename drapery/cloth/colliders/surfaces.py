"""Signed distance of triangle meshes, part by part.

The nearest point of a triangle follows Ericson, "Real-Time Collision Detection" (2005), section
5.1.5. The sign follows Bærentzen and Aanæs, "Signed distance computation using the angle weighted
pseudonormal" (IEEE TVCG 11(3), 2005): a point is outside when the vector from its nearest point to
it points along the pseudonormal of the face, edge or vertex on which that nearest point lies.
"""

import numpy as np
from numpy.typing import NDArray

from drapery.arrays import Triangles
from drapery.cloth.colliders.bvh import build_tree
from drapery.cloth.colliders.fields import SURFACE, Field
from drapery.cloth.colliders.shapes import TriangleMesh
from drapery.cloth.colliders.vectors import Vector, add_scaled, dot, norm, row, scale, subtract
from drapery.elementary import arccos
from drapery.jit import kernel
from drapery.mesh import Array, face_normals

FACE, EDGE_AB, EDGE_BC, EDGE_CA, AT_A, AT_B, AT_C = range(7)
"""The feature of a triangle on which a nearest point lies; also the index of its pseudonormal."""
DEPTH = 64
"""Size of the stack of a tree traversal: a tree of a million triangles is 20 levels deep."""


def pack_surface(mesh: TriangleMesh) -> Field:
    tree = build_tree(mesh.vertices[mesh.triangles], mesh.part)
    triangles = mesh.triangles[tree.order]
    parts = np.stack([tree.roots, mesh.solid], axis=1)
    return Field(
        SURFACE,
        np.zeros(0),
        np.stack([mesh.vertices.min(axis=0), mesh.vertices.max(axis=0)]),
        0.0,
        corners=np.ascontiguousarray(mesh.vertices[triangles], float),
        normals=pseudonormals(mesh.vertices, triangles),
        boxes=tree.boxes,
        links=tree.links,
        parts=parts.astype(np.int32),
    )


def pseudonormals(vertices: Array, triangles: Triangles) -> Array:
    """Unit normals of each face, its edges ab, bc, ca and its corners a, b, c, shape [T, 7, 3]."""
    faces = _units(face_normals(vertices, triangles))
    at_corners = np.zeros_like(vertices, float)
    angles = _corner_angles(vertices[triangles])
    for corner in range(3):
        np.add.at(at_corners, triangles[:, corner], angles[:, corner, None] * faces)
    edges = np.sort(np.stack([triangles[:, [i, (i + 1) % 3]] for i in range(3)], axis=1), axis=-1)
    names, place = np.unique(edges.reshape(-1, 2), axis=0, return_inverse=True)
    on_edges = np.zeros((len(names), 3))
    np.add.at(on_edges, place.reshape(-1), np.repeat(faces, 3, axis=0))
    return np.concatenate(
        [
            faces[:, None],
            _units(on_edges)[place.reshape(-1, 3)],
            _units(at_corners)[triangles],
        ],
        axis=1,
    )


def _corner_angles(corners: Array) -> Array:
    """Inner angles [radians] of triangles [T, 3, 3], shape [T, 3]."""
    to_next = _units(np.roll(corners, -1, axis=1) - corners)
    to_last = _units(np.roll(corners, 1, axis=1) - corners)
    cosines = np.clip(np.einsum("tci,tci->tc", to_next, to_last), -1, 1)
    angles: Array = arccos(cosines)
    return angles


def _units(vectors: Array) -> Array:
    lengths = np.linalg.norm(vectors, axis=-1, keepdims=True)
    units: Array = vectors / np.where(lengths > 0, lengths, 1)
    return units


@kernel
def surface_distance(field: Field, p: Vector, limit: float) -> tuple[float, Vector]:
    """The distance to the union of the parts: the least of theirs; at most `limit` [m]."""
    best, normal = limit, (0.0, 1.0, 0.0)
    for part in range(len(field.parts)):
        first, solid = field.parts[part]
        apart = _box_square(field.boxes[first], p)
        if apart < limit * limit:
            # Inside the part's box even a distant surface decides between inside and outside.
            max_distance = np.inf if solid and apart == 0 else limit
            d, n = _part_distance(field, first, solid, p, max_distance)
            if d < best:
                best, normal = d, n
    return best, normal


@kernel
def _part_distance(
    field: Field, first: int, solid: int, p: Vector, limit: float
) -> tuple[float, Vector]:
    square, at, region, closest = limit * limit, -1, 0, p
    nodes, apart = np.empty(DEPTH, np.int32), np.empty(DEPTH)
    nodes[0], apart[0], waiting = first, 0.0, 1
    while waiting > 0:
        waiting -= 1
        node = nodes[waiting]
        if apart[waiting] >= square:
            continue
        if field.links[node, 1] == field.links[node, 2]:
            waiting = _push_children(nodes, apart, waiting, field, node, p)
            continue
        for triangle in range(field.links[node, 1], field.links[node, 2]):
            c, r = closest_on_triangle(field.corners[triangle], p)
            offset = subtract(p, c)
            if dot(offset, offset) < square:
                square, at, region, closest = dot(offset, offset), triangle, r, c
    if at < 0:
        return limit, (0.0, 1.0, 0.0)
    return _with_sign(row(field.normals[at], region), subtract(p, closest), solid)


@kernel
def _push_children(
    nodes: NDArray[np.int32], apart: Array, waiting: int, field: Field, node: int, p: Vector
) -> int:
    """Put a node's children on the stack, the nearer one on top; returns the new stack size."""
    near, far = node + 1, field.links[node + 1, 0]
    near_apart, far_apart = _box_square(field.boxes[near], p), _box_square(field.boxes[far], p)
    if far_apart < near_apart:
        near, far, near_apart, far_apart = far, near, far_apart, near_apart
    nodes[waiting], apart[waiting] = far, far_apart
    nodes[waiting + 1], apart[waiting + 1] = near, near_apart
    return waiting + 2


@kernel
def _with_sign(pseudonormal: Vector, offset: Vector, solid: int) -> tuple[float, Vector]:
    length = norm(offset)
    if length < 1e-12:
        return 0.0, pseudonormal
    if solid and dot(offset, pseudonormal) < 0:
        return -length, scale(-1 / length, offset)
    return length, scale(1 / length, offset)


@kernel
def _box_square(box: Array, p: Vector) -> float:
    """Square of the distance from p to a box [2, 3]; 0 inside."""
    total = 0.0
    for axis in range(3):
        apart = max(box[0, axis] - p[axis], 0.0, p[axis] - box[1, axis])
        total += apart * apart
    return total


@kernel
def closest_on_triangle(corners: Array, p: Vector) -> tuple[Vector, int]:
    """The nearest point of a triangle [3, 3], and the face, edge or corner on which it lies."""
    a, b, c = row(corners, 0), row(corners, 1), row(corners, 2)
    ab, ac, ap = subtract(b, a), subtract(c, a), subtract(p, a)
    d1, d2 = dot(ab, ap), dot(ac, ap)
    if d1 <= 0 and d2 <= 0:
        return a, AT_A
    bp = subtract(p, b)
    d3, d4 = dot(ab, bp), dot(ac, bp)
    if d3 >= 0 and d4 <= d3:
        return b, AT_B
    vc = d1 * d4 - d3 * d2
    if vc <= 0 and d1 >= 0 and d3 <= 0:
        return add_scaled(a, d1 / (d1 - d3), ab), EDGE_AB
    cp = subtract(p, c)
    d5, d6 = dot(ab, cp), dot(ac, cp)
    if d6 >= 0 and d5 <= d6:
        return c, AT_C
    vb = d5 * d2 - d1 * d6
    if vb <= 0 and d2 >= 0 and d6 <= 0:
        return add_scaled(a, d2 / (d2 - d6), ac), EDGE_CA
    va = d3 * d6 - d5 * d4
    if va <= 0 and d4 >= d3 and d5 >= d6:
        return add_scaled(b, (d4 - d3) / ((d4 - d3) + (d5 - d6)), subtract(c, b)), EDGE_BC
    inverse = 1 / (va + vb + vc)
    return add_scaled(add_scaled(a, vb * inverse, ab), vc * inverse, ac), FACE
