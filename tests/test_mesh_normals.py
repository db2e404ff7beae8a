"""Vertex normals: the average of the faces around, whatever the batch."""

import numpy as np
import pytest

from drapery.cloth import grid
from drapery.mesh import face_normals, vertex_normals


@pytest.mark.parametrize("dtype", [np.float32, np.float64])
def test_vertex_normals_are_the_faces_added_one_after_another(dtype) -> None:
    cloth = grid(4, 5, 1.0, 1.0)
    crumpled = cloth.rest_positions + np.random.default_rng(0).normal(0, 0.1, (3, 20, 3))
    crumpled = crumpled.astype(dtype)
    faces = face_normals(crumpled, cloth.triangles)
    sums = np.zeros_like(crumpled)
    for corner in range(3):
        for number, triangle in enumerate(cloth.triangles):
            sums[:, triangle[corner]] += faces[:, number]
    lengths = np.linalg.norm(sums, axis=-1, keepdims=True)
    normals = vertex_normals(crumpled, cloth.triangles)
    assert normals.dtype == dtype
    np.testing.assert_allclose(normals, sums / lengths, atol=1e-6)


def test_a_batch_equals_its_meshes_one_by_one() -> None:
    cloth = grid(3, 3, 1.0, 1.0)
    crumpled = cloth.rest_positions + np.random.default_rng(1).normal(0, 0.1, (2, 2, 9, 3))
    whole = vertex_normals(crumpled, cloth.triangles)
    for place in np.ndindex(2, 2):
        assert np.array_equal(whole[place], vertex_normals(crumpled[place], cloth.triangles))


def test_a_vertex_without_area_looks_to_the_front() -> None:
    positions = np.zeros((4, 3))
    positions[1:3] = np.eye(3)[:2]
    normals = vertex_normals(positions, np.array([[0, 1, 2]], np.int32))
    assert normals.tolist() == [[0, 0, 1]] * 4
    alone = vertex_normals(positions, np.zeros((0, 3), np.int32))
    assert alone.tolist() == [[0, 0, 1]] * 4
