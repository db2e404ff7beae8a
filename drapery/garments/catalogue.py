"""The garments that come with the package, by name."""

from functools import cache
from importlib.resources import as_file, files
from pathlib import Path

from drapery.errors import OptionError, shown
from drapery.garments.model import Garment

ENDING = ".toml"


@cache
def garment_names() -> tuple[str, ...]:
    """The names of all garments of the package, sorted."""
    folder = files("drapery.garments") / "files"
    found = (each.name for each in folder.iterdir())
    return tuple(sorted(name.removesuffix(ENDING) for name in found if name.endswith(ENDING)))


def find_garment(name: str | Path) -> Garment:
    """The garment of this name, or of a file whose path ends with `.toml`.

    Raises OptionError for another name, and for a file as `Garment.load` does.
    """
    if str(name).endswith(ENDING):
        return Garment.load(name)
    if str(name) not in garment_names():
        known = ", ".join(garment_names())
        raise OptionError(
            f"garment {shown(str(name))} is not known; use a file that ends with {ENDING},"
            f" or one of: {known}"
        )
    return _of_package(str(name))


@cache
def _of_package(name: str) -> Garment:
    with as_file(files("drapery.garments") / "files" / f"{name}{ENDING}") as path:
        return Garment.load(path)
