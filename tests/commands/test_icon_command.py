"""`drapery icon` writes items as in the slots of the inventory."""

from pathlib import Path

import numpy as np
import pytest
from conftest import Run
from PIL import Image

from drapery import Banner, draw


@pytest.mark.parametrize("scale", [1, 2, 5])
def test_an_icon_is_the_item_at_a_whole_scale(drapery: Run, tmp_path: Path, scale: int) -> None:
    """Where it lies: `test_an_item_lies_in_its_slot_as_the_gui_view_sees_a_block`."""
    target = tmp_path / "a.png"
    assert drapery("icon", "red cross:white", "--scale", scale, "-o", target) == (0, "", "")
    side = 16 * scale
    drawn = draw(Banner.parse("red cross:white"), placement="item", size=(side, side), samples=1)
    found = np.asarray(Image.open(target))
    assert np.array_equal(found, drawn.pixels)
    assert {*np.unique(found[..., 3])} == {0, 255}, "an icon has no half transparent pixels"


def test_several_icons_go_into_a_folder(drapery: Run, tmp_path: Path) -> None:
    folder = tmp_path / "icons"
    assert drapery("icon", "red", "blue", "-o", folder)[0] == 0
    assert sorted(path.name for path in folder.iterdir()) == ["icon_00.png", "icon_01.png"]
    colours = [np.asarray(Image.open(path))[16, 16] for path in sorted(folder.iterdir())]
    assert colours[0][0] > colours[0][2] and colours[1][2] > colours[1][0]


def test_what_cannot_be_an_icon_is_refused(drapery: Run, tmp_path: Path) -> None:
    for words, fault in (
        (("red", "blue", "-o", tmp_path / "a.png"), "2 designs go into a folder; name one"),
        (("red", "--scale", 0, "-o", tmp_path / "a.png"), "scale 0 is out of range; use 1 to 64"),
        (("red", "-o", tmp_path / "a.mp4"), "MP4 holds no picture; use .png"),
        (("rde", "-o", tmp_path / "a.png"), "rde"),
    ):
        code, _, said = drapery("icon", *words)
        assert (code, said.count("\n")) == (2, 1) and fault in said
    assert list(tmp_path.iterdir()) == []
