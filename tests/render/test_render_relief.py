"""Normal maps bend the light as their slope says, wherever the surface looks."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from conftest import Run
from pack_maker import CREEPER, META, folder_pack, mcmeta, plain, png
from PIL import Image
from relief_shapes import LEVEL, WHITE, board, scene_of, slope

from drapery.mesh import Mesh
from drapery.render.light import GAME_LIGHT, Light
from drapery.render.relief import bake_normal_maps
from drapery.render.scene import Material, Model, TextureLayer
from drapery.render.soft import draw_scene
from drapery.style.block import turn


def brightness(mesh: Mesh, normal: np.ndarray, light: Light = GAME_LIGHT) -> float:
    """What the map makes of white: one shade all over, as a factor."""
    (model,) = bake_normal_maps(
        scene_of(mesh, TextureLayer(WHITE, normal=normal), light=light)
    ).models
    (shade,) = np.unique(model.materials[0].layers[0].texels[..., :3])
    return float(shade) / 255


def test_a_level_map_changes_nothing() -> None:
    texels = np.random.default_rng(1).integers(0, 256, (4, 4, 4), np.uint8)
    for degrees in (0, 40, 70):
        plain_scene = scene_of(turn(board(), degrees), TextureLayer(texels, (200, 90, 30)))
        mapped = scene_of(turn(board(), degrees), TextureLayer(texels, (200, 90, 30), normal=LEVEL))
        a, b = draw_scene(plain_scene).pixels, draw_scene(mapped).pixels
        assert np.abs(a.astype(int) - b).max() <= 1


def test_a_scene_without_maps_is_left_as_it_is() -> None:
    scene = scene_of(board(), TextureLayer(WHITE))
    assert bake_normal_maps(scene) is scene


@pytest.mark.parametrize("right, down", [(0, -0.6), (0, 0.6), (0.6, 0), (-0.6, 0), (0.3, -0.5)])
def test_light_falls_on_the_slope_that_the_map_says(right: float, down: float) -> None:
    lights = GAME_LIGHT, Light(((1.0, 0.3, 0.2),), 0.1, 0.8)
    for light in lights:
        for degrees in (0, 55, 200):
            mesh = turn(board(), degrees)
            level = np.sqrt(1 - right**2 - down**2)
            upright = Mesh(board().positions[:1], np.array([[right, -down, level]]), None, None)
            expected = light.brightness(turn(upright, degrees).normals)[0]
            assert brightness(mesh, slope(right, down), light) == pytest.approx(expected, abs=0.01)
            # Mirrored on the surface, the sheet's right is the surface's left.
            turned = turn(board(mirrored=True), degrees)
            assert brightness(turned, slope(-right, down), light) == pytest.approx(
                expected, abs=0.01
            )


def test_what_is_closed_gets_no_ambient_light() -> None:
    light = Light(((0.0, 0.0, 1.0),), 0.3, 0.5)
    assert brightness(board(), slope(0, 0, 255), light) == pytest.approx(0.8, abs=0.005)
    assert brightness(board(), slope(0, 0, 0), light) == pytest.approx(0.5, abs=0.005)


def test_the_upper_layers_relief_covers_the_lower_by_its_alpha() -> None:
    half = WHITE.copy()
    half[:, :2, 3] = 0
    lower, upper = (
        TextureLayer(WHITE, normal=slope(0, -0.6)),
        TextureLayer(half, normal=slope(0, 0.6)),
    )
    (model,) = bake_normal_maps(scene_of(board(), lower, upper)).models
    shades = model.materials[0].layers[0].texels[..., 0]
    top, foot = (brightness(board(), slope(0, y)) for y in (-0.6, 0.6))
    assert (shades[:, :2] == round(top * 255)).all() and (shades[:, 2:] == round(foot * 255)).all()
    # A layer without a map paints over the relief and leaves it as it is.
    (model,) = bake_normal_maps(scene_of(board(), lower, TextureLayer(half, (255, 0, 0)))).models
    texels = model.materials[0].layers[0].texels
    assert (texels[..., 0] == round(top * 255)).all() and (texels[:, 2:, 1:3] == 0).all()


def test_every_member_of_a_batch_is_lit_by_itself() -> None:
    meshes = [turn(board(), degrees) for degrees in (0, 20, 50)]
    material = Material((TextureLayer(WHITE, normal=slope(0.5, -0.3)),))
    batch = replace(
        meshes[0],
        positions=np.stack([mesh.positions for mesh in meshes]),
        normals=np.stack([mesh.normals for mesh in meshes]),
    )
    scene = replace(scene_of(board(), TextureLayer(WHITE)), models=(Model(batch, (material,)),))
    (model,) = bake_normal_maps(scene).models
    assert model.material_index is not None and model.material_index.tolist() == [0, 1, 2]
    for member, worn in zip(meshes, model.materials, strict=True):
        assert worn.layers[0].texels[0, 0, 0] == round(brightness(member, slope(0.5, -0.3)) * 255)


def test_maps_of_other_sizes_are_sampled_to_the_nearest() -> None:
    fine = np.kron(LEVEL[:2, :2], np.ones((8, 8, 1), np.uint8))
    fine[:, 8:] = slope(0, -0.6)[0, 0]
    (model,) = bake_normal_maps(scene_of(board(), TextureLayer(WHITE, normal=fine))).models
    texels = model.materials[0].layers[0].texels
    assert texels.shape == (16, 16, 4)
    assert len(np.unique(texels[:, :8])) == 2 and (texels[0, 8] > texels[0, 7]).any()


def test_pbr_lights_a_banner_by_its_packs_maps(drapery: Run, tmp_path: Path) -> None:
    files = {META: mcmeta(46), CREEPER: plain(255, 255, 255, 255)}
    for name, normal in (("level", LEVEL), ("steep", slope(0, 0.9))):
        mapped = files | {CREEPER.replace(".png", "_n.png"): png(np.tile(normal, (16, 16, 1)))}
        folder_pack(tmp_path / name, mapped)
    words = ("white creeper:white", "--size", "60x80", "--pose", "vanilla", "-o")
    means = {}
    for pack in ("level", "steep"):
        for pbr in ((), ("--pbr",)):
            target = tmp_path / f"{pack}{len(pbr)}.png"
            assert drapery("render", *words, target, "--pack", tmp_path / pack, *pbr)[0] == 0
            means[pack, bool(pbr)] = np.asarray(Image.open(target))[20:60, 20:40, :3].mean()
    assert means["level", False] == means["steep", False]
    assert means["level", True] == pytest.approx(means["level", False], abs=1)
    assert means["steep", True] < means["level", True] - 30
    code, _, err = drapery("render", *words, tmp_path / "x.gif.png", "--pbr", "--layers", "flat")
    assert code == 2 and "use layers stacked" in err and len(err.splitlines()) == 1
