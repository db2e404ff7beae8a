"""Every item that a design takes has an icon, of the packs or our own."""

import base64
import io
import re
from pathlib import Path

import numpy as np
from PIL import Image

from drapery import Banner, Layer
from drapery.banner import DYE_NAMES, PATTERN_NAMES, crafting_items
from drapery.packs import MemoryPack, open_packs
from drapery.studio.icons import icon_address, own_icon
from drapery.studio.line_icons import LINES
from drapery.studio.page import PANELS


def test_every_item_of_every_pattern_has_an_icon_of_its_own_kind() -> None:
    paper = own_icon("paper")
    for dye, pattern in zip(DYE_NAMES * 3, PATTERN_NAMES, strict=False):
        banner = Banner(dye, (Layer(pattern, dye),))
        for item in crafting_items(banner):
            icon = own_icon(item.item)
            assert icon.shape == (8, 8, 4) and icon[..., 3].any()
            assert item.item == "paper" or not np.array_equal(icon, paper), item.item


def test_wool_and_dye_have_their_dye() -> None:
    assert not np.array_equal(own_icon("red_wool"), own_icon("lime_wool"))
    red = own_icon("red_dye")
    assert red[red[..., 3] > 0][:, 0].mean() > 100


def test_a_pack_shows_its_own_item() -> None:
    blue = np.full((16, 16, 4), (0, 0, 255, 255), np.uint8)
    pack = MemoryPack(textures={"minecraft:item/red_dye": blue})
    address = icon_address("red_dye", open_packs((pack,)))
    data = base64.b64decode(address.partition(",")[2])
    np.testing.assert_array_equal(np.asarray(Image.open(io.BytesIO(data)).convert("RGBA")), blue)


def test_a_damaged_or_large_item_of_a_pack_is_no_fault(tmp_path: Path) -> None:
    folder = tmp_path / "assets/minecraft/textures/item"
    folder.mkdir(parents=True)
    (tmp_path / "pack.mcmeta").write_text('{"pack": {"pack_format": 46, "description": "x"}}')
    (folder / "stick.png").write_bytes(b"x")
    Image.new("RGBA", (1024, 1024), "red").save(folder / "paper.png")
    packs = open_packs((tmp_path,))
    assert icon_address("stick", packs) == icon_address("stick", open_packs(()))
    data = base64.b64decode(icon_address("paper", packs).partition(",")[2])
    assert Image.open(io.BytesIO(data)).size == (64, 64)


def test_every_tab_has_a_picture_of_lines() -> None:
    tabs = {panel.name for panel in PANELS if panel.group}
    assert tabs | {"fault", "warning", "done"} < {*LINES}
    assert all(re.fullmatch(r"M[-\dMLHVChvlacsz .]+", path) for path in LINES.values())
    assert len({*LINES.values()}) == len(LINES)
