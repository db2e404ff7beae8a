"""Where a pack's files come from: a folder, a zip or jar, or our own art.

Nothing is ever unpacked: a file is found by its name inside the pack, read whole up to a limit and
handed on. Names are those of the pack's root: `assets/minecraft/textures/…`, with slashes.
"""

import os
import struct
import zlib
from collections.abc import Iterator
from dataclasses import dataclass
from importlib.resources import files
from importlib.resources.abc import Traversable
from pathlib import Path
from stat import S_ISLNK
from typing import TYPE_CHECKING, Protocol

from drapery.errors import PackError

if TYPE_CHECKING:
    from zipfile import ZipFile, ZipInfo

MAX_FILES = 100_000
"""Most files in a zip; the game's own jar has about 30,000."""

MAX_DIRECTORY = 8 << 20
"""Largest list of contents in a zip [bytes]; it is read whole before the first file."""

MAX_RATIO = 200
"""Most that a file over a mebibyte may be squeezed; PNG files hardly shrink at all."""

_LONGEST_TAIL = 76 + 22 + (1 << 16)
"""A zip's end records and the longest comment behind them [bytes]."""

_ROOTS = ("assets", "data", "pack.mcmeta")
_LITTER = ("__MACOSX", ".DS_Store")


class Source(Protocol):
    """The files of one pack."""

    @property
    def label(self) -> str:
        """What errors call the pack."""

    def read(self, name: str, limit: int) -> bytes | None:
        """A file whole, or None where there is none. Raises PackError, also beyond the limit."""

    def files(self, folder: str) -> tuple[str, ...]:
        """Names of all files under a folder, sorted."""

    def folders(self, folder: str) -> tuple[str, ...]:
        """Names of the folders right under a folder, sorted, without the path to it."""


def open_source(path: str | Path) -> Source:
    """A folder, zip or jar as a source. Raises PackError naming the path and the remedy."""
    target = Path(path)
    try:
        if target.is_dir():
            return _folder(target)
        if target.is_file():
            return _zip(target)
    except (OSError, ValueError) as error:
        raise PackError(f"pack {target} cannot be read: {_reason(error)}") from None
    raise PackError(f"pack {target} does not exist: check the path")


@dataclass(frozen=True)
class OwnArt:
    """The art that comes with this package; its folder is a pack's `assets`."""

    label: str = "drapery's own art"

    def read(self, name: str, limit: int) -> bytes | None:
        """See Source."""
        node = self._node(name)
        return node.read_bytes() if node is not None and node.is_file() else None

    def files(self, folder: str) -> tuple[str, ...]:
        """See Source."""
        node = self._node(folder)
        return tuple(sorted(_walk(node, folder))) if node is not None and node.is_dir() else ()

    def folders(self, folder: str) -> tuple[str, ...]:
        """See Source."""
        node = self._node(folder)
        if node is None or not node.is_dir():
            return ()
        return tuple(sorted(n.name for n in node.iterdir() if n.is_dir() and n.name[0] not in "_."))

    def _node(self, name: str) -> Traversable | None:
        top, *parts = name.split("/")
        return files("drapery.assets").joinpath(*parts) if top == "assets" else None


@dataclass(frozen=True)
class FolderSource:
    """A pack in a folder. Links that lead out of it are refused."""

    root: Path
    label: str

    def read(self, name: str, limit: int) -> bytes | None:
        """See Source."""
        path = self.root / name
        try:
            if not path.is_file():
                self._refuse_broken_link(path, name)
                return None
            self._refuse_way_out(path, name)
            with path.open("rb") as file:
                return _within(file.read(limit + 1), limit, f"{self.label}: {name}")
        except (OSError, RuntimeError) as error:
            raise PackError(f"{self.label}: {name} cannot be read: {_reason(error)}") from None

    def files(self, folder: str) -> tuple[str, ...]:
        """See Source."""
        found = []
        for here, folders, names in os.walk(self.root / folder):
            folders.sort()
            place = Path(here).relative_to(self.root).as_posix()
            found += [f"{place}/{name}" for name in names]
            if len(found) > MAX_FILES:
                raise PackError(
                    f"{self.label}: {folder} has over {MAX_FILES} files: leave some out"
                )
        return tuple(sorted(found))

    def folders(self, folder: str) -> tuple[str, ...]:
        """See Source."""
        try:
            with os.scandir(self.root / folder) as entries:
                return tuple(sorted(entry.name for entry in entries if entry.is_dir()))
        except OSError:
            return ()

    def _refuse_way_out(self, path: Path, name: str) -> None:
        if not path.resolve().is_relative_to(self.root.resolve()):
            raise PackError(
                f"{self.label}: {name} is a link out of the pack: put the file itself there"
            )

    def _refuse_broken_link(self, path: Path, name: str) -> None:
        if path.is_symlink():
            raise PackError(f"{self.label}: {name} is a link to nothing: put the file itself there")


@dataclass(frozen=True)
class ZipSource:
    """A pack in a zip or jar. entries: the files by their names under the pack's root."""

    archive: "ZipFile"
    entries: "dict[str, ZipInfo]"
    doubles: frozenset[str]
    label: str

    def read(self, name: str, limit: int) -> bytes | None:
        """See Source."""
        entry = self.entries.get(name)
        if entry is None:
            return None
        place = f"{self.label}: {name}"
        if name in self.doubles:
            raise PackError(f"{place} is in the zip twice: pack it anew")
        _check_entry(entry, limit, place)
        try:
            with self.archive.open(entry) as file:
                # The stated size may lie; never more than the limit is unpacked.
                return _within(file.read(limit + 1), limit, place)
        except _zip_faults() as error:
            raise PackError(f"{place} is damaged ({_reason(error)}): get the zip anew") from None

    def files(self, folder: str) -> tuple[str, ...]:
        """See Source."""
        return tuple(sorted(name for name in self.entries if name.startswith(f"{folder}/")))

    def folders(self, folder: str) -> tuple[str, ...]:
        """See Source."""
        start = len(folder) + 1
        inside = (name[start:] for name in self.entries if name.startswith(f"{folder}/"))
        return tuple(sorted({rest.split("/", 1)[0] for rest in inside if "/" in rest}))


def _zip_faults() -> tuple[type[Exception], ...]:
    """All that zipfile is known to raise on damaged files."""
    from zipfile import BadZipFile, LargeZipFile

    wrong = (EOFError, ValueError, RuntimeError, IndexError, struct.error, zlib.error)
    return BadZipFile, LargeZipFile, OSError, *wrong


def _folder(path: Path) -> FolderSource:
    names = {entry.name for entry in path.iterdir() if entry.name not in _LITTER}
    if names & set(_ROOTS):
        return FolderSource(path, str(path))
    inside = [name for name in sorted(names) if _looks_like_pack(path / name)]
    if len(inside) == 1:
        return FolderSource(path / inside[0], str(path / inside[0]))
    raise PackError(f"pack {path} is no resource pack: {_folder_hint(path, inside)}")


def _folder_hint(path: Path, inside: list[str]) -> str:
    if inside:
        return f"it holds several, choose one: {', '.join(inside[:5])}"
    for parent in path.resolve().parents:
        if (parent / "pack.mcmeta").is_file():
            return f"it lies inside one, point at {parent}"
    if (path / "manifest.json").is_file():
        return "it is one for Bedrock, and only those for Java are read"
    zips = sorted(entry.name for entry in path.iterdir() if entry.suffix in (".zip", ".jar"))
    if zips:
        return f"it holds {', '.join(zips[:5])}, point at one of them"
    return "it has neither assets nor pack.mcmeta, point at the folder that has"


def _looks_like_pack(path: Path) -> bool:
    return any((path / name).exists() for name in _ROOTS)


def _zip(path: Path) -> ZipSource:
    _check_directory(path)
    from zipfile import ZipFile

    try:
        archive = ZipFile(path)
    except _zip_faults() as error:
        raise PackError(f"pack {path} is a damaged zip ({_reason(error)}): get it anew") from None
    try:
        return _indexed(archive, str(path))
    except PackError:
        archive.close()
        raise


def _indexed(archive: "ZipFile", label: str) -> ZipSource:
    # Nameless entries occur in damaged zips, and is_dir fails on them before Python 3.12.
    infos = [info for info in archive.infolist() if info.filename and not info.is_dir()]
    if len(infos) > MAX_FILES:
        raise PackError(f"pack {label} has {len(infos)} files; at most {MAX_FILES} are read")
    # Some old tools write backslashes.
    named = [(info.filename.replace("\\", "/"), info) for info in infos]
    for name, _ in named:
        if name.startswith("/") or name[1:2] == ":" or ".." in name.split("/"):
            raise PackError(
                f"pack {label}: the name {name[:80]!r} leads out of it: do not trust it"
            )
    root = _root_in_zip([name for name, _ in named], label)
    entries: dict[str, ZipInfo] = {}
    doubles = set()
    for name, info in named:
        if name.startswith(root):
            short = name[len(root) :]
            if short in entries:
                doubles.add(short)
            entries[short] = info
    return ZipSource(archive, entries, frozenset(doubles), label)


def _root_in_zip(names: list[str], label: str) -> str:
    """The prefix of the pack's root: none, or the one top folder of a repacked download."""
    tops = {name.split("/", 1)[0] for name in names}
    if tops & set(_ROOTS):
        return ""
    inside = {
        parts[0]
        for parts in (name.split("/", 2) for name in names)
        if len(parts) > 1 and parts[1] in _ROOTS and parts[0] not in _LITTER
    }
    if len(inside) == 1:
        return f"{inside.pop()}/"
    if inside:
        hint = f"it holds several, unpack it and choose one: {', '.join(sorted(inside)[:5])}"
    elif "manifest.json" in tops:
        hint = "it is one for Bedrock, and only those for Java are read"
    elif any(name.endswith(".zip") for name in tops):
        hint = "it holds another zip, unpack it once"
    else:
        hint = "it has neither assets nor pack.mcmeta at its top"
    raise PackError(f"pack {label} is no resource pack: {hint}")


def _check_directory(path: Path) -> None:
    """Refuse a huge list of contents before zipfile reads it; see APPNOTE 4.3.14 to 4.3.16."""
    with path.open("rb") as file:
        size = file.seek(0, os.SEEK_END)
        file.seek(max(0, size - _LONGEST_TAIL))
        tail = file.read()
    at = tail.rfind(b"PK\x05\x06")
    if at < 0 or len(tail) < at + 22:
        raise PackError(f"pack {path} is neither a folder nor a whole zip or jar: get it anew")
    length = struct.unpack_from("<I", tail, at + 12)[0]
    if tail[at - 20 : at - 16] == b"PK\x06\x07":
        # Only the place where zipfile itself looks counts: right before the locator.
        big = tail[max(0, at - 76) : at - 20]
        length = struct.unpack_from("<Q", big, 40)[0] if big[:4] == b"PK\x06\x06" else 1 << 64
    if length > MAX_DIRECTORY:
        raise PackError(
            f"pack {path} lists too many files; at most {MAX_FILES} are read: thin it out"
        )


def _check_entry(entry: "ZipInfo", limit: int, place: str) -> None:
    if entry.flag_bits & 1:
        raise PackError(f"{place} is encrypted: pack it without a password")
    if S_ISLNK(entry.external_attr >> 16):
        raise PackError(f"{place} is a link: put the file itself there")
    if entry.compress_type not in (0, 8):
        raise PackError(f"{place} is squeezed in a way the game cannot read: use plain deflate")
    squeezed = entry.file_size > MAX_RATIO * max(1, entry.compress_size)
    if entry.file_size > limit or (squeezed and entry.file_size > 1 << 20):
        raise PackError(
            f"{place} would unpack from {entry.compress_size} to {entry.file_size} bytes:"
            " a zip bomb is not read"
        )


def _within(data: bytes, limit: int, place: str) -> bytes:
    if len(data) > limit:
        raise PackError(f"{place} is over {limit} bytes: shrink it")
    return data


def _walk(node: Traversable, name: str) -> Iterator[str]:
    for child in node.iterdir():
        path = f"{name}/{child.name}"
        if child.is_dir():
            yield from _walk(child, path)
        else:
            yield path


def _reason(error: BaseException) -> str:
    return getattr(error, "strerror", None) or str(error) or type(error).__name__
