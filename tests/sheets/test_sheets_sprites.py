"""Sprites: the loops of several directions by one camera, and the file that engines read."""

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from PIL import Image

from drapery import Banner, Frame, OptionError, Settings, animate
from drapery.garments import find_garment
from drapery.render import save_sprites
from drapery.sheets import draw_sprites

BANNER = Banner.parse("white creeper:lime border:black")
SMALL = Settings(size=(48, 64), grid=(8, 15), samples=1)
LOOP: dict[str, Any] = {"seconds": 0.5, "fps": 8.0}


def filled(width: int, height: int, level: int) -> Frame:
    return Frame(np.full((height, width, 4), level, np.uint8))


def rows_shown(frame: Frame) -> list[int]:
    return np.flatnonzero(frame.pixels[..., 3].any(axis=1)).tolist()


def test_one_direction_is_the_loop() -> None:
    (frames,) = draw_sprites(BANNER, SMALL, directions=1, **LOOP).values()
    loop = animate(BANNER, SMALL, **LOOP)
    assert all(np.array_equal(a.pixels, b.pixels) for a, b in zip(frames, loop, strict=True))


def test_directions_follow_each_other_at_one_scale() -> None:
    loops = draw_sprites(BANNER, SMALL, directions=4, **LOOP)
    assert list(loops) == ["south", "west", "north", "east"]
    feet = {rows_shown(frames[0])[-1] for frames in loops.values()}
    assert len(feet) == 1, "the pole ends in the same row"
    south, _, north, _ = (frames[0].pixels for frames in loops.values())
    assert (south[..., 1] > 150).sum() > (north[..., 1] > 150).sum(), "the pole hides the back"


def test_large_pixels_become_one() -> None:
    settings = Settings(style="pixel-art", size=(64, 64))
    loops = draw_sprites(BANNER, settings, directions=2, **LOOP)
    sizes = {frame.pixels.shape for frames in loops.values() for frame in frames}
    assert sizes == {(32, 32, 4)}
    whole = animate(BANNER, settings, **LOOP).frames[0].pixels
    assert np.array_equal(whole, whole[::2, ::2].repeat(2, axis=0).repeat(2, axis=1))
    plain = draw_sprites(BANNER, SMALL, directions=1, **LOOP)["south"]
    assert plain[0].pixels.shape == (64, 48, 4), "others keep their pixels"


def test_a_garment_has_sprites() -> None:
    loops = draw_sprites(find_garment("cape"), SMALL, directions=2, **LOOP)
    assert not np.array_equal(loops["south"][0].pixels, loops["north"][0].pixels)


@pytest.mark.parametrize("directions", [0, 3, 32])
def test_other_numbers_of_directions_are_refused(directions: int) -> None:
    with pytest.raises(OptionError, match="1, 2, 4, 8 or 16"):
        draw_sprites(BANNER, SMALL, directions=directions, **LOOP)


def test_each_loop_has_a_row_and_a_tag(tmp_path: Path) -> None:
    loops = {"south": [filled(3, 5, 10 + n) for n in range(3)]}
    loops["north"] = [filled(3, 5, 20 + n) for n in range(3)]
    save_sprites(loops, 7, tmp_path / "a.sheet.png")
    sheet = np.asarray(Image.open(tmp_path / "a.sheet.png"))
    assert sheet.shape == (10, 9, 4)
    index = json.loads((tmp_path / "a.sheet.json").read_text())
    for number, each in enumerate(index["frames"].values()):
        x, y, w, h = (each["frame"][name] for name in "xywh")
        level = 10 * (1 + number // 3) + number % 3
        assert (sheet[y : y + h, x : x + w] == level).all()
        assert (w, h) == (3, 5)
    tags = [tuple(tag.values()) for tag in index["meta"]["frameTags"]]
    assert tags == [("south", 0, 2, "forward"), ("north", 3, 5, "forward")]
    times = [each["duration"] for each in index["frames"].values()]
    assert sum(times[:3]) == sum(times[3:]) == round(3000 / 7)
    assert index["meta"]["size"] == {"w": 9, "h": 10}


@pytest.mark.parametrize(
    ("loops", "fps", "name", "said"),
    [
        ({"a": [filled(2, 2, 0)]}, 8, "a.png", "end the name with .sheet.png"),
        ({"a": [filled(2, 2, 0)], "b": [filled(3, 2, 0)]}, 8, "a.sheet.png", "differ"),
        ({"a": [filled(2, 2, 0)], "b": [filled(2, 2, 0)] * 2}, 8, "a.sheet.png", "differ"),
        ({"a": [filled(2, 2, 0)], "b": []}, 8, "a.sheet.png", "differ"),
        ({}, 8, "a.sheet.png", "differ"),
        ({"a": [filled(2, 2, 0)]}, 0, "a.sheet.png", "fps 0"),
    ],
)
def test_wrong_sheets_are_refused(
    loops: dict[str, list[Frame]], fps: float, name: str, said: str, tmp_path: Path
) -> None:
    with pytest.raises(OptionError, match=said):
        save_sprites(loops, fps, tmp_path / name)
    assert not list(tmp_path.iterdir())
