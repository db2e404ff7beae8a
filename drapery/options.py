"""Options from outside, as texts or values of JSON, TOML or YAML, become checked Settings."""

import difflib
import re
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from drapery.errors import OptionError
from drapery.settings import NAMED_OPTIONS, Settings

NAMES = frozenset(NAMED_OPTIONS)


def check_options(given: Mapping[str, Any], folder: Path) -> Settings | list[str]:
    """Checked options, or a list of all faults in them, one line each.

    given: values by the names of `NAMED_OPTIONS`, as `Option.parse` reads them.
    folder: relative paths start here.
    """
    values: dict[str, Any] = {}
    faults: list[str] = []
    for name, value in given.items():
        try:
            if name not in NAMED_OPTIONS:
                raise OptionError(unknown(name, NAMES))
            values[name] = NAMED_OPTIONS[name].parse(value, folder)
        except OptionError as error:
            faults.append(one_line(str(error)))
    if faults:
        return faults
    try:
        return Settings(**values)
    except OptionError as error:
        return [one_line(str(error))]


def unknown(name: object, known: frozenset[str]) -> str:
    """The message for an unknown option."""
    shown = str(name)[:40]
    close = difflib.get_close_matches(shown, known, 1)
    hint = f"did you mean {close[0]}?" if close else "leave it out"
    return f"{shown!r} is not an option; {hint}"


def one_line(text: str) -> str:
    """A text without line breaks, shortened if it is long."""
    return re.sub(r"\s+", " ", text).strip()[:300]
