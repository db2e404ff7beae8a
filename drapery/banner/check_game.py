"""What a version of the game has that Drapery does not know.

`python -m drapery.banner.check_game [JAR] [MINECRAFT_DATA]` reads a client jar, the data of the
project PrismarineJS/minecraft-data, or both. It ends with 1 if something is not known, with 2 for
input that cannot be read.
"""

import sys
from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import Any

from drapery.banner.dyes import DYES
from drapery.banner.formats.leftovers import STATES
from drapery.banner.formats.tree import is_banner_id
from drapery.banner.packs.equipment import LAYERS
from drapery.banner.packs.meta import read_json
from drapery.banner.packs.versions import NEWEST_DATA_FORMAT, PACK_FORMATS
from drapery.banner.packs.zips import ZipSource, open_zip
from drapery.banner.patterns import PATTERNS
from drapery.errors import DraperyError, OptionError
from drapery.user_files import read_user_file

MAX_JSON = 1 << 26
"""Most bytes of one JSON file."""

_TEXTURES = "assets/minecraft/textures"
_PATTERNS = "data/minecraft/banner_pattern"
_EQUIPMENT = "assets/minecraft/equipment"
_BLOCKS = "assets/minecraft/blockstates"
_REMEDY = "give the file of a client or the folder of minecraft-data"


def check_jar(path: Path) -> Iterator[str]:
    """What a client jar has that is not known, a line each. Raises PackError."""
    try:
        jar = open_zip(path, ("assets", "version.json"))
    except OSError as error:
        raise OptionError(f"{path}: {error.strerror or 'no file'}; {_REMEDY}") from None
    with jar.archive:
        yield from _check_version(_json(jar, "version.json"), path)
        if not jar.files(_PATTERNS):
            raise OptionError(f"{path}: it has no patterns in {_PATTERNS}; {_REMEDY}")
        yield from _unknown("pattern", _stems(jar.files(_PATTERNS)), PATTERNS)
        wool = _with_end(_stems(jar.files(f"{_TEXTURES}/block")), "_wool")
        dyes = _with_end(_stems(jar.files(f"{_TEXTURES}/item")), "_dye")
        yield from _unknown("dye", [*wool, *dyes], DYES)
        layers = set(jar.folders(f"{_TEXTURES}/entity/equipment"))
        for name in jar.files(_EQUIPMENT):
            layers.update(_mapping(_json(jar, name).get("layers")))
        yield from _unknown("equipment layer", layers, LAYERS)
        yield from _unknown_blocks(_stems(jar.files(_BLOCKS)))


def _check_version(version: dict[str, Any], path: Path) -> Iterator[str]:
    """The version's name and its formats of packs."""
    yield from _unknown("version", [str(version.get("id"))], _versions())
    packs = _mapping(version.get("pack_version"))
    resource = packs.get("resource_major", packs.get("resource"))
    data = packs.get("data_major", packs.get("data"))
    if not isinstance(resource, int) or not isinstance(data, int):
        raise OptionError(f"{path}: version.json has no formats of packs; {_REMEDY}")
    known = {each.number: each.minor for each in PACK_FORMATS}
    minor = packs.get("resource_minor", 0)
    if resource not in known or (isinstance(minor, int) and minor > known[resource]):
        yield f"unknown format of resource packs: {resource}.{minor}"
    if data > NEWEST_DATA_FORMAT:
        yield f"unknown format of data packs: {data}"


def check_data(folder: Path) -> Iterator[str]:
    """What the newest version in the folder of minecraft-data has that is not known.

    Raises OptionError.
    """
    root = folder / "data" if (folder / "data").is_dir() else folder
    paths = _mapping(_mapping(_file(root / "dataPaths.json")).get("pc"))
    if not paths:
        raise OptionError(f"{root / 'dataPaths.json'}: no versions under 'pc'; {_REMEDY}")
    newest = list(paths)[-1]
    yield from _unknown("version", [newest], _versions())
    places = _mapping(paths[newest])
    names = _names(root, places, "items")
    yield from _unknown("dye", _with_end(names, "_dye"), DYES)
    blocks = _entries(root, places, "blocks")
    yield from _unknown_blocks(str(block.get("name")) for block in blocks)
    for block in blocks:
        states = block.get("states")
        if is_banner_id(block.get("name")) and isinstance(states, list):
            found = (str(_mapping(state).get("name")) for state in states)
            yield from _unknown(f"state of {block['name']}", found, STATES)


def _entries(root: Path, places: dict[str, Any], kind: str) -> list[dict[str, Any]]:
    path = root / str(places.get(kind)) / f"{kind}.json"
    entries = _file(path)
    if not isinstance(entries, list) or not all(isinstance(entry, dict) for entry in entries):
        raise OptionError(f"{path}: it is not a list of objects; {_REMEDY}")
    return entries


def _names(root: Path, places: dict[str, Any], kind: str) -> list[str]:
    return [str(entry.get("name")) for entry in _entries(root, places, kind)]


def _unknown_blocks(names: Iterable[str]) -> Iterator[str]:
    banners = (name for name in names if "banner" in name and not is_banner_id(name))
    yield from _unknown("block", banners, ())


def _unknown(what: str, found: Iterable[str], known: Iterable[str]) -> Iterator[str]:
    names = sorted(set(found) - set(known))
    yield from (f"unknown {what}: {name[:80]!r}" for name in names)


def _versions() -> set[str]:
    return {name for each in PACK_FORMATS for name in each.game.split(" - ")}


def _with_end(names: Iterable[str], end: str) -> list[str]:
    return [name.removesuffix(end) for name in names if name.endswith(end)]


def _stems(names: Iterable[str]) -> list[str]:
    """The names of files directly in a folder, without folders and endings; `.mcmeta` left out."""
    return [Path(name).stem for name in names if name.endswith((".json", ".png"))]


def _json(jar: ZipSource, name: str) -> dict[str, Any]:
    data = jar.read(name, MAX_JSON)
    if data is None:
        raise OptionError(f"{jar.label}: it has no {name}; {_REMEDY}")
    return _mapping(read_json(data, f"{jar.label}: {name}"))


def _file(path: Path) -> Any:
    try:
        data = read_user_file(path, MAX_JSON, name=str(path), error=OptionError)
    except OSError as error:
        raise OptionError(f"{path}: {error.strerror or 'no file'}; {_REMEDY}") from None
    return read_json(data, str(path))


def _mapping(value: Any) -> dict[str, Any]:
    return value if isinstance(value, dict) else {}


def main(arguments: list[str]) -> int:
    """Print what is not known in a jar, a folder or both. Returns the exit code."""
    try:
        if not 1 <= len(arguments) <= 2:
            raise OptionError(
                "python -m drapery.banner.check_game [JAR] [MINECRAFT_DATA]: give one"
            )
        paths = [Path(argument) for argument in arguments]
        lines = [
            line
            for path in paths
            for line in (check_data(path) if path.is_dir() else check_jar(path))
        ]
    except DraperyError as error:
        print(error, file=sys.stderr)
        return 2
    print("\n".join(lines) if lines else "all is known")
    return 1 if lines else 0


if __name__ == "__main__":
    raise SystemExit(main(sys.argv[1:]))
