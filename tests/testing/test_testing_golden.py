"""What a golden forgives, what it takes as a picture, and how it explains a change."""

import numpy as np
import pytest
from hypothesis import given, strategies as st
from PIL import Image

from drapery.banner.design import Banner
from drapery.banner.packs import open_packs
from drapery.comparison.metrics import measure
from drapery.comparison.picture import as_picture
from drapery.comparison.tolerance import Tolerance
from drapery.errors import OptionError
from drapery.render.frame import Animation, Frame
from drapery.testing.explain import explain_change, layer_notes
from drapery.testing.golden import (
    GoldenError,
    agrees,
    decode,
    encode,
)

pytestmark = pytest.mark.quick


def noise(seed: int, height: int = 12, width: int = 9) -> Frame:
    random = np.random.default_rng(seed)
    return Frame(random.integers(0, 256, (height, width, 4), np.uint8))


def test_a_golden_holds_the_picture_and_the_layers_exactly() -> None:
    frame, notes = noise(1), [{"name": "base, red", "face": "x"}]
    back, kept = decode(encode(frame, notes))
    assert np.array_equal(back.frames[0], frame.pixels)
    assert kept == notes
    assert encode(frame, notes) == encode(frame, notes)


def loop(count: int = 3, fps: float = 12.5) -> Animation:
    return Animation(tuple(noise(seed) for seed in range(count)), fps)


def test_a_golden_holds_a_loop_and_the_layers_exactly() -> None:
    still = Animation((noise(1), noise(1), noise(2), noise(1)), 30)
    for picture in (loop(), still):
        back, kept = decode(encode(picture, [{"name": "base, red", "face": "x"}]))
        assert back.delays == pytest.approx([1 / picture.fps] * len(picture))
        assert np.array_equal(back.frames, [frame.pixels for frame in picture])
        assert kept == [{"name": "base, red", "face": "x"}]
        assert agrees(back, picture, Tolerance()) and decode(encode(picture))[1] is None


def test_a_changed_loop_is_explained() -> None:
    other = Animation((noise(0), noise(7), noise(2)), 12.5)
    assert not agrees(loop(), other, Tolerance(pixels=107))
    assert agrees(loop(), other, Tolerance(pixels=108))
    assert ", in frame 2, in columns 0 to 8" in explain_change(loop(), other)
    for changed, size in (
        (loop(2), "9x12, 2 frames at 12.5/s"),
        (loop(3, 10), "9x12, 3 frames at 10/s"),
        (noise(0), "9x12"),
    ):
        assert not agrees(loop(), changed, Tolerance(255))
        said = explain_change(loop(), changed)
        assert said == f"the size changed from 9x12, 3 frames at 12.5/s to {size}"


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


def pixels(source: object) -> np.ndarray:
    return as_picture(source).frames[0]


def test_pictures_come_as_frames_images_and_arrays() -> None:
    frame = noise(3)
    grey = frame.pixels[..., 0]
    assert np.array_equal(pixels(frame), frame.pixels)
    assert np.array_equal(pixels(Image.fromarray(frame.pixels)), frame.pixels)
    assert np.array_equal(pixels(frame.pixels), frame.pixels)
    assert np.array_equal(pixels(frame.pixels[..., :3])[..., 3], np.full((12, 9), 255))
    assert np.array_equal(pixels(grey)[..., :3], np.stack([grey] * 3, -1))
    for wrong in (np.zeros((4, 4, 4)), np.zeros((4, 4, 2), np.uint8), None):
        with pytest.raises(OptionError, match="golden picture"):
            as_picture(wrong)
    with pytest.raises(OptionError, match="cannot be read"):
        as_picture("a picture")


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
    for first, second, what in ((before, more, "new"), (more, before, "gone")):
        line = explain_change(noise(1), noise(2), first, second)
        assert line.startswith(f"layer 2 (border, red) is {what}; 108 pixels differ")
    # What remains is not said to have changed.
    below = explain_change(
        noise(1), noise(2), layer_notes(Banner.parse("white border:red"), packs), more
    )
    assert below.startswith("layer 1 (creeper, lime) is new; 108")


def notes_of(design: str) -> list[dict[str, str]]:
    return layer_notes(Banner.parse(design), open_packs(()))


def test_more_changed_layers_than_are_named_are_counted() -> None:
    before = notes_of("white cross:red border:red creeper:red skull:red")
    after = notes_of("white cross:lime border:lime creeper:lime skull:lime")
    line = explain_change(noise(1), noise(2), before, after)
    assert line.count("became") == 3 and "; 1 more layer changed; 108 pixels" in line
    line = explain_change(noise(1), noise(2), before, notes_of("blue"))
    assert "; 2 more layers changed; 108 pixels" in line


@pytest.mark.parametrize(
    ("first", "second", "change"),
    [
        ("white creeper:red base:blue", "white creeper:lime base:blue", "became (creeper, lime)"),
        ("white creeper:red base:blue", "white base:blue", "is gone"),
        ("white base:blue", "white creeper:red base:blue", "is new"),
    ],
)
def test_a_hidden_layer_is_named_as_hidden_after_those_that_can_be_seen(
    first: str, second: str, change: str
) -> None:
    said = explain_change(
        noise(1),
        noise(2),
        notes_of(f"{first} cross:red"),
        notes_of(f"{second} cross:lime"),
    ).split("; ")
    assert "(cross, red) became (cross, lime)" in said[0] and "hidden" not in said[0]
    assert said[1].startswith("layer 1 (creeper, red) ")
    assert said[1].endswith(f"{change}, hidden on the front by layers above")


def test_a_layer_that_shows_beside_those_above_is_not_hidden() -> None:
    line = explain_change(noise(1), noise(2), notes_of("white border:red"), notes_of("white"))
    more = explain_change(
        noise(1), noise(2), notes_of("white border:red cross:red"), notes_of("white cross:red")
    )
    assert "hidden" not in line + more


@pytest.mark.parametrize("face", ["x", "AAAA", ""])
def test_a_damaged_picture_of_a_layer_is_said(face: str) -> None:
    after = notes_of("white creeper:lime")
    before = [*after[:2], {**after[2], "face": face}]
    line = explain_change(noise(1), noise(2), before, after)
    assert line.startswith("layer 1 (creeper, lime) cannot be compared: its picture in the golden")


def _shifted(face: str, down: int) -> str:
    from drapery.testing.explain import packed_face, unpacked_face

    pixels = unpacked_face(face)
    assert pixels is not None
    return packed_face(np.roll(pixels, down, axis=0))
