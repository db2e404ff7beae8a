"""What real packs have beside the game's own files: new places, other shapes, extra sprites."""

import json
from io import BytesIO
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from conftest import Run
from pack_maker import (
    BANNER,
    CREEPER,
    META,
    SHIELD,
    folder_pack,
    mcmeta,
    noise,
    plain,
    png,
    red,
)
from PIL import Image

from drapery.banner.design import Banner, Layer
from drapery.banner.packs import open_packs
from drapery.banner.packs.contents import describe_packs
from drapery.banner.packs.png import read_png
from drapery.banner.patterns import PATTERN_NAMES
from drapery.banner.sprites import composite, shield_layers
from drapery.packs import PACK_FORMATS
from drapery.pictures import draw
from drapery.studio.art import pattern_names

ENTITY = "assets/minecraft/textures/entity/"


@pytest.mark.parametrize("name", ["shield_base", "shield_base_nopattern"])
def test_shield_bases_are_read_from_both_places(tmp_path: Path, name: str) -> None:
    old, new = f"{ENTITY}{name}.png", f"{SHIELD}{name}.png"
    both = {old: plain(1, 0, 0, 255), new: plain(2, 0, 0, 255)}
    for number, files in enumerate((both, {old: both[old]}, {new: both[new]})):
        folder_pack(tmp_path / str(number), files)

    def reds(format: int | None) -> list[int]:
        stacks = [open_packs([tmp_path / str(n)], format=format) for n in range(3)]
        return [int(packs.base(name)[0, 0, 0]) for packs in stacks]  # type: ignore[arg-type]

    assert reds(None) == reds(80) == [2, 1, 2]
    assert reds(75) == [1, 1, 2]


def test_a_shield_of_the_new_layout_wears_the_packs_base(tmp_path: Path) -> None:
    files = {SHIELD + "shield_base_nopattern.png": plain(9, 8, 7, 255)}
    packs = open_packs([folder_pack(tmp_path, files)])
    assert (composite(shield_layers(None, packs)) == (9, 8, 7, 255)).all()
    (report,) = describe_packs([tmp_path])
    assert report.bases == ("shield_base_nopattern",)


@pytest.fixture
def extra_pack(tmp_path: Path) -> Path:
    files = {CREEPER: plain(1, 0, 0, 255), BANNER + "half_vertical_left.png": plain(2, 0, 0, 255)}
    return folder_pack(tmp_path / "extra", {META: mcmeta(46), **files})


def test_a_sprite_that_no_design_can_name_is_listed_as_extra(extra_pack: Path) -> None:
    (report,) = describe_packs([extra_pack])
    assert report.extra == ("minecraft:half_vertical_left",) and report.added == ()
    packs = open_packs([extra_pack])
    assert packs.patterns() == (*PATTERN_NAMES, "minecraft:half_vertical_left")
    assert packs.extra_sprites() == ("minecraft:half_vertical_left",)
    assert red(packs, "minecraft:half_vertical_left") == 2
    assert pattern_names(packs) == PATTERN_NAMES


def test_the_commands_draw_extra_sprites_too(
    drapery: Run, extra_pack: Path, tmp_path: Path
) -> None:
    for words in (
        ("packs", extra_pack, "-o", tmp_path / "a.html"),
        ("sheet", "patterns", "--pack", extra_pack, "--dyes", "red", "-o", tmp_path / "b.html"),
    ):
        code, out, err = drapery(*words)
        assert code == 0, err
        assert ("half_vertical_left" in out) == (words[0] == "packs")
        assert "half_vertical_left (extra)" in Path(words[-1]).read_text(encoding="utf-8")


@pytest.mark.parametrize(
    ("pack", "read", "words"),
    [
        ({"min_format": [98, 1], "max_format": [110, 3]}, 97, "98 to 110, read as 97"),
        ({"min_format": 69, "max_format": [75, 3]}, 75, "69 to 75, read as 75"),
        ({"pack_format": 34, "supported_formats": [18, 9999]}, 97, "18 to 9999, read as 97"),
        ({"pack_format": 34, "supported_formats": 34}, 34, "34"),
        ({"pack_format": 99}, 97, "99, read as 97"),
        ({"min_format": 97, "max_format": [97, 1]}, 97, "97"),
        ({"pack_format": 15}, 15, "15"),
    ],
)
def test_a_range_of_formats_is_shown_with_the_one_that_was_used(
    drapery: Run, tmp_path: Path, pack: dict[str, object], read: int, words: str
) -> None:
    path = folder_pack(tmp_path, {META: json.dumps({"pack": pack}), CREEPER: plain(1, 0, 0, 255)})
    assert open_packs([path]).packs[1].format == read
    code, out, _ = drapery("packs", path)
    (line,) = (line for line in out.splitlines() if line.startswith("  format "))
    assert code == 0 and line.split(maxsplit=1)[1] == words
    is_newer = words[:2] in ("98", "99")
    assert out.count(
        "only for formats after 97, the newest known here, and is read as that one"
    ) == (is_newer)
    noted = [line for line in open_packs([path]).warnings() if "only for formats after" in line]
    assert len(noted) == is_newer


def test_a_given_format_after_the_newest_is_said_once(tmp_path: Path) -> None:
    path = folder_pack(tmp_path, {META: mcmeta(46), CREEPER: plain(1, 0, 0, 255)})
    (line,) = open_packs([path, path], format=120).warnings()
    assert line == "format 120 is after 97, the newest known here, and is read as that one"


def test_overlays_of_a_pack_of_data_count_by_formats_of_data(tmp_path: Path) -> None:
    entry = {"directory": "newer", "min_format": 110, "max_format": 130}
    meta = {"pack": {"min_format": 94, "max_format": 130}, "overlays": {"entries": [entry]}}
    files = {
        META: json.dumps(meta),
        "data/g/banner_pattern/owl.json": '{"asset_id": "g:owl"}',
        "newer/data/g/banner_pattern/owl.json": '{"asset_id": "skull"}',
    }
    packs = open_packs([folder_pack(tmp_path, files)])
    assert (packs.sheet("g:owl") == packs.sheet("skull")).all() and packs.notes() == ()


OLD_SHIELD = ENTITY + "shield_base.png"
NEW_SHIELD = ENTITY + "shield/shield_base.png"


@pytest.mark.parametrize(
    ("format", "files", "red", "wrong"),
    [
        (46, {OLD_SHIELD: 1, NEW_SHIELD: 2}, 1, None),
        (84, {OLD_SHIELD: 1, NEW_SHIELD: 2}, 2, None),
        (46, {NEW_SHIELD: 2}, 2, NEW_SHIELD),
        (84, {OLD_SHIELD: 1}, 1, OLD_SHIELD),
        (None, {OLD_SHIELD: 1}, 1, None),
    ],
)
def test_a_pack_is_read_at_the_places_of_its_own_format(
    tmp_path: Path, format: int | None, files: dict[str, int], red: int, wrong: str | None
) -> None:
    meta = {} if format is None else {META: mcmeta(format)}
    sheets = {name: plain(number, 0, 0, 255) for name, number in files.items()}
    packs = open_packs([folder_pack(tmp_path, {**meta, **sheets})])
    assert packs.base("shield_base")[0, 0, 0] == red
    right = ({OLD_SHIELD, NEW_SHIELD} - {wrong}).pop()
    assert [wrong in line and right in line for line in packs.notes()] == [True] * bool(wrong)


def test_fields_of_formats_that_the_game_refuses_are_noted(tmp_path: Path) -> None:
    for number, (fields, word) in enumerate(
        (
            ({"min_format": 69, "max_format": 84, "supported_formats": [69, 84]}, "leave it out"),
            ({"min_format": 69}, "min_format stands alone"),
            ({"min_format": 34, "max_format": 84, "supported_formats": [34, 64]}, None),
        )
    ):
        path = tmp_path / str(number)
        files = {META: json.dumps({"pack": fields}), CREEPER: plain(1, 0, 0, 255)}
        lines = open_packs([folder_pack(path, files)]).notes()
        assert [word in line for line in lines if word] == [True] * (word is not None)


def test_the_table_of_formats_is_in_order() -> None:
    numbers = [each.number for each in PACK_FORMATS]
    dates = [each.date for each in PACK_FORMATS]
    assert numbers == sorted(set(numbers)) and dates == sorted(dates)
    assert {46: "1.21.4", 84: "26.1", 97: "26.3"}.items() <= {
        each.number: each.game for each in PACK_FORMATS
    }.items()


def test_a_given_format_is_shown_beside_the_packs_own(drapery: Run, tmp_path: Path) -> None:
    path = folder_pack(tmp_path, {META: mcmeta(46), CREEPER: plain(1, 0, 0, 255)})
    _, out, _ = drapery("packs", path, "--format", "15")
    assert "  format        46, read as 15\n" in out


def test_an_overlay_of_a_pack_for_newer_formats_counts(tmp_path: Path) -> None:
    overlay = {"directory": "newer", "min_format": 85, "max_format": 88}
    meta = {"pack": {"min_format": 85, "max_format": 88}, "overlays": {"entries": [overlay]}}
    files = {CREEPER: plain(1, 0, 0, 255), "newer/" + CREEPER: plain(2, 0, 0, 255)}
    path = folder_pack(tmp_path, {META: json.dumps(meta), **files})
    assert red(open_packs([path])) == 2


def test_a_description_of_text_components_is_plain_text(tmp_path: Path) -> None:
    parts = ["A ", {"text": "little\n", "color": "red", "extra": [{"text": "noise"}]}, ["!"]]
    meta = {"pack": {"pack_format": 46, "description": parts}}
    path = folder_pack(tmp_path, {META: json.dumps(meta), CREEPER: plain(1, 0, 0, 255)})
    assert describe_packs([path])[0].description == "A little noise!"


@pytest.mark.parametrize("command", ["--flat", "--size=20x24"])
def test_warnings_of_a_sheet_of_packs_name_their_pack(
    drapery: Run, tmp_path: Path, command: str
) -> None:
    for name in ("one", "two"):
        folder_pack(tmp_path / name, {META: mcmeta(46), BANNER + "base.png": plain(1, 1, 1, 255)})
    target = tmp_path / "sheet.png"
    packs = (tmp_path / "one", tmp_path / "two")
    code, _, err = drapery("sheet", "packs", "white creeper:red", *packs, "-o", target, command)
    lines = [line for line in err.splitlines() if "our own art" in line]
    assert code == 0 and len(lines) == 2
    for name, line in zip(("one", "two"), lines, strict=True):
        assert str(tmp_path / name) in line and "creeper" in line


@pytest.mark.parametrize("shape", [(64, 32), (32, 64), (48, 64), (7, 5)])
def test_a_sheet_that_is_not_square_is_stretched_as_in_the_game(
    tmp_path: Path, shape: tuple[int, int]
) -> None:
    texels = noise(3)[: shape[0], : shape[1]]
    files = {CREEPER: png(texels), ENTITY + "shield_base.png": png(texels)}
    packs = open_packs([folder_pack(tmp_path, files)])
    for sheet in (packs.sheet("creeper"), packs.base("shield_base")):
        side = len(sheet)
        assert sheet.shape == (side, side, 4) and side % shape[0] == side % shape[1] == 0
        tall = texels.repeat(side // shape[0], axis=0)
        assert (sheet == tall.repeat(side // shape[1], axis=1)).all()
    (line,) = (line for line in packs.warnings() if "creeper.png" in line)
    assert f"is {shape[1]} x {shape[0]} px" in line and "stretched" in line and "\n" not in line


def test_frames_that_are_not_square_are_stretched_one_at_a_time(tmp_path: Path) -> None:
    frames = np.zeros((8192, 512, 4), np.uint8)  # stretched together they take 8 GB
    frames[..., 3] = 255
    frames[1:, :, 0] = 7
    meta = json.dumps({"animation": {"width": 512, "height": 1}})
    files = {CREEPER: png(frames, compress_level=1), CREEPER + ".mcmeta": meta}
    packs = open_packs([folder_pack(tmp_path, files)])
    assert packs.sheet("creeper").shape == (512, 512, 4)
    assert packs.sheet("creeper", time=0.05)[5, 5, 0] == 7
    assert packs.sheet("creeper") is packs.sheet("creeper")


def test_maps_of_a_stretched_sheet_are_stretched_with_it(tmp_path: Path) -> None:
    wide = np.full((32, 64, 4), 128, np.uint8)
    files = {CREEPER: png(wide), BANNER + "creeper_n.png": png(wide)}
    packs = open_packs([folder_pack(tmp_path, files)])
    banner = Banner("white", (Layer("creeper", "red"),))
    with pytest.warns(UserWarning, match="stretched"):
        assert draw(banner, packs=packs, pbr=True, size=(20, 24)).pixels.any()


def back_sheet(colour: int) -> bytes:
    return png(np.full((32, 64, 4), (colour, 0, 0, 255), np.uint8))


SHORT: dict[str, dict[str, Any]] = {"cape": {"time": 0.5}, "elytra": {}}
"""A cape's cloth moves before its picture."""
OLD_WINGS, NEW_WINGS = ENTITY + "elytra.png", ENTITY + "equipment/wings/elytra.png"


@pytest.mark.parametrize(
    ("files", "format", "seen"),
    [
        ({OLD_WINGS: 40}, None, 40),
        ({NEW_WINGS: 90}, None, 90),
        ({OLD_WINGS: 40, NEW_WINGS: 90}, None, 90),
        ({OLD_WINGS: 40, NEW_WINGS: 90}, 34, 40),
    ],
)
@pytest.mark.parametrize("kind", ["elytra", "cape"])
def test_wings_and_capes_wear_the_packs_elytra(
    tmp_path: Path, files: dict[str, int], format: int | None, seen: int, kind: str
) -> None:
    path = folder_pack(tmp_path, {name: back_sheet(colour) for name, colour in files.items()})
    pixels = draw(
        kind=kind,  # type: ignore[arg-type]
        packs=path,
        format=format,
        light="flat",
        size=(30, 40),
        **SHORT[kind],
    ).pixels
    assert set(np.unique(pixels[pixels[..., 3] > 0, 0])) == {seen}


@pytest.mark.parametrize("size", [(16, 32), (24, 48), (128, 256)])
@pytest.mark.parametrize("kind", ["elytra", "cape"])
def test_sheets_of_wings_of_any_size_are_drawn(
    tmp_path: Path, size: tuple[int, int], kind: str
) -> None:
    sheet = png(np.full((*size, 4), (90, 0, 0, 255), np.uint8))
    path = folder_pack(tmp_path, {NEW_WINGS: sheet})
    assert describe_packs([path])[0].problems == ()
    small = {"kind": kind, "packs": path, "light": "flat", "size": (30, 40)} | SHORT[kind]
    pixels = draw(**small).pixels  # type: ignore[arg-type]
    assert set(np.unique(pixels[pixels[..., 3] > 0, 0])) == {90}


def test_a_given_texture_overrules_the_packs(tmp_path: Path) -> None:
    path = folder_pack(tmp_path, {NEW_WINGS: back_sheet(90)})
    given = np.full((32, 64, 4), 200, np.uint8)
    given[..., 3] = 255
    seen = draw(kind="elytra", packs=path, texture=given, light="flat", size=(30, 40)).pixels
    assert set(np.unique(seen[seen[..., 3] > 0, 0])) == {200}


def test_a_cape_is_not_drawn_from_wings_without_a_cape(drapery: Run, tmp_path: Path) -> None:
    wings = np.zeros((32, 64, 4), np.uint8)
    wings[:22, 22:46] = 200
    path = folder_pack(tmp_path, {NEW_WINGS: png(wings)})
    words = ("--pack", path, "-o", tmp_path / "a.png", "--size", "30x40")
    assert drapery("render", "--kind", "elytra", *words)[0] == 0
    code, _, err = drapery("render", "--kind", "cape", *words)
    assert code != 0 and "by texture" in err and "has no cape" in err


def test_without_texture_and_pack_the_error_names_both(drapery: Run, tmp_path: Path) -> None:
    code, _, err = drapery("render", "--kind", "elytra", "-o", tmp_path / "a.png")
    assert code != 0 and "by texture" in err and "a pack that has elytra.png" in err


@pytest.mark.parametrize("bits", [1, 2, 4, 8])
@pytest.mark.parametrize("clear", [None, 0, 1, bytes([0, 128])])
def test_quantised_palettes_are_read_bit_for_bit(bits: int, clear: int | bytes | None) -> None:
    colours = 1 << bits
    for seed in range(4):
        for method in (Image.Quantize.FASTOCTREE, Image.Quantize.MEDIANCUT):
            source = Image.fromarray(noise(seed))
            if method is Image.Quantize.MEDIANCUT:
                source = source.convert("RGB")
            file = BytesIO()
            options = {} if clear is None else {"transparency": clear}
            source.quantize(colours, method).save(file, "png", bits=bits, **options)
            data = file.getvalue()
            with Image.open(BytesIO(data)) as image:
                assert image.mode == "P"
                wanted = np.asarray(image.convert("RGBA"))
            assert (read_png(data, "a") == wanted).all()
