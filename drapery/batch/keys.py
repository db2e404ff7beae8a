"""The key of a picture: a hash of all its inputs. Pictures with equal keys have equal bytes."""

import hashlib
import json
import os
import sys
from collections.abc import Callable, Iterable, Iterator
from dataclasses import asdict
from functools import cache, partial
from importlib.metadata import entry_points
from importlib.resources import files
from importlib.resources.abc import Traversable
from inspect import unwrap
from pathlib import Path
from typing import TYPE_CHECKING, Any

from drapery import Banner, __version__
from drapery.errors import PackError
from drapery.render import backend
from drapery.settings import OPTIONS, LoopSettings, Settings
from drapery.styles import combined_style
from drapery.user_files import open_user_file

if TYPE_CHECKING:
    from drapery.garments import Garment

MAX_FILES = 200_000


class DigestCache:
    """Hashes of packs and textures, each read once."""

    def __init__(self) -> None:
        self._known: dict[Path, str] = {}

    def of(self, path: str | Path) -> str:
        """The hash of a file, or of all files in a folder. Raises PackError."""
        path = Path(path)
        if path not in self._known:
            self._known[path] = digest(path)
        return self._known[path]


def digest(path: Path) -> str:
    """The hash of a file's bytes, or of names and bytes in a folder. Raises PackError."""
    try:
        if path.is_file():
            return _of_file(path)
        if not path.is_dir():
            raise PackError(f"{path} does not exist: check the path")
        whole = hashlib.sha256()
        for name in _names(path):
            whole.update(f"{name}\0{_of_file(path / name)}\n".encode("utf-8", "surrogateescape"))
        return whole.hexdigest()
    except OSError as error:
        raise PackError(f"{path} cannot be read: {error.strerror}; check the path") from None


def picture_key(
    banner: "Banner | Garment | None",
    settings: Settings,
    digests: DigestCache,
    *,
    ending: str,
    timing: LoopSettings | None,
) -> str:
    """The key of a picture: 64 hexadecimal digits. Raises PackError for unreadable packs.

    It is a hash of the design in its canonical form or of the garment, the options, the steps of
    styles, the bytes of packs and textures (not their names), `code_version`, and `added_code` of
    the packages that add its styles and backend. Raises OptionError or BackendError if one of these
    cannot be loaded.
    """
    style = combined_style(settings.style)
    texture = settings.texture_path
    options = {name: settings.as_given(name) for name in OPTIONS}
    options["style"] = style.describe()
    options["packs"] = [digests.of(pack) for pack in settings.pack_paths]
    options["texture"] = None if texture is None else digests.of(texture)
    whole: dict[str, Any] = {
        "design": _described(banner, digests),
        "options": options,
        "file": [ending, None if timing is None else asdict(timing)],
        "version": code_version(),
        "added": added_code([step.function for step in style.steps], settings.backend),
    }
    return hashlib.sha256(json.dumps(whole, sort_keys=True).encode()).hexdigest()


def _described(banner: "Banner | Garment | None", digests: DigestCache) -> Any:
    """A design, or a garment with the bytes of its files, as values of JSON. Raises PackError."""
    if banner is None or isinstance(banner, Banner):
        return None if banner is None else asdict(banner)
    tree = banner.model_dump(mode="json", exclude={"folder"})
    return {"garment": tree, "files": [digests.of(path) for path in banner.paths]}


@cache
def code_version() -> str:
    """The release with a hash of its code and art: an edited checkout is another version."""
    whole = hashlib.sha256()
    for package in ("drapery", "drapery.render", "drapery.assets"):
        for name, file in sorted(_own_files(files(package), package)):
            whole.update(name.encode() + hashlib.sha256(file.read_bytes()).digest())
    return f"{__version__}+{whole.hexdigest()[:16]}"


def added_code(
    functions: Iterable[Callable[..., Any]], chosen: str | Callable[..., Any]
) -> dict[str, list[str]]:
    """The code of other packages that draws a picture: by the name of each top-level package, the
    versions of its distributions and the hash of its files, so that an edit counts too.

    functions: of the steps of its style. chosen: its backend, or the name of one. Raises
    BackendError or PackError.
    """
    used = [*functions, backend(chosen) if isinstance(chosen, str) else chosen]
    packages = {_module_of(function).partition(".")[0] for function in used}
    return {name: code_of(name) for name in sorted(packages - {"drapery"})}


def _module_of(function: Any) -> str:
    while isinstance(function, partial):
        function = function.func
    return str(getattr(unwrap(function), "__module__", type(function).__module__))


@cache
def code_of(package: str) -> list[str]:
    """The versions and digests of an imported package: what is imported is what draws.

    Distributions are found by their entry points. Those without one are known by digests alone: to
    find all, importlib looks for each file of each distribution, which takes seconds.
    """
    points = [each for each in entry_points() if each.module.partition(".")[0] == package]
    found = sorted({f"{each.dist.name} {each.dist.version}" for each in points if each.dist})
    module = sys.modules[package]
    places = [Path(place) for place in getattr(module, "__path__", [])]
    if not places and getattr(module, "__file__", None):
        places = [Path(str(module.__file__))]
    return [*found, *(digest(place) for place in sorted(places))]


def _own_files(node: Traversable, name: str) -> Iterator[tuple[str, Traversable]]:
    for child in node.iterdir():
        if child.is_dir() and child.name != "__pycache__":
            yield from _own_files(child, f"{name}/{child.name}")
        elif child.name.endswith(
            (".py", ".png", ".mcmeta", ".json", ".lark", ".toml", ".vert", ".frag")
        ):
            yield f"{name}/{child.name}", child


def _of_file(path: Path) -> str:
    file: Any
    with open_user_file(path) as file:
        return hashlib.file_digest(file, "sha256").hexdigest()


def _raise(error: OSError) -> None:
    raise error


def _names(folder: Path) -> list[str]:
    found: list[str] = []
    for top, folders, names in os.walk(folder, onerror=_raise):
        folders[:] = [name for name in folders if name not in (".git", "__pycache__")]
        found += [Path(top, name).relative_to(folder).as_posix() for name in names]
        if len(found) > MAX_FILES:
            raise PackError(f"{folder} has over {MAX_FILES} files: name a resource pack")
    return sorted(name for name in found if (folder / name).is_file())
