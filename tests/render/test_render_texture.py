"""Texels and colours: exact places, exact arithmetic."""

from typing import Any

import numpy as np
import pytest
from render_shapes import FACING, mesh, noise, plain, quad

from drapery.render import flatten
from drapery.render.camera import Camera, clip_matrix
from drapery.render.light import UNLIT, Light
from drapery.render.materials import MaterialTables
from drapery.render.scene import Material, Model, Scene, TextureLayer
from drapery.render.soft import draw_scene


def drawn(*materials: Material, size: tuple[int, int] = (64, 64), **options: object) -> np.ndarray:
    """A square that fills the picture, wearing looks one before the other."""
    aspect = size[0] / size[1]
    squares = [quad(-aspect, -1, aspect, 1, 0.1 * i) for i in range(len(materials))]
    models = tuple(
        Model(square, (material,)) for square, material in zip(squares, materials, strict=True)
    )
    scene = Scene(models, FACING, size, **{"light": UNLIT, **options})  # type: ignore[arg-type]
    return draw_scene(scene).pixels


def drawn_mesh(surface: Any, material: Material) -> np.ndarray:
    return draw_scene(Scene((Model(surface, (material,)),), FACING, (64, 64), UNLIT)).pixels


def opaque(texels: np.ndarray) -> np.ndarray:
    return np.concatenate([texels[..., :3], np.full_like(texels[..., 3:], 255)], axis=-1)


def over(top: np.ndarray, tint: tuple[int, int, int], below: np.ndarray) -> np.ndarray:
    """The definition of a layer on an opaque surface, in fractions without rounding errors."""
    a = top[..., 3:].astype(int)
    src = (2 * top[..., :3].astype(int) * np.array(tint) + 255) // 510
    colour = (2 * (a * src + (255 - a) * below[..., :3].astype(int)) + 255) // 510
    return np.concatenate([colour, np.full_like(a, 255)], axis=-1).astype(np.uint8)


@pytest.mark.parametrize("shape", [(1, 1), (4, 8), (16, 16), (64, 32), (3, 5)])
def test_a_texture_seen_straight_is_enlarged_exactly(shape: tuple[int, int]) -> None:
    texels = noise(1, *shape)
    pixels = drawn(Material((TextureLayer(texels),)), size=(shape[1] * 7, shape[0] * 7))
    assert (pixels == opaque(texels).repeat(7, 0).repeat(7, 1)).all()


def test_texture_coordinates_are_right_in_perspective() -> None:
    """Against the ray through each pixel's centre: where it meets a square that lies askew."""
    corners = np.array([(-1.3, 1.2, -3.0), (1.4, 0.9, 0.6), (-1.0, -1.1, 0.9), (1.1, -1.4, -2.0)])
    corners[3] = corners[1] + corners[2] - corners[0]
    camera, size, texels = Camera((0.4, 0.2, 3), (0, 0, 0), fov=60), (200, 160), noise(2, 16, 16)
    surface = mesh(corners, [(0, 2, 1), (1, 2, 3)], [(0, 0), (1, 0), (0, 1), (1, 1)])
    pixels = draw_scene(
        Scene((Model(surface, (Material((TextureLayer(texels),)),)),), camera, size, UNLIT)
    ).pixels

    x, y = np.meshgrid((np.arange(200) + 0.5) / 100 - 1, 1 - (np.arange(160) + 0.5) / 80)
    ends = [
        np.einsum(
            "ij,hwj->hwi",
            np.linalg.inv(clip_matrix(camera, size)),
            np.stack([x, y, np.full_like(x, z), np.ones_like(x)], -1),
        )
        for z in (-1, 1)
    ]
    near, far = (end[..., :3] / end[..., 3:] for end in ends)
    across, down = corners[1] - corners[0], corners[2] - corners[0]
    normal = np.cross(across, down)
    t = ((corners[0] - near) @ normal) / ((far - near) @ normal)
    place = near + t[..., None] * (far - near) - corners[0]
    # place = u across + v down, solved in the square's plane
    inverse = np.linalg.pinv(np.stack([across, down], axis=1))
    uv = np.einsum("ij,hwj->hwi", inverse, place) * 16
    # Corners are snapped to 1/256 pixel, so a texel's outermost hundredth may fall either way.
    clear = (
        (np.abs(uv - np.rint(uv)) > 0.02).all(axis=-1) & (uv > 0.02).all(-1) & (uv < 15.98).all(-1)
    )
    j, i = (uv[clear][:, axis].astype(int) for axis in (1, 0))
    assert clear.sum() > 5000
    assert (pixels[clear] == opaque(texels)[j, i]).all()


def test_a_region_never_shows_its_neighbours() -> None:
    """Only texels that a triangle's UVs touch are seen, from wherever it is looked at."""
    sheet = np.zeros((64, 64, 4), np.uint8)
    sheet[:] = (0, 255, 0, 255)
    sheet[1:41, 1:21] = (255, 0, 0, 255)
    uvs = np.array([(1, 1), (21, 1), (1, 41), (21, 41)]) / 64
    corners = [(-1, 2, 0), (1, 2, 0), (-1, -2, 0), (1, -2, 0)]
    flag = Model(mesh(corners, [(0, 2, 1), (1, 2, 3)], uvs), (Material((TextureLayer(sheet),)),))
    random = np.random.default_rng(3)
    for distance in (1.5, 4, 30, 100):
        for direction in random.normal(size=(10, 3)):
            position = distance * direction / np.linalg.norm(direction)
            camera = Camera(tuple(position), (0, 0, 0), fov=50)  # type: ignore[arg-type]
            pixels = draw_scene(Scene((flag,), camera, (80, 80), UNLIT)).pixels
            assert not pixels[..., 1].any()


@pytest.mark.parametrize("rows", [16, 17, 41, 64])
def test_a_cut_out_region_ends_where_an_opaque_one_does(rows: int) -> None:
    """Its edges run through the centres of pixels, and transparent texels lie around it."""
    sheet = np.zeros((rows + 2, 33, 4), np.uint8)
    sheet[1:-1, 1:21] = (255, 0, 0, 255)
    u, v = np.array([1, 21]) / 33, np.array([1, rows + 1]) / (rows + 2)
    edge = 31 / 32 - np.arange(0, 12, 4) / 32
    seen = {}
    for alpha in ("opaque", "cutout"):
        material = Material((TextureLayer(sheet),), alpha=alpha)  # type: ignore[arg-type]
        seen[alpha] = [
            drawn_mesh(
                mesh(
                    [(-e, e, 0), (e, e, 0), (-e, -e, 0), (e, -e, 0)],
                    [(0, 2, 1), (1, 2, 3)],
                    [(u[0], v[0]), (u[1], v[0]), (u[0], v[1]), (u[1], v[1])],
                ),
                material,
            )
            for e in edge + 1 / 64
        ]
    assert np.array_equal(seen["cutout"], seen["opaque"])


def test_every_tint_of_every_texel_is_exact() -> None:
    texels = np.zeros((16, 16, 4), np.uint8)
    texels[..., :3] = np.arange(256, dtype=np.uint8).reshape(16, 16, 1)
    for tint in range(0, 256, 5):
        pixels = drawn(Material((TextureLayer(texels, (tint, 255 - tint, 128)),)), size=(16, 16))
        exact = (2 * texels[..., :3].astype(int) * (tint, 255 - tint, 128) + 255) // 510
        assert (pixels[..., :3] == exact).all()


@pytest.mark.parametrize("per_sample", [False, True])
@pytest.mark.parametrize("seed", range(4))
def test_stacks_are_laid_over_in_whole_numbers(
    seed: int, per_sample: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Whether layers are composited beforehand or at every sample, down to the last bit."""
    if per_sample:
        monkeypatch.setattr(flatten, "MAX_TEXELS", 0)
    random = np.random.default_rng(seed)
    sizes = random.choice([8, 16, 32, 64], 17)
    layers = tuple(
        TextureLayer(noise(seed * 100 + i, n, n), tuple(random.integers(0, 256, 3)))
        for i, n in enumerate(sizes)
    )
    expected = over(
        opaque(layers[0].texels), layers[0].tint, np.zeros((*layers[0].texels.shape[:2], 3))
    )
    expected = expected.repeat(64 // sizes[0], 0).repeat(64 // sizes[0], 1)
    for layer, n in zip(layers[1:], sizes[1:], strict=True):
        expected = over(layer.texels.repeat(64 // n, 0).repeat(64 // n, 1), layer.tint, expected)
    assert (drawn(Material(layers)) == expected).all()


@pytest.mark.parametrize("alpha", ["opaque", "cutout", "blend"])
def test_compositing_beforehand_changes_no_bit(alpha: str, monkeypatch: pytest.MonkeyPatch) -> None:
    layers = tuple(
        TextureLayer(noise(i, n, n), (200, 90, 40 * i)) for i, n in enumerate((32, 8, 64))
    )
    material = Material(layers, alpha)  # type: ignore[arg-type]
    beforehand = drawn(material, background=(10, 200, 30, 77))

    def leave(worn: MaterialTables) -> MaterialTables:
        return worn

    monkeypatch.setattr("drapery.render.soft.composite_layers", leave)
    assert (drawn(material, background=(10, 200, 30, 77)) == beforehand).all()


def test_textures_whose_sizes_do_not_divide_one_another() -> None:
    below, above = noise(1, 6, 6), noise(2, 4, 4)
    pixels = drawn(
        Material((TextureLayer(below), TextureLayer(above, (255, 255, 254)))), size=(12, 12)
    )
    under = opaque(below).repeat(2, 0).repeat(2, 1)
    assert (pixels == over(above.repeat(3, 0).repeat(3, 1), (255, 255, 254), under)).all()


def test_cutout_leaves_out_texels_under_one_half() -> None:
    texels = noise(7, 32, 32)
    behind = Material((plain(1, 2, 3, 255),))
    pixels = drawn(behind, Material((TextureLayer(texels),), "cutout"), size=(32, 32))
    expected = np.where(texels[..., 3:] < 128, np.array([1, 2, 3, 255]), opaque(texels))
    assert (pixels == expected).all()


@pytest.mark.parametrize("nearest_first", [False, True])
def test_what_blends_is_laid_over_what_is_behind_it(nearest_first: bool) -> None:
    back, middle, front = noise(8, 16, 16), noise(9, 16, 16), noise(10, 16, 16)
    worn = [(0.0, back, "opaque"), (1.0, middle, "blend"), (2.0, front, "blend")]
    models = [Model(quad(z=z), (Material((TextureLayer(t),), a),)) for z, t, a in worn]  # type: ignore[arg-type]
    scene = Scene(tuple(models[::-1] if nearest_first else models), FACING, (16, 16), UNLIT)
    plain_tint = (255, 255, 255)
    expected = over(front, plain_tint, over(middle, plain_tint, opaque(back)))
    assert (draw_scene(scene).pixels == expected).all()


def test_what_blends_hides_behind_what_is_solid() -> None:
    solid = Model(quad(z=1), (Material((plain(9, 8, 7, 255),)),))
    veil = Model(quad(z=0), (Material((plain(200, 0, 0, 99),), "blend"),))
    assert (draw_scene(Scene((solid, veil), FACING, (8, 8), UNLIT)).pixels == (9, 8, 7, 255)).all()


def test_a_veil_keeps_its_own_colour_on_nothing_and_alphas_add_up() -> None:
    veil = Material((plain(200, 100, 40, 60),), "blend")
    assert (drawn(veil) == (200, 100, 40, 60)).all()
    twice = drawn(veil, veil)[0, 0]
    assert tuple(twice) == (200, 100, 40, round(60 + 60 * (255 - 60) / 255))


def test_background_shows_where_nothing_is() -> None:
    scene = Scene(
        (Model(quad(-1, -1, 0, 1), (Material((plain(5, 6, 7, 255),)),)),), FACING, (10, 10)
    )
    for background in ((0, 0, 0, 0), (12, 34, 56, 78), (90, 80, 70, 255)):
        scene = Scene(scene.models, FACING, (10, 10), UNLIT, background)
        pixels = draw_scene(scene).pixels
        assert (pixels[:, 5:] == background).all() and (pixels[:, :5] == (5, 6, 7, 255)).all()


def test_light_multiplies_once_and_rounds() -> None:
    light = Light(((0, 0, 1),), 0.25, 0.5, tint=(1.0, 0.5, 0.25))
    pixels = drawn(Material((plain(200, 201, 202, 255),)), light=light)
    assert (pixels[..., :3] == np.floor(np.array([200, 201 * 0.5, 202 * 0.25]) * 0.75 + 0.5)).all()
    pixels = drawn(Material((plain(200, 201, 202, 255),), lit=False), light=light)
    assert (pixels[..., :3] == (200, 201, 202)).all()


def test_the_games_light_has_the_games_brightness() -> None:
    """North and south 0.7395, east and west 0.497, up 1, down 0.4."""
    from drapery.render.light import GAME_LIGHT

    normals = np.array([(0, 0, 1), (0, 0, -1), (1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0)], float)
    assert GAME_LIGHT.brightness(normals) == pytest.approx(
        [0.7395, 0.7395, 0.497, 0.497, 1.0, 0.4], abs=5e-4
    )
