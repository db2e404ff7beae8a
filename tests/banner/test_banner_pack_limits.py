"""Hostile and broken packs are refused in one line that names them; nothing is unpacked."""

import os
import random
import stat
import struct
import zipfile
import zlib
from collections.abc import Callable
from pathlib import Path

import pytest
from cost import limited_cost
from pack_maker import BANNER, CREEPER, folder_pack, mcmeta, plain, zip_pack

from drapery.banner.packs.checks import MAX_FILES
from drapery.banner.packs.stack import MAX_PNG, open_packs
from drapery.errors import PackError

pytestmark = pytest.mark.quick

SOUND = {"pack.mcmeta": mcmeta(), CREEPER: plain(1, 0, 0, 255)}


def refusal(path: Path, pattern: str = "creeper") -> str:
    """The one line with which a pack is refused, on opening or on the first sheet."""
    with pytest.raises(PackError) as caught:
        open_packs([path]).sheet(pattern)
    line = str(caught.value)
    assert path.name in line and "\n" not in line
    return line


def entry(name: str, **fields: int) -> zipfile.ZipInfo:
    info = zipfile.ZipInfo(name)
    info.compress_type = zipfile.ZIP_DEFLATED
    for field, value in fields.items():
        setattr(info, field, value)
    return info


def test_no_such_path(tmp_path: Path) -> None:
    assert "does not exist" in refusal(tmp_path / "nothing.zip")


@pytest.mark.parametrize("data", [b"", b"PK", b"hello" * 100, plain(1, 1, 1, 1)])
def test_other_files(tmp_path: Path, data: bytes) -> None:
    (tmp_path / "a.zip").write_bytes(data)
    assert "neither a folder nor a complete zip" in refusal(tmp_path / "a.zip")


@pytest.mark.parametrize(
    ("folder", "hint"),
    [
        ("packs/one/assets", "it is a folder inside a pack, give"),
        ("packs/one/assets/minecraft/textures", "it is a folder inside a pack, give"),
        ("packs", "it holds several packs, choose one: one, two"),
        ("zips", "it holds a.zip, give one of them"),
        ("bedrock", "it is a pack for Bedrock"),
        ("empty", "it has neither assets nor pack.mcmeta"),
    ],
)
def test_folders_that_are_not_packs(tmp_path: Path, folder: str, hint: str) -> None:
    folder_pack(tmp_path / "packs/one", SOUND)
    folder_pack(tmp_path / "packs/two", SOUND)
    folder_pack(tmp_path / "bedrock", {"manifest.json": "{}"})
    folder_pack(tmp_path / "empty", {"readme.txt": "x"})
    (tmp_path / "zips").mkdir()
    zip_pack(tmp_path / "zips/a.zip", SOUND)
    assert hint in refusal(tmp_path / folder)


@pytest.mark.parametrize(
    ("names", "hint"),
    [
        (["manifest.json"], "it is a pack for Bedrock"),
        (["inner.zip"], "it holds another zip"),
        (
            ["one/assets/a", "two/assets/a"],
            "it holds several packs, unpack it and choose one: one, two",
        ),
        (
            ["a\nb/assets/a", "c/assets/a"],
            "it holds several packs, unpack it and choose one: 'a\\nb', c",
        ),
        (["readme.txt"], "neither assets nor pack.mcmeta"),
        ([], "neither assets nor pack.mcmeta"),
    ],
)
def test_zips_that_are_not_packs(tmp_path: Path, names: list[str], hint: str) -> None:
    assert hint in refusal(zip_pack(tmp_path / "a.zip", dict.fromkeys(names, "x")))


@pytest.mark.parametrize(
    "name", ["../evil", "assets/../../evil", "/etc/evil", "C:/evil", "..\\evil"]
)
def test_names_that_lead_out(tmp_path: Path, name: str) -> None:
    assert "leads out of the pack" in refusal(zip_pack(tmp_path / "a.zip", {**SOUND, name: "x"}))
    assert sorted(path.name for path in tmp_path.rglob("*")) == ["a.zip"]


def test_links_in_folders(tmp_path: Path) -> None:
    secret = tmp_path / "secret.png"
    secret.write_bytes(plain(1, 1, 1, 1))
    pack = folder_pack(tmp_path / "pack", SOUND)
    (pack / CREEPER).unlink()
    (pack / CREEPER).symlink_to(secret)
    assert "is a link out of the pack" in refusal(pack)
    (pack / CREEPER).unlink()
    (pack / CREEPER).symlink_to(pack / "nothing")
    assert "is a broken link" in refusal(pack)
    (pack / CREEPER).unlink()
    (pack / CREEPER).symlink_to(pack / CREEPER)
    assert "creeper.png" in refusal(pack)


def test_a_link_within_the_pack_or_to_the_pack_is_followed(tmp_path: Path) -> None:
    pack = folder_pack(tmp_path / "pack", SOUND)
    (pack / BANNER / "skull.png").symlink_to("creeper.png")
    (tmp_path / "link").symlink_to(pack)
    assert open_packs([tmp_path / "link"]).sheet("skull")[0, 0, 0] == 1


def test_links_in_zips(tmp_path: Path) -> None:
    link = entry(CREEPER, external_attr=(stat.S_IFLNK | 0o777) << 16)
    with zipfile.ZipFile(tmp_path / "a.zip", "w") as archive:
        archive.writestr(link, "/etc/passwd")
    assert "is a link" in refusal(tmp_path / "a.zip")


def test_pipes_and_folders_in_place_of_files(tmp_path: Path) -> None:
    pack = folder_pack(tmp_path / "pack", {"pack.mcmeta": mcmeta(), CREEPER + "/x": "x"})
    os.mkfifo(pack / BANNER / "skull.png")
    packs = open_packs([pack])
    assert packs.level("creeper") == 0 and packs.level("skull") == 0


def flagged(path: Path, bit: int) -> Path:
    """The zip with a flag bit set in every local and central header; see APPNOTE 4.4.4."""
    data = bytearray(path.read_bytes())
    for signature, offset in ((b"PK\3\4", 6), (b"PK\1\2", 8)):
        at = data.find(signature)
        while at >= 0:
            data[at + offset] |= bit
            at = data.find(signature, at + 4)
    path.write_bytes(data)
    return path


def test_encrypted_zips(tmp_path: Path) -> None:
    path = flagged(zip_pack(tmp_path / "a.zip", SOUND), 1)
    assert "is encrypted: make the zip without a password" in refusal(path)


@pytest.mark.parametrize("method", [zipfile.ZIP_BZIP2, zipfile.ZIP_LZMA])
def test_other_compressions(tmp_path: Path, method: int) -> None:
    with zipfile.ZipFile(tmp_path / "a.zip", "w", method) as archive:
        archive.writestr(CREEPER, plain(1, 1, 1, 1))
    assert "use deflate" in refusal(tmp_path / "a.zip")


def test_truncated_zips(tmp_path: Path) -> None:
    whole = zip_pack(tmp_path / "whole.zip", SOUND).read_bytes()
    cut = tmp_path / "cut.zip"
    for length in range(0, len(whole) - 1, 23):
        cut.write_bytes(whole[:length])
        assert "download it again" in refusal(cut)
    # Without its middle the list of contents points at the wrong places.
    cut.write_bytes(whole[:40] + whole[90:])
    assert "again" in refusal(cut)


def test_files_twice_in_a_zip(tmp_path: Path) -> None:
    with zipfile.ZipFile(tmp_path / "a.zip", "w") as archive, pytest.warns(UserWarning):
        archive.writestr(CREEPER, plain(1, 1, 1, 1))
        archive.writestr(CREEPER, plain(2, 2, 2, 2))
    assert "is in the zip twice" in refusal(tmp_path / "a.zip")


def test_zip_bombs(tmp_path: Path) -> None:
    path = zip_pack(tmp_path / "a.zip", {CREEPER: bytes(MAX_PNG + 1)})
    assert "zip bombs are not read" in refusal(path)
    small = zip_pack(tmp_path / "b.zip", {CREEPER: bytes(2 << 20)})
    assert "zip bombs are not read" in refusal(small)


def test_zip_bombs_that_lie_about_their_size(tmp_path: Path) -> None:
    path = zip_pack(tmp_path / "a.zip", {CREEPER: bytes(MAX_PNG * 2)})
    data = bytearray(path.read_bytes())
    central = data.find(b"PK\1\2")
    data[central + 24 : central + 28] = struct.pack("<I", 1000)
    path.write_bytes(data)
    with limited_cost():
        assert "creeper.png" in refusal(path)


def listing(count: int) -> bytes:
    """Only the central directory of a zip that claims so many empty files."""
    record = b"PK\1\2" + bytes(24) + struct.pack("<H", 7) + bytes(16)
    body = b"".join(record + b"%07d" % n for n in range(count))
    return body + struct.pack(
        "<4s4H2LH", b"PK\5\6", 0, 0, count & 0xFFFF, count & 0xFFFF, len(body), 0, 0
    )


def test_nameless_entries(tmp_path: Path) -> None:
    record = b"PK\1\2" + bytes(42)
    end = struct.pack("<4s4H2LH", b"PK\5\6", 0, 0, 1, 1, len(record), 0, 0)
    (tmp_path / "a.zip").write_bytes(record + end)
    assert "neither assets nor pack.mcmeta" in refusal(tmp_path / "a.zip")


@pytest.mark.parametrize("count", [MAX_FILES + 1, 1_000_000])
def test_millions_of_files(tmp_path: Path, count: int) -> None:
    (tmp_path / "a.zip").write_bytes(listing(count))
    with limited_cost(40):
        assert str(MAX_FILES) in refusal(tmp_path / "a.zip")


def test_millions_of_files_behind_a_zip64_record(tmp_path: Path) -> None:
    data = listing(1_000_000)
    body, end = data[:-22], data[-22:]
    big = struct.pack("<4sQ2H2L4Q", b"PK\6\6", 44, 45, 45, 0, 0, 10**6, 10**6, len(body), 0)
    locator = struct.pack("<4sLQL", b"PK\6\7", 0, len(body), 1)
    modest = end[:12] + struct.pack("<I", 53) + end[16:]
    for records in (big + locator, locator):
        (tmp_path / "a.zip").write_bytes(body + records + modest)
        assert "lists too many files" in refusal(tmp_path / "a.zip")


def test_png_bombs(tmp_path: Path) -> None:
    def chunk(kind: bytes, data: bytes) -> bytes:
        return (
            struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
        )

    header = chunk(b"IHDR", struct.pack(">2I5B", 60_000, 60_000, 8, 6, 0, 0, 0))
    rows = zlib.compress(bytes(4 << 20), 9)
    bomb = b"\x89PNG\r\n\x1a\n" + header + chunk(b"IDAT", rows) + chunk(b"IEND", b"")
    assert "60000 x 60000 px" in refusal(folder_pack(tmp_path / "pack", {**SOUND, CREEPER: bomb}))


def test_large_files_in_folders(tmp_path: Path) -> None:
    pack = folder_pack(tmp_path / "pack", SOUND)
    with (pack / CREEPER).open("r+b") as file:
        file.truncate(MAX_PNG + 1)
    assert "shrink it" in refusal(pack)


def mutated(data: bytes, rng: random.Random) -> bytes:
    """A few bytes changed, a stretch cut out or doubled, or the end lost."""
    result = bytearray(data)
    for _ in range(rng.choice((1, 1, 2, 5, 30))):
        at, length = rng.randrange(len(result)), rng.choice((1, 1, 2, 4, 16))
        kind = rng.randrange(4)
        if kind == 0:
            result[at : at + length] = rng.randbytes(length)
        elif kind == 1:
            result[at : at + length] = rng.choice((b"\xff\xff\xff\xff", bytes(4), b"\x7f"))
        elif kind == 2 and len(result) > 64:
            del result[at : at + length]
        else:
            result[at:at] = result[at : at + length]
    return bytes(result)


@pytest.mark.parametrize("seed", range(4))
def test_mutated_zips_are_read_or_refused(tmp_path: Path, seed: int) -> None:
    rng = random.Random(seed)
    whole = zip_pack(tmp_path / "whole.zip", SOUND).read_bytes()
    path = tmp_path / "a.zip"
    outcomes: dict[bool, int] = {True: 0, False: 0}
    for _ in range(150):
        path.write_bytes(mutated(whole, rng))
        outcomes[_reads(lambda: open_packs([path]).sheet("creeper"))] += 1
    assert min(outcomes.values()) > 0


def test_mutated_meta_is_read_or_refused(tmp_path: Path) -> None:
    rng = random.Random(5)
    overlays = {"entries": [{"directory": "a", "formats": [4, 84], "min_format": [69, 0]}]}
    whole = mcmeta(18, overlays=overlays, filter={"block": [{"path": "a.*b"}]})
    pack = folder_pack(tmp_path / "pack", SOUND)
    for _ in range(500):
        (pack / "pack.mcmeta").write_bytes(mutated(whole, rng))
        _reads(lambda: open_packs([pack]).sheet("creeper"))


def _reads(act: Callable[[], object]) -> bool:
    try:
        act()
    except PackError as error:
        assert "\n" not in str(error)
        return False
    return True
