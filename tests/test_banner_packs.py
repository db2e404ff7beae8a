"""Packs lie over our art as in the game: order, overlays, places, atlases, definitions, masks."""

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from pack_maker import (
    BANNER,
    NEW_BASE,
    OLD_BASE,
    SHIELD,
    folder_pack,
    mcmeta,
    noise,
    plain,
    png,
    zip_pack,
)

from drapery.banner.contact import contact_sheet
from drapery.banner.design import Banner, Layer
from drapery.banner.dyes import DYES
from drapery.banner.pack_contents import describe_packs
from drapery.banner.packs import Packs, open_packs
from drapery.banner.patterns import PATTERN_NAMES
from drapery.banner.sprites import FLAG_REGIONS, composite, face, flag_layers, shield_layers
from drapery.errors import PackError

CREEPER = BANNER + "creeper.png"
META = "pack.mcmeta"
ATLAS = "assets/minecraft/atlases/banner_patterns.json"


def red(packs: Packs, pattern: str = "creeper", time: float = 0.0) -> int:
    """The first texel's red, by which the packs here number their files."""
    return int(packs.sheet(pattern, time=time)[0, 0, 0])


def sprites(*sources: dict[str, Any]) -> str:
    return json.dumps({"sources": sources})


# Order and containers


def test_without_packs_all_is_our_own_art() -> None:
    packs = open_packs()
    for pattern in PATTERN_NAMES:
        sheet = packs.sheet(pattern)
        assert sheet.shape == (64, 64, 4) and sheet.dtype == np.uint8
        assert sheet[..., 3].any(), pattern
    assert packs.base_sheet().shape == (64, 64, 4)
    assert packs.warnings() == ()
    assert packs.patterns() == PATTERN_NAMES


@pytest.mark.parametrize("make", [folder_pack, zip_pack])
@pytest.mark.parametrize("top", ["", "Pack v2 (1)/"])
def test_a_folder_and_a_zip_are_alike_also_in_one_top_folder(
    tmp_path: Path, make: Any, top: str
) -> None:
    files = {top + META: mcmeta(), top + CREEPER: plain(1, 0, 0, 255)}
    packs = open_packs([make(tmp_path / "pack.zip", files)])
    assert red(packs) == 1


def test_a_client_jar_says_its_format_in_version_json(tmp_path: Path) -> None:
    files = {
        "version.json": '{"name": "1.14.4", "pack_version": 4}',
        "net/minecraft/a.class": b"\xca\xfe",
        CREEPER: plain(1, 0, 0, 255),
    }
    (pack,) = open_packs([zip_pack(tmp_path / "1.14.4.jar", files)]).packs[1:]
    assert pack.format == 4 and pack.meta.description == "Minecraft 1.14.4"


def test_backslashes_of_old_tools_are_slashes(tmp_path: Path) -> None:
    path = zip_pack(tmp_path / "a.zip", {CREEPER.replace("/", "\\"): plain(7, 0, 0, 255)})
    assert red(open_packs([path])) == 7


def test_the_later_pack_wins_file_by_file(tmp_path: Path) -> None:
    a = folder_pack(
        tmp_path / "a", {CREEPER: plain(1, 0, 0, 255), BANNER + "skull.png": plain(2, 0, 0, 255)}
    )
    b = zip_pack(tmp_path / "b.zip", {CREEPER: plain(3, 0, 0, 255)})
    packs = open_packs([a, b])
    assert (red(packs), red(packs, "skull")) == (3, 2)
    assert red(open_packs([b, a])) == 1
    assert red(open_packs(str(b))) == 3


def test_files_are_read_once_and_only_when_asked_for(tmp_path: Path) -> None:
    path = folder_pack(tmp_path, {CREEPER: plain(1, 0, 0, 255), BANNER + "skull.png": b"broken"})
    packs = open_packs([path])
    assert packs.sheet("creeper") is packs.sheet("creeper")
    (tmp_path / CREEPER).unlink()
    assert red(packs) == 1
    with pytest.raises(PackError, match=r"skull\.png is not a PNG file"):
        packs.sheet("skull")


def test_any_texture_by_id(tmp_path: Path) -> None:
    stone = png(noise(1, 16))
    path = folder_pack(tmp_path, {"assets/minecraft/textures/block/stone.png": stone})
    packs = open_packs([path])
    assert (packs.texture("minecraft:block/stone") == noise(1, 16)).all()
    assert packs.texture("block/stone") is packs.texture("minecraft:block/stone")


# pack.mcmeta


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
        ({"pack_format": 18, "supported_formats": {"min_inclusive": 4, "max_inclusive": 9999}}, 84),
        ({"min_format": 69, "max_format": [75, 3]}, 75),
    ],
)
def test_by_default_a_pack_is_taken_at_its_newest(
    tmp_path: Path, pack: dict[str, Any], newest: int
) -> None:
    path = folder_pack(tmp_path, {META: json.dumps({"pack": pack}), CREEPER: plain(1, 0, 0, 255)})
    assert open_packs([path]).packs[1].format == newest
    assert open_packs([path], format=5).packs[1].format == 5


def test_a_byte_order_mark_and_raw_line_breaks_are_borne(tmp_path: Path) -> None:
    text = '\ufeff{"pack": {"pack_format": 9, "description": "two\nlines"}}'
    path = folder_pack(tmp_path, {META: text, CREEPER: plain(1, 0, 0, 255)})
    assert open_packs([path]).packs[1].format == 9


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
        ('{"pack": {"supported_formats": [1, 2, 3]}}', r"must be a number or two"),
        ('{"pack": {"min_format": [1, 2, 3]}}', r"must be a number or \[major, minor\]"),
        ('{"overlays": {"entries": {}}}', r"overlays\.entries must be a list"),
        ('{"overlays": {"entries": [{"directory": "a"}]}}', "overlay 0 must say its formats"),
        ('{"overlays": {"entries": [{"directory": "../b", "formats": 4}]}}', "must be a name"),
        ('{"overlays": {"entries": [{"directory": "..", "formats": 4}]}}', "must be a name"),
        ('{"filter": {"block": [{"path": "("}]}}', "is no regular expression"),
        ('{"filter": {"block": [{"path": "(a+)+b"}]}}', "could search for hours"),
        ('{"filter": {"block": [{"path": ".*.*.*.*x"}]}}', "could search for hours"),
        ("[" * 100_000, "nested too deep"),
        ('{"pack": {"pack_format": ' + "9" * 5000 + "}}", "too long a number"),
        (b"\xff\xfe{", "is not UTF-8"),
        (b" " * (1 << 20) + b"{}", r"pack\.mcmeta is over 1048576 bytes"),
    ],
)
def test_broken_pack_mcmeta_is_named(tmp_path: Path, meta: str | bytes, message: str) -> None:
    path = folder_pack(tmp_path / "a", {META: meta, CREEPER: plain(1, 0, 0, 255)})
    with pytest.raises(PackError, match=message) as caught:
        open_packs([path])
    assert "\n" not in str(caught.value) and "pack.mcmeta" in str(caught.value)


# Custom patterns and atlases


def test_a_data_pack_names_the_texture_of_its_patterns(tmp_path: Path) -> None:
    data = zip_pack(
        tmp_path / "data.zip",
        {
            META: mcmeta(48),
            "data/guild/banner_pattern/owl.json": '{"asset_id": "guild:birds/owl"}',
            "data/minecraft/banner_pattern/creeper.json": '{"asset_id": "skull"}',
        },
    )
    art = folder_pack(
        tmp_path / "art",
        {
            "assets/guild/textures/entity/banner/birds/owl.png": plain(9, 0, 0, 255),
            BANNER + "skull.png": plain(5, 0, 0, 255),
        },
    )
    packs = open_packs([data, art])
    assert red(packs, "guild:owl") == red(packs, "guild:birds/owl") == 9
    assert red(packs, "creeper") == 5
    assert set(packs.patterns()) - set(PATTERN_NAMES) == {"guild:owl", "guild:birds/owl"}
    assert packs.warnings() == ()


@pytest.mark.parametrize(
    "definition",
    ["{}", "[]", '{"asset_id": 3}', '{"asset_id": "../../etc/passwd"}', '{"asset_id": "A b"}'],
)
def test_broken_definitions_are_named(tmp_path: Path, definition: str) -> None:
    path = folder_pack(tmp_path, {"data/g/banner_pattern/owl.json": definition})
    with pytest.raises(PackError, match=r"data/g/banner_pattern/owl\.json"):
        open_packs([path]).sheet("g:owl")


def test_maps_and_the_base_are_no_patterns(tmp_path: Path) -> None:
    names = ("creeper", "creeper_n", "creeper_s", "banner_base", "banner_base_n", "own", "own_s")
    files = {f"{BANNER}{name}.png": plain(1, 0, 0, 255) for name in names}
    packs = open_packs([folder_pack(tmp_path, files)])
    assert set(packs.patterns()) - set(PATTERN_NAMES) == {"minecraft:own"}


def test_an_atlas_leads_sprites_to_other_folders(tmp_path: Path) -> None:
    files = {
        ATLAS: sprites(
            {"type": "single", "resource": "a:odd/place", "sprite": "a:entity/banner/odd"},
            {"type": "minecraft:directory", "source": "flags", "prefix": "entity/banner/"},
        ),
        "assets/a/textures/odd/place.png": plain(1, 0, 0, 255),
        "assets/a/textures/flags/far.png": plain(2, 0, 0, 255),
        "assets/minecraft/textures/flags/skull.png": plain(3, 0, 0, 255),
        BANNER + "skull.png": plain(4, 0, 0, 255),
        CREEPER: plain(5, 0, 0, 255),
    }
    packs = open_packs([folder_pack(tmp_path, files)])
    found = [red(packs, name) for name in ("a:odd", "a:far", "skull", "creeper")]
    assert found == [1, 2, 3, 5], "the later source wins, and what is not there is passed over"


def test_a_filter_takes_away_what_came_before_it(tmp_path: Path) -> None:
    files = {
        ATLAS: sprites(
            {"type": "filter", "pattern": {"path": "banner/(creeper|skull)$"}},
            {"type": "single", "resource": "entity/banner/skull"},
        ),
        CREEPER: plain(1, 0, 0, 255),
        BANNER + "skull.png": plain(2, 0, 0, 255),
    }
    packs = open_packs([folder_pack(tmp_path, files)])
    assert packs.level("creeper") is None
    assert red(packs, "skull") == 2


def test_unknown_sources_are_told_once(tmp_path: Path) -> None:
    source = {"type": "paletted_permutations", "textures": []}
    path = folder_pack(tmp_path, {ATLAS: sprites(source, source), CREEPER: plain(1, 0, 0, 255)})
    packs = open_packs([path])
    packs.sheet("creeper"), packs.sheet("creeper")
    (line,) = packs.warnings()
    assert "paletted_permutations" in line and "banner_patterns.json" in line


@pytest.mark.parametrize(
    "atlas",
    [
        "{}",
        '{"sources": [3]}',
        sprites({"type": "single"}),
        sprites({"type": "directory", "source": "a"}),
    ],
)
def test_broken_atlases_are_named(tmp_path: Path, atlas: str) -> None:
    path = folder_pack(tmp_path, {ATLAS: atlas})
    with pytest.raises(PackError, match=r"atlases/banner_patterns\.json"):
        open_packs([path]).sheet("creeper")


@pytest.mark.parametrize(
    "name", ["../x", "a:../../x", "a:b:c", "Überall", "a: b", "x" * 200, "", "a:"]
)
def test_names_that_are_no_ids_are_refused(name: str) -> None:
    with pytest.raises(PackError, match="is no id"):
        open_packs().sheet(name)


# What is missing


def test_a_missing_sprite_is_the_games_checker_and_is_told(tmp_path: Path) -> None:
    packs = open_packs()
    sheet = packs.sheet("guild:owl")
    assert sheet[0, 0].tolist() == sheet[15, 15].tolist() == [0, 0, 0, 255]
    assert sheet[0, 15].tolist() == sheet[15, 0].tolist() == [0xF8, 0, 0xF8, 255]
    packs.texture("block/nothing"), packs.sheet("guild:owl")
    (line,) = packs.warnings()
    assert "guild:owl" in line and "minecraft:block/nothing" in line and line.count("owl") == 1


def test_what_falls_back_to_our_art_is_told_in_one_line(tmp_path: Path) -> None:
    packs = open_packs([folder_pack(tmp_path, {CREEPER: plain(1, 0, 0, 255)})])
    for pattern in ("creeper", "flow", "guster", "flow"):
        packs.sheet(pattern)
    (line,) = packs.warnings()
    assert line.endswith("flow, guster")
    assert (packs.sheet("flow") == open_packs().sheet("flow")).all()


def test_a_pack_that_gives_nothing_is_told(tmp_path: Path) -> None:
    path = folder_pack(
        tmp_path / "blocks", {"assets/minecraft/textures/block/dirt.png": plain(1, 1, 1, 1)}
    )
    packs = open_packs([path])
    assert packs.warnings() == ()
    packs.sheet("creeper")
    (line,) = packs.warnings()
    assert "blocks" in line


# Sizes, animations, masks, maps


def test_sizes_from_8_to_512_mix_in_one_design(tmp_path: Path) -> None:
    sides = {"base": 8, "creeper": 16, "skull": 32, "flower": 128, "globe": 256, "cross": 512}
    files = {f"{BANNER}{name}.png": png(noise(n, n)) for name, n in sides.items()}
    packs = open_packs([folder_pack(tmp_path, files)])
    banner = Banner("white", tuple(Layer(name, "red") for name in list(sides)[1:]))
    assert composite(flag_layers(banner, packs)).shape == (512, 512, 4)
    assert face(banner, packs).shape == (320, 160, 4)


@pytest.mark.parametrize(
    ("shape", "message"),
    [((64, 32), "is 32 x 64 px; a sheet is square"), ((513, 513), "at most 512")],
)
def test_sheets_of_other_shapes_are_refused(
    tmp_path: Path, shape: tuple[int, int], message: str
) -> None:
    wrong = png(np.zeros((*shape, 4), np.uint8))
    packs = open_packs([folder_pack(tmp_path, {CREEPER: wrong, NEW_BASE: wrong})])
    for ask in (lambda: packs.sheet("creeper"), packs.base_sheet):
        with pytest.raises(PackError, match=message):
            ask()


def strip(*reds: int) -> bytes:
    """A texture of frames 8 x 8 one under the other."""
    frames = [np.full((8, 8, 4), (r, 0, 0, 255), np.uint8) for r in reds]
    return png(np.concatenate(frames))


@pytest.mark.parametrize(
    ("animation", "seen", "period"),
    [
        ({}, [1, 2, 3, 1], 3),
        ({"frametime": 2}, [1, 1, 2, 2, 3, 3, 1], 6),
        ({"frames": [2, 0]}, [3, 1, 3, 1], 2),
        ({"frames": [0, {"index": 2, "time": 3}], "frametime": 1}, [1, 3, 3, 3, 1], 4),
        ({"width": 8, "height": 8, "interpolate": True}, [1, 2, 3], 3),
    ],
)
def test_animations_show_the_frame_of_the_time(
    tmp_path: Path, animation: dict[str, Any], seen: list[int], period: int
) -> None:
    meta = json.dumps({"animation": animation})
    files = {CREEPER: strip(1, 2, 3), CREEPER + ".mcmeta": meta}
    packs = open_packs([folder_pack(tmp_path, files)])
    assert [red(packs, time=tick / 20) for tick in range(len(seen))] == seen
    assert packs.period("creeper") == pytest.approx(period / 20)
    assert packs.period("skull") == 0
    assert packs.sheet("creeper").shape == (8, 8, 4)


def test_frames_may_lie_side_by_side(tmp_path: Path) -> None:
    quarters = np.arange(4, dtype=np.uint8).reshape(2, 2).repeat(8, 0).repeat(8, 1)
    texels = np.stack([quarters, quarters, quarters, np.full_like(quarters, 255)], -1)
    meta = '{"animation": {"width": 8, "height": 8}}'
    packs = open_packs([folder_pack(tmp_path, {CREEPER: png(texels), CREEPER + ".mcmeta": meta})])
    assert [red(packs, time=tick / 20) for tick in range(4)] == [0, 1, 2, 3]


@pytest.mark.parametrize(
    "meta",
    [
        '{"animation": 3}',
        '{"animation": {"frames": [3]}}',
        '{"animation": {"frametime": 0}}',
        '{"animation": {"height": 7}}',
        '{"animation": {"frames": [true]}}',
        "{",
    ],
)
def test_broken_animations_are_named(tmp_path: Path, meta: str) -> None:
    files = {CREEPER: strip(1, 2, 3), CREEPER + ".mcmeta": meta}
    packs = open_packs([folder_pack(tmp_path, files)])
    with pytest.raises(PackError, match=r"creeper\.png\.mcmeta"):
        packs.sheet("creeper")


def test_masks_of_old_packs_show_the_base_in_the_dye(tmp_path: Path) -> None:
    mask = np.zeros((64, 64, 4), np.uint8)
    mask[..., 3] = 255
    mask[1:21, :, :3] = 255
    mask[21:41, :, :3] = 100
    base = noise(1)
    base[..., 3] = 255
    files = {META: mcmeta(4), CREEPER: png(mask), OLD_BASE: png(base)}
    path = folder_pack(tmp_path, files)
    sheet = open_packs([path]).sheet("creeper")
    assert (sheet[..., :3] == base[..., :3]).all()
    assert (sheet[..., 3] == mask[..., 0]).all()
    assert (open_packs([path], format=46).sheet("creeper") == mask).all()


def test_what_is_a_mask(tmp_path: Path) -> None:
    cut, grey = noise(2), np.full((64, 64, 4), 255, np.uint8)
    cut[..., 3] = np.where(cut[..., 3] > 128, 255, 0)
    grey[..., :3] = np.arange(64)[:, None, None] * 255 // 63
    sheets = {"creeper": grey, "skull": np.full_like(grey, 128), "globe": cut, "cross": cut | 255}
    files = {f"{BANNER}{name}.png": png(sheet) for name, sheet in sheets.items()}

    def masks(meta: dict[str, bytes], folder: str) -> list[str]:
        packs = open_packs([folder_pack(tmp_path / folder, files | meta)])
        return [n for n in sheets if (packs.sheet(n)[..., 3] != sheets[n][..., 3]).any()]

    assert masks({META: mcmeta(5)}, "new") == []
    assert masks({}, "unknown") == ["creeper"]
    assert masks({META: mcmeta(4)}, "old") == ["creeper", "globe"]


def test_a_mask_and_a_base_of_other_sizes_meet(tmp_path: Path) -> None:
    files = {
        META: mcmeta(3),
        CREEPER: plain(255, 255, 255, 255, side=16),
        OLD_BASE: png(noise(1, 24)),
    }
    sheet = open_packs([folder_pack(tmp_path, files)]).sheet("creeper")
    assert (sheet[..., :3] == noise(1, 24).repeat(2, 0).repeat(2, 1)[..., :3]).all()


def test_our_art_is_never_a_mask() -> None:
    assert (open_packs(format=4).sheet("creeper") == open_packs().sheet("creeper")).all()


def test_maps_come_from_the_pack_of_the_sheet_or_above(tmp_path: Path) -> None:
    a = folder_pack(
        tmp_path / "a",
        {
            CREEPER: plain(1, 0, 0, 255),
            BANNER + "creeper_n.png": plain(128, 128, 255, 10),
            BANNER + "creeper_s.png": plain(200, 4, 0, 255, side=16),
            OLD_BASE: plain(1, 1, 1, 255),
            OLD_BASE.replace(".png", "_n.png"): plain(3, 3, 3, 3),
        },
    )
    b = folder_pack(tmp_path / "b", {CREEPER: plain(2, 0, 0, 255)})
    c = folder_pack(tmp_path / "c", {BANNER + "creeper_n.png": plain(9, 9, 9, 9)})
    packs = open_packs([a])
    normal, specular, base = (
        packs.normal_map("creeper"),
        packs.specular_map("creeper"),
        packs.base_normal_map(),
    )
    assert normal is not None and normal[0, 0].tolist() == [128, 128, 255, 10]
    assert specular is not None and specular.shape == (16, 16, 4)
    assert base is not None and base[0, 0].tolist() == [3, 3, 3, 3]
    assert packs.base_specular_map() is None and packs.normal_map("skull") is None
    assert open_packs([a, b]).normal_map("creeper") is None
    above = open_packs([a, b, c]).normal_map("creeper")
    assert above is not None and above[0, 0].tolist() == [9, 9, 9, 9]


def test_shields_have_sheets_of_their_own(tmp_path: Path) -> None:
    shield = "assets/minecraft/textures/entity/"
    files = {
        SHIELD + "base.png": plain(255, 255, 255, 0),
        SHIELD + "creeper.png": plain(255, 0, 0, 255),
        shield + "shield_base.png": plain(40, 50, 60, 255),
        shield + "shield_base_nopattern.png": plain(70, 80, 90, 255),
    }
    packs = open_packs([folder_pack(tmp_path, files)])
    bare = composite(shield_layers(Banner("red"), packs))
    assert (bare == (40, 50, 60, 255)).all()
    charged = composite(shield_layers(Banner("red", (Layer("creeper", "lime"),)), packs))
    assert (charged == (DYES["lime"].rgb[0], 0, 0, 255)).all(), charged[0, 0]
    assert (composite(shield_layers(None, packs)) == (70, 80, 90, 255)).all()


# Reports


def test_a_report_says_what_a_pack_has_lacks_and_overrides(tmp_path: Path) -> None:
    entry = {"directory": "new", "formats": 46}
    low = folder_pack(tmp_path / "low", {CREEPER: plain(1, 0, 0, 255)})
    files = {
        META: mcmeta(46, overlays={"entries": [entry]}),
        CREEPER: strip(1, 2),
        CREEPER + ".mcmeta": '{"animation": {}}',
        BANNER + "creeper_n.png": plain(1, 1, 1, 1),
        "new/" + BANNER + "skull.png": plain(1, 1, 1, 200),
        BANNER + "flower.png": b"no picture",
        NEW_BASE: plain(1, 1, 1, 255),
        "assets/g/textures/entity/banner/owl.png": plain(1, 1, 1, 1, side=32),
    }
    report_low, report = describe_packs([low, zip_pack(tmp_path / "top.zip", files)])
    assert report_low.has == ("creeper",) and len(report_low.lacks) == 42
    assert set(report.has) == {"creeper", "skull", "flower"}
    assert not set(report.has) & set(report.lacks) and len(report.has + report.lacks) == 43
    assert report.added == ("g:owl",) and report.bases == ("banner_base",)
    assert report.overrides == (("creeper", str(low)),)
    assert report.sides == ((8, 1), (32, 1), (64, 1))
    assert report.normal_maps == report.animated == ("creeper",)
    assert report.format == 46 and report.overlays == ("new",) and report.description == "a test"
    (problem,) = report.problems
    assert "flower.png is not a PNG file" in problem


def test_the_contact_sheet_shows_every_pattern(tmp_path: Path) -> None:
    plain_sheet = contact_sheet(open_packs())
    assert plain_sheet.shape == (4 * 174, 11 * 96, 4) and (plain_sheet[..., 3] == 255).all()
    path = folder_pack(tmp_path, {CREEPER: plain(255, 255, 255, 255, side=128)})
    changed = (contact_sheet(open_packs([path])) != plain_sheet).any(axis=2)
    number = PATTERN_NAMES.index("creeper")
    rows, columns = np.nonzero(changed)
    assert set(rows // 174 * 11 + columns // 96) == {number}


# The real pack


def test_the_real_pack_renders_front_back_and_edges(real_pack: Path) -> None:
    packs, ours = open_packs([real_pack]), open_packs()
    for pattern in PATTERN_NAMES:
        sheet = packs.sheet(pattern)
        assert sheet.shape == (64, 64, 4)
        is_own = pattern in ("flow", "guster")
        assert (packs.level(pattern) == 0) == is_own
        assert (sheet == ours.sheet(pattern)).all() == is_own
        flag = composite(flag_layers(Banner("white", (Layer(pattern, "red"),)), packs))
        plain_flag = composite(flag_layers(Banner("white"), packs))
        for side in ("front", "back"):
            region = FLAG_REGIONS[side]
            assert (region.crop(flag) != region.crop(plain_flag)).any(), (pattern, side)
    for name, region in FLAG_REGIONS.items():
        white = region.crop(composite(flag_layers(Banner("white"), packs)))
        red_cloth = region.crop(composite(flag_layers(Banner("red"), packs)))
        assert (white != red_cloth).any(axis=2).mean() > 0.9, name
    (line,) = packs.warnings()
    assert line.endswith("flow, guster")


def test_the_real_packs_report(real_pack: Path) -> None:
    (report,) = describe_packs([real_pack])
    assert report.lacks == ("flow", "guster") and len(report.shields) == 41
    assert report.sides == ((64, 41),) and report.problems == () and report.format == 6
    assert report.bases == ("banner_base", "shield_base", "shield_base_nopattern")


def test_masks_left_over_in_the_real_packs_shields_are_told(real_pack: Path) -> None:
    packs = open_packs([real_pack])
    packs.sheet("creeper", "shield")
    assert "creeper (shield)" in packs.warnings()[0] and "black" in packs.warnings()[0]
    old = open_packs([real_pack], format=4)
    assert (old.sheet("creeper", "shield")[..., 3] == 0).mean() > 0.9
    assert old.warnings() == ()
