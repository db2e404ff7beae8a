"""Pictures of all modes, depths, lengths and sizes are compared with all that they hold."""

import json
import struct
import zlib
from pathlib import Path

import numpy as np
import pytest
from conftest import Run
from PIL import Image

from drapery import Banner
from drapery.comparison import (
    Picture,
    Tolerance,
    align,
    as_picture,
    compare,
    difference_words,
    measure_pictures,
    read_picture,
    short_labels,
)
from drapery.errors import OptionError
from drapery.testing import decode, encode, fingerprint

SMALL = {"size": (24, 32), "grid": (3, 5), "time": 0.0}


def png(values: np.ndarray, colour_type: int, clear: bytes = b"") -> bytes:
    """A PNG of 16 bits a channel, written by hand. values: [H, W, channels]."""
    height, width = values.shape[:2]
    rows = b"".join(b"\0" + row.astype(">u2").tobytes() for row in values)

    def chunk(kind: bytes, body: bytes) -> bytes:
        whole = kind + body
        return struct.pack(">I", len(body)) + whole + struct.pack(">I", zlib.crc32(whole))

    header = struct.pack(">IIBBBBB", width, height, 16, colour_type, 0, 0, 0)
    parts = [chunk(b"IHDR", header), chunk(b"tRNS", clear) if clear else b""]
    parts += [chunk(b"IDAT", zlib.compress(rows)), chunk(b"IEND", b"")]
    return b"\x89PNG\r\n\x1a\n" + b"".join(parts)


@pytest.mark.parametrize(("colour_type", "channels"), [(0, 1), (2, 3), (4, 2), (6, 4)])
def test_all_sixteen_bits_of_a_png_are_read(
    tmp_path: Path, colour_type: int, channels: int
) -> None:
    values = np.random.default_rng(1).integers(0, 65536, (5, 7, channels), np.uint16)
    (tmp_path / "a.png").write_bytes(png(values, colour_type))
    (pixels,) = read_picture(tmp_path / "a.png").frames
    assert pixels.dtype == np.uint16
    colours = np.repeat(values[..., :1], 3, axis=-1) if channels < 3 else values[..., :3]
    assert np.array_equal(pixels[..., :3], colours)
    alpha = values[..., -1] if channels in (2, 4) else np.full((5, 7), 65535)
    assert np.array_equal(pixels[..., 3], alpha)


@pytest.mark.parametrize(("colour_type", "channels"), [(0, 1), (2, 3)])
def test_a_transparent_colour_of_sixteen_bits_is_exact(
    tmp_path: Path, colour_type: int, channels: int
) -> None:
    values = np.full((1, 2, channels), 0x1234, np.uint16)
    values[0, 1, 0] = 0x1235
    clear = struct.pack(f">{channels}H", *[0x1234] * channels)
    (tmp_path / "a.png").write_bytes(png(values, colour_type, clear))
    assert read_picture(tmp_path / "a.png").frames[0][0, :, 3].tolist() == [0, 65535]


def test_a_golden_holds_sixteen_bits() -> None:
    pixels = np.random.default_rng(2).integers(0, 65536, (6, 4, 4), np.uint16)
    notes = [{"name": "base, red", "face": "x"}]
    back, kept = decode(encode(pixels, notes))
    assert np.array_equal(back.frames[0], pixels) and kept == notes
    other = pixels.copy()
    other[0, 0, 3] |= 1 << 15
    pixels[0, 0, 3] |= 1 << 15
    assert fingerprint(pixels) == fingerprint(other)
    other[0, 0, 0] ^= 1
    assert fingerprint(pixels) != fingerprint(other)
    assert b"16 bits" in fingerprint(pixels)


def frames_of(levels: tuple[int, ...]) -> list[Image.Image]:
    return [Image.fromarray(np.full((8, 6, 3), level, np.uint8)) for level in levels]


def loop(path: Path, levels: tuple[int, ...], durations: list[int], plays: int = 0) -> Path:
    first, *rest = frames_of(levels)
    more = {"lossless": True} if path.suffix == ".webp" else {}
    first.save(path, save_all=True, append_images=rest, duration=durations, loop=plays, **more)
    return path


@pytest.mark.parametrize("ending", ["gif", "png", "webp"])
def test_frames_times_and_plays_of_loops_count(tmp_path: Path, drapery: Run, ending: str) -> None:
    kept = loop(tmp_path / f"kept.{ending}", (0, 50, 100), [100, 200, 100])
    others = {
        "same to the last bit": loop(tmp_path / f"a.{ending}", (0, 50, 100), [100, 200, 100]),
        "in frame 2": loop(tmp_path / f"b.{ending}", (0, 60, 100), [100, 200, 100]),
        "the time of frame 2 (200 and 300 ms)": loop(
            tmp_path / f"c.{ending}", (0, 50, 100), [100, 300, 100]
        ),
        "3 frames and 2 frames": loop(tmp_path / f"d.{ending}", (0, 50), [100, 200]),
        "played for ever and": loop(tmp_path / f"e.{ending}", (0, 50, 100), [100, 200, 100], 3),
    }
    for words, path in others.items():
        code, out, _ = drapery("compare", kept, path)
        assert words in out and code == ("same" not in words), out
    with Image.open(kept) as first, Image.open(others["in frame 2"]) as second:
        found = measure_pictures(as_picture(first), as_picture(second))
    assert found.frames == (2,) and not found.agrees
    back, _ = decode(encode(kept))
    assert measure_pictures(back, read_picture(kept)).exact
    assert back.delays == pytest.approx((0.1, 0.2, 0.1))


@pytest.mark.parametrize("mode", ["F", "I"])
def test_a_mode_without_a_range_is_refused(mode: str) -> None:
    image = Image.fromarray(np.ones((2, 2), np.float32 if mode == "F" else np.int32))
    with pytest.raises(OptionError, match=f"mode {mode} has no fixed range of values; scale it"):
        as_picture(image)


@pytest.mark.parametrize("mode", ["1", "L", "LA", "P", "PA", "RGB", "RGBA", "CMYK", "YCbCr", "HSV"])
def test_other_modes_of_pillow_are_pictures(mode: str) -> None:
    noise = np.random.default_rng(0).integers(0, 256, (9, 9, 3), np.uint8)
    image = Image.fromarray(noise).convert("L" if mode in ("1", "LA") else "RGB").convert(mode)
    expected = np.asarray(image.convert("RGBA"))
    assert np.array_equal(as_picture(image).frames[0], expected)


@pytest.mark.parametrize("ending", ["jpg", "bmp", "tiff", "png"])
def test_pictures_of_other_files_are_compared(tmp_path: Path, drapery: Run, ending: str) -> None:
    paths = [tmp_path / f"{name}.{ending}" for name in "ab"]
    for path, image in zip(paths, frames_of((10, 200)), strict=True):
        image.save(path)
    assert drapery("compare", paths[0], paths[0])[0] == 0
    code, out, _ = drapery("compare", *paths)
    assert code == 1 and "48 pixels differ, max 190" in out


def test_pictures_of_two_sizes_are_different(tmp_path: Path, drapery: Run) -> None:
    Image.new("RGB", (6, 8), "red").save(tmp_path / "a.png")
    Image.new("RGB", (9, 5), "red").save(tmp_path / "b.png")
    out = [tmp_path / f"c.{ending}" for ending in ("png", "gif", "html", "json")]
    words = [word for path in out for word in ("-o", path)]
    code, said, _ = drapery("compare", tmp_path / "a.png", tmp_path / "b.png", *words)
    assert code == 1 and "the sizes 6x8 and 9x5; 33 pixels differ" in said
    assert all(path.stat().st_size for path in out)
    same = drapery("compare", tmp_path / "a.png", tmp_path / "b.png", "--pixels", "999")
    assert same[0] == 1


def test_one_verdict_stands_in_text_json_and_html(tmp_path: Path, drapery: Run) -> None:
    pixels = np.full((8, 8, 4), 200, np.uint8)
    Image.fromarray(pixels).save(tmp_path / "a.png")
    pixels[0, :3, 0], pixels[1, 1, 0] = 203, 150
    Image.fromarray(pixels).save(tmp_path / "b.png")
    files = (tmp_path / "a.png", tmp_path / "b.png", "-o", tmp_path / "c.json", "-o")
    for tolerance, verdict, words in (
        (0, "different", "4 pixels differ, max 50"),
        (5, "different", "1 pixel differs, 3 pixels differ within the limits (tolerance 5)"),
        (50, "within", "4 pixels differ within the limits (tolerance 50)"),
    ):
        code, out, _ = drapery("compare", *files, tmp_path / "c.html", "--tolerance", tolerance)
        facts = json.loads((tmp_path / "c.json").read_text(encoding="utf-8"))["pairs"][0]
        page = (tmp_path / "c.html").read_text(encoding="utf-8")
        assert words in out and words in page, out
        assert (code, facts["verdict"]) == (int(verdict == "different"), verdict)
        assert facts["limits"] == ({"tolerance": tolerance} if tolerance else {})
        assert f'class="{"different" if code else "same"}"' in page


def test_ignored_parts_and_smoothed_edges_by_the_command(tmp_path: Path, drapery: Run) -> None:
    pixels = np.full((8, 8, 4), 200, np.uint8)
    Image.fromarray(pixels).save(tmp_path / "a.png")
    pixels[2, 3, :3] = 0
    Image.fromarray(pixels).save(tmp_path / "b.png")
    both = ("compare", tmp_path / "a.png", tmp_path / "b.png")
    assert drapery(*both)[0] == 1
    assert drapery(*both, "--ratio", "0.02")[0] == 0
    code, out, _ = drapery(*both, "--ignore", "3,2,1,1")
    assert code == 0 and "the same to the eye; 1 pixel is ignored" in out
    mask = np.zeros((8, 8), np.uint8)
    mask[2, 3] = 255
    Image.fromarray(mask).save(tmp_path / "mask.png")
    assert drapery(*both, "--mask", tmp_path / "mask.png")[0] == 0
    for wrong in ("3,2,1", "a,b,c,d", "3,2,0,1"):
        code, _, err = drapery(*both, "--ignore", wrong)
        assert code == 2 and err.count("\n") == 1
    assert drapery(*both, "--flip", "2")[0] == 2


def test_equal_items_belong_together() -> None:
    assert align("abc", "abc") == [(0, 0), (1, 1), (2, 2)]
    assert align("abc", "bc") == [(0, None), (1, 0), (2, 1)]
    assert align("bc", "abc") == [(None, 0), (0, 1), (1, 2)]
    assert align("abc", "axc") == [(0, 0), (1, 1), (2, 2)]
    assert align("", "ab") == [(None, 0), (None, 1)]
    for first, second in (("abcab", "bacba"), ("aaaa", "aa"), ("xyz", "zyx")):
        pairs = align(first, second)
        assert [i for i, _ in pairs if i is not None] == [*range(len(first))]
        assert [j for _, j in pairs if j is not None] == [*range(len(second))]


def test_a_removed_layer_is_the_cause_not_the_one_above() -> None:
    whole = Banner.parse("white creeper:lime border:black")
    found = compare(whole, Banner.parse("white border:black"), **SMALL)
    assert found.culprit == "layer 1 (creeper, lime), which only the first has"
    assert [step.names for step in found.build_up] == [
        ("base (white)", "base (white)"),
        ("layer 1 (creeper, lime)", None),
        ("layer 2 (border, black)", "layer 1 (border, black)"),
    ]
    found = compare(Banner.parse("white border:black"), whole, **SMALL)
    assert found.culprit == "layer 1 (creeper, lime), which only the second has"


def test_what_is_hidden_in_the_end_is_no_cause() -> None:
    """The first layers differ and are covered by a whole one; the border differs at the end."""
    first = Banner.parse("white creeper:lime base:red border:black")
    second = Banner.parse("white skull:blue base:red border:white")
    found = compare(first, second, **SMALL)
    assert (
        found.culprit is not None
        and found.culprit == "layer 3 (border, white) in place of layer 3 (border, black)"
    )
    same = compare(first, Banner.parse("white skull:blue base:red border:black"), **SMALL)
    assert same.difference.exact and same.culprit is None


def test_labels_are_cut_where_they_differ() -> None:
    assert short_labels("red", "blue") == ("red", "blue")
    start = "white " + "creeper:lime " * 9
    first, second = short_labels(start + "border:black", start + "border:red")
    assert max(len(first), len(second)) <= 42 and first != second
    assert "black" in first and "red" in second and first.startswith("…")


def test_figures_are_told_the_same_everywhere() -> None:
    a, b = (Picture((np.full((4, 4, 4), level, np.uint8),)) for level in (10, 13))
    tolerance = Tolerance(2)
    words = difference_words(measure_pictures(a, b, tolerance), tolerance)
    assert words == "16 pixels differ (tolerance 2), max 3, in columns 0 to 3 of rows 0 to 3"


@pytest.mark.parametrize(
    ("first", "second", "cause", "hidden"),
    [
        ("white creeper:lime base:red", "white base:red", None, "only the first has"),
        ("white base:red", "white creeper:lime base:red", None, "only the second has"),
        (
            "white creeper:lime base:red border:black",
            "white skull:blue base:blue border:black",
            "layer 2 (base, blue) in place of layer 2 (base, red)",
            "layer 1 (skull, blue) in place of layer 1 (creeper, lime)",
        ),
        (
            "white creeper:lime",
            "white skull:blue base:red",
            "layer 2 (base, red), which only the second has",
            "layer 1 (skull, blue) in place of layer 1 (creeper, lime)",
        ),
        (
            "white base:red border:white",
            "black base:red border:black",
            "layer 2 (border, black) in place of layer 2 (border, white)",
            None,
        ),
    ],
)
def test_layers_that_cannot_be_seen_are_named_as_such(
    first: str, second: str, cause: str | None, hidden: str | None
) -> None:
    found = compare(Banner.parse(first), Banner.parse(second), **SMALL)
    assert found.culprit == cause
    if hidden is not None:
        (layer,) = found.hidden_layers
        assert hidden in layer and f"{layer}; it cannot be seen" in found.line()
    if cause is not None:
        assert f"; from {cause} on" in found.line()
