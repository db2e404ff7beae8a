"""Packs in zips and jars. Nothing is unpacked to disk, and stated sizes are not trusted."""

import os
import struct
import zlib
from dataclasses import dataclass
from pathlib import Path
from stat import S_ISLNK
from typing import TYPE_CHECKING

from drapery.banner.packs.checks import IGNORED_NAMES, MAX_FILES, ROOTS, listed, within
from drapery.errors import PackError
from drapery.user_files import open_user_file, reason

if TYPE_CHECKING:
    from zipfile import ZipFile, ZipInfo

MAX_DIRECTORY = 8 << 20
"""Largest list of contents in a zip [bytes]; it is read before the first file."""

MAX_RATIO = 200
"""Largest compression ratio of a file over a mebibyte; PNG files have about 1."""

_LONGEST_TAIL = 76 + 22 + (1 << 16)
"""A zip's end records and the longest comment behind them [bytes]."""


@dataclass(frozen=True)
class ZipSource:
    """A pack in a zip or jar. entries: the files by their names under the pack's root."""

    archive: "ZipFile"
    entries: "dict[str, ZipInfo]"
    duplicates: frozenset[str]
    label: str

    def read(self, name: str, limit: int) -> bytes | None:
        """See `PackSource`."""
        entry = self.entries.get(name)
        if entry is None:
            return None
        place = f"{self.label}: {name}"
        if name in self.duplicates:
            raise PackError(f"{place} is in the zip twice: make the zip again")
        _check_entry(entry, limit, place)
        try:
            with self.archive.open(entry) as file:
                # The stated size may be wrong; never more than the limit is unpacked.
                return within(file.read(limit + 1), limit, place)
        except _zip_faults() as error:
            raise PackError(f"{place} {_fault(error)}: download the zip again") from None

    def files(self, folder: str) -> tuple[str, ...]:
        """See `PackSource`."""
        return tuple(sorted(name for name in self.entries if name.startswith(f"{folder}/")))

    def folders(self, folder: str) -> tuple[str, ...]:
        """See `PackSource`."""
        start = len(folder) + 1
        inside = (name[start:] for name in self.entries if name.startswith(f"{folder}/"))
        return tuple(sorted({rest.split("/", 1)[0] for rest in inside if "/" in rest}))


def _zip_faults() -> tuple[type[Exception], ...]:
    """All that zipfile is known to raise on damaged files."""
    from zipfile import BadZipFile, LargeZipFile

    wrong = (EOFError, ValueError, RuntimeError, IndexError, struct.error, zlib.error)
    return BadZipFile, LargeZipFile, OSError, *wrong


def _fault(error: Exception) -> str:
    if isinstance(error, OSError):
        return f"cannot be read ({reason(error)})"
    return "is locked by a password" if isinstance(error, RuntimeError) else "is damaged"


def open_zip(path: Path, roots: tuple[str, ...] = ROOTS) -> ZipSource:
    """The pack in a zip or jar, also under one top folder. Raises PackError, OSError.

    roots: the files and folders of which a pack has at least one at its top.
    """
    _check_directory(path)
    from zipfile import ZipFile

    try:
        archive = ZipFile(path)
    except _zip_faults() as error:
        raise PackError(f"pack {path} {_fault(error)}: download it again") from None
    try:
        return _indexed(archive, str(path), roots)
    except PackError:
        archive.close()
        raise


def _indexed(archive: "ZipFile", label: str, roots: tuple[str, ...]) -> ZipSource:
    # Nameless entries occur in damaged zips, and is_dir fails on them before Python 3.12.
    infos = [info for info in archive.infolist() if info.filename and not info.is_dir()]
    if len(infos) > MAX_FILES:
        raise PackError(f"pack {label} has {len(infos)} files; at most {MAX_FILES} are read")
    # Some old tools write backslashes.
    named = [(info.filename.replace("\\", "/"), info) for info in infos]
    for name, _ in named:
        if name.startswith("/") or name[1:2] == ":" or ".." in name.split("/"):
            raise PackError(
                f"pack {label}: the name {name[:80]!r} leads out of the pack: do not use this pack"
            )
    root = _root_in_zip([name for name, _ in named], label, roots)
    entries: dict[str, ZipInfo] = {}
    duplicates = set()
    for name, info in named:
        if name.startswith(root):
            short = name[len(root) :]
            if short in entries:
                duplicates.add(short)
            entries[short] = info
    return ZipSource(archive, entries, frozenset(duplicates), label)


def _root_in_zip(names: list[str], label: str, roots: tuple[str, ...]) -> str:
    """The prefix of the pack's root: none, or the one top folder of a repacked download."""
    tops = {name.split("/", 1)[0] for name in names}
    if tops & set(roots):
        return ""
    inside = {
        parts[0]
        for parts in (name.split("/", 2) for name in names)
        if len(parts) > 1 and parts[1] in roots and parts[0] not in IGNORED_NAMES
    }
    if len(inside) == 1:
        return f"{inside.pop()}/"
    if inside:
        hint = f"it holds several packs, unpack it and choose one: {listed(inside)}"
    elif "manifest.json" in tops:
        hint = "it is a pack for Bedrock Edition; only packs for Java Edition are read"
    elif any(name.endswith(".zip") for name in tops):
        hint = "it holds another zip, unpack it once"
    else:
        hint = "it has neither assets nor pack.mcmeta at its top"
    raise PackError(f"pack {label} is not a resource pack: {hint}")


def _check_directory(path: Path) -> None:
    """Refuse a huge list of contents before zipfile reads it; see APPNOTE 4.3.14 to 4.3.16."""
    with open_user_file(path) as file:
        size = file.seek(0, os.SEEK_END)
        file.seek(max(0, size - _LONGEST_TAIL))
        tail = file.read()
    at = tail.rfind(b"PK\x05\x06")
    if at < 0 or len(tail) < at + 22:
        raise PackError(
            f"pack {path} is neither a folder nor a complete zip or jar: download it again"
        )
    length = struct.unpack_from("<I", tail, at + 12)[0]
    if tail[at - 20 : at - 16] == b"PK\x06\x07":
        # Only the place where zipfile itself looks counts: right before the locator.
        big = tail[max(0, at - 76) : at - 20]
        length = struct.unpack_from("<Q", big, 40)[0] if big[:4] == b"PK\x06\x06" else 1 << 64
    if length > MAX_DIRECTORY:
        raise PackError(
            f"pack {path} lists too many files; at most {MAX_FILES} are read: remove some"
        )


def _check_entry(entry: "ZipInfo", limit: int, place: str) -> None:
    if entry.flag_bits & 1:
        raise PackError(f"{place} is encrypted: make the zip without a password")
    if S_ISLNK(entry.external_attr >> 16):
        raise PackError(f"{place} is a link: replace it by the file itself")
    if entry.compress_type not in (0, 8):
        raise PackError(f"{place} has a compression that the game cannot read: use deflate")
    is_dense = entry.file_size > MAX_RATIO * max(1, entry.compress_size)
    if entry.file_size > limit or (is_dense and entry.file_size > 1 << 20):
        raise PackError(
            f"{place} would unpack from {entry.compress_size} to {entry.file_size} bytes:"
            " zip bombs are not read"
        )
