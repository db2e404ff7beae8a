"""What `drapery packs` says of a damaged or misnamed file, and that pictures agree with it."""

import json
from collections.abc import Callable, Mapping
from pathlib import Path
from types import MappingProxyType
from typing import NamedTuple

import numpy as np
import pytest
from conftest import Run
from pack_maker import BANNER, CREEPER, META, SHIELD, folder_pack, mcmeta, plain, png, strip

from drapery.banner.packs.contents import PackReport, describe_packs
from drapery.banner.packs.versions import NEWEST_FORMAT
from drapery.banner.patterns import PATTERN_NAMES

TEXTURES = "assets/minecraft/textures/"
ARMOR = f"{TEXTURES}entity/equipment/humanoid/"
LEGGINGS = f"{TEXTURES}entity/equipment/humanoid_leggings/"
SHIELD_BASE = f"{SHIELD}shield_base.png"
NAMES = ("creeper", "skull", "flower")

Files = dict[str, bytes | str]
ARMED = {
    ARMOR + "iron.png": png(np.full((32, 64, 4), (9, 9, 9, 255), np.uint8)),
    LEGGINGS + "iron.png": png(np.full((32, 64, 4), (9, 9, 9, 255), np.uint8)),
    f"{TEXTURES}trims/entity/humanoid/coast.png": plain(1, 1, 1, 255),
    f"{TEXTURES}trims/entity/humanoid_leggings/coast.png": plain(1, 1, 1, 255),
    f"{TEXTURES}palettes/trim_base.png": png(np.full((1, 4, 4), 255, np.uint8)),
    f"{TEXTURES}palettes/trim/gold.png": png(np.full((1, 4, 4), 99, np.uint8)),
}
"""A suit of armour with a trim."""


class Texture(NamedTuple):
    """A kind of texture of a pack: a file that a picture needs, and the words of its command."""

    file: str
    words: tuple[str, ...]
    others: Mapping[str, bytes | str] = MappingProxyType({})
    lies_missing: bool = False
    """Whether a picture without the file is refused, since our own art has none."""


GARMENT = """
[[piece]]
name = "flag"
size = [4, 4]
points = [2, 2]
texture = {pack = "minecraft:item/red_dye"}
"""

KINDS = {
    "banner": Texture(CREEPER, ("render", "white creeper:lime", "--pose", "vanilla")),
    "shield": Texture(SHIELD + "creeper.png", ("render", "white creeper:lime", "--kind", "shield")),
    "base": Texture(BANNER + "banner_base.png", ("render", "white", "--pose", "vanilla")),
    "shield base": Texture(SHIELD_BASE, ("render", "white", "--kind", "shield")),
    "normal map": Texture(
        BANNER + "creeper_n.png",
        ("render", "white creeper:lime", "--pbr", "--pose", "vanilla"),
        {CREEPER: plain(9, 9, 9, 99)},
    ),
    "base's normal map": Texture(
        BANNER + "banner_base_n.png",
        ("render", "white", "--pbr", "--pose", "vanilla"),
        {BANNER + "banner_base.png": plain(9, 9, 9, 255)},
    ),
    "armour": Texture(
        ARMOR + "iron.png",
        ("player", "--armor", "iron", "--motion", "stand"),
        ARMED,
        lies_missing=True,
    ),
    "trim": Texture(
        f"{TEXTURES}trims/entity/humanoid/coast.png",
        ("player", "--armor", "iron", "--trim", "coast:gold", "--motion", "stand"),
        ARMED,
        lies_missing=True,
    ),
    "palette": Texture(
        f"{TEXTURES}palettes/trim/gold.png",
        ("player", "--armor", "iron", "--trim", "coast:gold", "--motion", "stand"),
        ARMED,
        lies_missing=True,
    ),
    "wings": Texture(
        f"{TEXTURES}entity/equipment/wings/elytra.png",
        ("render", "--kind", "elytra"),
        lies_missing=True,
    ),
    "item icon": Texture(f"{TEXTURES}item/red_dye.png", ("garment", "item.toml")),
}


def sound(kind: Texture) -> bytes:
    """A sound file of the kind, with a text in it."""
    given = kind.others.get(kind.file)
    wings = kind.file.endswith("elytra.png")
    size = (32, 64) if wings else (64, 64)
    data = given if isinstance(given, bytes) else png(np.full((*size, 4), (9, 9, 9, 99), np.uint8))
    return data[:33] + b"\0\0\0\1tEXtx" + b"\x46\xbe\xbb\x3c" + data[33:]


def flipped(data: bytes, at: int) -> bytes:
    changed = bytearray(data)
    changed[at] ^= 1
    return bytes(changed)


def other_size(kind: Texture, size: tuple[int, int]) -> bytes:
    return png(np.full((*size, 4), (9, 9, 9, 99), np.uint8), compress_level=1)


DAMAGE: dict[str, Callable[[Texture], bytes]] = {
    "sound": sound,
    "cut in its header": lambda kind: sound(kind)[:20],
    "cut in its texels": lambda kind: sound(kind)[: sound(kind).index(b"IDAT") + 10],
    "empty": lambda kind: b"",
    "no picture": lambda kind: b"version https://git-lfs.github.com/spec/v1\n" * 3,
    "wrong checksum of the header": lambda kind: flipped(sound(kind), 29),
    "wrong checksum of texels": lambda kind: flipped(sound(kind), -13),
    "wrong checksum of a text": lambda kind: flipped(sound(kind), 45),
    "wrong texels": lambda kind: flipped(sound(kind), sound(kind).index(b"IDAT") + 4),
    "too large": lambda kind: other_size(kind, (1, 8193)),
    "not square": lambda kind: other_size(kind, (16, 48)),
    "large": lambda kind: other_size(kind, (2, 2050)),
    "without alpha": lambda kind: png(np.full((32, 64, 3), 9, np.uint8)),
    "grey": lambda kind: png(np.full((32, 64), 9, np.uint8)),
}
SAID = {
    "cut in its header": "is not a PNG file",
    "cut in its texels": "is a broken PNG file",
    "empty": "is not a PNG file",
    "no picture": "is not a PNG file",
    "wrong checksum of the header": "is a broken PNG file",
    "wrong checksum of texels": "wrong checksums",
    "wrong checksum of a text": "wrong checksums",
    "wrong texels": "is a broken PNG file",
    "too large": "is 8193 x 1 px",
}
"""Words that `drapery packs` says of a damage, whatever the texture."""


def pack_of(path: Path, kind: Texture, data: bytes | None, name: str | None = None) -> Path:
    files: Files = {META: mcmeta(NEWEST_FORMAT), **kind.others}
    files.pop(kind.file, None)
    if data is not None:
        files[name or kind.file] = data
    return folder_pack(path / "pack", {"assets/x": "", **files})


def draws(drapery: Run, path: Path, kind: Texture) -> tuple[int, str]:
    """The exit code and the errors of a picture that needs the texture."""
    (path / "item.toml").write_text(GARMENT, encoding="utf-8")
    words = [str(path / word) if word == "item.toml" else word for word in kind.words]
    size = ("--size", "24x24", "-o", path / "a.png", "--pack", path / "pack")
    code, _, err = drapery(*words, *size)
    return code, err


@pytest.mark.parametrize("damage", DAMAGE)
@pytest.mark.parametrize("name", KINDS)
def test_packs_and_pictures_agree_on_damage(
    drapery: Run, tmp_path: Path, name: str, damage: str
) -> None:
    kind = KINDS[name]
    pack_of(tmp_path, kind, DAMAGE[damage](kind))
    code, out, _ = drapery("packs", tmp_path / "pack")
    drawn, err = draws(drapery, tmp_path, kind)
    assert (code == 1) == (drawn == 2), (out, err)
    problems = [line for line in out.splitlines() if line.startswith("  problem")]
    assert bool(problems) == (code == 1)
    assert all(kind.file in line for line in problems)
    if damage in SAID:
        assert any(kind.file in line and SAID[damage] in line for line in out.splitlines()), out


@pytest.mark.parametrize("name", KINDS)
def test_packs_say_what_is_missing_or_misspelt(drapery: Run, tmp_path: Path, name: str) -> None:
    kind = KINDS[name]
    folder, _, file = kind.file.rpartition("/")
    misspelt = {
        f"{folder}/{file.title().replace('.Png', '.png')}": file,
        f"{folder}/{file.upper()}": file,
        f"{folder}/{file[:-4]} .png": file,
    }
    for number, (wrong, right) in enumerate(misspelt.items()):
        path = tmp_path / str(number)
        pack_of(path, kind, sound(kind), wrong)
        code, out, _ = drapery("packs", path / "pack")
        assert code == 0 and f"{wrong} (name it {right})" in out
        drawn, err = draws(drapery, path, kind)
        assert drawn == (2 if kind.lies_missing else 0), err
        # A missing file is not the pack's fault: another pack below may have it.
        assert not kind.lies_missing or file in err


def report(path: Path, files: Files, format: int = NEWEST_FORMAT) -> PackReport:
    files = {META: mcmeta(format), "assets/x": "", **files}
    (found,) = describe_packs([folder_pack(path, files)])
    return found


def notes(path: Path, files: Files, format: int = NEWEST_FORMAT) -> str:
    return "\n".join(report(path, files, format).notes)


SLIPS = {
    "pattern": ({BANNER + "creper.png": b""}, "creper.png is not read; did you mean creeper.png?"),
    "shield": ({SHIELD + "skul.png": b""}, "skul.png is not read; did you mean skull.png?"),
    "base": ({BANNER + "baner_base.png": b""}, "did you mean banner_base.png?"),
    "armour": ({ARMOR + "diamnd.png": b""}, "diamnd.png is not read; did you mean diamond.png?"),
    "icon": ({f"{TEXTURES}item/redd_dye.png": b""}, "did you mean red_dye.png?"),
    "folder": (
        {f"{TEXTURES}entity/banners/creeper.png": b""},
        f"{TEXTURES}entity/banners/ is not read; did you mean {TEXTURES}entity/banner/?",
    ),
    "namespace": (
        {"assets/textures/entity/banner/creeper.png": b""},
        f"assets/textures/entity/banner/ is not read; did you mean {BANNER}?",
    ),
    "upper-case namespace": (
        {"assets/Minecraft/textures/entity/banner/creeper.png": b""},
        f"(name it {CREEPER})",
    ),
    "plural": (
        {"data/g/banner_patterns/owl.json": "{}"},
        "data/g/banner_patterns/ is not read; did you mean data/g/banner_pattern/?",
    ),
    "layer": (
        {f"{TEXTURES}entity/equipment/humanoid_bby/iron.png": b""},
        "did you mean assets/minecraft/textures/entity/equipment/humanoid_baby/?",
    ),
}


@pytest.mark.parametrize("slip", SLIPS)
def test_slips_get_a_suggestion(tmp_path: Path, slip: str) -> None:
    files, words = SLIPS[slip]
    found = {name: data or plain(9, 9, 9, 99) for name, data in files.items()}
    assert words in notes(tmp_path, found)


@pytest.mark.parametrize(
    "name",
    [
        CREEPER,
        BANNER + "creeper_n.png",
        "assets/g/textures/entity/banner/creper.png",
        "assets/textures/textures/entity/banner/creeper.png",
        f"{TEXTURES}painting/bust.png",
        f"{TEXTURES}entity/equipment/mule_saddle/saddle.png",
        f"{TEXTURES}entity/banner/deep/owl.png",
        "assets/minecraft/texts/splashes.json",
        "data/minecraft/tags/banner_pattern/no_item_required.json",
        "data/minecraft/trim_pattern/coast.json",
    ],
)
def test_names_that_are_right_get_none(tmp_path: Path, name: str) -> None:
    # creeper_n alone is an extra sprite, which `extra` lists.
    files: Files = {name: plain(9, 9, 9, 99)}
    if name.endswith("_n.png"):
        files[CREEPER] = plain(9, 9, 9, 99)
    assert "did you mean" not in notes(tmp_path, files) and "name it" not in notes(tmp_path, files)


def test_an_overlay_without_its_folder_is_noted(tmp_path: Path) -> None:
    entries = [{"directory": name, "formats": 46} for name in ("new", "gone")]
    files = {META: mcmeta(46, overlays={"entries": entries}), "new/" + CREEPER: plain(1, 1, 1, 9)}
    (found,) = describe_packs([folder_pack(tmp_path, files)])
    (note,) = found.notes
    assert "names the overlay gone, but there is no such folder" in note


def test_a_definition_without_a_texture_is_noted(tmp_path: Path) -> None:
    definition = "data/g/banner_pattern/{}.json"
    data = folder_pack(
        tmp_path / "data",
        {
            definition.format("owl"): '{"asset_id": "g:birds/owl"}',
            definition.format("fox"): '{"asset_id": "g:fox"}',
        },
    )
    art = folder_pack(
        tmp_path / "art", {"assets/g/textures/entity/banner/foxx.png": plain(9, 9, 9, 99)}
    )
    lines = "\n".join(describe_packs([data, art])[0].notes)
    owl = "g:owl is defined, but no pack has its texture"
    assert f"{owl} assets/g/textures/entity/banner/birds/owl.png" in lines
    assert "entity/banner/fox.png; there is one for g:foxx" in lines
    whole = {"assets/g/textures/entity/banner/birds/owl.png": plain(9, 9, 9, 99)}
    more = folder_pack(tmp_path / "more", whole)
    assert owl not in "\n".join(describe_packs([data, more])[0].notes)


def test_shields_alone_have_their_lines(drapery: Run, tmp_path: Path) -> None:
    files = {f"{SHIELD}{name}.png": plain(9, 9, 9, 99, side=32) for name in PATTERN_NAMES[:40]}
    code, out, _ = drapery("packs", folder_pack(tmp_path, files))
    assert code == 0
    assert "  for shields   40 of 43\n" in out and "  shield sheets 40 of 32 x 32 px\n" in out
    assert f"  shields lack  {', '.join(PATTERN_NAMES[40:])}\n" in out


def test_a_sheet_for_shields_that_is_not_square_is_noted(tmp_path: Path) -> None:
    wide = png(np.full((32, 64, 4), 99, np.uint8))
    assert f"{SHIELD}creeper.png is 64 x 32 px: stretched" in notes(
        tmp_path / "one", {SHIELD + "creeper.png": wide}
    )
    many = notes(tmp_path / "many", {f"{SHIELD}{name}.png": wide for name in PATTERN_NAMES})
    (line,) = many.splitlines()
    assert "border.png is 64 x 32 px" in line and "and 38 more: stretched" in line


def test_small_sheets_are_named(tmp_path: Path) -> None:
    for number, folder in enumerate((BANNER, SHIELD)):
        files: Files = {f"{folder}{name}.png": plain(9, 9, 9, 99) for name in NAMES}
        files[folder + "skull.png"] = plain(9, 9, 9, 99, side=32)
        kind = ("banner", "shield")[number]
        line = f"smaller than most {kind} sheets, which have 64 px: skull (32 px)"
        assert line in notes(tmp_path / kind, files)


def test_sheets_that_hide_all_or_show_nothing_are_named(tmp_path: Path) -> None:
    sheet = np.full((64, 64, 4), (9, 9, 9, 99), np.uint8)
    opaque, clear = sheet.copy(), sheet.copy()
    opaque[:41, :42, 3], clear[:41, :42, 3] = 255, 0
    for folder, place in ((BANNER, "flag"), (SHIELD, "shield")):
        files: Files = {
            folder + "creeper.png": png(opaque),
            folder + "base.png": png(opaque),
            folder + "skull.png": png(clear),
            folder + "flower.png": png(sheet),
        }
        lines = notes(tmp_path / place, files).splitlines()
        hides = f"no transparent texel on the {place}, so that each hides all below it: creeper"
        assert hides in lines
        assert f"no visible texel on the {place}, so that each shows nothing: skull" in lines


def test_masks_that_old_games_leave_out_are_noted_in_one_line(tmp_path: Path) -> None:
    mask = np.zeros((32, 32, 3), np.uint8)
    mask[4:12, 4:12] = 255
    files: Files = {f"{BANNER}{name}.png": png(mask) for name in NAMES}
    size = "leaves out masks that have not the size of the base, 64 x 64 px: "
    for format, modes in ((4, 0), (3, 1)):
        lines = notes(tmp_path / str(format), files, format).splitlines()
        (line,) = (line for line in lines if size in line)
        assert all(f"{BANNER}{name}.png (32 x 32 px)" in line for name in NAMES)
        assert sum("that are not RGBA" in line for line in lines) == modes
    assert size not in notes(tmp_path / "new", files)


def test_palettes_wings_and_armour_of_wrong_sizes(tmp_path: Path) -> None:
    files: Files = {
        **ARMED,
        f"{TEXTURES}palettes/trim/gold.png": png(np.full((1, 3, 4), 99, np.uint8)),
        ARMOR + "iron.png": plain(9, 9, 9, 255),
    }
    found = report(tmp_path, files)
    (problem,) = found.problems
    assert "trim/gold.png: its palette has 3 colours, the key has 4" in problem
    assert any(f"{ARMOR}iron.png (64 x 64 px)" in line for line in found.notes)


def test_definitions_of_equipment_are_read(tmp_path: Path) -> None:
    layers = {"humanoid_bby": [{"texture": "minecraft:iron"}], "wings": [{"texture": "g:bat"}]}
    found = report(
        tmp_path,
        {
            "assets/g/equipment/bat.json": json.dumps({"layers": layers}),
            "assets/g/equipment/odd.json": '{"layers": {"wings": 3}}',
            "assets/minecraft/equipment/iron.json": '{"layers": {}, "trim_overrides": 3}',
        },
    )
    lines = "\n".join(found.notes)
    assert "'humanoid_bby' is no layer of equipment; did you mean humanoid_baby?" in lines
    assert "no pack has assets/g/textures/entity/equipment/wings/bat.png" in lines
    assert "odd.json: each layer must be a list of objects with texture" in lines
    (problem,) = found.problems
    assert "iron.json: trim_overrides must be a list" in problem


def test_a_wrong_animation_is_a_note_for_shields_too(tmp_path: Path) -> None:
    name = SHIELD + "creeper.png"
    found = report(
        tmp_path, {name: strip(1, 2), name + ".mcmeta": '{"animation": {"frametime": 0}}'}
    )
    assert not found.problems and any("drawn as a still" in line for line in found.notes)
