"""What single steps of styles do to cloth, texels and pixels."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from style_inputs import canvas, rippled

from drapery import Banner, Settings
from drapery.banner import DYES
from drapery.cloth import grid
from drapery.errors import OptionError
from drapery.packs import open_packs
from drapery.render import Buffers, Material, TextureLayer
from drapery.scenes import still
from drapery.style import FLAG_MAPPING, FLAG_SIZE, flag_material
from drapery.style.grids import grid_shell
from drapery.styles import STEPS, Canvas, Style, StyleStep, find_style
from drapery.styles.palette_files import read_palette
from drapery.styles.void_and_cluster import LEVELS, SIDE, blue_noise

MOTION, PICTURE, SHAPE, MATERIAL = (
    STEPS["motion"],
    STEPS["picture"],
    STEPS["shape"],
    STEPS["material"],
)
FLAG, RIPPLES = rippled()


def swaying(sideways: bool = False, count: int = 12) -> np.ndarray:
    """A flag that swings about its top edge, or its left one, and waves; a loop of `count`."""
    turn, waves = 2 * np.pi * np.arange(count) / count, RIPPLES[:, 2] - 0.02
    far = FLAG.shell.sheet_uvs[:, 0 if sideways else 1]
    ahead = 0.8 * np.sin(turn)[:, None] * far + np.cos(turn)[:, None] * far * waves
    rows, columns = FLAG.grid_shape
    flat = grid(columns, rows, *FLAG_SIZE).rest_positions
    moving: np.ndarray = flat + ahead[..., None] * [0.0, 0.0, 1.0]
    return moving


def at_a_pole(positions: np.ndarray) -> np.ndarray:
    """A flag turned so that its upper edge stands upright and the others are to its right."""
    x, y, z = np.moveaxis(positions, -1, 0)
    return np.stack([-y, x, z], axis=-1)


def chain_angles(positions: np.ndarray, sideways: bool, upright: bool) -> np.ndarray:
    """The mean angle of each row to its rest position [degrees], shape [F, rows - 1]."""
    rows = FLAG.rows(positions)
    rows = rows.swapaxes(1, 2) if sideways else rows
    x, y, z = np.moveaxis(np.diff(rows, axis=1).mean(axis=2), -1, 0)
    return np.degrees(np.arctan2(z, x if upright else -y))


@pytest.mark.parametrize(
    ("given", "held"),
    [(swaying(), "top"), (swaying(sideways=True), "left"), (at_a_pole(swaying()), "pole")],
    ids=["top", "left", "pole"],
)
def test_snapped_angles_are_multiples_and_keep_lengths_and_the_held_edge(
    given: np.ndarray, held: str
) -> None:
    snapped = MOTION["snap-angles"](FLAG, given, degrees=12.0)
    sideways, upright = held == "left", held != "top"
    steps = chain_angles(snapped, sideways, upright) / 12
    np.testing.assert_allclose(steps, np.round(steps), atol=1e-9)
    off = 12 * steps - chain_angles(given, sideways, upright)
    assert 4 < np.abs(off).max() < 0.7 * 12 + 1e-9
    axis = 2 if sideways else 1
    pieces = [np.diff(FLAG.rows(each), axis=axis) for each in (given, snapped)]
    np.testing.assert_allclose(*(np.linalg.norm(each, axis=-1) for each in pieces), atol=1e-12)
    edge = (slice(None), slice(None), 0) if sideways else (slice(None), 0)
    assert np.array_equal(FLAG.rows(snapped)[edge], FLAG.rows(given)[edge])


def test_a_snapped_angle_does_not_flicker_between_two_neighbours() -> None:
    angles = np.radians(7.5 + 0.8 * np.array([1, -1, 1, -1, 1, -1]))[:, None]
    flat = grid(5, 9, *FLAG_SIZE).rest_positions
    x, down = flat[:, 0] + 0 * angles, flat[0, 1] - flat[:, 1]
    tilted = np.stack([x, flat[0, 1] - np.cos(angles) * down, np.sin(angles) * down], axis=-1)
    snapped = MOTION["snap-angles"](FLAG, tilted, degrees=15.0)
    np.testing.assert_allclose(snapped, np.broadcast_to(snapped[:1], snapped.shape), atol=1e-12)


@pytest.mark.parametrize("sideways", [False, True])
def test_squash_stretches_along_the_velocity_and_keeps_the_volume(sideways: bool) -> None:
    given = swaying(sideways)
    moved = MOTION["squash"](FLAG, given, strength=0.5)
    first = (slice(None), slice(None), 0) if sideways else (slice(None), 0)
    assert np.array_equal(FLAG.rows(moved)[first], FLAG.rows(given)[first])
    same = MOTION["squash"](FLAG, given, strength=0.0)
    assert np.array_equal(same, given)
    # At the fastest moment the flag swings ahead: it is narrower and shorter by the same factor.
    size = [np.ptp(each[0], axis=0)[:2] for each in (moved, given)]
    free = [
        FLAG.rows(each)[0, -1, :, 0] if not sideways else FLAG.rows(each)[0, :, -1, 1]
        for each in (moved, given)
    ]
    np.testing.assert_allclose(np.ptp(free[0]) / np.ptp(free[1]), 1.5**-0.5, rtol=2e-3)
    along = 0 if sideways else 1
    np.testing.assert_allclose(size[0][along] / size[1][along], 1.5**-0.5, rtol=2e-2)


@pytest.mark.parametrize("name", ["snap-angles", "squash"])
def test_a_motion_step_has_no_seam(name: str) -> None:
    given = swaying(count=12)
    later = np.roll(given, 5, axis=0)
    one, other = (MOTION[name](FLAG, each) for each in (given, later))
    np.testing.assert_allclose(np.roll(one, 5, axis=0), other, atol=1e-12)


def test_a_still_has_snapped_angles_too() -> None:
    style = Style("puppet", (StyleStep("motion", MOTION["snap-angles"], {"degrees": 30.0}),))
    settings = Settings(style=(style,), grid=(3, 5), size=(40, 50))
    banner, packs = Banner.parse("red"), open_packs(())
    (snapped, plain) = (
        still(banner, packs, each).models[-1].mesh.positions
        for each in (settings, replace(settings, style=()))
    )
    assert np.abs(snapped - plain).max() > 0.01


def cells(name: str, **parameters: object) -> np.ndarray:
    """Which cells of its grid a shape step keeps: half the number of its triangles in each row."""
    shell = SHAPE[name](FLAG, RIPPLES, **parameters)[0].shell
    down = len(np.unique(shell.sheet_uvs[:, 1])) - 1
    rows = (shell.sheet_uvs[shell.sheet].mean(axis=1)[:, 1] * down).astype(int)
    return np.bincount(rows, minlength=down) // 2


def cut_of(name: str, across: int, depth: float) -> tuple[float, np.ndarray, np.ndarray]:
    """The share of a cloth that a cut keeps, and the places of its new edge: from the middle to a
    side, -1 to 1, and from the upper end of the cut down, 0 to 1."""
    piece = replace(FLAG, size=(across * FLAG.texel, FLAG.size[1]))
    shell = SHAPE[name](piece, RIPPLES, depth=depth)[0].shell
    one, two = (
        shell.sheet_uvs[shell.sheet[:, k]] - shell.sheet_uvs[shell.sheet[:, 0]] for k in (1, 2)
    )
    ends = shell.sheet_uvs[shell.rim]
    inner = ends[~((ends[:, 0] == ends[:, 1]) & np.isin(ends[:, 0], (0.0, 1.0))).any(axis=-1)]
    aside, down = inner.reshape(-1, 2).T
    area = np.abs(one[:, 0] * two[:, 1] - one[:, 1] * two[:, 0]).sum() / 2
    return float(area), 2 * aside - 1, (down - 1 + depth) / depth


@pytest.mark.parametrize("across", [20, 7])
def test_a_swallow_tail_is_cut_along_two_straight_lines(across: int) -> None:
    area, aside, down = cut_of("swallow-tail", across, 0.3)
    np.testing.assert_allclose(np.abs(aside), down, atol=1e-9)
    assert np.isclose(area, 1 - 0.3 / 2) and down.min() < 1e-9 and down.max() > 1 - 1e-9


@pytest.mark.parametrize("across", [20, 7])
def test_a_rounded_hem_is_half_an_ellipse(across: int) -> None:
    area, aside, down = cut_of("rounded-hem", across, 0.25)
    assert np.abs(np.hypot(aside, down) - 1).max() < 0.02
    assert np.isclose(area, 1 - 0.25 + 0.25 * np.pi / 4, atol=0.005)


@pytest.mark.parametrize("name", ["swallow-tail", "rounded-hem"])
def test_a_cut_of_no_depth_keeps_the_whole_cloth(name: str) -> None:
    shell = SHAPE[name](FLAG, RIPPLES, depth=0.0)[0].shell
    assert len(shell.sheet) == 2 * 20 * 40


def test_a_fringe_is_half_cut_away_and_uneven() -> None:
    kept = cells("fringe", length=4, threads=2)
    assert (kept[:72] == 40).all() and (kept[72:76] == 20).all() and 0 < kept[-1] < 20


def test_parchment_turns_white_into_its_own_colour_and_keeps_patterns_darker() -> None:
    material = flag_material(Banner.parse("white stripe_center:black"), open_packs(()))
    (layer,) = MATERIAL["parchment"](material, stains=0.0).layers
    scale = layer.texels.shape[1] // 64
    white, black = (layer.texels[10 * scale, x * scale, :3].astype(int) for x in (2, 11))
    assert np.abs(white - [0xE6, 0xD3, 0xA3]).max() < 24 and (black < white - 60).all()


@pytest.mark.parametrize("name", list(MATERIAL))
def test_steps_of_materials_take_textures_of_any_size(name: str) -> None:
    """Wings of wool are 30 texels wide, which do not divide the 64 of a sheet."""
    noise = np.random.default_rng(5)
    for height, width in ((1, 1), (60, 30), (68, 34), (7, 13), (22, 12), (64, 64), (130, 65)):
        texels = noise.integers(0, 256, (height, width, 4), np.uint8)
        small = TextureLayer(texels)
        large = TextureLayer(texels.repeat(2, axis=0).repeat(2, axis=1), DYES["red"].rgb)
        for layers in ((small,), (small, large)):
            styled = MATERIAL[name](Material(layers))
            for layer in styled.layers:
                tall, wide = layer.texels.shape[:2]
                assert tall * width == wide * height, (height, width, len(layers))


def test_level_texels_are_flat_on_levels_and_leave_no_gap() -> None:
    thin, rows = replace(FLAG, thickness=0.5 / 24), FLAG.rows(RIPPLES)
    mesh = SHAPE["level-texels"](thin, RIPPLES, step=0.5)
    faces = mesh.positions.reshape(40, 20, 6, 4, 3)
    right, down = np.array([1.0, 0, 0]), (rows[-1] - rows[0]).mean(axis=0)
    ahead = mesh.normals.reshape(40, 20, 6, 4, 3)[0, 0, 0, 0]
    assert abs(ahead @ right) < 0.05 and abs(ahead @ down) < 1e-9
    np.testing.assert_allclose(mesh.normals.reshape(faces.shape)[:, :, 0] @ ahead, 1)
    height = (faces @ ahead)[:, :, :2]
    np.testing.assert_allclose(np.ptp(height, axis=-1), 0, atol=1e-12)
    front, back = np.moveaxis(height.mean(axis=-1), -1, 0)
    levels = (front - front[0, 0]) * 24 / 0.5
    np.testing.assert_allclose(levels, np.round(levels), atol=1e-9)
    assert len(np.unique(np.round(levels))) > 4
    # Neighbours have common corners on the plane, and their depths overlap by the thickness.
    top = faces[:, :, 0] - front[..., None, None] * ahead
    np.testing.assert_allclose(top[:, :-1, [1, 3]], top[:, 1:, [0, 2]], atol=1e-12)
    np.testing.assert_allclose(top[:-1, :, [2, 3]], top[1:, :, [0, 1]], atol=1e-12)
    for one, other in ((np.s_[:, :-1], np.s_[:, 1:]), (np.s_[:-1], np.s_[1:])):
        shared = np.minimum(front[one], front[other]) - np.maximum(back[one], back[other])
        assert shared.min() > 0.5 / 24 - 1e-12


def test_a_palette_of_a_material_is_that_of_a_picture(tmp_path: Path) -> None:
    material = flag_material(Banner.parse("white stripe_center:black gradient:red"), open_packs(()))
    colours = ("#f0f0f0", "#101010", "#b02020")
    for given in ({}, {"dither": 0.8}):
        (layer,) = MATERIAL["palette"](material, colours=colours, **given).layers
        assert layer.tint == (255, 255, 255) and layer.texels.shape == (64, 64, 4)
        found = {bytes(texel).hex() for texel in layer.texels[..., :3].reshape(-1, 3)}
        assert found == {colour[1:] for colour in colours}
    sheet = MATERIAL["age"](material, fade=0.0, dirt=0.0).layers[0].texels
    flat = replace(material, layers=(replace(material.layers[0], texels=sheet),))
    drawn = PICTURE["palette"](replace(canvas(), pixels=sheet), colours=colours, dither=0.4).pixels
    (layer,) = MATERIAL["palette"](flat, colours=colours, dither=0.4).layers
    assert np.array_equal(layer.texels, drawn)
    (tmp_path / "two.hex").write_text("000000\nff8000\n", encoding="utf-8")
    text = '[[material]]\nstep = "palette"\nfile = "two.hex"\n'
    (tmp_path / "my.toml").write_text(text, encoding="utf-8")
    (step,) = Style.load(tmp_path / "my.toml").steps
    assert (step.kind, dict(step.parameters)["colours"]) == ("material", ("#000000", "#ff8000"))


def test_bevelled_texels_have_one_bright_and_one_dark_corner() -> None:
    texels = np.full((64, 64, 4), 100, np.uint8)
    texels[..., 3] = 255
    (layer,) = MATERIAL["bevel"](Material((TextureLayer(texels),)), depth=0.4).layers
    texel = layer.texels[8:16, 16:24, 0]
    assert texel[0, 0] == 120 and texel[-1, -1] == 60
    assert (texel[1:-1, 1:-1] == 100).all()
    assert np.array_equal(np.tile(texel, (64, 64)), layer.texels[..., 0])


def test_each_face_of_a_cube_shows_its_texel_upright() -> None:
    """Its corners lie in the texel of its middle, the upper left one above and to the left."""
    faces = SHAPE["voxels"](FLAG, RIPPLES).uvs.reshape(40, 20, 6, 4, 2)
    middle = faces.mean(axis=3)
    assert (np.abs(faces - middle[..., None, :]) * 64 < 0.5).all()
    front, left = faces[3, 4, 0], faces[3, 4, 2]
    assert np.array_equal(front, left)
    assert (front[3] > front[0]).all() and np.allclose(front[1] - front[0], front[3] - front[2])


def test_tears_stay_within_a_low_sheet() -> None:
    shell = grid_shell(9, 9, FLAG_MAPPING)
    flat = np.zeros((81, 3))
    flat[:, 0], flat[:, 1] = shell.sheet_uvs[:, 0] * 0.5, -shell.sheet_uvs[:, 1] * 0.5
    low = replace(FLAG, shell=shell, size=(0.5, 0.5), texel=1 / 16)
    for seed in range(40):
        torn, _ = SHAPE["tear"](low, flat, depth=0.9, holes=40, seed=seed)
        assert len(torn.shell.sheet)


def test_scanlines_darken_every_third_row() -> None:
    given = replace(canvas(), pixels=np.full((9, 4, 4), 200, np.uint8))
    drawn = PICTURE["scanlines"](given, every=3, strength=0.5).pixels
    assert drawn[:, 0, 0].tolist() == [100, 200, 200] * 3 and (drawn[..., 3] == 200).all()


def square() -> np.ndarray:
    """A red square of 8 x 8 pixels in the middle of 32 x 32."""
    pixels = np.zeros((32, 32, 4), np.uint8)
    pixels[12:20, 12:20] = (255, 0, 0, 255)
    return pixels


def test_outlines_between_materials_of_one_model_are_drawn_if_wanted() -> None:
    given = canvas()
    material = np.where(np.arange(40) < 10, 0, 1).astype(np.int32) + 0 * given.buffers.model
    material[~given.buffers.coverage] = -1
    found = replace(given.buffers, material=material)
    given = replace(given, make_buffers=lambda: found)
    without, drawn = (PICTURE["outline"](given, materials=each).pixels for each in (False, True))
    changed = np.flatnonzero((without != drawn).any(axis=(0, 2)))
    assert changed.tolist() == [9]


def shown_model(pixels: np.ndarray) -> Canvas:
    """A picture of one flat model that looks to the viewer."""
    shape = pixels.shape[:2]
    normal = np.broadcast_to(np.float32([0, 0, 1]), (*shape, 3)).copy()
    depth, model = np.full(shape, 3, np.float32), np.zeros(shape, np.int32)
    found = Buffers(depth, normal, model, np.zeros((*shape, 2), np.float32), model)
    return Canvas(pixels, lambda: found)


def test_lines_between_dark_colours_are_white_and_those_beside_bright_ones_are_not() -> None:
    pixels = np.full((12, 40, 4), 255, np.uint8)
    pixels[:, :14, :3], pixels[:, 14:28, :3] = (0, 0, 60), (70, 0, 0)
    given = {"contrast": 40, "width": 1, "colour": "#102030"}
    line = PICTURE["outline"](shown_model(pixels), white_below=100, **given).pixels[6]
    assert line[13].tolist() == [255] * 4 and line[27].tolist() == [16, 32, 48, 255]
    plain = PICTURE["outline"](shown_model(pixels), **given).pixels[6]
    assert plain[13].tolist() == plain[27].tolist() == [16, 32, 48, 255]


def test_strokes_are_of_paper_where_it_is_dark_and_end_where_it_is_black() -> None:
    """The share of ink grows with the darkness."""
    shares = []
    for level in (250, 150, 120, 90, 60, 30):
        grey = np.full((96, 96, 4), level, np.uint8)
        grey[..., 3] = 255
        drawn = PICTURE["hatching"](shown_model(grey), turned=0.6, spacing=8, width=2).pixels
        shares.append(float((drawn[..., 0] < 128).mean()))
    assert shares[0] == 0.0 and shares[-1] == 1.0
    assert shares == sorted(shares)
    assert 0.6 <= shares[3] < shares[4] < 1.0


def test_strokes_grow_with_the_tone_from_nothing() -> None:
    drawn = []
    for level in range(255, 9, -1):
        grey = np.full((48, 48, 4), level, np.uint8)
        grey[..., 3] = 255
        drawn.append(PICTURE["hatching"](shown_model(grey), spacing=8, width=2).pixels)
    assert not np.any(drawn[0] - drawn[20]) and drawn[-1][..., 0].mean() < 128
    assert np.abs(np.diff(np.stack(drawn).astype(int), axis=0)).max() < 24


def test_calm_poses_are_means_over_the_seam_of_a_loop() -> None:
    def calmed(heights: list[int]) -> list[float]:
        poses = np.zeros((len(heights), *RIPPLES.shape))
        poses[..., 1] = np.array(heights)[:, None]
        calm: np.ndarray = MOTION["calm"](FLAG, poses)
        return calm[:, 0, 1].tolist()

    assert calmed([9] + 15 * [0]) == [3, 2, 1] + 11 * [0] + [1, 2]
    assert calmed([*range(16)]) == pytest.approx([4 / 9, 10 / 9, *range(2, 14), 125 / 9, 131 / 9])
    assert calmed([9, 0, 3, 0, 9, 1, 0]) == [9, 0, 3, 0, 9, 1, 0]


def test_a_drop_shadow_is_moved_and_lies_below() -> None:
    given = replace(canvas(), pixels=square())
    drawn = PICTURE["drop-shadow"](given, right=4, down=6, blur=0, strength=0.5).pixels
    assert np.array_equal(drawn[12:20, 12:20], square()[12:20, 12:20])
    shadow = np.argwhere(drawn[..., 3] == 128)
    assert shadow.max(axis=0).tolist() == [25, 23] and not drawn[22, 14:23, :3].any()


def test_a_glow_is_even_around_and_fades() -> None:
    alpha = PICTURE["glow"](replace(canvas(), pixels=square()), radius=6).pixels[..., 3]
    assert np.array_equal(alpha, alpha.T) and np.array_equal(alpha, alpha[::-1])
    assert (np.diff(alpha[16, 20:27].astype(int)) < 0).all() and not alpha[16, 26:].any()


def test_blue_noise_has_each_threshold_equally_often_and_apart() -> None:
    tile = blue_noise()
    assert (np.bincount(tile.reshape(-1)) == SIDE * SIDE // LEVELS).all()
    dark = tile < LEVELS // 8
    beside = np.count_nonzero(dark & np.roll(dark, 1, 0)) + np.count_nonzero(
        dark & np.roll(dark, 1, 1)
    )
    assert beside < 0.02 * np.count_nonzero(dark)


@pytest.mark.parametrize("pattern", ["bayer", "blue-noise"])
def test_a_dither_has_the_mean_of_what_it_replaces(pattern: str) -> None:
    given = replace(canvas(), pixels=np.full((32, 32, 4), (96, 96, 96, 255), np.uint8))
    drawn = PICTURE["posterize"](given, levels=2, dither=1.0, pattern=pattern).pixels
    assert set(np.unique(drawn[..., :3])) == {0, 255}
    assert abs(drawn[..., :3].mean() - 96) < 8


def test_palettes_come_from_files_beside_the_style(tmp_path: Path) -> None:
    gpl = "GIMP Palette\nName: two\nColumns: 2\n# a comment\n  0   0   0\tblack\n255 128 0 orange\n"
    (tmp_path / "two.gpl").write_text(gpl, encoding="utf-8")
    (tmp_path / "two.hex").write_text("000000\n#FF8000\n", encoding="utf-8")
    for name in ("two.gpl", "two.hex"):
        text = f'[[picture]]\nstep = "palette"\nfile = "{name}"\n'
        (tmp_path / "my.toml").write_text(text, encoding="utf-8")
        style = Style.load(tmp_path / "my.toml")
        assert dict(style.steps[0].parameters)["colours"] == ("#000000", "#ff8000")


@pytest.mark.parametrize(
    ("name", "content", "said"),
    [
        ("a.png", "", "is of an unknown type; use .gpl or .hex"),
        ("a.hex", "00000\n", "line 1: '00000' is not a colour; use six hexadecimal digits"),
        ("a.hex", "000000\n", "has 1 colours; use 2 to 256"),
        ("a.gpl", "0 0 0\n", "line 1: it is not 'GIMP Palette'"),
        ("a.gpl", "GIMP Palette\nred: 1 2 3\n", "line 2: 'red: 1 2 3' is not a colour"),
        ("a.gpl", "GIMP Palette\n0 0 256\n", "line 2: '0 0 256' is not a colour"),
        ("a.hex", "f" * 70_000, "over 65536 bytes; a palette is shorter"),
    ],
)
def test_a_fault_in_a_palette_names_the_line_and_the_remedy(
    name: str, content: str, said: str, tmp_path: Path
) -> None:
    (tmp_path / name).write_text(content, encoding="utf-8")
    with pytest.raises(OptionError) as caught:
        read_palette(tmp_path / name)
    assert said in str(caught.value)


def test_a_fault_of_a_palette_names_the_line_of_the_style(tmp_path: Path) -> None:
    path = tmp_path / "my.toml"
    for lines, said in (
        ('file = "none.gpl"', "none.gpl cannot be read"),
        ("file = 3", "file 3 is not a path"),
        ('file = "a.gpl"\ncolours = ["#000000", "#ffffff"]', "both file and colours"),
    ):
        path.write_text(f'[[picture]]\nstep = "palette"\n{lines}\n', encoding="utf-8")
        with pytest.raises(OptionError, match=r"my\.toml line 3: .*") as caught:
            find_style(path)
        assert said in str(caught.value)
