"""Files that hold banners: recognises a file by its bytes, and finds all banners in it."""

import os
import re
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import NamedTuple

from drapery.banner.formats import (
    blueprint,
    chunk,
    litematic,
    mcstructure,
    region,
    schem,
    structure,
)
from drapery.banner.formats.blocks import OnError, raise_error
from drapery.banner.formats.compression import MAX_BYTES, check_size, is_compressed
from drapery.banner.formats.found import FoundBanner, find_banners
from drapery.banner.formats.nbt import is_nbt, read_nbt
from drapery.banner.formats.tree import DataTree
from drapery.errors import DesignError
from drapery.user_files import open_user_file

MAX_FILES = 100_000
"""Most files of one world that are read."""

PACKS = "datapacks"
"""The folder of a world in which its data packs are."""

_HEAD = 2 * region.SECTOR
_NUMBER = re.compile(r"-?[0-9]{1,11}")


class NbtLayout(NamedTuple):
    """A layout of NBT files: its name, a test whether a tree has it, and a search for banners."""

    name: str
    recognises: Callable[[dict[str, DataTree]], bool]
    find: Callable[[dict[str, DataTree], str, OnError], Iterator[FoundBanner]]


def _find_anywhere(
    tree: dict[str, DataTree], where: str, on_error: OnError
) -> Iterator[FoundBanner]:
    return find_banners(tree, where, on_error=on_error)


LAYOUTS = (
    NbtLayout(schem.NAME, schem.recognises, schem.find),
    NbtLayout(litematic.NAME, litematic.recognises, litematic.find),
    NbtLayout(mcstructure.NAME, mcstructure.recognises, mcstructure.find),
    NbtLayout(blueprint.NAME, blueprint.recognises, blueprint.find),
    NbtLayout(structure.NAME, structure.recognises, structure.find),
    NbtLayout("chunk", chunk.recognises, chunk.find),
    NbtLayout("nbt", lambda tree: True, _find_anywhere),
)
"""Layouts in the order in which they are tried. The last fits any tree: players, level.dat."""


def banners_in(path: str | Path, on_error: OnError = raise_error) -> Iterator[FoundBanner]:
    """Every banner of a file or of a world's folder, with its place.

    Files are NBT (structures, schematics, Litematica, Bedrock's, players, items) and regions. They
    are recognised by their bytes, not by their names. Links out of a world are not followed.

    on_error: called with the error of one broken banner, chunk or file of a world, after which
        the search continues; by default the error is raised.

    Raises DesignError for any other file, and for a folder that is not a world.
    """
    path = Path(path)
    if path.is_dir():
        yield from _in_world(path, on_error)
    elif path.is_file():
        yield from _in_file(path, path.name, on_error)
    else:
        raise DesignError(f"{path}: no such file or folder; check the path")


def is_binary(head: bytes, size: int) -> bool:
    """Whether `banners_in` reads a file of this size [bytes].

    head: its first 8 KiB.
    """
    return is_compressed(head) or is_nbt(head, size) or region.recognises(head, size)


def find_in_bytes(
    data: bytes, where: str, on_error: OnError = raise_error
) -> Iterator[FoundBanner]:
    """Every banner of an NBT file's bytes, by its layout."""
    tree = read_nbt(data, where)
    layout = next(layout for layout in LAYOUTS if layout.recognises(tree))
    return layout.find(tree, where, on_error)


def _in_file(path: Path, where: str, on_error: OnError) -> Iterator[FoundBanner]:
    size = path.stat().st_size
    with open_user_file(path) as file:
        head = file.read(_HEAD)
        file.seek(0)
        if is_compressed(head) or is_nbt(head, size):
            check_size(size, where, MAX_BYTES)
            yield from find_in_bytes(file.read(), where, on_error)
        elif region.recognises(head, size) or path.suffix == ".mca":
            yield from region.find(file, path.name, where, on_error, path.parent)
        else:
            raise DesignError(f"{where}: {_refusal(head)}")


def _refusal(head: bytes) -> str:
    if head[:4] == b"PK\x03\x04":
        return "a zip file; unpack it and give the world's folder or one of its files"
    if not head:
        return "an empty file; save or download it again"
    return "neither NBT nor a region file; give a structure, a schematic or a world"


def _in_world(folder: Path, on_error: OnError) -> Iterator[FoundBanner]:
    if (folder / "db" / "CURRENT").exists():
        raise DesignError(
            f"{folder}: a world of Bedrock Edition, which is not supported;"
            " save the part that you want with a structure block and give the .mcstructure"
        )
    found = False
    for path in world_files(folder, on_error):
        found = True
        try:
            yield from _in_file(path, path.relative_to(folder).as_posix(), on_error)
        except DesignError as error:
            on_error(error)
        except OSError as error:
            on_error(DesignError(f"{path}: {error.strerror}; make it readable"))
    if not found:
        raise DesignError(f"{folder}: not a world of Java Edition; give the folder of level.dat")


def unreadable(on_error: OnError) -> Callable[[OSError], None]:
    """What `os.walk` calls for a folder that it cannot list, which it would skip in silence."""

    def report(error: OSError) -> None:
        on_error(DesignError(f"{error.filename}: {error.strerror}; make it readable"))

    return report


def world_files(folder: Path, on_error: OnError) -> Iterator[Path]:
    """The files of a world that may hold banners, folder by folder in a fixed order.

    Its data packs have a reader of their own.
    """
    count = 0
    for top, folders, names in os.walk(folder, onerror=unreadable(on_error)):
        if Path(top) == folder:
            folders[:] = (name for name in folders if name != PACKS)
        folders.sort()
        for name in sorted(names, key=_natural):
            path = Path(top, name)
            if not _may_hold(path) or path.is_symlink() or not path.is_file():
                continue
            count += 1
            if count > MAX_FILES:
                raise DesignError(f"{folder}: over {MAX_FILES} files; give one dimension's folder")
            yield path


def _may_hold(path: Path) -> bool:
    """Whether a file is level.dat, a player, a saved structure, or a region of a world."""
    if path.suffix == ".mca":
        return path.parent.name != "poi"
    if path.suffix == ".dat":
        players = path.parent.name == "playerdata" or path.parent.parent.name == "players"
        return path.name == "level.dat" or players
    return path.suffix == ".nbt"


def _natural(name: str) -> list[tuple[int, str]]:
    """A key that sorts regions by the numbers in their names, -1 before 10."""
    return [(int(part), "") if _NUMBER.fullmatch(part) else (0, part) for part in name.split(".")]
