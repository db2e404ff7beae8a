"""Filters in packs: regular expressions of files or sprites that are removed."""

import re
from dataclasses import dataclass
from typing import Any

from drapery.errors import PackError

MAX_REPEATS = 3
"""Most repetitions in an expression. Each multiplies the time of a search by an id's length."""

MAX_OPTIONS = 6

_MAX_LENGTH = 200


@dataclass(frozen=True)
class IdFilter:
    """Removes the ids whose namespace and path both match; None matches every id."""

    namespace: re.Pattern[str] | None
    path: re.Pattern[str] | None

    def matches(self, namespace: str, path: str) -> bool:
        """Whether this id is removed. A match anywhere in it counts, as in the game."""
        pairs = ((self.namespace, namespace), (self.path, path))
        return all(pattern is None or pattern.search(text) for pattern, text in pairs)


def parse_filter(entry: Any, name: str) -> IdFilter:
    """Read `{"namespace": regex, "path": regex}`. Raises PackError naming the file."""
    if not isinstance(entry, dict):
        raise PackError(f"{name}: a filter must be an object with namespace and path")
    return IdFilter(
        *(_regex(entry.get(key), f"{name}: filter {key}") for key in ("namespace", "path"))
    )


def _regex(text: Any, name: str) -> re.Pattern[str] | None:
    if text is None:
        return None
    if not isinstance(text, str) or len(text) > _MAX_LENGTH:
        raise PackError(f"{name} must be a regular expression of up to {_MAX_LENGTH} characters")
    if not _is_cheap(text):
        raise PackError(
            f"{name} {text!r} could search for hours: use at most 3 of * and +, and repeat no group"
        )
    try:
        return re.compile(text)
    except (re.error, RecursionError, OverflowError):
        raise PackError(f"{name} {text!r} is not a regular expression: correct it") from None


def _is_cheap(text: str) -> bool:
    """Whether there are few repetitions and no repeated group: a search is cubic at worst."""
    bare = re.sub(r"\\.", "x", text)
    bare = re.sub(r"\[\^?\]?[^\]]*\]", "x", bare)
    repeats = len(re.findall(r"[*+{]", bare))
    few = repeats <= MAX_REPEATS and bare.count("?") <= MAX_OPTIONS
    return few and not re.search(r"\)[*+{]", bare) and "(?" not in bare
