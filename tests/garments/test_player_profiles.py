"""Profiles of the game as skins: their textures, cape, elytra and arms."""

import json
from pathlib import Path

import numpy as np
import pytest
from conftest import Run
from pack_maker import folder_pack, png

from drapery import draw
from drapery.errors import OptionError
from drapery.garments import PlayerSettings, player_of
from drapery.garments.profiles import MAX_PROFILE, Profile, profile_of, read_profile
from drapery.packs import open_packs
from drapery.stage.wearers import wearer_of

FULL = {
    "texture": "g:skins/knight",
    "cape": "g:capes/red",
    "elytra": "g:wings/blue",
    "model": "slim",
}
KNIGHT = Profile("g:skins/knight", "g:capes/red", "g:wings/blue", "slim")
SNBT = '{texture:"g:skins/knight",cape:"g:capes/red",elytra:"g:wings/blue",model:"slim"}'
START = "assets/g/textures/"


def flat(*rgb: int, height: int = 32) -> bytes:
    return png(np.full((height, 64, 4), (*rgb, 255), np.uint8))


@pytest.fixture
def pack(tmp_path: Path) -> Path:
    """A skin of green, a cape of red, wings of blue."""
    files = {
        f"{START}skins/knight.png": flat(0, 200, 0, height=64),
        f"{START}capes/red.png": flat(200, 0, 0),
        f"{START}wings/blue.png": flat(0, 0, 200),
    }
    return folder_pack(tmp_path / "pack", files)


@pytest.mark.parametrize(
    "text",
    [
        SNBT,
        json.dumps(FULL),
        json.dumps({"profile": FULL}),
        f"player_head[profile={SNBT}]",
        f"/give @s minecraft:player_head[minecraft:profile={SNBT}] 2",
        f"/summon mannequin ~ ~ ~ {{profile:{SNBT}}}",
        json.dumps({"id": "player_head", "components": {"minecraft:profile": FULL}}),
        SNBT[:-1] + ',name:"Kay",id:[I;1,2,3,4],properties:[{name:"textures",value:"e30="}]}',
    ],
)
def test_a_profile_is_read_alone_and_in_items_entities_and_commands(text: str) -> None:
    assert read_profile(text) == KNIGHT and profile_of(text) == KNIGHT


def test_a_profile_is_read_from_a_file(tmp_path: Path) -> None:
    for name, text in (("a.json", json.dumps(FULL)), ("b.SNBT", "\ufeff" + SNBT)):
        (tmp_path / name).write_text(text, encoding="utf-8")
        assert profile_of(name, tmp_path) == KNIGHT
    assert profile_of("traveller") is None and profile_of("{odd}.png") is None


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ('{name:"Notch"}', r"profile of 'Notch' names no texture: .* on a server of the game, not"),
        ('player_head[profile="Notch"]', "has no profile with textures"),
        ('{properties:[{name:"textures",value:"e30="}]}', "names no texture"),
        ('{texture:"a b"}', "profile: texture: 'a b' is not an id"),
        ("{texture:3}", "texture 3 is not the id of a texture"),
        ('{texture:"a",model:"thin"}', "model 'thin' is not known; use one of: wide, slim"),
        ("{texture:", "profile is not JSON or SNBT: line 1"),
        ("{}", "has no profile with textures"),
        ("{" * 600, "profile is not JSON or SNBT"),
        ("{" + " " * MAX_PROFILE + "}", f"profile has over {MAX_PROFILE} characters"),
    ],
)
def test_profiles_without_textures_of_packs_are_refused_in_one_line(text: str, said: str) -> None:
    with pytest.raises(OptionError, match=said) as caught:
        read_profile(text)
    assert "\n" not in str(caught.value) and len(str(caught.value)) < 400


def test_files_that_are_no_profiles_are_named(tmp_path: Path) -> None:
    (tmp_path / "odd.json").write_bytes(b"\xff{")
    (tmp_path / "long.json").write_bytes(b"{" + b" " * MAX_PROFILE * 2)
    (tmp_path / "names.json").write_text('{"name": "Kay"}', encoding="utf-8")
    for name, said in (
        ("no.json", "cannot be read"),
        ("odd.json", "is not UTF-8"),
        ("long.json", "has over"),
        ("names.json", "of 'Kay' names no texture"),
    ):
        with pytest.raises(OptionError, match=rf"profile .*{name}.* {said}"):
            profile_of(name, tmp_path)


def colours(pixels: np.ndarray) -> set[str]:
    """Which of red, green and blue are the only channel of some pixel."""
    shown = pixels[pixels[..., 3] > 0][:, :3]
    only = (shown > 60) & (shown.sum(axis=1, keepdims=True) == shown)
    return {"red", "green", "blue"} & {
        name for name, seen in zip(("red", "green", "blue"), only.any(axis=0), strict=True) if seen
    }


@pytest.mark.parametrize(
    ("elytra", "fields", "seen"),
    [
        (False, FULL, {"red", "green"}),
        (True, FULL, {"blue", "green"}),
        (True, {"texture": FULL["texture"], "cape": FULL["cape"]}, {"red", "green"}),
        (False, {"texture": FULL["texture"], "elytra": FULL["elytra"]}, {"green"}),
    ],
)
def test_a_player_wears_what_its_profile_names(
    pack: Path, elytra: bool, fields: dict[str, str], seen: set[str]
) -> None:
    player = player_of(
        PlayerSettings(skin=json.dumps(fields), elytra=elytra, motion="stand", speed=0.0)
    )
    options = {"view": "back", "background": "transparent", "ground": "none", "samples": 1}
    pixels = draw(player, packs=pack, size=(40, 60), time=0.2, light="flat", **options).pixels
    assert colours(pixels) == seen


def test_a_cape_of_ones_own_replaces_that_of_the_profile(tmp_path: Path) -> None:
    (tmp_path / "own.png").write_bytes(flat(9, 9, 9))
    player = player_of(PlayerSettings(skin=SNBT, cape="own.png"), tmp_path)
    assert player.over[0].piece[0].texture.file == (tmp_path / "own.png")  # type: ignore[union-attr]


@pytest.mark.parametrize(("arms", "width"), [("auto", 3), ("classic", 4)])
def test_the_model_of_a_profile_says_its_arms(pack: Path, arms: str, width: int) -> None:
    player = player_of(PlayerSettings(skin=SNBT, arms=arms))  # type: ignore[arg-type]
    wearer = wearer_of(player, open_packs(pack))
    assert wearer is not None and wearer.parts["left_arm"].box.size[0] == width


def test_a_skin_that_no_pack_has_is_named(drapery: Run, tmp_path: Path, pack: Path) -> None:
    words = ("player", "--size", "20x20", "--motion", "stand", "-o", tmp_path / "a.png")
    code, _, err = drapery(*words, "--skin", SNBT)
    assert code == 2
    assert "skin g:skins/knight: no pack has assets/g/textures/skins/knight.png" in err
    (tmp_path / "knight.json").write_text(json.dumps(FULL), encoding="utf-8")
    assert drapery(*words, "--skin", tmp_path / "knight.json", "--pack", pack)[0] == 0


def test_the_file_of_a_profile_is_a_file_of_the_garment(tmp_path: Path) -> None:
    (tmp_path / "knight.json").write_text(json.dumps(FULL), encoding="utf-8")
    player = player_of(PlayerSettings(skin="knight.json"), tmp_path)
    assert tmp_path / "knight.json" in player.paths
