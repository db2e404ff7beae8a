"""Options from outside, as texts or values of JSON, TOML or YAML, become checked Settings."""

import difflib
import re
from collections.abc import Container, Hashable, Iterable, Mapping
from functools import lru_cache
from pathlib import Path
from typing import Any

from drapery.errors import OptionError
from drapery.option import Subject
from drapery.settings import NAMED_OPTIONS, OPTIONS, Settings, settled

NAMES = frozenset(NAMED_OPTIONS)
MAX_HINTS = 8
"""The most unknown names for which the nearest known name is looked up."""


def check_options(
    given: Mapping[str, Any], folder: Path, defaults: Container[str] = ()
) -> Settings | list[str]:
    """Checked options, or a list of all faults in them, one line each.

    given: values by the names of `NAMED_OPTIONS`, as `Option.parse` reads them.
    folder: relative paths start here.
    defaults: names of those that are defaults of many pictures; what of them does nothing for this
    one is left out.
    """
    values = parse_options(given, folder)
    if isinstance(values, list):
        return values
    own = {name: value for name, value in values.items() if name in defaults}
    try:
        # A kind that only the design tells is judged with the design.
        subject = Subject(*(values.get(name, OPTIONS[name].default) for name in Subject._fields))
        chosen = {name: value for name, value in values.items() if name not in defaults}
        return settled(Settings(**chosen), subject, own=own)
    except OptionError as error:
        return [one_line(str(error))]


def parse_options(given: Mapping[str, Any], folder: Path) -> dict[str, Any] | list[str]:
    """The values of options by name, or a list of all faults in them; see `check_options`."""
    values: dict[str, Any] = {}
    faults: list[str] = []
    refusals = iter(unknown_names(given, NAMES))
    for name, value in given.items():
        try:
            if name not in NAMED_OPTIONS:
                raise OptionError(next(refusals))
            values[name] = NAMED_OPTIONS[name].parse(value, folder)
        except OptionError as error:
            faults.append(one_line(str(error)))
    return faults or values


def unknown_names(names: Iterable[Hashable], known: frozenset[str]) -> list[str]:
    """The message for each name that no option has.

    Only the first `MAX_HINTS` are compared with all known names, which takes time.
    """
    strange = [name for name in names if name not in known]
    plain = [f"{str(name)[:40]!r} is not an option; leave it out" for name in strange[MAX_HINTS:]]
    return [unknown(name, known) for name in strange[:MAX_HINTS]] + plain


@lru_cache(1024)
def unknown(name: Hashable, known: frozenset[str]) -> str:
    """The message for a name that no option has."""
    shown = str(name)[:40]
    close = difflib.get_close_matches(shown, known, 1)
    hint = f"did you mean {close[0]}?" if close else "leave it out"
    return f"{shown!r} is not an option; {hint}"


def one_line(text: str) -> str:
    """A text without line breaks, shortened if it is long."""
    return re.sub(r"\s+", " ", text).strip()[:300]
