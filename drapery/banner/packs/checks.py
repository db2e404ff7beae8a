"""Helpers for packs in folders and zips: how to recognise a pack, limits, and error texts."""

from collections.abc import Iterable

from drapery.errors import PackError

MAX_FILES = 100_000
"""Most files in a zip or folder; the game's own jar has about 30,000."""

ROOTS = ("assets", "data", "pack.mcmeta")
"""A folder with one of these at its top is a pack."""

IGNORED_NAMES = ("__MACOSX", ".DS_Store")
"""Files that some systems add beside a pack."""


def within(data: bytes, limit: int, place: str) -> bytes:
    """The data of a file. Raises PackError naming the place if it is over the limit [bytes]."""
    if len(data) > limit:
        raise PackError(f"{place} is over {limit} bytes: shrink it")
    return data


MAX_PATH = 200
"""The longest path of a file that a line of several shows."""


def listed(names: Iterable[str], longest: int = 80) -> str:
    """The first five names, sorted, in one short line, whatever is in them.

    longest: how many characters of each are shown.
    """
    all_names = sorted(names)
    short = [name[:longest] for name in all_names[:5]]
    words = [name if name.isprintable() else ascii(name) for name in short]
    more = [f"and {len(all_names) - 5} more"] if len(all_names) > 5 else []
    return ", ".join(words + more)
