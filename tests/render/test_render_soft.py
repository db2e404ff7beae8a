"""The rasteriser as a whole: order, depth, clipping, samples, sameness and absurd input."""

import gc
import hashlib
import os
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from render_shapes import FACING, mesh, noise, painted, plain, quad, soup

from drapery.errors import OptionError
from drapery.mesh import Mesh, vertex_normals
from drapery.render import soft
from drapery.render.camera import Camera, clip_matrix
from drapery.render.light import UNLIT
from drapery.render.scene import Material, Model, Scene, TextureLayer
from drapery.render.soft import draw_scene

RED, GREEN = painted(255, 0, 0, 255), painted(0, 255, 0, 255)


def medley(seed: int = 0, count: int = 400) -> Scene:
    """A bit of everything: layers, holes, veils, light, near and far, before and behind."""
    random = np.random.default_rng(seed)
    materials = (
        Material(
            (
                TextureLayer(noise(1, 16, 16), (200, 30, 90)),
                TextureLayer(noise(2, 32, 32), (10, 200, 250)),
            )
        ),
        Material((TextureLayer(noise(3, 8, 8)),), "cutout"),
        Material((TextureLayer(noise(4, 5, 7)),), "blend"),
    )
    middles = random.uniform((-3, -2, -8), (3, 2, 3), (3, count, 1, 1, 3))
    sizes = random.choice([0.05, 0.3, 2.0], (3, count, 1, 1, 1))
    points = middles + sizes * random.normal(size=(3, count, 1, 3, 3))
    models = []
    for corners, material in zip(points, materials, strict=True):
        shape = soup(corners[:, 0], random.random((3 * count, 2)))
        normals = vertex_normals(shape.positions, shape.triangles)
        models.append(Model(replace(shape, normals=normals), (material,)))
    return Scene(tuple(models), Camera((0.5, 0.3, 4), (0, 0, 0)), (320, 200))


def digest(scene: Scene, **options: int) -> str:
    return hashlib.sha256(draw_scene(scene, **options).pixels.tobytes()).hexdigest()


def many_sheets() -> Scene:
    """Enough triangles that every stage is shared out."""
    u, v = np.meshgrid(*[np.linspace(-1, 1, 101)] * 2)
    points = np.stack([u, v, 0.2 * np.sin(7 * u + 3 * v)], axis=-1).reshape(-1, 3)
    a = (np.arange(100)[:, None] * 101 + np.arange(100)).ravel()
    triangles = np.concatenate(
        [np.stack([a, a + 1, a + 101], 1), np.stack([a + 1, a + 102, a + 101], 1)]
    )
    sheet = mesh(points, triangles, (points[:, :2] + 1) / 2)
    sheet = replace(sheet, normals=vertex_normals(sheet.positions, sheet.triangles))
    material = Material(
        (TextureLayer(noise(5, 64, 64)), TextureLayer(noise(6, 64, 64), (1, 99, 200)))
    )
    return Scene((Model(sheet, (material,)),), Camera((1, 1, 3), (0, 0, 0)), (333, 222))


@pytest.mark.parametrize("scene", [medley(), many_sheets()], ids=["medley", "sheet"])
def test_the_number_of_threads_changes_no_bit(scene: Scene) -> None:
    one = digest(scene, threads=1)
    assert all(digest(scene, threads=threads) == one for threads in (2, 3, 7))


@pytest.mark.parametrize("scene", [medley(), many_sheets()], ids=["medley", "sheet"])
def test_drawing_in_parts_changes_no_bit(scene: Scene, monkeypatch: pytest.MonkeyPatch) -> None:
    whole = digest(scene)
    monkeypatch.setattr(soft, "MAX_RECORDS", 300)
    assert digest(scene) == whole


def test_the_same_scene_gives_the_same_bits_again() -> None:
    assert len({digest(medley()) for _ in range(5)}) == 1


def test_the_nearer_is_seen_whatever_the_order() -> None:
    near, far = Model(quad(z=0.5), (RED,)), Model(quad(z=0.499), (GREEN,))
    for models in ((near, far), (far, near)):
        assert (draw_scene(Scene(models, FACING, (16, 16))).pixels == (255, 0, 0, 255)).all()


def test_of_equals_in_depth_the_later_is_seen() -> None:
    askew = quad()
    askew.positions[:, 2] = askew.positions[:, 0] * 0.7 + askew.positions[:, 1] * 0.3
    models = Model(askew, (RED,)), Model(askew, (GREEN,))
    camera = Camera((1, 2, 3), (0, 0, 0))
    pixels = draw_scene(Scene(models, camera, (64, 64))).pixels
    assert pixels[..., 3].any() and not pixels[..., 0].any()


def test_both_sides_of_a_sheet_are_drawn() -> None:
    behind = replace(FACING, position=(0, 0, -10))
    assert (draw_scene(Scene((Model(quad(), (RED,)),), behind, (8, 8))).pixels[..., 3] == 255).all()


def test_a_batch_is_the_same_as_its_members_one_by_one() -> None:
    materials = (
        RED,
        GREEN,
        Material((TextureLayer(noise(1, 8, 8)), TextureLayer(noise(2, 16, 16), (9, 99, 199)))),
    )
    random = np.random.default_rng(0)
    one = quad()
    positions = (one.positions * 0.3 + random.uniform(-1, 1, (50, 1, 3))).astype(np.float32)
    normals = np.broadcast_to(one.normals, positions.shape)
    index = random.integers(0, 3, 50).astype(np.int32)
    batch = Model(Mesh(positions, normals, one.triangles, one.uvs), materials, index)
    loop = tuple(
        Model(Mesh(positions[i], normals[i], one.triangles, one.uvs), (materials[index[i]],))
        for i in range(50)
    )
    camera = Camera((1, 1, 4), (0, 0, 0))
    assert digest(Scene((batch,), camera)) == digest(Scene(loop, camera))


def test_a_floor_under_the_camera_reaches_to_the_horizon() -> None:
    """Triangles through the camera's plane are clipped: against the rays through the pixels."""
    floor = mesh(
        [(-500, 0, -500), (500, 0, -500), (-500, 0, 500), (500, 0, 500)], [(0, 2, 1), (1, 2, 3)]
    )
    camera = Camera((0.3, 1.7, 0.2), (2.0, 1.2, -5.0), fov=70, near=0.05, far=5000)
    size = (200, 150)
    pixels = draw_scene(Scene((Model(floor, (RED,)),), camera, size)).pixels
    x, y = np.meshgrid((np.arange(200) + 0.5) / 100 - 1, 1 - (np.arange(150) + 0.5) / 75)
    inverse = np.linalg.inv(clip_matrix(camera, size))
    ends = [
        np.einsum("ij,hwj->hwi", inverse, np.stack([x, y, 0 * x + z, 0 * x + 1], -1))
        for z in (-1, 1)
    ]
    near, far = (end[..., :3] / end[..., 3:] for end in ends)
    t = near[..., 1] / (near[..., 1] - far[..., 1])
    place = near + t[..., None] * (far - near)
    hit = (t > 0) & (t < 1) & (np.abs(place[..., 0]) < 500) & (np.abs(place[..., 2]) < 500)
    assert 0.4 < hit.mean() < 0.6
    assert ((pixels[..., 3] > 0) != hit).mean() < 0.002


def test_texture_and_light_go_on_through_a_cut() -> None:
    """A quad cut by the near plane looks in its remaining part as one that is not cut."""
    wall = quad(-1, -1, 1, 1)
    wall.positions[:, 2] = wall.positions[:, 0] * 3
    model = Model(wall, (Material((TextureLayer(noise(1, 16, 16)),)),))
    camera = Camera((0, 0, 2), (0, 0, 0), fov=90, near=0.01)
    whole = draw_scene(Scene((model,), camera, (128, 128), UNLIT)).pixels
    cut = draw_scene(Scene((model,), replace(camera, near=1.0), (128, 128), UNLIT)).pixels
    kept = cut[..., 3] > 0
    assert 0.02 < kept.mean() < (whole[..., 3] > 0).mean()
    assert (cut[kept] == whole[kept]).all(axis=-1).mean() > 0.99


@pytest.mark.parametrize("samples", [4, 16])
def test_samples_give_the_covered_share_as_alpha(samples: int) -> None:
    """A straight edge between red and nothing: alpha is the share covered, the colour stays."""
    grid = int(samples**0.5)
    edge = -1 + 2 * (3 * grid + 1) / (8 * grid)  # one column of samples into the fourth pixel
    scene = Scene((Model(quad(-1, -1, edge, 1), (RED,)),), FACING, (8, 8), samples=samples)  # type: ignore[arg-type]
    pixels = draw_scene(scene).pixels
    assert (pixels[:, :3] == (255, 0, 0, 255)).all()
    assert (pixels[:, 3] == (255, 0, 0, (2 * 255 // grid + 1) // 2)).all()
    assert not pixels[:, 4:].any()


@pytest.mark.parametrize("samples", [4, 16])
def test_samples_are_the_average_of_a_larger_picture(samples: int) -> None:
    """Weighted by alpha, so that nothing does not darken an edge."""
    grid = int(samples**0.5)
    scene = replace(medley(3, 60), background=(0, 0, 0, 0), size=(97, 55))
    large = draw_scene(replace(scene, size=(97 * grid, 55 * grid))).pixels.astype(int)
    parts = large.reshape(55, grid, 97, grid, 4).swapaxes(1, 2).reshape(55, 97, samples, 4)
    alpha = parts[..., 3].sum(-1)
    colour = (parts[..., :3] * parts[..., 3:]).sum(-2) + alpha[..., None] // 2
    colour //= np.maximum(alpha, 1)[..., None]
    expected = np.concatenate([colour, ((alpha + samples // 2) // samples)[..., None]], axis=-1)
    pixels = draw_scene(replace(scene, samples=samples)).pixels  # type: ignore[arg-type]
    assert (pixels == expected).all()


def test_lists_may_not_be_written_to() -> None:
    """Arrays from files are often read-only; they draw all the same."""
    shape = quad()
    for array in (shape.positions, shape.normals, shape.triangles, shape.uvs):
        array.flags.writeable = False
    texels = noise(1, 4, 4)
    texels.flags.writeable = False
    pixels = draw_scene(
        Scene((Model(shape, (Material((TextureLayer(texels),)),)),), FACING, (8, 8))
    ).pixels
    assert (pixels[..., 3] == 255).all()


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"size": (0, 5)}, "size 0x5"),
        ({"size": (20000, 5)}, "size 20000x5 cannot be drawn; use 1 to 16384"),
        ({"background": (0, 0, 256, 0)}, "is not a colour; use four numbers from 0 to 255"),
        ({"background": (0, 0, 0)}, "is not a colour"),
        ({"samples": 5}, "samples 5 is not known; use 1, 4 or 16"),
        ({"camera": Camera((1, 1, 1), (1, 1, 1))}, "the camera's position"),
        ({"camera": Camera((0, 5, 0), (0, 0, 0))}, "the camera's position"),
        ({"camera": Camera((0, np.nan, 0), (0, 0, 0))}, "the camera's position"),
    ],
)
def test_absurd_scenes_are_refused(change: dict[str, object], words: str) -> None:
    scene = replace(Scene((Model(quad(), (RED,)),), FACING), **change)  # type: ignore[arg-type]
    with np.errstate(all="ignore"), pytest.raises(OptionError, match=words):
        draw_scene(scene)


@pytest.mark.parametrize("bad", [np.nan, np.inf, -np.inf])
@pytest.mark.parametrize("where", ["positions", "normals"])
def test_numbers_that_are_none_are_refused(where: str, bad: float) -> None:
    shape = quad()
    getattr(shape, where)[2, 1] = bad
    with pytest.raises(OptionError, match="model 1 has positions or normals that are not finite"):
        draw_scene(Scene((Model(quad(), (RED,)), Model(shape, (RED,))), FACING))


def test_what_cannot_be_seen_is_not_drawn() -> None:
    behind, degenerate, beyond = quad(z=30), quad(), quad(z=-30)
    degenerate.positions[:] = (0.5, 0.5, 0)
    for shape in (behind, degenerate, beyond, quad(5, 5, 6, 6), quad(1e30, 0, 2e30, 1)):
        assert not draw_scene(Scene((Model(shape, (RED,)),), FACING, (32, 32))).pixels.any()


def test_huge_triangles_cover_everything() -> None:
    for scale in (1e3, 1e6, 1e9, 1e15):
        shape = quad(-scale, -scale, scale, scale)
        pixels = draw_scene(Scene((Model(shape, (RED,)),), FACING, (64, 48))).pixels
        assert (pixels == (255, 0, 0, 255)).all()


@pytest.mark.parametrize("size", [(1, 1), (1, 500), (16384, 1), (65, 63)])
def test_odd_sizes(size: tuple[int, int]) -> None:
    wide = quad(-1e5, -1, 1e5, 1)
    pixels = draw_scene(Scene((Model(wide, (RED,)),), FACING, size)).pixels
    assert pixels.shape == (size[1], size[0], 4) and (pixels == (255, 0, 0, 255)).all()


def test_nothing_at_all() -> None:
    assert (
        draw_scene(Scene((), FACING, (3, 2), background=(1, 2, 3, 4))).pixels == (1, 2, 3, 4)
    ).all()
    empty = mesh(np.zeros((0, 3)), np.zeros((0, 3)), np.zeros((0, 2)))
    assert not draw_scene(Scene((Model(empty, (RED,)),), FACING, (3, 2))).pixels.any()


@pytest.mark.slow
def test_many_frames_keep_the_memory_flat() -> None:
    """Changing meshes, looks and sizes: nothing is kept but the last few preparations."""

    def resident() -> int:
        pages = Path("/proc/self/statm").read_text(encoding="utf-8").split()[1]
        return int(pages) * os.sysconf("SC_PAGE_SIZE")

    if not Path("/proc/self/statm").exists():
        pytest.skip("this system does not tell how much memory a process has")

    def frame(number: int) -> None:
        material = Material((TextureLayer(noise(number, 64, 64)), plain(9, 9, 9, number % 256)))
        draw_scene(Scene((Model(quad(), (material,)),), FACING, (64 + number % 3, 64)))

    for number in range(100):
        frame(number)
    gc.collect()
    before = resident()
    for number in range(600):  # 10 MB of textures
        frame(number)
    gc.collect()
    assert resident() - before < 5 << 20
