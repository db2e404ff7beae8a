"""`pack.mcmeta` chooses overlays and hides files; a broken one is named."""

import json
from pathlib import Path
from typing import Any

import pytest
from pack_maker import (
    BANNER,
    CREEPER,
    META,
    folder_pack,
    mcmeta,
    plain,
    red,
    zip_pack,
)

from drapery.banner.packs import open_packs
from drapery.errors import PackError

OVERLAYS = [
    ({"formats": 46}, {46}),
    ({"formats": [34, 46]}, {34, 40, 46}),
    ({"formats": {"min_inclusive": 34, "max_inclusive": 46}}, {34, 40, 46}),
    ({"min_format": 69, "max_format": 75}, {69, 75}),
    ({"min_format": [75, 1], "max_format": [80, 0]}, {75, 80}),
    ({"min_format": [75], "max_format": 75}, {75}),
    ({"formats": [18, 34], "min_format": 40, "max_format": 46}, {40, 46}),
]


@pytest.mark.parametrize(("formats", "inside"), OVERLAYS)
def test_overlays_count_in_their_formats(
    tmp_path: Path, formats: dict[str, Any], inside: set[int]
) -> None:
    entry = {"directory": "newer", **formats}
    files = {
        META: mcmeta(18, overlays={"entries": [entry]}),
        CREEPER: plain(1, 0, 0, 255),
        "newer/" + CREEPER: plain(2, 0, 0, 255),
    }
    path = folder_pack(tmp_path, files)
    for number in (17, 34, 40, 46, 69, 75, 80, 84):
        assert red(open_packs([path], format=number)) == (2 if number in inside else 1)


def test_later_overlays_lie_over_earlier_ones(tmp_path: Path) -> None:
    entries = [{"directory": d, "formats": [18, 99]} for d in ("one", "two")]
    files = {
        META: mcmeta(34, overlays={"entries": entries}),
        CREEPER: plain(1, 0, 0, 255),
        "one/" + CREEPER: plain(2, 0, 0, 255),
        "two/" + CREEPER: plain(3, 0, 0, 255),
        "one/" + BANNER + "skull.png": plain(4, 0, 0, 255),
    }
    packs = open_packs([zip_pack(tmp_path / "a.zip", files)])
    assert (red(packs), red(packs, "skull")) == (3, 4)


@pytest.mark.parametrize(
    ("pack", "newest"),
    [
        ({"pack_format": 18}, 18),
        ({"pack_format": 18, "supported_formats": [18, 46]}, 46),
        ({"pack_format": 18, "supported_formats": {"min_inclusive": 4, "max_inclusive": 9999}}, 97),
        ({"min_format": 69, "max_format": [75, 3]}, 75),
    ],
)
def test_by_default_a_pack_is_taken_at_its_newest(
    tmp_path: Path, pack: dict[str, Any], newest: int
) -> None:
    path = folder_pack(tmp_path, {META: json.dumps({"pack": pack}), CREEPER: plain(1, 0, 0, 255)})
    assert open_packs([path]).packs[1].format == newest
    assert open_packs([path], format=5).packs[1].format == 5


def test_a_byte_order_mark_and_raw_line_breaks_are_accepted(tmp_path: Path) -> None:
    text = '\ufeff{"pack": {"pack_format": 9, "description": "§ltwo\n lines\u001b[2J"}}'
    path = folder_pack(tmp_path, {META: text, CREEPER: plain(1, 0, 0, 255)})
    pack = open_packs([path]).packs[1]
    assert pack.format == 9 and pack.meta.description == "two lines[2J"


def test_a_pack_may_hide_files_below_it(tmp_path: Path) -> None:
    a = folder_pack(
        tmp_path / "a", {CREEPER: plain(1, 0, 0, 255), BANNER + "skull.png": plain(2, 0, 0, 255)}
    )
    block = {"namespace": "minecraft", "path": "banner/creeper"}
    b = folder_pack(tmp_path / "b", {META: mcmeta(filter={"block": [block]}), "assets/x": ""})
    packs = open_packs([a, b])
    assert red(packs, "skull") == 2
    assert packs.sheet("creeper").shape == (16, 16, 4)
    assert "creeper" in packs.warnings()[0]


@pytest.mark.parametrize(
    ("meta", "message"),
    [
        ("{", r"a: pack\.mcmeta, line 1, column 2"),
        ("[]", "'pack' must be an object"),
        ('{"pack": 3}', "'pack' must be an object"),
        ('{"pack": {"pack_format": "six"}}', "pack_format must be a number"),
        ('{"pack": {"pack_format": true}}', "pack_format must be a number"),
        ('{"pack": {"supported_formats": [1, 2, 3]}}', r"must be a number or \[lowest, highest\]"),
        ('{"pack": {"min_format": [1, 2, 3]}}', r"must be a number or \[major, minor\]"),
        ('{"overlays": {"entries": {}}}', r"overlays\.entries must be a list"),
        ('{"overlays": {"entries": [{"directory": "a"}]}}', "overlay 0 must have formats"),
        ('{"overlays": {"entries": [{"directory": "../b", "formats": 4}]}}', "must be a name"),
        ('{"overlays": {"entries": [{"directory": "..", "formats": 4}]}}', "must be a name"),
        ('{"filter": {"block": [{"path": "("}]}}', "is not a regular expression"),
        ('{"filter": {"block": [{"path": "(a+)+b"}]}}', "could search for hours"),
        ('{"filter": {"block": [{"path": ".*.*.*.*x"}]}}', "could search for hours"),
        ("[" * 100_000, "nested too deep"),
        ('{"pack": {"pack_format": ' + "9" * 5000 + "}}", "a number with too many digits"),
        (b"\xff\xfe{", "is not UTF-8"),
        (b" " * (1 << 20) + b"{}", r"pack\.mcmeta is over 1048576 bytes"),
    ],
)
def test_broken_pack_mcmeta_is_named(tmp_path: Path, meta: str | bytes, message: str) -> None:
    path = folder_pack(tmp_path / "a", {META: meta, CREEPER: plain(1, 0, 0, 255)})
    with pytest.raises(PackError, match=message) as caught:
        open_packs([path])
    assert "\n" not in str(caught.value) and "pack.mcmeta" in str(caught.value)


LONG = "x" * 900_000
MANY = [1] * 300_000


@pytest.mark.parametrize(
    "value", [LONG, MANY, {"min_inclusive": LONG}, [LONG, 1], 1e308, LONG[:99]]
)
@pytest.mark.parametrize("key", ["pack_format", "supported_formats", "min_format", "max_format"])
def test_an_error_is_short_whatever_a_pack_says(tmp_path: Path, key: str, value: object) -> None:
    path = folder_pack(tmp_path / "a", {META: json.dumps({"pack": {key: value}})})
    with pytest.raises(PackError) as caught:
        open_packs([path])
    assert len(str(caught.value)) < 300 + len(str(path)) and "\n" not in str(caught.value)


def test_errors_and_warnings_of_the_other_files_are_short(tmp_path: Path) -> None:
    overlays = {"entries": [{"directory": LONG, "formats": 4}]}
    animation = {"animation": {"frames": [LONG], "frametime": 1}}
    source = {"type": LONG[:400_000]}
    atlas = "assets/minecraft/atlases/banner_patterns.json"
    for number, wrong in enumerate((animation, {"animation": {"width": LONG}})):
        files = {CREEPER: plain(1, 1, 1, 1), CREEPER + ".mcmeta": json.dumps(wrong)}
        path = folder_pack(tmp_path / f"frames{number}", files)
        packs = open_packs([path])
        packs.sheet("creeper")
        assert all(len(line) < 400 + len(str(path)) for line in packs.warnings())
    for name, files in {
        "overlay": {META: mcmeta(overlays=overlays)},
        "asset": {"data/minecraft/banner_pattern/creeper.json": json.dumps({"asset_id": LONG})},
    }.items():
        path = folder_pack(tmp_path / name, {"assets/x": "", **files})
        with pytest.raises(PackError) as caught:
            open_packs([path]).sheet("creeper")
        assert len(str(caught.value)) < 400 + len(str(path)), name
    kinds = [{"type": f"{number}{LONG[:100]}"} for number in range(4000)]
    path = folder_pack(tmp_path / "atlas", {atlas: json.dumps({"sources": [source, *kinds]})})
    packs = open_packs([path])
    packs.sheet("creeper")
    (line,) = (line for line in packs.warnings() if "not read" in line)
    assert len(line) < 800 + len(str(path)) and "and 3996 more" in line
