"""The library that all tabs of a studio share."""

from functools import lru_cache
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from drapery.studio.library import Library


def library_at(path: Path | None) -> "Library":
    """The library in a file, or a person's own; opened at first use. Raises OutputError."""
    from drapery.studio.library import default_place

    return _opened(path or default_place())


@lru_cache(maxsize=4)
def _opened(path: Path) -> "Library":
    from drapery.studio.library import Library

    return Library(path)
