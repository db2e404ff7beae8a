"""Large pictures show curves through the particles of a grid."""

import math
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import trimesh
from PIL import Image

from drapery import Banner, Settings, draw, save_model
from drapery.errors import OptionError
from drapery.garments import find_garment
from drapery.mesh import Array
from drapery.packs import open_packs
from drapery.render import Scene
from drapery.scenes import still
from drapery.style import FLAG_MAPPING
from drapery.style.grids import finer_shell, grid_shell
from drapery.style.refinement import MAX_SIDE, cells_per_cell, cover_curves, finer_shape, on_curves

BANNER = Banner.parse("white creeper:lime border:black")
LARGE, SMALL = (720, 960), (360, 480)


def rolled(rows: int, columns: int, radius: float = 0.3) -> Array:
    """A grid on a cylinder, shape [rows * columns, 3]; a row is an arc of one radian."""
    down, across = np.meshgrid(np.linspace(0, 1, rows), np.linspace(0, 1, columns), indexing="ij")
    ring = [radius * np.sin(across), -down, radius * np.cos(across)]
    return np.stack(ring, axis=-1).reshape(-1, 3)


def cloth_of(scene: Scene) -> Array:
    """The vertices of the cloth in a scene: its last model."""
    return scene.models[-1].mesh.positions


@pytest.mark.parametrize(
    ("size", "shape", "times"),
    [
        ((639, 639), (31, 16), 1),
        ((640, 640), (31, 16), 3),
        ((1920, 1080), (31, 16), 5),
        ((128, 1920), (31, 16), 2),
        ((1920, 1080), (129, 65), 2),
        ((8192, 8192), (31, 16), (MAX_SIDE - 1) // 30),
        ((1920, 1080), (257, 257), 1),
    ],
)
def test_cells_grow_with_the_picture(
    size: tuple[int, int], shape: tuple[int, int], times: int
) -> None:
    assert cells_per_cell(size, shape) == times


def test_curves_go_through_the_particles_and_along_straight_lines() -> None:
    points = np.random.default_rng(1).random((2, 35, 3))
    fine = on_curves(points, (7, 5), finer_shape((7, 5), 4)).reshape(2, 25, 17, 3)
    assert np.allclose(fine[:, ::4, ::4], points.reshape(2, 7, 5, 3), atol=1e-15)
    flat = rolled(7, 5) * [0.0, 1.0, 0.0]
    curved = on_curves(flat, (7, 5), (25, 17)).reshape(25, 17, 3)
    assert np.allclose(curved[:, 3, 1], -np.linspace(0, 1, 25), atol=1e-15)


def test_curves_approach_a_circle_with_the_third_order() -> None:
    away = []
    for columns in (9, 17, 33):
        fine = on_curves(rolled(3, columns), (3, columns), finer_shape((3, columns), 4))
        inner = fine.reshape(9, -1, 3)[:, 4:-4]
        away.append(np.abs(np.hypot(inner[..., 0], inner[..., 2]) - 0.3).max())
    assert math.log2(away[0] / away[1]) > 2.9 and math.log2(away[1] / away[2]) > 2.9


def test_the_surface_is_closed_and_its_normals_are_those_of_the_cloth() -> None:
    shell, points = grid_shell(7, 9, FLAG_MAPPING), rolled(7, 9)
    normals = points * [1.0, 0.0, 1.0] / 0.3
    finer = finer_shell(shell, 5)
    assert finer is not None
    mesh = cover_curves(finer, (7, 9), points, normals, 0.02)
    solid = trimesh.Trimesh(mesh.positions, mesh.triangles).process()
    assert solid.is_watertight and solid.volume > 0
    # A row ends with a straight piece, so its last cells lie beside the cylinder.
    front = mesh.positions[: 31 * 41].reshape(31, 41, 3)[:, 5:-5]
    assert np.allclose(np.hypot(front[..., 0], front[..., 2]), 0.31, atol=3e-5)
    assert np.allclose(np.sum(mesh.normals**2, axis=-1), 1.0, atol=1e-12)


def test_cloth_with_cells_cut_out_has_no_curves() -> None:
    whole = grid_shell(3, 3)
    cut = type(whole)(whole.count, whole.sheet, whole.rim, whole.uvs, whole.sheet_uvs)
    assert finer_shell(cut, 2) is None and finer_shell(whole, 1) is None
    with pytest.raises(OptionError, match="cells cut out"):
        cover_curves(cut, (3, 3), rolled(3, 3), rolled(3, 3), 0.1)


@pytest.mark.parametrize("kind", ["banner", pytest.param("cape", marks=pytest.mark.slow)])
def test_all_sizes_show_the_same_cloth(kind: str, tmp_path: Path) -> None:
    design = BANNER if kind == "banner" else None
    settings = Settings(kind=kind, wind=9.0)
    if kind == "cape":
        Image.new("RGB", (64, 32), "red").save(tmp_path / "cape.png")
        settings = replace(settings, texture=tmp_path / "cape.png")
    scenes = [
        still(design, open_packs(()), replace(settings, size=size)) for size in (SMALL, LARGE)
    ]
    assert scenes[0].camera == scenes[1].camera
    coarse, fine = map(cloth_of, scenes)
    shape = finer_shape((31, 16), cells_per_cell(LARGE, (31, 16)))
    times = (shape[0] - 1) // 30
    front = fine[: shape[0] * shape[1]].reshape(*shape, 3)[::times, ::times]
    assert np.allclose(front, coarse[: 31 * 16].reshape(31, 16, 3), atol=1e-12)


def test_the_outline_lies_within_half_a_pixel_of_the_curve() -> None:
    size = (1920, 1080)
    scene = still(BANNER, open_packs(()), Settings(size=size, wind=25.0, fabric="silk"))
    times = cells_per_cell(size, (31, 16))
    rows, columns = finer_shape((31, 16), times)
    front = cloth_of(scene)[: rows * columns].reshape(rows, columns, 3)
    exact = on_curves(front.reshape(-1, 3), (rows, columns), finer_shape((rows, columns), 2))
    hem = exact.reshape(2 * rows - 1, 2 * columns - 1, 3)
    for line in (hem[-1], hem[:, 0], hem[:, -1]):
        chord = (line[:-2:2] + line[2::2]) / 2
        away = np.sqrt(((line[1::2] - chord) ** 2).sum(axis=-1))
        assert away.max() < 0.5 * scene.camera.height / size[1]


def test_shape_steps_and_files_have_the_simulated_grid(tmp_path: Path) -> None:
    packs = open_packs(())
    shaped = still(BANNER, packs, Settings(size=LARGE, style="low-poly"))
    same = still(BANNER, packs, Settings(size=SMALL, style="low-poly"))
    assert np.array_equal(cloth_of(shaped), cloth_of(same))
    save_model(BANNER, tmp_path / "banner.glb", seconds=0)
    scene = trimesh.load(tmp_path / "banner.glb")
    assert sum(len(each.faces) for each in scene.geometry.values()) < 4000


def test_garments_show_curves_and_keep_their_camera() -> None:
    cape = find_garment("cape")
    large, small = (still(cape, open_packs(()), Settings(size=size)) for size in (LARGE, SMALL))
    assert len(cloth_of(large)) > 2 * len(cloth_of(small))
    assert large.camera.height == pytest.approx(small.camera.height, rel=0.01)
    first, second = (draw(cape, size=LARGE, seed=3).pixels for _ in range(2))
    assert np.array_equal(first, second)
