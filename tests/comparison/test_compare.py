"""Comparisons say what differs, by how much, and from which layer on."""

import json
from pathlib import Path

import numpy as np
import pytest
from conftest import Run
from PIL import Image

from drapery import Banner
from drapery.banner.loom import fits_loom, loom_steps, simplify
from drapery.banner.packs import open_packs
from drapery.comparison.metrics import measure
from drapery.comparison.panels import difference_panel
from drapery.comparison.tolerance import Tolerance
from drapery.errors import OptionError
from drapery.render.contact import contact_sheet, on_checker, stack_frames
from drapery.render.frame import Frame

SMALL = ("--size", "48x64")


def grey(value: int, height: int = 16, width: int = 16) -> np.ndarray:
    return np.full((height, width, 4), (value, value, value, 255), np.uint8)


def test_figures_of_a_known_difference() -> None:
    expected, actual = grey(100), grey(100)
    actual[2, 3, 1] = 110
    actual[5, 5] = 0
    difference = measure(expected, actual)
    assert (difference.pixels, difference.changed, difference.max_error) == (256, 2, 255)
    assert difference.mean_error == pytest.approx((10 + 300 + 255) / (256 * 4))
    assert measure(expected, actual, Tolerance(channel=10)).beyond == 1


def test_perceptual_metrics_know_their_ends() -> None:
    same = measure(grey(100), grey(100), perceptual=True)
    assert (same.ssim, same.flip) == (1.0, 0.0)
    far = measure(grey(0), grey(255), perceptual=True)
    assert far.ssim is not None and far.ssim < 0.1
    assert far.flip is not None and far.flip > 0.9


def test_pictures_of_other_sizes_are_refused() -> None:
    with pytest.raises(OptionError, match="16x16 and 8x16"):
        measure(grey(0), grey(0, 16, 8))


def test_the_panel_marks_every_changed_pixel_and_no_other() -> None:
    expected, actual = grey(100), grey(100)
    actual[4, 7, 0] += 1
    panel = difference_panel(expected, actual).astype(int)
    marked = panel[..., 0] - panel[..., 1] > 20
    assert np.argwhere(marked).tolist() == [[4, 7]]


def test_contact_sheets_keep_texels() -> None:
    picture = np.random.default_rng(1).integers(0, 256, (5, 7, 4), np.uint8)
    picture[..., 3] = 255
    sheet = contact_sheet([("a", picture.repeat(3, 0).repeat(3, 1)), ("b", picture)]).pixels
    found = [
        (y, x)
        for y in range(sheet.shape[0] - 15)
        for x in range(sheet.shape[1] - 21)
        if np.array_equal(sheet[y : y + 15, x : x + 21], picture.repeat(3, 0).repeat(3, 1))
    ]
    assert len(found) == 1
    assert stack_frames([Frame(picture), Frame(picture)]).pixels.shape == (10, 7, 4)
    assert (on_checker(np.zeros((9, 9, 4), np.uint8))[..., 3] == 255).all()


def test_designs_differ_from_the_layer_that_differs(drapery: Run, tmp_path: Path) -> None:
    target = tmp_path / "report.json"
    designs = ("white creeper:lime border:black", "white creeper:lime border:red")
    code, out, _ = drapery("compare", *designs, *SMALL, "-o", target)
    assert code == 1
    assert "from layer 2 (border, red) in place of layer 2 (border, black) on" in out
    (pair,) = json.loads(target.read_text())["pairs"]
    assert (
        pair["changed"] > 100
        and pair["from"] == "layer 2 (border, red) in place of layer 2 (border, black)"
    )


def test_tolerance_decides_the_exit_code(drapery: Run, tmp_path: Path) -> None:
    paths = []
    for name, value in (("a", 100), ("b", 103)):
        paths.append(tmp_path / f"{name}.png")
        Image.fromarray(grey(value)).save(paths[-1])
    assert drapery("compare", *paths)[0] == 1
    assert drapery("compare", *paths, "--tolerance", "3")[0] == 0
    assert drapery("compare", *paths, "--pixels", "256")[0] == 0
    assert drapery("compare", paths[0], paths[0])[0] == 0


def test_every_form_of_report_is_written(drapery: Run, tmp_path: Path) -> None:
    targets = [tmp_path / f"out.{ending}" for ending in ("png", "gif", "html", "json")]
    words = [word for target in targets for word in ("-o", target)]
    code, out, _ = drapery(
        "compare", "red", "blue cross:white", *SMALL, *words, "--perceptual", "--cost"
    )
    assert code == 1 and "quads" in out
    with Image.open(targets[1]) as flicker:
        assert flicker.n_frames == 2
    page = targets[2].read_text()
    assert page.count("data:image/png") == 2 and "ssim" in page and "http" not in page
    assert 'alt="side by side: Banner: Gules; Banner: Azure, a saltire Argent"' in page


def test_stacked_and_flat_agree(drapery: Run) -> None:
    design = "blue gradient_up:light_blue rhombus:yellow flower:white curly_border:black"
    words = ("--layers", "stacked,flat", "--tolerance", "2", *SMALL)
    assert drapery("compare", design, *words)[0] == 0


def test_packs_are_compared(drapery: Run, tmp_path: Path) -> None:
    for name in ("one", "two"):
        sprite = tmp_path / name / "assets/minecraft/textures/entity/banner/creeper.png"
        sprite.parent.mkdir(parents=True)
        Image.new("RGBA", (64, 64), (255, 255, 255, 255 if name == "one" else 0)).save(sprite)
    code, out, _ = drapery(
        "compare", "white creeper:red", tmp_path / "one", tmp_path / "two", *SMALL
    )
    assert code == 1 and "one and two" in out and "layer 1 (creeper, red)" in out


@pytest.mark.parametrize(
    "words",
    [
        ("red",),
        ("red", "blue", "--layers", "stacked,flat"),
        ("red", "blue", "-o", "out.doc"),
        ("red", "bluu"),
        ("red", "blue", "--backend", "soft,crayon"),
        ("red", "blue", "--tolerance", "300"),
    ],
)
def test_bad_comparisons_are_one_line(drapery: Run, words: tuple[str, ...]) -> None:
    code, _, err = drapery("compare", *words, *SMALL)
    lines = [line for line in err.splitlines() if "kernels" not in line]
    assert (code, len(lines)) == (2, 1)


def test_the_loom_is_described_step_by_step(drapery: Run, tmp_path: Path) -> None:
    out_file, steps_file = tmp_path / "apart.png", tmp_path / "steps.png"
    code, out, _ = drapery(
        "layers",
        "white base:red creeper:lime",
        "-o",
        out_file,
        "--steps",
        steps_file,
        "--size",
        "64x64",
    )
    assert code == 0 and out_file.exists() and steps_file.exists()
    assert "2. creeper with lime dye and a creeper banner pattern" in out
    banner = Banner.parse("white base:red creeper:lime")
    assert [step.banner.layers[-1] for step in loom_steps(banner)] == list(banner.layers)
    assert fits_loom(banner) and not fits_loom(Banner.parse("white" + " cross:red" * 7))


def test_hidden_layers_are_found_and_visible_ones_are_not() -> None:
    packs = open_packs(())
    hidden = Banner.parse("white creeper:lime base:red cross:black")
    assert simplify(hidden, packs) == Banner.parse("white base:red cross:black")
    visible = Banner.parse("white gradient:red cross:black")
    assert simplify(visible, packs) == visible
    twice = Banner.parse("white base:black base:black")
    assert len(simplify(twice, packs).layers) == 1
    darker_edges = Banner.parse("white cross:black cross:black")
    assert simplify(darker_edges, packs) == darker_edges


@pytest.mark.parametrize("target", ["out.bmp", "none/out.png"])
def test_a_bad_target_is_refused_before_anything_is_drawn(
    drapery: Run, tmp_path: Path, target: str
) -> None:
    designs = ("white creeper:lime", "white creeper:red")
    code, out, err = drapery("compare", *designs, "-o", tmp_path / target, *SMALL)
    assert (code, out, len(err.splitlines())) == (2, "", 1)


def test_designs_are_read_and_drawn_as_render_does(drapery: Run, tmp_path: Path) -> None:
    two = tmp_path / "two.mcfunction"
    two.write_text("give @p white_banner\ngive @p red_banner\n")
    words = ("compare", two, "red", "--number", "2", "--size", "32x48", "--grid", "2x3")
    assert drapery(*words, "--rotation", "3", "--shadow", "--samples", "4")[0] == 0
    assert drapery(*words[:3], "--number", "1", *words[5:])[0] == 1
