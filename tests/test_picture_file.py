"""Pictures from outside are judged by their headers before anything is decoded."""

import io
import logging
import struct
from unittest import mock

import numpy as np
import pytest
from cost import limited_cost
from PIL import Image

from drapery.comparison import decode_picture
from drapery.errors import OptionError
from drapery.match import decode_pixels
from drapery.picture_file import MAX_SCANS, opened_picture


def encoded(kind: str, side: int = 64, **options: object) -> bytes:
    ramp = np.add.outer(np.arange(side), np.arange(side)).astype(np.uint8)
    buffer = io.BytesIO()
    Image.fromarray(np.stack([ramp, ramp.T, ramp], axis=-1)).save(buffer, kind, **options)
    return buffer.getvalue()


def of_scans(count: int, side: int = 64) -> bytes:
    """A JPEG whose last scan is repeated until it has so many."""
    data = encoded("JPEG", side, progressive=True)
    last = data[data.rindex(b"\xff\xda") : -2]
    return data[:-2] + last * (count - data.count(b"\xff\xda")) + data[-2:]


def test_a_jpeg_of_many_scans_is_refused_before_it_is_decoded() -> None:
    assert decode_pixels(of_scans(MAX_SCANS)).shape == (64, 64, 4)
    with pytest.raises(OptionError, match="the picture is a JPEG of over 100 scans; save it"):
        decode_pixels(of_scans(MAX_SCANS + 1))
    with limited_cost(2), pytest.raises(OptionError, match="over 100 scans"):
        decode_pixels(of_scans(3000, 1024))


def test_a_broken_picture_writes_nothing_beside_its_error(
    capfd: pytest.CaptureFixture[str],
) -> None:
    """Pillow logs some faults, which Python writes to standard error where nobody handles them."""
    data = encoded("TIFF")
    tag = struct.pack("<HHI", 277, 3, 1)  # samples of a pixel
    assert data.count(tag) == 1
    broken = data.replace(tag + b"\3\0", tag + b"\0\1")
    with (
        mock.patch.object(logging.getLogger(), "handlers", []),
        pytest.raises(OptionError, match=r"wide\.tif is (a broken|not a) picture"),
        opened_picture(broken, "wide.tif", ("TIFF",)),
    ):
        pass
    assert capfd.readouterr() == ("", "")


def test_the_scans_of_a_larger_picture_cost_more(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("drapery.picture_file.MAX_PIXELS", 32 * 32)
    with (
        pytest.raises(OptionError, match="over 25 scans"),
        opened_picture(of_scans(30), "x", max_pixels=1 << 20),
    ):
        pass


def test_a_gif_with_a_frame_outside_of_its_picture_is_refused_before_it_is_decoded() -> None:
    """Pillow enlarges the picture for such a frame: a kilobyte took a gigabyte."""
    buffer = io.BytesIO()
    frames = [Image.new("RGB", (8, 8), colour) for colour in ("red", "blue")]
    frames[0].save(buffer, "GIF", save_all=True, append_images=frames[1:], disposal=2)
    data = buffer.getvalue()
    with opened_picture(data, "small.gif", ("GIF",)) as image:
        assert getattr(image, "n_frames", 0) == 2
    frame = data.rindex(b"," + struct.pack("<4H", 0, 0, 8, 8))
    for sides in ((13_000, 13_000, 8, 8), (0, 0, 9, 8), (0, 1, 8, 8)):
        changed = data[: frame + 1] + struct.pack("<4H", *sides) + data[frame + 9 :]
        with pytest.raises(OptionError, match="a frame outside of its 8 x 8 px; save it again"):
            decode_picture(changed, "large.gif")


def test_bytes_that_look_like_scans_are_none() -> None:
    comment = b"\xff\xfe" + struct.pack(">H", 2 + 1000) + b"\xff\xda" * 500
    data = encoded("JPEG")
    assert decode_pixels(data[:2] + comment + data[2:] + b"\xff\xda" * 500).shape == (64, 64, 4)


@pytest.mark.parametrize("options", [{}, {"lossless": True}, {"exif": b"Exif\0\0"}])
def test_a_webp_file_is_refused_by_its_header(options: dict[str, object]) -> None:
    data = encoded("WEBP", **options)
    assert decode_pixels(data).shape == (64, 64, 4)
    with (
        pytest.raises(OptionError, match=r"x is 64 x 64 px; at most 0 million pixels are read"),
        opened_picture(data, "x", max_pixels=1000),
    ):
        pass


@pytest.mark.parametrize("kind", ["PNG", "JPEG", "WEBP", "GIF"])
def test_each_format_has_a_largest_side_and_broken_ones_are_named(kind: str) -> None:
    data = encoded(kind)
    with opened_picture(data, "x") as image:
        assert image.size == (64, 64)
    with (
        pytest.raises(OptionError, match="x is larger than 60"),
        opened_picture(data, "x", max_side=60),
    ):
        pass
    with (
        pytest.raises(OptionError, match=r"^x is (not a picture|a broken picture)"),
        opened_picture(data[: len(data) // 2], "x") as image,
    ):
        image.convert("RGBA")


def test_other_formats_of_pillow_are_not_read() -> None:
    for kind in ("PPM", "ICO", "TGA"):
        with (
            pytest.raises(OptionError, match="save it as PNG, WebP, AVIF, GIF, TIFF, JPEG or BMP"),
            opened_picture(encoded(kind), "x"),
        ):
            pass
