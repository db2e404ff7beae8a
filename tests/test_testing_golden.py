"""What a golden forgives, what it takes as a picture, and how it explains a change."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from PIL import Image

from drapery.banner.design import Banner
from drapery.banner.packs import open_packs
from drapery.comparison.metrics import measure
from drapery.errors import OptionError
from drapery.render.frame import Frame
from drapery.testing.explain import explain_change, layer_notes
from drapery.testing.golden import GoldenError, Tolerance, agrees, as_frame, decode, encode


def noise(seed: int, height: int = 12, width: int = 9) -> Frame:
    random = np.random.default_rng(seed)
    return Frame(random.integers(0, 256, (height, width, 4), np.uint8))


def test_a_golden_holds_the_picture_and_the_layers_exactly() -> None:
    frame, notes = noise(1), [{"name": "base, red", "face": "x"}]
    back, kept = decode(encode(frame, notes))
    assert np.array_equal(back.pixels, frame.pixels)
    assert kept == notes
    assert encode(frame, notes) == encode(frame, notes)


@given(st.integers(0, 255), st.integers(0, 255), st.integers(0, 4))
def test_tolerance_counts_channels_and_pixels(error: int, allowed: int, pixels: int) -> None:
    expected = Frame(np.full((6, 6, 4), 255, np.uint8))
    actual = expected.pixels.copy()
    actual[0, :3, 1] -= np.uint8(error)
    close = agrees(expected, Frame(actual), Tolerance(allowed, pixels))
    assert close == (error <= allowed or pixels >= 3)


def test_hidden_colours_do_not_count() -> None:
    expected = np.zeros((4, 4, 4), np.uint8)
    actual = expected.copy()
    actual[..., :3] = 200
    assert measure(expected, actual).same
    actual[0, 0, 3] = 1
    assert measure(expected, actual).changed == 1


def test_pictures_come_as_frames_images_and_arrays() -> None:
    frame = noise(3)
    grey = frame.pixels[..., 0]
    assert as_frame(frame) is frame
    assert np.array_equal(as_frame(Image.fromarray(frame.pixels)).pixels, frame.pixels)
    assert np.array_equal(as_frame(frame.pixels).pixels, frame.pixels)
    assert np.array_equal(as_frame(frame.pixels[..., :3]).pixels[..., 3], np.full((12, 9), 255))
    assert np.array_equal(as_frame(grey).pixels[..., :3], np.stack([grey] * 3, -1))
    for wrong in (np.zeros((4, 4, 4)), np.zeros((4, 4, 2), np.uint8), "a picture"):
        with pytest.raises(OptionError, match="golden picture"):
            as_frame(wrong)


def test_broken_goldens_are_named() -> None:
    for data in (b"", b"\x89PNG\r\n\x1a\n", encode(noise(1))[:60]):
        with pytest.raises(GoldenError, match="PNG"):
            decode(data)


def test_a_moved_layer_is_recognised() -> None:
    banner = Banner.parse("white creeper:lime border:black")
    before = layer_notes(banner, open_packs(()))
    after = [dict(note) for note in before]
    for shift in (1, 3):
        after[3] = {"name": before[3]["name"], "face": _shifted(before[3]["face"], shift)}
        line = explain_change(noise(1), noise(2), before, after)
        assert line.startswith(f"layer 2 (border, black) moved by {shift} texel")
        assert "pixels differ, max" in line


def test_other_dyes_and_counts_are_named() -> None:
    packs = open_packs(())
    before = layer_notes(Banner.parse("white creeper:lime"), packs)
    dyed = layer_notes(Banner.parse("white creeper:red"), packs)
    more = layer_notes(Banner.parse("white creeper:lime border:red"), packs)
    assert "layer 1 (creeper, lime) became (creeper, red)" in explain_change(
        noise(1), noise(2), before, dyed
    )
    assert "1 layers became 2" in explain_change(noise(1), noise(2), before, more)


def _shifted(face: str, down: int) -> str:
    from drapery.testing.explain import _pack, _unpack

    return _pack(np.roll(_unpack(face), down, axis=0))
