"""Styles: chains of checked steps for motion, shape, material and picture."""

import re
import tracemalloc
from dataclasses import replace
from importlib.resources import files
from pathlib import Path
from typing import Annotated, Any

import numpy as np
import pytest
import trimesh
from conftest import Run
from cost import limited_cost
from PIL import Image
from pydantic import Field
from style_inputs import TEXEL, canvas, rippled

from drapery import Banner, Settings, animate, draw
from drapery.batch.keys import DigestCache, picture_key
from drapery.batch.manifest import read_manifest
from drapery.errors import OptionError
from drapery.mesh import Mesh
from drapery.render import Buffers, Camera, Scene, draw_scene
from drapery.serve.request_params import ServiceConfig, read_request
from drapery.sheets import styles_sheet
from drapery.styles import (
    STEPS,
    Canvas,
    Style,
    StyleStep,
    combined_style,
    find_style,
    style_names,
)
from drapery.styles.catalogue import PRESETS
from drapery.styles.loading import MAX_BYTES, MAX_STEPS
from drapery.styles.style import MAX_SAMPLES

BANNER = Banner.parse("white creeper:lime border:black")
ALL_STEPS = [(kind, name) for kind, steps in STEPS.items() for name in steps]


def no_buffers() -> Buffers:
    raise AssertionError("nobody should have asked for buffers")


@pytest.mark.parametrize("name", PRESETS)
def test_a_preset_is_what_its_description_says(name: str, tmp_path: Path) -> None:
    style = find_style(name)
    path = tmp_path / f"{name}.toml"
    path.write_text(style.describe(), encoding="utf-8")
    assert Style.load(path) == style
    assert style.description


@pytest.mark.parametrize("name", PRESETS)
def test_the_gallery_shows_a_preset_with_its_file(name: str) -> None:
    docs = Path(__file__).parents[2] / "docs"
    text = (files("drapery.styles") / "presets" / f"{name}.toml").read_text(encoding="utf-8")
    assert f"```toml\n{text}```" in (docs / "reference" / "style-gallery.md").read_text("utf-8")
    assert (docs / "pictures" / "styles" / f"{name}.png").is_file()


@pytest.mark.parametrize(
    ("text", "line", "said"),
    [
        ("light = flat", "line 1", "is not TOML"),
        ('light = "dim"', "line 1", "use game, flat or studio"),
        ("samples = 2", "line 1", "use 1, 4 or 16"),
        ("\ncolour = 1", "line 2", "colour is not a field of a style; use one of: description"),
        ("[[shape]]\ntimes = 2", "line 1", "step is missing; use one of: thickness, smooth"),
        ('[[shape]]\nstep = "pixels"', "line 2", "step 'pixels' is not known; use one of"),
        (
            '[[shape]]\nstep = "facets"\n\n[[shape]]\nstep = "smooth"\ntimes = 99',
            "line 6",
            "smooth: times 99 cannot be used; use whole numbers 1 to 8",
        ),
        (
            '[[picture]]\nstep = "outline"\nwide = 3',
            "line 3",
            "outline: wide is not a parameter; use one of: colour, width",
        ),
        (
            '[[picture]]\nstep = "outline"\ncolour = "red"',
            "line 3",
            "outline: colour 'red' cannot be used; use a colour like #5a3c1e",
        ),
        ("shape = 3", "line 1", "shape 3 cannot be used; use at most 32 tables like [[shape]]"),
    ],
)
def test_a_fault_in_a_file_names_the_line_the_field_and_the_remedy(
    text: str, line: str, said: str, tmp_path: Path
) -> None:
    path = tmp_path / "my.toml"
    path.write_text(text, encoding="utf-8")
    with pytest.raises(OptionError) as caught:
        Style.load(path)
    message = str(caught.value)
    assert "my.toml" in message and line in message and said in message


def test_a_file_of_a_style_has_a_largest_size(tmp_path: Path) -> None:
    path = tmp_path / "my.toml"
    path.write_text("#" * (MAX_BYTES + 1), encoding="utf-8")
    with pytest.raises(OptionError, match="over 65536 bytes; a style is shorter"):
        Style.load(path)
    path.write_text('[[shape]]\nstep = "facets"\n' * (MAX_STEPS + 1), encoding="utf-8")
    with pytest.raises(OptionError, match="use at most 32 tables"):
        Style.load(path)
    path.write_text('[[shape]]\nstep = "facets"\n' * MAX_STEPS, encoding="utf-8")
    assert len(Style.load(path).steps) == MAX_STEPS


@pytest.mark.parametrize(
    ("steps", "line", "said"),
    [
        (["picture.pixels size=64"] * 5, 5, "step 2 (pixels) makes pixels of 4096 x 4096; use si"),
        (["picture.clean"] * 32, 26, "picture step 9 (clean) brings the cost of the picture steps"),
        (["material.embroider"] * 32, 11, "material step 4 (embroider) brings the cost of the ma"),
        (["shape.smooth"] * 32, 77, "shape step 26 (smooth) brings the cost of the shape steps to"),
        (
            ["picture.pixels size=8", *["picture.clean"] * 9, *["picture.pixels size=9"]],
            32,
            "picture step 11 (pixels) makes pixels of 72 x 72; use sizes whose product is at most",
        ),
    ],
)
def test_a_chain_of_steps_is_bounded(
    steps: list[str], line: int, said: str, tmp_path: Path
) -> None:
    tables = []
    for each in steps:
        name, _, value = each.partition(" ")
        kind, _, step_name = name.partition(".")
        tables.append(f'[[{kind}]]\nstep = "{step_name}"\n{value}\n')
    path = tmp_path / "my.toml"
    path.write_text("".join(tables), encoding="utf-8")
    with limited_cost(), pytest.raises(OptionError) as caught:
        Style.load(path)
    message = str(caught.value)
    assert message.startswith(f"{path} line {line}: ") and said in message, message


def test_styles_that_are_joined_are_one_chain() -> None:
    wide = Style("wide", (StyleStep("picture", STEPS["picture"]["pixels"], {"size": 9}),))
    with pytest.raises(OptionError, match=r"style wide \| wide: picture step 2 \(pixels\) makes"):
        wide | wide
    every = Style("", ())
    for name in style_names():  # each with each other one may be joined
        for other in style_names():
            every = find_style(name) | find_style(other)
    assert every.steps


def test_a_step_does_not_divide_cloth_into_too_many_texels() -> None:
    piece, positions = rippled()
    large = replace(piece, size=(257 * TEXEL, TEXEL))
    for name in ("voxels", "level-texels", "swallow-tail", "rounded-hem", "fringe", "tear"):
        with pytest.raises(OptionError, match="cloth of 257 x 1 texels is too large for a step"):
            STEPS["shape"][name](large, positions)


def test_discs_around_marks_in_a_row_are_those_of_each_mark() -> None:
    from drapery.styles.kernels import draw_marks
    from drapery.styles.picture_steps import disc_widths

    rng = np.random.default_rng(5)
    source = rng.integers(0, 2**32, (20, 45), dtype=np.uint32)
    marks = np.zeros((20, 48), np.uint8)
    marks[:, :45] = rng.random((20, 45)) < 0.1
    table = np.stack([np.arange(256)[::-1]] * 3).astype(np.uint8)
    for radius in (0.0, 1.0, 2.5, 7.0):
        reach, drawn = disc_widths(radius), source.copy()
        draw_marks(drawn, source, marks.view(np.uint64), reach, table)
        near = np.zeros(source.shape, bool)
        for y, x in zip(*np.nonzero(marks), strict=True):
            for row in range(max(0, y - len(reach) // 2), min(20, y + len(reach) // 2 + 1)):
                side = reach[row - y + len(reach) // 2]
                near[row, max(0, x - side) : x + side + 1] = True
        wanted = np.where(near, ~source | 0xFF000000, source)
        assert np.array_equal(drawn, wanted)


def test_a_picture_that_a_style_changes_has_a_largest_size() -> None:
    scene = Scene((), Camera((0, 0, 3), (0, 0, 0)), (8192, 8192), samples=4)
    assert scene.size[0] * scene.size[1] * scene.samples > MAX_SAMPLES
    with pytest.raises(OptionError, match=r"style ink changes .*; use a smaller size, fewer"):
        find_style("ink").draw(scene, draw_scene)


def test_a_style_that_is_not_known_names_all_that_are() -> None:
    with pytest.raises(OptionError, match=r"style 'inky' is not known; use a file .* one of: game"):
        find_style("inky")
    with pytest.raises(OptionError, match=r"missing\.toml cannot be read: .*; check the path"):
        find_style("missing.toml")


def test_steps_of_two_styles_follow_each_other() -> None:
    one, other = find_style("cel"), find_style("tattered")
    both = one | other
    assert both.steps == (*one.steps, *other.steps)
    assert (both.light, both.samples) == (other.light, other.samples)
    assert combined_style(["cel", other]).steps == both.steps


def test_a_step_of_ones_own_has_checked_parameters() -> None:
    def dim(canvas: Canvas, *, share: Annotated[float, Field(ge=0, le=1)] = 0.5) -> Canvas:
        """Darker by a share."""
        pixels = canvas.pixels.copy()
        pixels[..., :3] = pixels[..., :3] * (1 - share)
        return canvas.painted(pixels)

    style = Style("dim", (StyleStep("picture", dim, {"share": 1.0}),))
    dark = draw(BANNER, style=style, size=(40, 50)).pixels
    assert not dark[..., :3].any() and dark[..., 3].any()
    with pytest.raises(OptionError, match="step dim: share 2 cannot be used; use 0 to 1"):
        StyleStep("picture", dim, {"share": 2})
    with pytest.raises(OptionError, match="kind of step 'sound' is not known"):
        StyleStep("sound", dim)  # type: ignore[arg-type]
    with pytest.raises(OptionError, match="step dim: a step of shape takes piece and positions"):
        StyleStep("shape", dim)


@pytest.mark.parametrize(("kind", "name"), ALL_STEPS)
def test_every_parameter_has_a_meaning_and_every_step_a_docstring(kind: str, name: str) -> None:
    function = STEPS[kind][name]  # type: ignore[index]
    text = Style("one", (StyleStep(kind, function),)).describe()  # type: ignore[arg-type]
    assert function.__doc__
    assert all("  # " in line for line in text.splitlines()[2:])


def test_the_style_game_is_the_plain_picture() -> None:
    plain, game = draw(BANNER, size=(60, 80)), draw(BANNER, size=(60, 80), style="game")
    assert np.array_equal(plain.pixels, game.pixels)


def test_options_win_over_the_light_and_samples_of_a_style() -> None:
    settled = find_style("cel").settle(Settings(samples=1))
    assert (settled.light, settled.samples) == ("flat", 1)


@pytest.mark.parametrize("name", [n for n in STEPS["shape"] if n != "voxels"])
def test_a_shape_step_leaves_a_closed_mesh(name: str) -> None:
    style = Style(name, (StyleStep("shape", STEPS["shape"][name]),))
    closed(style.mesh(*rippled()))


def test_shape_steps_work_one_after_the_other() -> None:
    steps = [StyleStep("shape", STEPS["shape"][n]) for n in ("smooth", "boards", "tear", "facets")]
    closed(Style("many", tuple(steps)).mesh(*rippled()))
    with pytest.raises(OptionError, match="put it before the step that cuts it"):
        Style("late", tuple(steps[2:0:-1])).mesh(*rippled())
    voxels = StyleStep("shape", STEPS["shape"]["voxels"])
    with pytest.raises(OptionError, match="step smooth follows one that makes a mesh"):
        Style("late", (voxels, steps[0])).mesh(*rippled())


def closed(mesh: Mesh) -> None:
    merged = trimesh.Trimesh(mesh.positions, mesh.triangles, process=False)
    merged.merge_vertices(merge_tex=True, merge_norm=True)
    edges, count = np.unique(np.sort(merged.edges, axis=1), axis=0, return_counts=True)
    assert len(edges) and (count % 2 == 0).all()
    np.testing.assert_allclose(np.linalg.norm(mesh.normals, axis=-1), 1, atol=1e-5)


def test_smooth_goes_through_the_particles() -> None:
    piece, positions = rippled()
    fine, between = STEPS["shape"]["smooth"](piece, positions, times=4)
    given = piece.rows(positions)
    np.testing.assert_allclose(fine.rows(between)[::4, ::4], given, atol=1e-12)


def test_hold_shows_each_pose_for_several_frames() -> None:
    piece, positions = rippled()
    moments = np.stack([positions + n for n in range(9)])
    held = STEPS["motion"]["hold"](piece, moments, every=2)
    assert [round(each[0, 0] - moments[0, 0, 0]) for each in held] == [0, 0, 2, 2, 4, 4, 6, 6, 8]


@pytest.mark.parametrize("count", [1, 4, 7])
def test_a_short_loop_holds_no_pose(count: int) -> None:
    piece, positions = rippled()
    moments = np.stack([positions + n for n in range(count)])
    assert np.array_equal(STEPS["motion"]["hold"](piece, moments, every=60), moments)


@pytest.mark.parametrize("count", [2, 3, 4])
def test_each_frame_of_a_short_loop_of_pixel_art_has_a_pose_of_its_own(count: int) -> None:
    options: Any = {"size": (90, 120), "grid": (5, 9), "style": "pixel-art"}
    frames = animate(BANNER, seconds=count / 5, fps=5, **options).frames
    assert len({frame.pixels.tobytes() for frame in frames}) == count


def test_a_loop_takes_motion_steps() -> None:
    style = Style("held", (StyleStep("motion", STEPS["motion"]["hold"], {"every": 2}),))
    frames = animate(BANNER, style=style, seconds=0.8, fps=10, size=(40, 50)).frames
    first, second, third, fourth = (frame.pixels for frame in frames[:4])
    assert np.array_equal(first, second) and np.array_equal(third, fourth)
    assert not np.array_equal(first, third)


@pytest.mark.parametrize("name", STEPS["picture"])
def test_a_picture_step_changes_colours_and_keeps_the_size(name: str) -> None:
    given = canvas()
    before = given.pixels.copy()
    (result,) = [each.finished((40, 30)) for each in stepped(name, given)]
    assert result.shape == (30, 40, 4) and result.dtype == np.uint8
    assert np.array_equal(given.pixels, before)


def test_steps_do_not_change_the_background() -> None:
    drawn = draw(BANNER, style="pixel-art", size=(60, 80), background="#123456").pixels
    assert drawn[0, 0].tolist() == [0x12, 0x34, 0x56, 255]
    assert (drawn[..., 3] == 255).all()


def test_buffers_are_made_only_when_a_step_asks() -> None:
    plain = replace(canvas(), make_buffers=no_buffers)
    STEPS["picture"]["tones"](STEPS["picture"]["pixels"](plain))
    with pytest.raises(AssertionError, match="nobody"):
        STEPS["picture"]["outline"](plain)


def test_steps_leave_invisible_pixels_as_they_are() -> None:
    given = canvas()
    given.pixels[:, :7] = (3, 2, 1, 0)
    for name in ("shade", "posterize", "palette", "tones", "hatching"):
        drawn = STEPS["picture"][name](given).pixels
        assert (drawn[:, :7] == (3, 2, 1, 0)).all(), name


def test_large_pixels_are_squares_of_one_colour() -> None:
    drawn = draw(BANNER, style="pixel-art", size=(60, 90)).pixels
    blocks = drawn.reshape(45, 2, 30, 2, 4)
    assert (blocks == blocks[:, :1, :, :1]).all()


def test_an_outline_has_one_pixel() -> None:
    marked = STEPS["picture"]["outline"](canvas(), colour="#010203")
    line = (marked.pixels[..., :3] == [1, 2, 3]).all(axis=-1)
    assert (line.sum(axis=1) == 1).all() and line[:, 19].all()


def test_a_palette_limits_the_colours() -> None:
    table = ("#000000", "#808080", "#ff4000")
    few = STEPS["picture"]["palette"](canvas(), colours=table, dither=0.5).pixels
    found = {f"#{bytes(each).hex()}" for each in few[..., :3].reshape(-1, 3)}
    assert found <= set(table)


@pytest.mark.parametrize("name", ["cel", "tattered", "felt"])
def test_the_same_style_gives_the_same_bytes(name: str) -> None:
    one, other = (draw(BANNER, style=name, size=(60, 75)).pixels for _ in range(2))
    assert np.array_equal(one, other)


def test_a_command_takes_styles(drapery: Run, tmp_path: Path) -> None:
    path = tmp_path / "my.toml"
    path.write_text('[[picture]]\nstep = "tones"\n', encoding="utf-8")
    words = ["--style", "game", "--style", path, "--size", "40x50", "-o", tmp_path / "a.png"]
    code, _, said = drapery("render", "white", *words)
    assert code == 0, said
    code, _, said = drapery("render", "white", "--style", "gane", "-o", tmp_path / "b.png")
    assert code == 2 and "style 'gane' is not known" in said


def test_commands_list_and_show_styles(drapery: Run, tmp_path: Path) -> None:
    code, listed, _ = drapery("style", "list")
    assert code == 0
    assert [line.split()[0] for line in listed.splitlines()] == style_names()
    code, shown, _ = drapery("style", "show", "ink")
    assert code == 0
    assert shown == find_style("ink").describe()
    code, shown, _ = drapery("style", "show", "palette")
    assert code == 0
    assert [line for line in shown.splitlines() if line.startswith("[[")] == [
        "[[material]]",
        "[[picture]]",
    ]


def test_a_sheet_of_styles_has_a_row_for_each_of_several_moments(tmp_path: Path) -> None:
    settings = Settings(style=("game", "cel"), size=(40, 50), grid=(5, 9))
    sheet = styles_sheet(BANNER, settings, moments=2)
    assert (sheet.down, len(sheet.across), len(sheet.cells)) == (("game", "cel"), 2, 4)
    assert (sheet.cells[0].pixels[..., 3] == 255).all()
    assert len(styles_sheet(BANNER, settings).cells) == 2


def test_a_sheet_of_styles_has_a_column_for_each_design_and_a_row_for_each_size() -> None:
    settings = Settings(style=("game", "cel"), grid=(5, 9))
    designs = [BANNER, Banner.parse("red"), Banner.parse("blue cross:white")]
    sheet = styles_sheet(designs, settings, sizes=[(20, 25), (40, 50)])
    assert sheet.across == ("white creeper:lime border:black", "red", "blue cross:white")
    assert sheet.down == ("game 20 x 25", "game 40 x 50", "cel 20 x 25", "cel 40 x 50")
    assert {cell.pixels.shape for cell in sheet.cells} == {(50, 40, 4)}
    assert len(sheet.cells) == 12
    small = sheet.cells[0].pixels
    assert np.array_equal(small[::2, ::2], small[1::2, 1::2])
    with pytest.raises(OptionError, match="leave out moments"):
        styles_sheet(designs, settings, moments=2)


def test_the_command_draws_several_designs_and_sizes(drapery: Run, tmp_path: Path) -> None:
    target = tmp_path / "sheet.png"
    more = ["--style", "game", "--grid", "5x9", "--size", "20x25", "--size", "40x50"]
    code, _, error = drapery("sheet", "styles", "white", "red", *more, "-o", str(target))
    assert (code, error) == (0, "")
    with Image.open(target) as drawn:
        assert drawn.width > 2 * 40 and drawn.height > 2 * 50


def test_a_manifest_reads_files_of_styles_beside_it(tmp_path: Path) -> None:
    (tmp_path / "my.toml").write_text('[[picture]]\nstep = "tones"\n', encoding="utf-8")
    rows = tmp_path / "rows.csv"
    rows.write_text("design,style\nwhite,my.toml\n", encoding="utf-8")
    keys = []
    for gamma in (1.0, 2.0):
        text = f'[[picture]]\nstep = "tones"\ngamma = {gamma}\n'
        (tmp_path / "my.toml").write_text(text, encoding="utf-8")
        (request,) = read_manifest(rows)
        given = {"ending": ".png", "timing": None}
        keys.append(picture_key(request.banner, request.settings, DigestCache(), **given))
    assert keys[0] != keys[1]
    (tmp_path / "my.toml").write_text("light = 3", encoding="utf-8")
    with pytest.raises(OptionError, match=r"my\.toml line 1: light 3 cannot be used"):
        read_manifest(rows)


def test_an_address_takes_names_and_no_files() -> None:
    config = ServiceConfig()
    good = read_request([("design", "white"), ("style", "cel;ink")], ".png", config)
    assert not isinstance(good, list) and good.settings.style == ("cel", "ink")
    (fault,) = read_request([("design", "white"), ("style", "/etc/my.toml")], ".png", config)
    assert "names a file, which an address cannot; use a name" in fault
    (fault,) = read_request([("design", "white"), ("style", "gane")], ".png", config)
    assert "style 'gane' is not known" in fault


def test_a_package_adds_a_style(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "sparkle_styles.py").write_text(
        'from drapery.styles import Style\n\nsparkle = Style("sparkle", light="flat")\nwrong = 3\n',
        encoding="utf-8",
    )
    about = tmp_path / "sparkle-1.0.dist-info"
    about.mkdir()
    (about / "METADATA").write_text("Name: sparkle\nVersion: 1.0\n", encoding="utf-8")
    (about / "entry_points.txt").write_text(
        "[drapery.styles]\nsparkle = sparkle_styles:sparkle\nwrong = sparkle_styles:wrong\n",
        encoding="utf-8",
    )
    monkeypatch.syspath_prepend(str(tmp_path))
    assert "sparkle" in style_names()
    assert find_style("sparkle").light == "flat"
    with pytest.raises(OptionError, match="is not a Style; make it one"):
        find_style("wrong")


def test_the_page_on_styles_names_everything_and_its_file_loads(tmp_path: Path) -> None:
    text = (Path(__file__).parents[2] / "docs" / "guides" / "styles.md").read_text("utf-8")
    for name in (*PRESETS, *(name for _, name in ALL_STEPS)):
        assert f"`{name}`" in text
    blocks = re.findall(r"```(\w+)\n(.*?)```", text, re.DOTALL)
    (tmp_path / "my.toml").write_text(blocks[1][1], encoding="utf-8")
    assert Style.load(tmp_path / "my.toml").steps[0].name == "hold"
    names: dict[str, Style] = {}
    exec(blocks[2][1], names)
    draw(BANNER, style=names["television"], size=(40, 50))


def stepped(name: str, *canvases: Canvas) -> list[Canvas]:
    """A picture step on the frames of a loop."""
    step = StyleStep("picture", STEPS["picture"][name])
    return step.apply(canvases) if step.over_time else [step.apply(one) for one in canvases]


def flat_canvas(colours: list[list[int]]) -> Canvas:
    """Visible pixels of these levels of red, each over a model whose depth is that level."""
    red = np.array(colours)
    pixels = np.zeros((*red.shape, 4), np.uint8)
    pixels[..., 0], pixels[..., 3] = red, 255
    normal = np.zeros((*red.shape, 3), np.float32)
    shown = np.zeros(red.shape, np.int32)
    buffers = Buffers(red.astype(np.float32), normal, shown, normal[..., :2], shown)
    return Canvas(pixels, lambda: buffers)


def test_steady_pixels_do_not_return_to_a_colour_over_the_seam_either() -> None:
    times = [[1, 5, 1, 3, 3, 3, 3, 3], [9, 9, 9, 9, 9, 2, 9, 9], [4, 4, 4, 7, 7, 7, 7, 4]]
    loop = [flat_canvas([[row[frame] for row in times]]) for frame in range(8)]
    drawn = STEPS["picture"]["steady"](loop, frames=3)
    shown = np.array([canvas.pixels[0, :, 0] for canvas in drawn]).T
    assert shown.tolist() == [[1, 1, 1, 3, 3, 3, 3, 3], [9] * 8, [4, 4, 4, 7, 7, 7, 7, 4]]
    assert np.array_equal([canvas.buffers.depth[0] for canvas in drawn], shown.T)


def test_a_limit_of_colours_holds_for_a_whole_loop() -> None:
    loop = [flat_canvas([[0, 10, 10, 200]]), flat_canvas([[12, 10, 201, 200]])]
    drawn = [
        canvas.pixels[0, :, 0].tolist() for canvas in STEPS["picture"]["limit"](loop, colours=2)
    ]
    assert drawn == [[10, 10, 10, 200], [10, 10, 200, 200]]


def test_a_limit_of_many_colours_takes_little_memory() -> None:
    pixels = np.random.default_rng(0).integers(0, 256, (250, 240, 4), np.uint8)
    pixels[..., 3] = 255
    tracemalloc.start()
    (drawn,) = STEPS["picture"]["limit"]([Canvas(pixels, no_buffers)], colours=128)
    assert tracemalloc.get_traced_memory()[1] < 100e6
    tracemalloc.stop()
    assert len(np.unique(drawn.words())) == 128


def test_a_loop_without_frames_stays_so() -> None:
    style = Style("calm", (StyleStep("picture", STEPS["picture"]["steady"]),))
    assert list(style.draw_loop([], draw_scene)) == []


@pytest.mark.parametrize(
    "change",
    [
        lambda pixels: pixels[::2].copy(),
        lambda pixels: pixels[..., :3].copy(),
        lambda pixels: pixels.astype(float),
    ],
)
def test_a_picture_step_that_changes_the_size_or_type_is_refused(change: Any) -> None:
    with pytest.raises(OptionError, match="a picture step"):
        STEPS["picture"]["shade"](canvas().painted(change(canvas().pixels)))


def test_large_pixels_of_large_pixels_stay_in_their_place() -> None:
    given = replace(canvas(), corner=(1, 2))
    assert given.coarse(2).coarse(2).corner == (1, 2)


def test_a_style_is_shown_as_it_reads_back(tmp_path: Path) -> None:
    (tmp_path / "my.toml").write_text(
        'description = "a \\"quoted\\" style"\n[[picture]]\nstep = "outline"\nwidth = 1.23456789\n',
        encoding="utf-8",
    )
    style = Style.load(tmp_path / "my.toml")
    (tmp_path / "again.toml").write_text(style.describe(), encoding="utf-8")
    again = Style.load(tmp_path / "again.toml")
    assert (again.description, again.steps) == (style.description, style.steps)


def of_models(colours: list[list[int]], models: list[list[int]]) -> Canvas:
    given = flat_canvas(colours)
    found = replace(given.buffers, model=np.array(models, np.int32))
    return replace(given, make_buffers=lambda: found)


def test_a_model_has_a_palette_of_its_own() -> None:
    """A few pixels of cloth keep their colours beside a field of grass of many."""
    grass, cloth = [*range(100, 140)], [200, 204, 90]
    given = of_models([grass + cloth], [[0] * 40 + [1] * 3])
    for models, kept in ((False, False), (True, True)):
        (drawn,) = STEPS["picture"]["limit"]([given], colours=3, models=models)
        assert (drawn.pixels[0, 40:, 0].tolist() == cloth) == kept


def test_colours_of_a_palette_are_apart() -> None:
    given = flat_canvas([[10, 10, 12, 14, 60, 60, 63]])
    (drawn,) = STEPS["picture"]["limit"]([given], colours=16, apart=5)
    assert drawn.pixels[0, :, 0].tolist() == [10, 10, 10, 10, 60, 60, 60]


def test_a_clean_edge_takes_no_colour_from_the_model_behind() -> None:
    colours = [[5, 5, 5, 5], [9, 8, 5, 5], [9, 9, 5, 5]]
    given = of_models(colours, [[0, 0, 0, 0], [1, 1, 0, 0], [1, 1, 0, 0]])
    assert STEPS["picture"]["clean"](given).pixels[1, 1, 0] == 9


def test_a_large_pixel_shows_what_most_of_it_shows_with_all_that_lies_there() -> None:
    given = flat_canvas([[7, 7, 1, 3, 3, 3], [7, 1, 1, 3, 9, 3], [7, 7, 1, 3, 3, 3]])
    drawn = given.coarse(3)
    assert drawn.pixels[0, :, 0].tolist() == [7, 3]
    assert drawn.buffers.depth.tolist() == [[7, 3]]


@pytest.mark.parametrize("begin", range(6, 12))
@pytest.mark.parametrize("width", [2, 3, 4])
@pytest.mark.parametrize("upright", [True, False])
def test_a_line_as_thin_as_a_large_pixel_is_one_wide(begin: int, width: int, upright: bool) -> None:
    places = np.full((18, 18), 9)
    places[:, begin : begin + width] = 200
    given = flat_canvas((places if upright else places.T).tolist())
    drawn = STEPS["picture"]["pixels"](given, size=3).pixels[..., 0]
    assert ((drawn if upright else drawn.T) == 200).sum(axis=1).tolist() == [1] * 6


def test_no_large_pixel_sticks_out_alone_but_the_end_of_a_pole_stays() -> None:
    shown = np.array([[0] * 5, [0, 1, 0, 0, 0], [0, 1, 0, 1, 0], [1] * 5, [1] * 5])
    fine = shown.repeat(3, axis=0).repeat(3, axis=1)
    fine[8, 11] = 0
    given = flat_canvas(fine.tolist())
    given.pixels[..., 3] *= fine.astype(np.uint8)
    drawn = STEPS["picture"]["pixels"](given, size=3).pixels[..., 3] > 0
    shown[2, 3] = 0
    assert drawn.astype(int).tolist() == shown.tolist()


def test_a_speck_has_the_tone_around_it() -> None:
    given = flat_canvas([[200] * 5] * 5)
    given.buffers.normal[...] = (0, 0, 1)
    given.buffers.normal[2, 2] = given.buffers.normal[4] = (0, -1, 0)
    one, even = (STEPS["picture"]["shade"](given, around=around).pixels for around in (0, 1))
    assert (one[2, 2] != one[1, 1]).any() and (one[4] != one[1]).any()
    assert (even == one[1, 1]).all()


def test_a_soft_shadow_has_few_tones() -> None:
    given = flat_canvas([[9] * 256])
    given.pixels[..., 3] = np.arange(256)
    drawn = STEPS["picture"]["opacity"](given, levels=2).pixels
    assert np.unique(drawn[..., 3]).tolist() == [0, 127, 255]
    assert drawn[0, [63, 64, 191, 192], 3].tolist() == [0, 127, 127, 255]


@pytest.mark.parametrize(("height", "side"), [(48, 2), (128, 2), (256, 3), (512, 6), (1080, 13)])
def test_large_pixels_grow_with_the_picture(height: int, side: int) -> None:
    given = Canvas(np.zeros((height, 12, 4), np.uint8), no_buffers)
    assert STEPS["picture"]["pixels"](given).pixel == side
    assert STEPS["picture"]["pixels"](replace(given, grid=2)).pixel == max(2, side // 2)


def test_pixel_art_keeps_the_colours_of_a_small_design() -> None:
    """At 128 pixels, of the picture without a style, also where the outline is."""
    off = []
    for design in ("red rhombus:yellow", "black creeper:gray border:black", "white flower:pink"):
        given = {"size": (96, 128), "time": 2.0, "grid": (9, 17), "ground": "none"}
        banner = Banner.parse(design)
        plain = draw(banner, **given).pixels.astype(int)
        drawn = draw(banner, style="pixel-art", **given).pixels.astype(int)
        both = (plain[..., 3] > 0) & (drawn[..., 3] > 0)
        assert np.count_nonzero(both) > 4000
        off.append(np.abs(plain - drawn)[both][:, :3].mean())
    assert np.mean(off) < 15, off


def test_a_clean_picture_has_no_orphans() -> None:
    edge = STEPS["picture"]["clean"](flat_canvas([[9, 8, 8, 8], [8, 8, 8, 8], [8, 8, 8, 7]]))
    assert (edge.pixels[..., 0] == 8).all()
    speck = STEPS["picture"]["clean"](flat_canvas([[8, 8, 8, 8], [8, 9, 8, 7], [8, 8, 8, 7]]))
    assert speck.pixels[..., 0].tolist() == [[8, 8, 8, 8], [8, 8, 8, 7], [8, 8, 8, 7]]


def test_pixel_art_neither_creeps_nor_has_many_colours() -> None:
    style = find_style("pixel-art")
    frames = animate(BANNER, style=style, seconds=1, fps=12, size=(180, 240), grid=(5, 9)).frames
    words = np.stack([frame.pixels[::3, ::3].copy().view(np.uint32)[..., 0] for frame in frames])
    before, after = np.roll(words, 1, axis=0), np.roll(words, -1, axis=0)
    assert np.count_nonzero((before == after) & (words != before)) == 0
    assert len(np.unique(words[words != 0])) <= 2 * 24  # of the cloth, and of pole and bar


def test_a_loop_has_a_largest_size_for_steps_over_time(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("drapery.styles.style.MAX_SAMPLES", 1000)
    style = Style("calm", (StyleStep("picture", STEPS["picture"]["steady"]),))
    scene = Scene((), Camera((0, 0, 3), (0, 0, 0)), (20, 20))
    assert len(list(style.draw_loop([scene] * 2, draw_scene))) == 2
    with pytest.raises(OptionError, match=r"all frames together of at most .* or a shorter loop"):
        list(style.draw_loop([scene] * 3, draw_scene))
