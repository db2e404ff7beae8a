"""Surroundings and figures of scenes: only visible faces, closed bodies, feet on the ground."""

import numpy as np
import pytest

from assets.drawing.creatures import FILES, creatures
from assets.drawing.fox import fox
from drapery.banner.packs import open_packs
from drapery.garments import GarmentMesh
from drapery.garments.meshes import read_stiff_mesh
from drapery.style.block_world import blocks, plateau
from drapery.style.figure import PARTS, figure_material, figure_mesh
from drapery.style.scenery import path_ground, pole, post, sea, shadow
from drapery.style.tailoring import checked, dyed

PACKS = open_packs(())


def faces(models) -> int:
    return sum(len(model.mesh.triangles) for model in models) // 2


@pytest.mark.parametrize(
    ("cells", "seen"),
    [
        ({(0, 0, 0): "stone"}, 6),
        ({(0, 0, 0): "stone", (1, 0, 0): "dirt"}, 10),
        (plateau(3, 3, "stone"), 2 * 9 + 4 * 3),
        ({(x, y, z): "sand" for x in range(3) for y in range(3) for z in range(3)}, 54),
    ],
)
def test_only_faces_next_to_air_are_drawn(cells, seen) -> None:
    assert faces(blocks(cells, PACKS)) == seen


def test_faces_look_outwards_and_lie_on_their_block() -> None:
    for model in blocks({(2, 3, 4): "grass"}, PACKS):
        corners = model.mesh.positions[model.mesh.triangles]
        turned = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        normals = model.mesh.normals[model.mesh.triangles[:, 0]]
        np.testing.assert_allclose(turned, normals)
        away = corners.mean(axis=1) - np.array([2.5, 3.5, 4.5])
        assert (np.sum(away * normals, axis=1) > 0.4).all()


def test_grass_is_green_above_and_earth_below_and_a_dye_is_wool() -> None:
    top, side, bottom = (
        PACKS.texture(f"block/{n}") for n in ("grass_block_top", "grass_block_side", "dirt")
    )
    drawn = {
        float(model.mesh.normals[0, 1]): model.materials[0].layers[0].texels
        for model in blocks({(0, 0, 0): "grass"}, PACKS)
    }
    assert drawn[1] is top and drawn[0] is side and drawn[-1] is bottom
    (wool,) = blocks({(0, 0, 0): "red"}, PACKS)
    assert wool.materials[0].layers[0].tint == (176, 46, 38)


def test_a_path_repeats() -> None:
    for model in path_ground(10, 10, PACKS):
        places, z = model.mesh.positions, model.mesh.positions[:, 2]
        ahead = places[(z > 0.5) & (z < 9.5)]
        behind = places[(z > -9.5) & (z < -0.5)] + np.array([0, 0, 10])
        assert set(map(tuple, ahead)) == set(map(tuple, behind))


def test_the_figure_is_as_tall_as_the_games_players_and_stands_on_the_ground() -> None:
    mesh = figure_mesh({})
    assert mesh.positions[:, 1].min() == 0 and mesh.positions[:, 1].max() == 1.875
    assert len(mesh.triangles) == 12 * len(PARTS)
    for skin in ("traveller", "dancer", "cape"):
        assert figure_material(skin, PACKS).layers[0].texels.shape == (64, 64, 4)


def test_every_texel_of_a_figure_is_painted() -> None:
    mesh, sheet = figure_mesh({}), figure_material("traveller", PACKS).layers[0].texels
    for a, b, c in mesh.uvs[mesh.triangles]:
        u, v = (a + b + c) / 3 * 64
        assert sheet[int(v), int(u), 3] == 255


@pytest.mark.parametrize(("name", "bodies"), [("beetle", 1 + 2 + 6 + 2 + 2), ("fox", 1)])
def test_the_file_of_a_creature_is_as_drawn_and_made_of_closed_bodies(name, bodies) -> None:
    drawn = np.concatenate([model.mesh.positions for model in creatures()[name]])
    found = read_stiff_mesh(GarmentMesh(file=f"{name}.glb"), FILES, 1 / 16)
    points = np.concatenate([model.mesh.positions for model in found.models])
    apart = np.abs(np.unique(drawn, axis=0)[:, None] - np.unique(points, axis=0)).max(axis=2)
    assert max(apart.min(axis=0).max(), apart.min(axis=1).max()) < 1e-6, (
        "run python -m assets.drawing.creatures"
    )
    # The halves of a leg meet in its knee.
    assert found.surface.solid.all() and len(found.surface.solid) == bodies
    assert 0 <= points[:, 1].min() < 0.05
    for model in found.models:
        corners = model.mesh.positions[model.mesh.triangles]
        turned = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        assert (np.sum(turned * model.mesh.normals[model.mesh.triangles[:, 0]], axis=1) > 0).all()


def test_the_fox_holds_together() -> None:
    cells = set(fox())
    found, edge = set(), [next(iter(cells))]
    while edge:
        cell = edge.pop()
        if cell in cells and cell not in found:
            found.add(cell)
            edge += [
                tuple(np.add(cell, s * axis)) for axis in np.eye(3, dtype=int) for s in (1, -1)
            ]
    assert found == cells
    assert min(y for _, y, _ in cells) == 0
    assert {(-x, y, z) for x, y, z in cells} == cells


def test_posts_stand_and_poles_lie() -> None:
    standing = post(np.array([1.0, 2, 3]), 4.0, PACKS, 0.1).mesh.positions
    np.testing.assert_allclose([standing.min(0), standing.max(0)], [[0.9, 2, 2.9], [1.1, 6, 3.1]])
    start = np.array([1.0, 2, 3])
    lying = pole(start, start + np.array([4.0, 0, 0]), PACKS).mesh.positions
    np.testing.assert_allclose([lying.min(0), lying.max(0)], [[1, 1.94, 2.94], [5, 2.06, 3.06]])


def test_water_is_level_and_shadows_fade() -> None:
    assert set(sea(3, -0.5).mesh.positions[:, 1]) == {-0.5}
    assert faces([sea(3, 0.0)]) == 36
    alpha = shadow((0, 0), 1.0).materials[0].layers[0].texels[..., 3]
    assert alpha[0, 0] == 0 and alpha[8, 8] == alpha.max() > 60
    assert len(np.unique(alpha)) <= 5


def test_checks_are_of_two_dyes() -> None:
    wool = PACKS.texture("block/white_wool")
    board = checked(wool, ("lime", "white"), 2).layers[0].texels
    assert board.shape == (32, 32, 4)
    assert np.array_equal(board[:16, :16], board[16:, 16:])
    assert not np.array_equal(board[:16, :16], board[:16, 16:])
    assert dyed(wool, "lime").layers[0].tint == (128, 199, 31)
