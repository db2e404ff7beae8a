"""Data packs of Java and behaviour packs of Bedrock, as a folder or a zip: every banner in them.

Read are functions, structures, and the JSON of loot tables, item modifiers, recipes, advancements,
predicates, trades and processors. Template pools name structures of the pack, which are read as the
files that they are.
"""

import os
from collections.abc import Callable, Iterator
from contextlib import closing
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path, PurePosixPath

from drapery.banner.formats import files, functions, loot, structure
from drapery.banner.formats.blocks import OnError
from drapery.banner.formats.compression import MAX_BYTES, inflate
from drapery.banner.formats.found import FoundBanner, find_banners
from drapery.banner.formats.leftovers import looks_like_design
from drapery.banner.formats.snbt import parse_snbt
from drapery.banner.formats.tree import DataTree
from drapery.banner.formats.trees import read_text
from drapery.banner.packs.zips import ZipSource, open_zip
from drapery.errors import DesignError, PackError
from drapery.user_files import open_user_file

MAX_UNPACKED = 1 << 30
"""Most bytes of a pack's files that are read, unpacked; large packs have a tenth of that."""

_WORDS = (b"anner", b"hield")
"""A file without any of these in its bytes has no design and is not parsed."""

_NBT = (".nbt", ".mcstructure", ".schem")
_TEXTS = (".mcfunction", ".json", ".snbt")
_BEDROCK = ("functions", "loot_tables", "structures", "recipes", "trading", "entities")


@dataclass
class _Budget:
    """The bytes that may still be read."""

    where: str
    left: int

    def spend(self, size: int) -> None:
        self.left -= size
        if self.left < 0:
            raise DesignError(
                f"{self.where}: over {MAX_UNPACKED >> 20} MiB unpacked; split the pack"
            )


def is_pack(folder: Path) -> bool:
    """Whether a folder is a data pack or a behaviour pack."""
    if (folder / "pack.mcmeta").is_file():
        return (folder / "data").is_dir()
    return (folder / "manifest.json").is_file() and any(
        (folder / name).is_dir() for name in _BEDROCK
    )


def in_world(world: Path, on_error: OnError) -> Iterator[FoundBanner]:
    """Every banner of the data packs in a world's folder; a place begins with `datapacks/`.

    As `in_folder`; the bounds are those of all the packs together, and a pack that cannot be read
    is reported and skipped.
    """
    budget = _Budget(str(world / files.PACKS), MAX_UNPACKED)
    for path in sorted((world / files.PACKS).glob("*")):
        name = f"{files.PACKS}/{path.name}"
        try:
            if path.is_symlink():
                raise DesignError("a link; give the pack itself")
            if path.is_dir() and is_pack(path):
                yield from _in_folder(path, on_error, budget, f"{name}/")
            elif path.is_file() and path.suffix.lower() == ".zip":
                yield from _in_zip(path, on_error, budget, f"{name}/")
            elif path.is_dir():
                raise DesignError("not a data pack, since it lacks pack.mcmeta or data; add them")
        except DesignError as error:
            if budget.left < 0:
                raise
            on_error(DesignError(f"{name}: {str(error).removeprefix(f'{path}: ')}"))


def in_folder(folder: Path, on_error: OnError) -> Iterator[FoundBanner]:
    """Every banner of a pack's folder; a place begins with the file's path in it.

    Links are not followed.

    on_error: called with the error of one broken banner or file, after which the search continues.

    Raises DesignError for over MAX_FILES files or MAX_UNPACKED bytes.
    """
    yield from _in_folder(folder, on_error, _Budget(str(folder), MAX_UNPACKED))


def _in_folder(
    folder: Path, on_error: OnError, budget: _Budget, start: str = ""
) -> Iterator[FoundBanner]:
    """As `in_folder`. start: of every place."""
    paths: list[Path] = []
    for top, folders, names in os.walk(folder, onerror=files.unreadable(on_error)):
        folders.sort()
        paths += (Path(top, name) for name in names if _may_hold(Path(top, name), folder))
        if len(paths) > files.MAX_FILES:
            raise DesignError(f"{folder}: over {files.MAX_FILES} files; give a part of the pack")
    for path in sorted(paths):
        name = start + path.relative_to(folder).as_posix()
        if path.is_symlink():
            on_error(DesignError(f"{name}: a link; give the file itself"))
        elif path.is_file():
            yield from _in_file(name, partial(_start_of, path), budget, on_error)


def _start_of(path: Path, limit: int) -> bytes:
    with open_user_file(path) as file:
        return file.read(limit + 1)


def in_zip(path: Path, on_error: OnError) -> Iterator[FoundBanner]:
    """As `in_folder`, for a pack in a zip, also under one top folder.

    Raises DesignError for a zip that is broken or without a pack.
    """
    yield from _in_zip(path, on_error, _Budget(str(path), MAX_UNPACKED))


def _in_zip(
    path: Path, on_error: OnError, budget: _Budget, start: str = ""
) -> Iterator[FoundBanner]:
    """As `in_zip`. start: of every place."""
    try:
        source = open_zip(path, ("data", "pack.mcmeta", "manifest.json"))
    except PackError as error:
        if "is not a resource pack" in str(error):
            raise _no_pack(path) from None
        raise DesignError(str(error)) from None
    with closing(source.archive):
        names = [name for name in source.entries if _may_hold(PurePosixPath(name), None)]
        is_bedrock = "manifest.json" in source.entries
        if not is_bedrock and not any("data" in name.split("/")[:2] for name in names):
            raise _no_pack(path)
        for name in sorted(names):
            yield from _in_file(start + name, _reader(source, name), budget, on_error)


def _no_pack(path: Path) -> DesignError:
    return DesignError(
        f"{path}: a zip without a data pack; unpack it and give the world's folder or its files"
    )


def _reader(source: ZipSource, name: str) -> Callable[[int], bytes]:
    def read(limit: int) -> bytes:
        try:
            return source.read(name, limit) or b""
        except PackError as error:
            raise DesignError(str(error).removeprefix(f"{source.label}: {name} ")) from None

    return read


def _may_hold(path: Path | PurePosixPath, folder: Path | None) -> bool:
    """Whether a file of a pack may hold a banner, by its name."""
    if path.suffix.lower() not in (*_NBT, *_TEXTS):
        return False
    parts = (path.relative_to(folder) if folder else path).parts
    return not {"assets", "tags", "texts", "lang"}.intersection(parts[:-1])


def _in_file(
    name: str, read: Callable[[int], bytes], budget: _Budget, on_error: OnError
) -> Iterator[FoundBanner]:
    """The banners of a file. Whatever is wrong with it is one error with its name."""

    def report(error: DesignError) -> None:
        message = str(error)
        on_error(error if message.startswith(name) else DesignError(f"{name}: {message}"))

    try:
        data = read(MAX_BYTES)
        budget.spend(len(data))
        if name.lower().endswith(_NBT):
            raw = inflate(data, name)
            budget.spend(len(raw))
            if any(word in raw for word in _WORDS):
                yield from files.find_in_bytes(raw, name, report)
        elif any(word in data for word in _WORDS) or looks_like_design(str(data[:4096])):
            yield from _in_text(name, data.decode("utf-8-sig"), report)
    except UnicodeDecodeError as error:
        report(DesignError(f"not UTF-8 text (byte {error.start}); save it again"))
    except OSError as error:
        report(DesignError(f"{error.strerror or error}; make it readable"))
    except DesignError as error:
        if budget.left < 0:
            raise
        report(error)


def _in_snbt(tree: DataTree, name: str, report: OnError) -> Iterator[FoundBanner]:
    """The banners of a structure in SNBT, or of any other tree."""
    is_structure = isinstance(tree, dict) and structure.recognises(tree)
    find = structure.find if is_structure else find_banners
    return find(tree, name, on_error=report)


def _in_text(name: str, text: str, report: OnError) -> Iterator[FoundBanner]:
    if name.lower().endswith(".mcfunction"):
        for one in functions.find(text, report):
            yield replace(one, where=f"{name} {one.where}")
        return
    errors: list[DesignError] = []
    if name.lower().endswith(".snbt"):
        found = [*_in_snbt(parse_snbt(text), name, errors.append)]
    else:
        found = [*loot.find(read_text(text), name, errors.append)]
    yield from found
    for error in errors:
        report(error)
    if not found and not errors and looks_like_design(text):
        report(DesignError("a design that cannot be read here; give it as a /give command"))
