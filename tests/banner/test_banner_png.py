"""PNG files of every mode become the same texels; broken and huge ones are refused by name."""

import struct
import zlib

import numpy as np
import pytest
from pack_maker import noise, png
from PIL import Image

from drapery.banner.packs.png import MAX_SIDE, png_size, read_png
from drapery.banner.packs.png_chunks import MAX_CHUNKS, wrong_checksums
from drapery.errors import PackError

pytestmark = pytest.mark.quick

GREY, GREY_ALPHA, COLOUR, PALETTE, COLOUR_ALPHA = 0, 4, 2, 3, 6


def chunk(kind: bytes, data: bytes) -> bytes:
    return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))


def raw_png(width: int, height: int, depth: int, kind: int, rows: bytes, *more: bytes) -> bytes:
    """A PNG of unfiltered packed rows, with more chunks before the data."""
    header = struct.pack(">IIBBBBB", width, height, depth, kind, 0, 0, 0)
    stride = len(rows) // height if height else 0
    lines = b"".join(b"\0" + rows[n * stride : (n + 1) * stride] for n in range(height))
    chunks = [chunk(b"IHDR", header), *more, chunk(b"IDAT", zlib.compress(lines))]
    return b"\x89PNG\r\n\x1a\n" + b"".join(chunks) + chunk(b"IEND", b"")


def one_row(texels: np.ndarray) -> list[tuple[int, ...]]:
    return [tuple(texel) for texel in texels[0].tolist()]


def test_texels_come_back() -> None:
    texels = noise(1, 32)
    assert (read_png(png(texels), "x") == texels).all()


def test_colours_without_alpha_are_opaque() -> None:
    texels = noise(2, 16)
    got = read_png(png(np.ascontiguousarray(texels[..., :3])), "x")
    assert (got[..., :3] == texels[..., :3]).all() and (got[..., 3] == 255).all()


def test_grey_with_alpha() -> None:
    texels = noise(3, 16)
    got = read_png(png(np.ascontiguousarray(texels[..., 2:])), "x")
    assert (got[..., :3] == texels[..., 2:3]).all() and (got[..., 3] == texels[..., 3]).all()


@pytest.mark.parametrize("depth", [1, 2, 4, 8])
def test_grey_of_few_bits_spans_black_to_white_and_may_be_clear(depth: int) -> None:
    top = (1 << depth) - 1
    values = [0, top, 1, top]
    bits = "".join(f"{value:0{depth}b}" for value in values)
    row = int(bits, 2).to_bytes(len(bits) // 8, "big") if depth > 1 else bytes([0b01110000])
    got = read_png(raw_png(4, 1, depth, GREY, row, chunk(b"tRNS", struct.pack(">H", 1))), "x")
    level = 255 // top
    wanted = [
        (v * level,) * 3 + (0 if v == 1 else 255,) for v in (values if depth > 1 else [0, 1, 1, 1])
    ]
    assert one_row(got) == wanted


def test_palette_with_clear_and_half_clear_entries() -> None:
    palette = chunk(b"PLTE", bytes([255, 0, 0, 0, 255, 0, 0, 0, 255]))
    alphas = chunk(b"tRNS", bytes([0, 128]))
    got = read_png(raw_png(3, 1, 8, PALETTE, bytes([0, 1, 2]), palette, alphas), "x")
    assert one_row(got) == [(255, 0, 0, 0), (0, 255, 0, 128), (0, 0, 255, 255)]


def test_one_clear_colour() -> None:
    rows = bytes([1, 2, 3, 1, 2, 4])
    got = read_png(
        raw_png(2, 1, 8, COLOUR, rows, chunk(b"tRNS", struct.pack(">HHH", 1, 2, 3))), "x"
    )
    assert one_row(got) == [(1, 2, 3, 0), (1, 2, 4, 255)]


@pytest.mark.parametrize(
    ("kind", "channels"), [(GREY, 1), (GREY_ALPHA, 2), (COLOUR, 3), (COLOUR_ALPHA, 4)]
)
def test_sixteen_bits_keep_their_upper_eight(kind: int, channels: int) -> None:
    values = np.array([0x00FF, 0x80FF, 0x7F80, 0xFFFF] * channels, ">u2")
    got = read_png(raw_png(4, 1, 16, kind, values.tobytes()), "x")
    upper = (values.reshape(4, channels) >> 8).astype(np.uint8)
    colours = upper[:, :1].repeat(3, 1) if channels < 3 else upper[:, :3]
    alphas = upper[:, -1:] if channels in (2, 4) else np.full((4, 1), 255, np.uint8)
    assert (got[0] == np.concatenate([colours, alphas], 1)).all()


def test_sixteen_bit_grey_may_be_clear() -> None:
    rows = struct.pack(">2H", 0x1234, 0x1235)
    clear = chunk(b"tRNS", struct.pack(">H", 0x1234))
    assert one_row(read_png(raw_png(2, 1, 16, GREY, rows, clear), "x")) == [
        (0x12, 0x12, 0x12, 0),
        (0x12, 0x12, 0x12, 255),
    ]


def test_interlaced_files_are_read() -> None:
    # Adam7 of 8 x 8 by hand: each pass holds its own small picture.
    grid = np.arange(64, dtype=np.uint8).reshape(8, 8)
    passes = [(0, 0, 8, 8), (0, 4, 8, 8), (4, 0, 8, 4), (0, 2, 4, 4), (2, 0, 4, 2), (0, 1, 2, 2)]
    lines = b""
    for top, left, down, across in [*passes, (1, 0, 2, 1)]:
        for row in grid[top::down, left::across]:
            lines += b"\0" + row.tobytes()
    header = struct.pack(">IIBBBBB", 8, 8, 8, GREY, 0, 0, 1)
    data = b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(lines))
    assert (read_png(data + chunk(b"IEND", b""), "x")[..., 0] == grid).all()


def test_the_size_is_known_without_decoding() -> None:
    assert png_size(png(noise(4, 24)), "x") == (24, 24)


@pytest.mark.parametrize("side", [MAX_SIDE + 1, 1 << 31, 0])
def test_bombs_are_refused_by_their_header(side: int) -> None:
    data = raw_png(1, 1, 8, GREY, b"\0")
    bomb = data[:16] + struct.pack(">I", side) + data[20:]
    with pytest.raises(PackError, match=r"pack\.zip: big\.png is \d+ x 1 px"):
        read_png(bomb, "pack.zip: big.png")


def test_two_long_sides_are_refused_together() -> None:
    data = raw_png(1, 1, 8, GREY, b"\0")
    with pytest.raises(PackError, match="shrink it"):
        read_png(data[:16] + struct.pack(">II", MAX_SIDE, MAX_SIDE) + data[24:], "x")


@pytest.mark.parametrize("data", [b"", b"GIF89a", b"\x89PNG\r\n\x1a\n", b"\xff\xd8\xff" * 20])
def test_other_files_are_refused(data: bytes) -> None:
    with pytest.raises(PackError, match="is not a PNG file"):
        read_png(data, "x")


def test_other_formats_are_not_tried() -> None:
    from io import BytesIO

    file = BytesIO()
    Image.fromarray(noise(1, 8)[..., :3].copy()).save(file, "bmp")
    with pytest.raises(PackError, match="is not a PNG file"):
        read_png(file.getvalue(), "x")


def test_damaged_files_are_an_error_of_one_line() -> None:
    whole = png(noise(5, 32))
    rng = np.random.default_rng(6)
    for at in [*range(33, len(whole), 97), *range(33, 60)]:
        damaged = bytearray(whole)
        damaged[at] ^= int(rng.integers(1, 256))
        for data in (bytes(damaged), whole[:at]):
            try:
                read_png(data, "x.png")
            except PackError as error:
                assert "x.png" in str(error) and "\n" not in str(error)


def with_chunk(kind: bytes, data: bytes, at: int = 33) -> bytes:
    """A file with one more chunk, after IHDR unless `at` is given, whose checksum is wrong."""
    whole = png(noise(7, 8))
    wrong = bytearray(chunk(kind, data))
    wrong[-1] ^= 1
    return whole[:at] + bytes(wrong) + whole[at:]


@pytest.mark.parametrize(
    "kind", [b"iCCP", b"tEXt", b"iTXt", b"zTXt", b"gAMA", b"eXIf", b"acTL", b"pHYs", b"quIl"]
)
@pytest.mark.parametrize("data", [b"", b"x", b"a\0\0" + b"\xff" * 40])
@pytest.mark.parametrize("at", [33, -12])
def test_damage_in_chunks_without_texels_costs_nothing(kind: bytes, data: bytes, at: int) -> None:
    file = with_chunk(kind, data, at)
    assert (read_png(file, "x") == noise(7, 8)).all()
    assert wrong_checksums(file, "x") == (kind.decode(),)


def test_wrong_checksums_of_texels_are_told_and_those_of_headers_refused() -> None:
    whole = png(noise(7, 8))
    assert wrong_checksums(whole, "x") == ()
    damaged = bytearray(whole)
    damaged[-13] ^= 1  # the last byte of IDAT's
    assert wrong_checksums(bytes(damaged), "x") == ("IDAT",)
    assert (read_png(bytes(damaged), "x") == noise(7, 8)).all()
    damaged = bytearray(whole)
    damaged[32] ^= 1
    with pytest.raises(PackError, match="x is a broken PNG file"):
        read_png(bytes(damaged), "x")


def test_a_file_of_many_chunks_is_refused() -> None:
    whole = png(noise(7, 8))
    many = whole[:33] + chunk(b"tEXt", b"") * MAX_CHUNKS + whole[33:]
    with pytest.raises(PackError, match=f"x has over {MAX_CHUNKS} chunks"):
        read_png(many, "x")
