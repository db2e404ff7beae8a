"""The finish of fabrics: what it changes, what it leaves, and that it fades before it flickers."""

from dataclasses import replace
from itertools import combinations, pairwise
from typing import Any

import numpy as np
import pytest

from drapery import Banner, Settings, draw
from drapery.cloth import FABRICS, Fabric
from drapery.errors import OptionError
from drapery.mesh import Mesh, make_mesh
from drapery.packs import open_packs
from drapery.render import Camera, Material, Model, Scene, SurfaceDetail, TextureLayer
from drapery.render.drawlist import make_topology
from drapery.render.light import STUDIO_LIGHT, UNLIT, Light
from drapery.render.soft import draw_scene
from drapery.scenes import still
from drapery.stage.bodies import with_finish
from drapery.style.finish import FINISHES
from drapery.style.uv_mapping import SHEET_MAPPING

CREEPER = Banner.parse("white creeper:lime border:black")
HERO: dict[str, Any] = {"view": "hero", "size": (96, 128), "time": 0.5, "grid": (8, 15)}
GREY = np.full((1, 1, 4), (150, 150, 150, 255), np.uint8)
METRE = 1.0
SAMPLES = (1, 4, 16)
LIGHT = Light(STUDIO_LIGHT.directions, STUDIO_LIGHT.ambient, STUDIO_LIGHT.diffuse)


def wavy(columns: int = 13, rows: int = 13) -> Mesh:
    """A sheet of 1 m, one fold of it towards the viewer."""
    v, u = np.meshgrid(np.linspace(0, 1, rows), np.linspace(0, 1, columns), indexing="ij")
    places = np.stack([u - 0.5, 0.5 - v, 0.1 * u * (1 - u)], axis=-1).reshape(-1, 3)
    first = (np.arange(rows - 1)[:, None] * columns + np.arange(columns - 1)).reshape(-1, 1)
    cells = first + np.array([[0, columns, 1, 1, columns, columns + 1]])
    uvs = np.stack([u, v], axis=-1).reshape(-1, 2)
    mesh = make_mesh(places, cells.reshape(-1, 3).astype(np.int32))
    return replace(mesh, uvs=uvs)


def sheet(
    name: str | None, side: int, *, aside: float = 0.0, light: Light = LIGHT, samples: Any = 1
) -> Scene:
    """The sheet of a fabric, None for plain, which fills a picture with sides of so many pixels."""
    material = Material((TextureLayer(GREY),))
    if name is not None:
        material = with_finish(material, name, SHEET_MAPPING, (METRE, METRE))
    camera = Camera((aside, 0.0, 2.0), (aside, 0.0, 0.0), height=0.9)
    model = Model(wavy(), (material,))
    return Scene((model,), camera, (side, side), light, samples=samples)


def brightness(scene: Scene) -> np.ndarray[Any, np.dtype[np.float64]]:
    return draw_scene(scene).pixels[..., :3].astype(float).mean(axis=-1)


def texture_of(name: str, side: int) -> np.ndarray[Any, np.dtype[np.float64]]:
    """What a finish adds to a plain sheet [levels]."""
    return brightness(sheet(name, side)) - brightness(sheet(None, side))


def test_every_fabric_has_a_finish() -> None:
    assert list(FINISHES) == list(FABRICS)


def test_a_plain_finish_leaves_materials_as_they_are() -> None:
    """What it draws is what was drawn before there were finishes; see `test_same_pictures`."""
    for finish, has_detail in (("plain", False), ("fabric", True)):
        scene = still(CREEPER, open_packs(), Settings(finish=finish, fabric="silk", **HERO))
        materials = [material for model in scene.models for material in model.materials]
        assert any(material.detail is not None for material in materials) == has_detail
        assert any(material.transmission for material in materials) == has_detail


def test_pictures_of_a_design_share_the_tables_of_their_finish() -> None:
    settings = Settings(finish="fabric", fabric="silk", **HERO)
    scenes = [still(CREEPER, open_packs(), replace(settings, seed=seed)) for seed in (1, 2)]
    one, other = (make_topology(scene.models).material_tables for scene in scenes)
    assert one is other


def test_fabrics_can_be_told_apart_by_their_finish_alone() -> None:
    looks = {name: texture_of(name, 256) for name in FINISHES}
    for one, other in combinations(looks, 2):
        difference = looks[one] - looks[other]
        assert np.sqrt((difference * difference).mean()) > 4, (one, other)


def test_the_ribs_of_the_default_fabric_are_quieter_than_the_weave_of_coarse_ones() -> None:
    contrast = {name: texture_of(name, 512).std() for name in FINISHES}
    assert contrast["wool"] < min(contrast[each] for each in ("linen", "canvas", "leather", "felt"))


@pytest.mark.parametrize("name", FINISHES)
def test_an_edge_is_two_texels_of_a_flag_wide_and_like_no_other(name: str) -> None:
    """The sheet of 1 m fills 512 pixels: the edge is 43 of them wide."""
    changed = {each: np.abs(edge_of(each, 512)) for each in FINISHES}
    assert changed[name][60:-60, 60:-60].max() == 0
    for band in (changed[name][:28], changed[name][-28:], changed[name][:, :28]):
        assert band.mean() > 1
    for other in set(FINISHES) - {name}:
        assert np.abs(changed[name] - changed[other])[:28].mean() > 1


def edge_of(name: str, side: int) -> np.ndarray[Any, np.dtype[np.float64]]:
    """What the strips of a finish add [levels]."""
    camera = Camera((0.0, 0.0, 2.0), (0.0, 0.0, 0.0), height=1.0)
    scene = replace(sheet(name, side), camera=camera)
    (model,) = scene.models
    (material,) = model.materials
    assert material.detail is not None
    bare = replace(material, detail=replace(material.detail, strips=None))
    return brightness(scene) - brightness(replace(scene, models=(Model(model.mesh, (bare,)),)))


def edged(edges: tuple[tuple[float, float, float, float], ...], right: int) -> Scene:
    """The sheet in a light from the right; the strips of its upright sides lean inwards."""
    strips = np.full((2, 256, 32, 4), (128, 128, 128, 255), np.uint8)
    strips[0, :, :, 0] = right
    tile = np.full((4, 4, 4), (128, 128, 128, 255), np.uint8)
    detail = SurfaceDetail(tile, (96.0, 96.0), strips=strips, edges=edges)
    material = Material((TextureLayer(GREY),), detail=detail)
    flat = replace(wavy(), positions=wavy().positions * [1.0, 1.0, 0.0])
    flat = replace(make_mesh(flat.positions, flat.triangles), uvs=flat.uvs)
    camera, light = (
        Camera((0.0, 0.0, 2.0), (0.0, 0.0, 0.0), height=1.0),
        Light(((1, 0, 1),), 0.3, 0.6),
    )
    return Scene((Model(flat, (material,)),), camera, (96, 96), light)


def test_slopes_of_a_strip_lean_inwards_on_both_sides() -> None:
    row = brightness(edged(((0.0, 0.0, 1.0, 1.0),), 160))[48]
    assert row[4] > row[48] + 5 and row[-5] < row[48] - 5
    assert np.ptp(row[16:-16]) == 0


def test_each_part_of_a_texture_has_edges_of_its_own() -> None:
    row = brightness(edged(((0.0, 0.0, 0.5, 1.0), (0.5, 0.0, 1.0, 1.0)), 160))[48]
    assert row[44] < row[24] - 5 and row[52] > row[72] + 5
    assert row[4] > row[24] + 5 and row[-5] < row[72] - 5


@pytest.mark.parametrize(
    ("strips", "edges", "words"),
    [
        (np.zeros((2, 256, 16, 4), np.uint8), 1, "the strips of a detail have shape"),
        (np.zeros((2, 256, 32, 4)), 1, "type float64"),
        (np.zeros((2, 256, 32, 4), np.uint8), 0, "has 0 edges; use one or two"),
    ],
)
def test_strips_that_cannot_be_laid_are_refused(strips: Any, edges: int, words: str) -> None:
    scene = edged(((0.0, 0.0, 1.0, 1.0),) * edges, 128)
    (model,) = scene.models
    (material,) = model.materials
    assert material.detail is not None
    wrong = replace(material, detail=replace(material.detail, strips=strips))
    with pytest.raises(OptionError, match=words):
        draw_scene(replace(scene, models=(Model(model.mesh, (wrong,)),)))


@pytest.mark.parametrize("name", FINISHES)
def test_a_weave_fades_where_it_is_finer_than_a_pixel(name: str) -> None:
    fine, coarse = (texture_of(name, side).std() for side in (512, 48))
    assert coarse < 0.5 * fine or coarse < 2.5


@pytest.mark.parametrize("name", FINISHES)
def test_small_pictures_do_not_flicker(name: str) -> None:
    """While a sheet moves by parts of a pixel, squares of 8 x 8 pixels stay as bright: no pattern
    of threads and pixels runs over it."""
    side = 96
    pictures = [brightness(sheet(name, side, aside=k * 0.2 * 0.9 / side)) for k in range(5)]
    means = [each.reshape(12, 8, 12, 8).mean(axis=(1, 3)) for each in pictures]
    steps = [np.abs(after - before).mean() for before, after in pairwise(means)]
    assert max(steps) < 0.5


@pytest.mark.parametrize("name", FINISHES)
def test_a_finish_keeps_the_dye(name: str) -> None:
    """Gloss may make a dye lighter, but the mean stays near."""
    assert -6 < texture_of(name, 128).mean() < 30


@pytest.mark.parametrize("samples", SAMPLES)
def test_one_and_two_threads_draw_the_same_bits(samples: Any) -> None:
    scene = sheet("leather", 200, samples=samples)
    one, two = (draw_scene(scene, threads=threads).pixels for threads in (1, 2))
    assert np.array_equal(one, two)


def test_gloss_of_translucent_cloth_stays_on_it_and_is_smooth() -> None:
    """Tiles have 64 samples a side: what is left of one row may not show in the next tile."""
    tile = np.full((4, 4, 4), (128, 128, 128, 255), np.uint8)
    shiny = SurfaceDetail(tile, (4.0, 4.0), gloss=1.0, sharpness=0)
    glass = Material((TextureLayer(np.full((1, 1, 4), (200, 40, 40, 120), np.uint8)),), "blend")
    square = np.array([[-1.0, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]])
    halves = np.array([[0, 1, 2], [0, 2, 3]], np.int32)
    back = Model(make_mesh(square, halves), (Material((TextureLayer(GREY),)),))
    uvs = np.array([[0.0, 1], [1, 1], [1, 0], [0, 0]])
    over = replace(make_mesh(square * [0.5, 1, 1] + [-0.5, 0, 0.1], halves), uvs=uvs)
    camera = Camera((0, 0, 5), (0, 0, 0), height=2.0)
    drawn = [
        draw_scene(Scene((back, Model(over, (each,))), camera, (256, 256), LIGHT)).pixels
        for each in (glass, replace(glass, detail=shiny))
    ]
    plain, glossy = (np.int16(each) for each in drawn)
    assert np.array_equal(plain[:, 128:], glossy[:, 128:])
    assert (glossy[:, :128, :3] > plain[:, :128, :3] + 5).all()
    assert len(np.unique(glossy[:, :128].reshape(-1, 4), axis=0)) == 1


def test_triangles_beyond_the_camera_change_no_others() -> None:
    """Some triangles are clipped: the others keep how they lean, and so do new corners."""
    scene = sheet("silk", 128)
    behind = np.array([[9.0, 0.0, 1.5], [9.1, 0.0, 3.0], [9.0, 0.1, 3.0]])
    more = Model(make_mesh(behind, np.array([[0, 1, 2]], np.int32)), scene.models[0].materials)
    both = replace(scene, models=(*scene.models, more))
    assert np.array_equal(draw_scene(both).pixels, draw_scene(scene).pixels)
    shadows = replace(both, light=STUDIO_LIGHT)
    assert draw_scene(shadows).pixels[..., 3].all()


def test_a_clipped_triangle_shows_the_same_surface() -> None:
    """A near plane that cuts the sheet leaves what lies beyond it as it was."""
    scene = sheet("canvas", 96)
    camera = replace(scene.camera, near=1.99, far=3.0)
    whole, cut = (draw_scene(replace(scene, camera=one)).pixels for one in (scene.camera, camera))
    shown = (cut[..., 3] > 0) & (np.abs(whole.astype(int) - cut).max(axis=-1) < 200)
    assert 0.05 < shown.mean() < 0.95
    assert np.abs(whole[shown].astype(int) - cut[shown]).max() <= 2


def test_flat_light_shows_the_plain_colours() -> None:
    flat = sheet("silk", 64, light=UNLIT)
    assert np.array_equal(draw_scene(flat).pixels, draw_scene(sheet(None, 64, light=UNLIT)).pixels)


@pytest.mark.parametrize(
    ("options", "finish"),
    [
        ({}, "plain"),
        ({"view": "hero"}, "fabric"),
        ({"light": "studio"}, "fabric"),
        ({"view": "hero", "light": "game"}, "plain"),
        ({"view": "hero", "style": "felt"}, "plain"),
        ({"view": "hero", "pbr": True}, "plain"),
        ({"view": "hero", "pose": "vanilla"}, "plain"),
        ({"view": "hero", "backend": "pyrender"}, "plain"),
        ({"view": "hero", "style": "felt", "finish": "fabric"}, "fabric"),
    ],
)
def test_the_default_finish(options: dict[str, Any], finish: str) -> None:
    assert Settings(**options).finish == finish


@pytest.mark.parametrize(
    ("options", "words"),
    [
        ({"pbr": True}, "finish plain"),
        ({"backend": "pyrender"}, "backend soft"),
        ({"pose": "vanilla"}, "finish does nothing for pose vanilla"),
        ({"placement": "item"}, "finish does nothing for placement item"),
    ],
)
def test_a_finish_that_would_not_show_is_refused(options: dict[str, Any], words: str) -> None:
    with pytest.raises(OptionError, match=words):
        draw(CREEPER, finish="fabric", **options)


def test_a_fabric_of_a_program_looks_like_its_preset_or_plain() -> None:
    material = Material((TextureLayer(GREY),))
    linen, own = replace(FABRICS["linen"]), Fabric(density=0.123)
    found, preset = (
        with_finish(material, fabric, SHEET_MAPPING, (METRE, METRE)) for fabric in (linen, "linen")
    )
    assert found.detail is preset.detail is not None
    assert found.transmission == preset.transmission
    assert with_finish(material, own, SHEET_MAPPING, (METRE, METRE)) is material


@pytest.mark.parametrize(
    "tile", [np.zeros((3, 3, 4), np.uint8), np.zeros((4, 4, 3), np.uint8), np.zeros((4, 4, 4))]
)
def test_a_tile_that_cannot_repeat_is_refused(tile: Any) -> None:
    material = Material((TextureLayer(GREY),), detail=SurfaceDetail(tile, (1.0, 1.0)))
    with pytest.raises(OptionError, match="tile of a detail"):
        draw_scene(Scene((Model(wavy(), (material,)),), Camera((0, 0, 2.0), (0, 0, 0)), (8, 8)))


@pytest.mark.parametrize("name", ["silk", "leather"])
@pytest.mark.parametrize("side", [384, 200, 96])
def test_a_strip_shows_no_further_than_it_changes_the_tile(name: str, side: int) -> None:
    """A texel beside its inner side makes the renderer read all of it; nearer, nothing changes."""
    scene = sheet(name, side)
    (material,) = scene.models[0].materials
    detail = material.detail
    assert detail is not None and detail.strips is not None
    strips = detail.strips.copy()
    assert (strips[:, :, 16:] == (128, 128, 128, 255)).all()
    strips[:, :, -1, 2] = 0
    marked = replace(material, detail=replace(detail, strips=strips))
    other = replace(scene, models=(replace(scene.models[0], materials=(marked,)),))
    middle = slice(side // 3, -side // 3)
    changes = (brightness(scene) != brightness(other))[middle].any(axis=0)
    # The picture shows nine tenths of the sheet, which is 384 texels wide.
    texels = 384 * 0.9 / side
    away = 384 * 0.05 + np.flatnonzero(changes)[0] * texels
    assert 32 - 5 * texels < away < 32
