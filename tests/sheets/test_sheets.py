"""Sheets hold the pictures that they say they hold; `packs` says what is there."""

import base64
import re
from html import unescape
from io import BytesIO
from pathlib import Path

import numpy as np
import pytest
from conftest import Run
from pack_maker import CREEPER, META, NEW_BASE, folder_pack, mcmeta, noise, plain, png
from PIL import Image

from drapery.banner.design import Banner, Layer
from drapery.banner.dyes import DYE_NAMES
from drapery.banner.packs import open_packs
from drapery.banner.patterns import PATTERN_NAMES
from drapery.pictures import draw, draw_face
from drapery.render.contact import GAP, contact_sheet, contact_table
from drapery.settings import Settings
from drapery.sheets.drawn import packs_sheet, rotations_sheet
from drapery.sheets.faces import contents_sheet, patterns_sheet, steps_sheet
from drapery.sheets.sheet import PictureSheet

pytestmark = pytest.mark.filterwarnings("ignore:not in .*, taken from our own art")

DESIGN = Banner("white", (Layer("creeper", "lime"), Layer("border", "black")))


def blank(*rgb: int, size: tuple[int, int] = (9, 7)) -> np.ndarray:
    return np.full((size[1], size[0], 4), (*rgb, 255), np.uint8)


def boxes(picture: np.ndarray, colours: list[tuple[int, ...]]) -> list[tuple[int, ...]]:
    """Left, top, right, bottom of each colour, all of which must be there in full."""
    found = []
    for colour in colours:
        rows, columns = np.nonzero((picture == (*colour, 255)).all(axis=2))
        found.append((columns.min(), rows.min(), columns.max() + 1, rows.max() + 1))
        assert len(rows) == 9 * 7
    return found


def test_a_strip_shows_each_picture_whole_in_rows() -> None:
    colours = [(10 * n, 200, 3) for n in range(7)]
    pictures = [(f"a_name_of_many_words_{n}", blank(*c)) for n, c in enumerate(colours)]
    places = boxes(contact_sheet(pictures, 3).pixels, colours)
    assert len({left for left, *_ in places}) == 3 and len({top for _, top, *_ in places}) == 3
    assert [p[:2] for p in places] == sorted((p[:2] for p in places), key=lambda p: p[::-1])


def test_a_table_shows_each_picture_under_and_beside_its_heading() -> None:
    colours = [(10 * n, 200, 3) for n in range(6)]
    frame = contact_table(
        ["left", "middle", "right"], ["upper", "lower"], [blank(*c) for c in colours]
    )
    places = np.array(boxes(frame.pixels, colours)).reshape(2, 3, 4)
    assert (np.ptp(places[:, :, 1], axis=1) == 0).all()
    assert (np.ptp(places[:, :, 0], axis=0) == 0).all()
    ink = (frame.pixels[..., :3] < 100).all(axis=2)
    for left in places[0, :, 0]:
        assert ink[: places[0, 0, 1], left : left + 9].any()
    for top in places[:, 0, 1]:
        assert ink[top : top + 16, GAP : places[0, 0, 0] - GAP].any()


def test_all_patterns_in_all_dyes_are_on_the_sheet(tmp_path: Path) -> None:
    sheet = patterns_sheet(open_packs(), "white", DYE_NAMES, scale=1)
    assert sheet.across[3] == "light blue" and sheet.down == PATTERN_NAMES
    assert len(sheet.cells) == 43 * 16 and sheet.cells[17].label == "square_bottom_left, orange"
    for number in (0, 38 * 16 + 5, 43 * 16 - 1):
        banner = Banner("white", (Layer(PATTERN_NAMES[number // 16], DYE_NAMES[number % 16]),))
        assert np.array_equal(sheet.cells[number].pixels, draw_face(banner, scale=1).pixels)
    sheet.save(tmp_path / "sheet.html")
    assert html_pictures(tmp_path / "sheet.html") == picture_bytes(sheet)


def html_pictures(path: Path) -> list[tuple[str, bytes]]:
    """Label and pixels of each picture in a page, which may not ask for anything outside it."""
    text = path.read_text(encoding="utf-8")
    sources = re.findall(
        r'<img alt="([^"]*)" title="[^"]*" src="data:image/png;base64,([^"]*)"', text
    )
    assert "http" not in text and text.count("src=") == len(sources)
    return [
        (unescape(label), np.asarray(Image.open(BytesIO(base64.b64decode(data)))).tobytes())
        for label, data in sources
    ]


def picture_bytes(sheet: PictureSheet) -> list[tuple[str, bytes]]:
    return [(cell.label, cell.pixels.tobytes()) for cell in sheet.cells]


def test_labels_cannot_break_out_of_the_page(tmp_path: Path) -> None:
    pack = folder_pack(tmp_path / '<b>"&', {NEW_BASE: plain(9, 9, 9, 255)})
    sheet = packs_sheet(DESIGN, [pack], Settings(), scale=1)
    sheet.save(tmp_path / "sheet.html")
    assert html_pictures(tmp_path / "sheet.html") == picture_bytes(sheet)
    assert "<b>" not in (tmp_path / "sheet.html").read_text()


def test_a_contents_sheet_shows_the_pack_of_each_pattern(tmp_path: Path) -> None:
    files = {CREEPER: png(noise(1, 128)), CREEPER.replace("creeper", "skull"): b"no picture"}
    pack = folder_pack(tmp_path, files)
    ours, theirs = contents_sheet(open_packs()), contents_sheet(open_packs([pack]))
    changed = [
        number
        for number, (a, b) in enumerate(zip(ours.cells, theirs.cells, strict=True))
        if (a.pixels != b.pixels).any()
    ]
    assert [PATTERN_NAMES[number] for number in changed] == ["creeper", "skull"]
    labels = dict(zip(PATTERN_NAMES, (cell.label for cell in theirs.cells), strict=True))
    assert labels["creeper"] == "creeper" and labels["skull"] == "skull (broken)"
    assert labels["globe"] == "globe (ours)" and ours.cells[33].label == PATTERN_NAMES[33]


def test_rotations_are_seen_by_one_camera_that_holds_all() -> None:
    sheet = rotations_sheet(DESIGN, Settings(size=(60, 80), pose="vanilla", view="front"))
    assert [cell.label for cell in sheet.cells][:5] == ["0 south", "1", "2", "3", "4 west"]
    alpha = np.array([cell.pixels[..., 3] for cell in sheet.cells])
    assert not (alpha[:, 0].any() or alpha[:, -1].any() or alpha[:, :, [0, -1]].any())
    # Turned by as much to the left as to the right it fills the same pixels, mirrored.
    for rotation in range(1, 8):
        assert (alpha[rotation] != alpha[16 - rotation][:, ::-1]).mean() < 0.01
    assert len({cell.pixels.tobytes() for cell in sheet.cells}) == 16


def test_one_design_over_many_packs(tmp_path: Path) -> None:
    red = folder_pack(tmp_path / "red", {CREEPER: plain(255, 0, 0, 255)})
    blue = folder_pack(tmp_path / "blue", {CREEPER: plain(0, 0, 255, 255)})
    settings = Settings(size=(40, 50))
    sheet = packs_sheet(DESIGN, [red, blue], settings)
    assert [cell.label for cell in sheet.cells] == ["our own art", "red", "blue"]
    alone = draw(DESIGN, size=(40, 50)).pixels, draw(DESIGN, packs=[blue], size=(40, 50)).pixels
    assert np.array_equal(sheet.cells[0].pixels, alone[0])
    assert np.array_equal(sheet.cells[2].pixels, alone[1])


def test_the_looms_steps_end_in_the_banner() -> None:
    cells = steps_sheet(DESIGN, open_packs()).cells
    assert [cell.label for cell in cells] == [
        "0. base, white",
        "1. creeper, lime",
        "2. border, black",
    ]
    assert np.array_equal(cells[-1].pixels, draw_face(DESIGN, scale=4).pixels)


def test_packs_says_what_is_there_and_what_is_wrong(drapery: Run, tmp_path: Path) -> None:
    files = {META: mcmeta(46), CREEPER: png(noise(1)), CREEPER[:-4] + "_n.png": png(noise(2))}
    below = folder_pack(tmp_path / "below", files)
    above = folder_pack(tmp_path / "above", {CREEPER: plain(9, 9, 9, 255, side=32)})
    code, out, err = drapery("packs", below, above, "-o", tmp_path / "all.png")
    assert (code, err) == (0, "")
    first, second = out.strip().split("\n\n")
    assert str(below) in first and "1 of 43" in first and "normal maps   creeper" in first
    assert "1 of 64 x 64 px" in first and "overrides" not in first
    assert f"creeper of {below}" in second and "1 of 32 x 32 px" in second
    assert Image.open(tmp_path / "all.png").size[0] > 800
    broken = folder_pack(tmp_path / "broken", {CREEPER: b"GIF89a"})
    code, out, err = drapery("packs", broken)
    (problem,) = [line for line in out.splitlines() if "problem" in line]
    assert code == 1 and "creeper.png is not a PNG file" in problem and err == ""


def test_the_commands_write_what_the_sheets_hold(drapery: Run, tmp_path: Path) -> None:
    page, picture = tmp_path / "s.html", tmp_path / "s.png"
    words = ("--dyes", "red,Light Blue", "--scale", "1", "--base", "black")
    assert drapery("sheet", "patterns", "-o", page, *words)[0] == 0
    assert html_pictures(page) == picture_bytes(
        patterns_sheet(open_packs(), "black", ("red", "light_blue"), scale=1)
    )
    small = ("--size", "20x24")
    assert drapery("sheet", "rotations", "shield red", "-o", picture, *small)[0] == 0
    assert drapery("sheet", "packs", "red", tmp_path, "-o", page, "--flat", "--scale", "1")[0] == 2
    pack = folder_pack(tmp_path / "pack", {CREEPER: plain(255, 0, 0, 255)})
    assert drapery("sheet", "packs", "red creeper", pack, "-o", page)[0] == 2
    assert drapery("sheet", "packs", "red creeper:red", pack, "-o", page, "--flat")[0] == 0
    assert [label for label, _ in html_pictures(page)] == ["our own art", "pack"]


BAD_WORDS = [
    ("sheet", "patterns", "-o", "s.doc"),
    ("sheet", "patterns", "-o", "no/such/s.html"),
    ("sheet", "patterns", "-o", "s.png", "--dyes", "pinkish"),
    ("sheet", "patterns", "-o", "s.png", "--base", "none"),
    ("sheet", "patterns", "-o", "s.png", "--scale", "0"),
    ("sheet", "patterns", "-o", "s.png", "--format", "0"),
    ("sheet", "rotations", "-o", "s.png"),
    ("sheet", "rotations", "red", "-o", "s.png", "--kind", "cape"),
    ("sheet", "packs", "red", "-o", "s.png"),
    ("sheet", "packs", "red", "nowhere", "-o", "s.png"),
    ("sheet", "boats", "-o", "s.png"),
    ("packs",),
    ("packs", "nowhere"),
    ("packs", "nowhere", "-o", "s.doc"),
    ("render", "-o", "s.png"),
    ("render", "red", "-o", "s.png", "--rotation", "16"),
    ("render", "red", "-o", "s.png", "--rotation", "1", "--placement", "wall"),
    ("render", "red", "-o", "s.png", "--rotation", "1", "--placement", "item"),
    ("render", "red", "-o", "s.png", "--facing", "east"),
    ("render", "red", "-o", "s.png", "--facing", "up", "--placement", "wall"),
    ("render", "red", "-o", "s.png", "--kind", "boat"),
    ("render", "red", "-o", "s.png", "--kind", "cape", "--texture", "c.png"),
    ("render", "red", "-o", "s.png", "--kind", "shield", "--placement", "wall"),
    ("render", "red", "-o", "s.png", "--texture", "c.png"),
    ("render", "-o", "s.png", "--kind", "cape"),
    ("render", "-o", "s.png", "--kind", "elytra", "--texture", "c.png"),
    ("render", "-o", "s.png", "--kind", "cape", "--texture", "no\nsuch.png"),
    ("render", "-o", "s.png", "--kind", "cape", "--texture", "."),
    ("animate", "red", "-o", "s.gif", "--format", "1000000"),
]


@pytest.mark.parametrize("words", BAD_WORDS, ids=" ".join)
def test_bad_words_are_one_line_and_leave_nothing(
    drapery: Run, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, words: tuple[str, ...]
) -> None:
    (tmp_path / "c.png").write_bytes(plain(1, 2, 3, 255, side=48))
    monkeypatch.chdir(tmp_path)
    code, out, err = drapery(*words)
    lines = [line for line in err.splitlines() if "kernels" not in line]
    assert (code, out, len(lines)) == (2, "", 1), (out, err)
    assert [path.name for path in tmp_path.iterdir()] == ["c.png"]
