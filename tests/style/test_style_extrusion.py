"""Thickness: the shell is closed, keeps its volume, and is textured as the game's box."""

import numpy as np
import pytest
from hypothesis import given, strategies as st

from drapery.mesh import Mesh, face_normals, vertex_normals
from drapery.style.block import (
    FLAG_MAPPING,
    FLAG_SIZE,
    SCALE,
    flag_origin,
    stiff_flag,
    sway_angle,
    turn,
    wood,
)
from drapery.style.extrusion import boundary_edges, extrude


def sheet(columns: int, rows: int, bend: float = 0.0) -> Mesh:
    u, v = np.meshgrid(np.linspace(0, 1, columns), np.linspace(0, 1, rows))
    positions = np.stack([u, -v, bend * np.sin(3 * u) * v], -1).reshape(-1, 3)
    i = np.arange((rows - 1) * columns).reshape(rows - 1, columns)[:, :-1].reshape(-1, 1)
    corners = np.concatenate([i, i + columns, i + 1, i + 1, i + columns, i + columns + 1], axis=1)
    triangles = corners.reshape(-1, 3).astype(np.int32)
    uvs = np.stack([u, v], -1).reshape(-1, 2)
    return Mesh(positions, vertex_normals(positions, triangles), triangles, uvs)


def volume(mesh: Mesh) -> float:
    a, b, c = (mesh.positions[mesh.triangles[:, k]] for k in range(3))
    return float(np.einsum("ij,ij->", a, np.cross(b, c)) / 6)


@given(st.integers(2, 6), st.integers(2, 6), st.floats(0.0, 0.3))
def test_the_shell_is_closed_and_faces_outwards(columns: int, rows: int, bend: float) -> None:
    thin = sheet(columns, rows, bend)
    thick = extrude(thin, 0.05)
    # The rim repeats vertices of the sheets: merge equal places before the search for open edges.
    _, weld = np.unique(thick.positions.round(9), axis=0, return_inverse=True)
    assert len(boundary_edges(weld.reshape(-1)[thick.triangles].astype(np.int32))) == 0
    # Averaged normals shorten the distance of the sheets only by the cosine of half a bend.
    area = np.linalg.norm(face_normals(thin.positions, thin.triangles), axis=-1).sum() / 2
    assert volume(thick) == pytest.approx(0.05 * area, rel=0.02 if bend == 0 else 0.15)


def test_a_flat_sheet_becomes_a_board_of_exact_volume() -> None:
    assert volume(extrude(sheet(4, 5), 0.25)) == pytest.approx(0.25, rel=1e-12)


def test_a_batch_is_its_members_one_by_one() -> None:
    sheets = [sheet(4, 5, bend) for bend in (0.0, 0.1, 0.3)]
    batch = Mesh(
        np.stack([s.positions for s in sheets]),
        np.stack([s.normals for s in sheets]),
        sheets[0].triangles,
        sheets[0].uvs,
    )
    thick = extrude(batch, 0.1, FLAG_MAPPING)
    for member, alone in enumerate(extrude(s, 0.1, FLAG_MAPPING) for s in sheets):
        assert np.array_equal(thick.positions[member], alone.positions)
        assert np.array_equal(thick.normals[member], alone.normals)


def test_every_part_of_the_flag_samples_its_own_region() -> None:
    thick = extrude(sheet(5, 9), 0.04, FLAG_MAPPING)
    texels = thick.uvs * 64
    front, back, rim = texels[:45], texels[45:90], texels[90:].reshape(-1, 4, 2)
    assert front.min(0).tolist() == [1, 1] and front.max(0).tolist() == [21, 41]
    assert back.min(0).tolist() == [22, 1] and back.max(0).tolist() == [42, 41]
    # The left column of the back, seen from behind, is at the right of the cloth.
    assert np.allclose(back[:5, 0], [42, 37, 32, 27, 22])
    boxes = {tuple(e.reshape(-1, 2).min(0)) + tuple(e.reshape(-1, 2).max(0)) for e in rim}
    lefts = [b for b in boxes if b[0] == 0 and b[2] == 1 and b[1] >= 1]
    rights = [b for b in boxes if b[0] == 21 and b[2] == 22]
    tops = [b for b in boxes if b[1] == 0 and b[2] <= 21]
    bottoms = [b for b in boxes if b[1] == 0 and b[0] >= 21]
    assert (len(lefts), len(rights), len(tops), len(bottoms)) == (8, 8, 4, 4)


def test_texels_continue_around_the_corners() -> None:
    """At the border of the front the rim's front corners have the front's own UVs."""
    thin = sheet(5, 9)
    thick = extrude(thin, 0.04, FLAG_MAPPING)
    edges = boundary_edges(thin.triangles)
    rim = thick.uvs[90:].reshape(-1, 4, 2) * 64
    for (start, end), corners in zip(edges, rim, strict=True):
        if thin.uvs[[start, end], 1].max() == 1 and thin.uvs[[start, end], 1].min() == 1:
            continue  # the bottom strip lies apart, beside the top strip
        assert np.allclose(corners[:2], thick.uvs[[start, end]] * 64)


def test_the_standing_flag_is_where_the_game_draws_it() -> None:
    """A standing flag spans y = 0.167 .. 1.833 blocks, its middle in front of the pole."""
    flag = stiff_flag("standing", 0.25)
    upright = np.cos(sway_angle(0.25))
    assert flag.positions[:, 1].max() == pytest.approx(1.8333, abs=4e-3)
    assert flag.positions[:, 1].min() == pytest.approx(1.8333 - 1.6667 * upright, abs=4e-3)
    assert FLAG_SIZE == (20 * SCALE, 40 * SCALE)
    assert flag_origin("standing") == pytest.approx([0.5, 11 / 6, 0.5 + 1.5 * SCALE])


def test_the_sway_leans_forwards_and_repeats() -> None:
    angles = [sway_angle(p) for p in np.linspace(0, 1, 9)]
    assert max(angles) == pytest.approx(-0.0025 * np.pi)
    assert min(angles) == pytest.approx(-0.0225 * np.pi)
    assert angles[0] == pytest.approx(angles[-1])
    low = stiff_flag("standing", 0.5).positions
    assert low[low[:, 1].argmin(), 2] > flag_origin("standing")[2]


def test_wood_is_closed_and_stands_on_the_ground() -> None:
    pole_and_bar = wood("standing")
    assert pole_and_bar.positions[:, 1].min() == 0
    assert pole_and_bar.positions[:, 1].max() == pytest.approx(44 * SCALE)
    assert volume(pole_and_bar) == pytest.approx((2 * 42 * 2 + 20 * 2 * 2) * SCALE**3)
    assert wood("wall").positions[:, 2].min() == pytest.approx(0.5 - 11.5 * SCALE)


def test_normals_of_the_wood_agree_with_its_triangles() -> None:
    mesh = wood("standing")
    faces = face_normals(mesh.positions, mesh.triangles)
    unit = faces / np.linalg.norm(faces, axis=-1, keepdims=True)
    assert np.allclose(unit, mesh.normals[mesh.triangles[:, 0]])


def test_a_quarter_turn_faces_west() -> None:
    """The game turns by -angle about y: a rotation of 90 degrees takes south (+z) to west (-x)."""
    south = Mesh(
        np.array([[0.5, 0, 1.0]]),
        np.array([[0, 0, 1.0]]),
        np.zeros((0, 3), np.int32),
        np.zeros((1, 2)),
    )
    west = turn(south, 90)
    assert np.allclose(west.normals, [[-1, 0, 0]])
    assert np.allclose(west.positions, [[0, 0, 0.5]])
