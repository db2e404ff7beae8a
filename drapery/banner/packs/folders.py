"""Packs in folders, and our own art."""

import os
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache
from importlib.resources import files
from importlib.resources.abc import Traversable
from pathlib import Path

from drapery import assets
from drapery.banner.packs.checks import IGNORED_NAMES, MAX_FILES, ROOTS, listed, within
from drapery.errors import PackError
from drapery.user_files import open_user_file, reason


@dataclass(frozen=True)
class OwnArt:
    """The art that is installed with this package, whose folder is the `assets` of a pack."""

    label: str = "drapery's own art"

    def read(self, name: str, limit: int) -> bytes | None:
        """See `PackSource`."""
        node = self._node(name)
        return node.read_bytes() if node is not None and node.is_file() else None

    def files(self, folder: str) -> tuple[str, ...]:
        """See `PackSource`."""
        node = self._node(folder)
        return tuple(sorted(_walk(node, folder))) if node is not None and node.is_dir() else ()

    def folders(self, folder: str) -> tuple[str, ...]:
        """See `PackSource`."""
        node = self._node(folder)
        if node is None or not node.is_dir():
            return ()
        return tuple(sorted(n.name for n in node.iterdir() if n.is_dir() and n.name[0] not in "_."))

    def _node(self, name: str) -> Traversable | None:
        top, *parts = name.split("/")
        return _own_folder().joinpath(*parts) if top == "assets" else None


@cache
def _own_folder() -> Traversable:
    """A plain path where there is one: `files` imports zipfile and more."""
    folder = Path(str(assets.__file__)).parent
    return folder if folder.is_dir() else files("drapery.assets")


@dataclass(frozen=True)
class FolderSource:
    """A pack in a folder. Links that lead out of it are refused."""

    root: Path
    label: str

    def read(self, name: str, limit: int) -> bytes | None:
        """See `PackSource`."""
        path = self.root / name
        try:
            if not path.is_file():
                self._refuse_broken_link(path, name)
                return None
            self._refuse_outside_link(path, name)
            with open_user_file(path) as file:
                return within(file.read(limit + 1), limit, f"{self.label}: {name}")
        except (OSError, RuntimeError) as error:
            raise PackError(f"{self.label}: {name} cannot be read: {reason(error)}") from None

    def files(self, folder: str) -> tuple[str, ...]:
        """See `PackSource`."""
        found = []
        for here, folders, names in os.walk(self.root / folder, onerror=self._refuse):
            folders.sort()
            place = Path(here).relative_to(self.root).as_posix()
            found += [f"{place}/{name}" for name in names]
            if len(found) > MAX_FILES:
                raise PackError(
                    f"{self.label}: {folder} has over {MAX_FILES} files: leave some out"
                )
        return tuple(sorted(found))

    def folders(self, folder: str) -> tuple[str, ...]:
        """See `PackSource`."""
        try:
            with os.scandir(self.root / folder) as entries:
                return tuple(sorted(entry.name for entry in entries if entry.is_dir()))
        except OSError as error:
            self._refuse(error)
            return ()

    def _refuse(self, error: OSError) -> None:
        """Raises PackError unless a folder is only missing."""
        if not isinstance(error, FileNotFoundError | NotADirectoryError):
            name = Path(str(error.filename)).relative_to(self.root).as_posix()
            raise PackError(f"{self.label}: {name} cannot be read: {reason(error)}")

    def _refuse_outside_link(self, path: Path, name: str) -> None:
        if not path.resolve().is_relative_to(self.root.resolve()):
            raise PackError(
                f"{self.label}: {name} is a link out of the pack: replace it by the file itself"
            )

    def _refuse_broken_link(self, path: Path, name: str) -> None:
        if path.is_symlink():
            raise PackError(f"{self.label}: {name} is a broken link: replace it by the file itself")


def open_folder(path: Path) -> FolderSource:
    """The pack in a folder, or in its only subfolder that is a pack. Raises PackError, OSError."""
    names = {entry.name for entry in path.iterdir() if entry.name not in IGNORED_NAMES}
    if names & set(ROOTS):
        return FolderSource(path, str(path))
    inside = [name for name in sorted(names) if _looks_like_pack(path / name)]
    if len(inside) == 1:
        return FolderSource(path / inside[0], str(path / inside[0]))
    raise PackError(f"pack {path} is not a resource pack: {_folder_hint(path, inside)}")


def _folder_hint(path: Path, inside: list[str]) -> str:
    if inside:
        return f"it holds several packs, choose one: {listed(inside)}"
    for parent in path.resolve().parents:
        if (parent / "pack.mcmeta").is_file():
            return f"it is a folder inside a pack, give {parent}"
    if (path / "manifest.json").is_file():
        return "it is a pack for Bedrock Edition; only packs for Java Edition are read"
    zips = [entry.name for entry in path.iterdir() if entry.suffix in (".zip", ".jar")]
    if zips:
        return f"it holds {listed(zips)}, give one of them"
    return "it has neither assets nor pack.mcmeta, give the folder that has"


def _looks_like_pack(path: Path) -> bool:
    return any((path / name).exists() for name in ROOTS)


def _walk(node: Traversable, name: str) -> Iterator[str]:
    for child in node.iterdir():
        path = f"{name}/{child.name}"
        if child.is_dir():
            yield from _walk(child, path)
        else:
            yield path
