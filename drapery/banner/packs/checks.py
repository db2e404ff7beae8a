"""What folders and zips of packs have in common: what marks a pack, limits, words for faults."""

from collections.abc import Iterable

from drapery.errors import PackError

MAX_FILES = 100_000
"""Most files in a zip or folder; the game's own jar has about 30,000."""

ROOTS = ("assets", "data", "pack.mcmeta")
"""A folder with one of these at its top is a pack."""

LITTER = ("__MACOSX", ".DS_Store")
"""What some systems leave beside it."""


def within(data: bytes, limit: int, place: str) -> bytes:
    """The data of a file, if it keeps to the limit [bytes]. Raises PackError naming the place."""
    if len(data) > limit:
        raise PackError(f"{place} is over {limit} bytes: shrink it")
    return data


def listed(names: Iterable[str]) -> str:
    """The first five names in one line, whatever is in them."""
    return ", ".join(name if name.isprintable() else ascii(name) for name in sorted(names)[:5])


def reason(error: BaseException) -> str:
    """Why something failed, in the system's words."""
    return getattr(error, "strerror", None) or str(error) or type(error).__name__
