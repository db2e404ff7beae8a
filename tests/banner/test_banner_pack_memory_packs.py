"""Packs from arrays: own patterns and textures, checked, stacked with packs on disk."""

from pathlib import Path

import numpy as np
import pytest
from pack_maker import CREEPER, folder_pack, mcmeta, noise, plain

from drapery.banner.design import Banner, Layer
from drapery.banner.dyes import DYES
from drapery.banner.sprites import face, tint
from drapery.errors import PackError
from drapery.packs import MemoryPack, PackSource, describe_packs, open_pack, open_packs


def heart() -> np.ndarray:
    mask = np.zeros((64, 64), bool)
    mask[10:20, 5:15] = True
    return mask


def test_an_own_pattern_is_drawn_in_a_layer() -> None:
    packs = open_packs(MemoryPack(patterns={"mymod:heart": heart()}))
    banner = Banner("white", (Layer("mymod:heart", "red"),))
    plain_face, own_face = face(Banner("white"), packs), face(banner, packs)
    changed = (plain_face != own_face).any(axis=2)
    assert (changed == heart()[1:41, 1:21]).all()
    assert (own_face[changed] == (*DYES["red"].rgb, 255)).all()
    assert packs.patterns()[-1] == "mymod:heart"


def test_a_pack_in_memory_may_lack_what_it_does_not_replace(tmp_path: Path) -> None:
    memory = MemoryPack(patterns={"creeper": noise(1)}, label="mine")
    banner = Banner("white", (Layer("creeper", "red"),))
    alone = open_packs([memory, MemoryPack(patterns={"border": noise(2)})])
    face(banner, alone)
    assert alone.warnings() == ()
    beside = open_packs([memory, folder_pack(tmp_path / "disk", {CREEPER: plain(1, 0, 0, 255)})])
    face(banner, beside)
    (line,) = beside.warnings()
    assert line.startswith("not in ") and "mine" in line and "disk" in line
    assert line.endswith("taken from our own art: base, banner_base")


def test_a_pack_in_memory_of_which_nothing_is_drawn_is_named() -> None:
    packs = open_packs(MemoryPack(patterns={"creeper": noise(1)}, label="mine"))
    face(Banner("white"), packs)
    assert packs.warnings() == ("no texture comes from mine: the textures needed are not in it",)


def test_an_array_replaces_a_pattern_of_the_game_and_any_texture() -> None:
    creeper, stone, shield = noise(1), noise(2, 16), noise(3)
    pack = MemoryPack(
        patterns={"creeper": creeper},
        shields={"minecraft:creeper": shield},
        textures={"minecraft:block/stone": stone, "entity/banner/creeper_n": noise(4)},
    )
    packs = open_packs([pack])
    assert (packs.sheet("creeper") == creeper).all()
    assert (packs.sheet("creeper", "shield") == shield).all()
    assert (packs.texture("block/stone") == stone).all()
    normal_map = packs.normal_map("creeper")
    assert normal_map is not None and (normal_map == noise(4)).all()
    wanted = tint(creeper, (1, 2, 3))
    creeper[:] = 0
    assert (tint(packs.sheet("creeper"), (1, 2, 3)) == wanted).all()


def test_a_mask_is_white_with_that_alpha() -> None:
    alpha = noise(5)[..., 0]
    packs = open_packs(MemoryPack(patterns={"creeper": alpha}))
    sheet = packs.sheet("creeper")
    assert (sheet[..., :3] == 255).all() and (sheet[..., 3] == alpha).all()


def test_packs_in_memory_and_on_disk_lie_over_each_other(tmp_path: Path) -> None:
    path = folder_pack(tmp_path / "disk", {CREEPER: plain(1, 0, 0, 255)})
    memory = MemoryPack(patterns={"creeper": noise(1)}, label="mine")
    assert open_packs([memory, path]).sheet("creeper")[0, 0, 0] == 1
    assert (open_packs([path, memory]).sheet("creeper") == noise(1)).all()
    low, high = describe_packs([path, memory])
    assert (low.label, high.label) == (str(path), "mine")
    assert high.overrides == (("creeper", str(path)),)


def test_an_opened_stack_goes_wherever_paths_go(tmp_path: Path) -> None:
    path = folder_pack(tmp_path / "disk", {CREEPER: plain(1, 0, 0, 255)})
    memory = MemoryPack(patterns={"mymod:heart": heart()})
    opened = open_packs([path])
    assert open_packs(opened) is opened
    both = open_packs([opened, open_pack(memory)])
    assert [pack.label for pack in both.packs[1:]] == [str(path), "pack in memory"]
    assert open_packs(path).sheet("creeper")[0, 0, 0] == 1
    with pytest.raises(PackError, match="opened for format None: open them with format=46"):
        open_packs(opened, format=46)


def test_a_pack_that_was_opened_for_another_format_is_read_as_the_format_asked_for() -> None:
    entry = {"directory": "newer", "formats": [40, 46]}
    files = {
        "pack.mcmeta": mcmeta(18, overlays={"entries": [entry]}),
        CREEPER: plain(1, 0, 0, 255),
        f"newer/{CREEPER}": plain(2, 0, 0, 255),
    }
    opened = open_pack(MemoryPack(contents=files), 46)
    shown = [open_packs(opened, format=number).sheet("creeper")[0, 0, 0] for number in (46, 18)]
    assert shown == [2, 1] and open_packs(opened).packs[1] is opened


def test_contents_are_further_files_of_the_pack() -> None:
    files = {"pack.mcmeta": mcmeta(4), CREEPER + ".mcmeta": b'{"animation": {}}'}
    strip = np.concatenate([np.full((8, 8, 4), red, np.uint8) for red in (1, 2)])
    pack = MemoryPack(textures={"entity/banner/creeper": strip}, contents=files)
    packs = open_packs(pack)
    assert packs.packs[1].format == 4 and isinstance(pack, PackSource)
    assert packs.period("creeper") == 0.1
    assert "of 3 files" in repr(pack)


@pytest.mark.parametrize(
    ("image", "words"),
    [
        (np.zeros((64, 64, 4)), "an array of float64 [64, 64, 4]; give uint8"),
        (np.zeros((64, 64, 3), np.uint8), "an array of uint8 [64, 64, 3]; give uint8"),
        (np.zeros(64, np.uint8), "an array of uint8 [64]; give uint8"),
        ("creeper.png", "; give uint8"),
        (np.zeros((64, 32, 4), np.uint8), "is 32 x 64 px; a sheet is square"),
        (np.zeros((2049, 2049), bool), "is 2049 x 2049 px; a sheet is square, at most 2048"),
        (np.zeros((0, 0, 4), np.uint8), "is 0 x 0 px; give 1 to 8192 px a side"),
        (np.zeros((1, 8193), bool), "is 8193 x 1 px; give 1 to 8192 px a side"),
    ],
)
def test_other_arrays_are_refused(image: np.ndarray, words: str) -> None:
    with pytest.raises(PackError) as caught:
        MemoryPack(patterns={"creeper": image})
    line = str(caught.value)
    assert line.startswith("pack in memory: pattern 'creeper' is ") and words in line
    assert "\n" not in line


@pytest.mark.parametrize("name", ["Creeper", "a b", "x:../y", "", "x" * 200])
def test_other_ids_are_refused(name: str) -> None:
    for mapping in ("patterns", "shields", "textures"):
        with pytest.raises(PackError, match=r"pack in memory: (pattern|texture)"):
            MemoryPack(**{mapping: {name: heart()}})


@pytest.mark.parametrize("packs", [5, [5], [None], [["x.zip"]]])
def test_what_is_not_a_pack_is_refused_in_one_line(packs: object) -> None:
    with pytest.raises(PackError, match="give a path"):
        open_packs(packs)
