"""Options as texts or values from outside -> checked Settings, with every fault of them told."""

import difflib
import re
from collections.abc import Mapping
from dataclasses import fields
from functools import cache
from pathlib import Path
from typing import Any

from pydantic import TypeAdapter, ValidationError

from drapery.errors import OptionError
from drapery.settings import Settings, pair

NAMES = frozenset(field.name for field in fields(Settings))
PAIRS = ("size", "grid")


@cache
def _model() -> TypeAdapter[Settings]:
    # Settings are the model; pydantic reads their types, and they check their own bounds.
    return TypeAdapter(Settings)


def check_options(words: Mapping[str, Any], folder: Path) -> Settings | list[str]:
    """Checked options, or all their faults, one line each.

    words: by the names of `Settings`; `size` and `grid` may be texts like 64x64, `packs` a text
    with semicolons. folder: what paths are relative to.
    """
    try:
        return _read(words, folder)
    except (ValidationError, OptionError) as error:
        alone = [fault for name in words for fault in _faults({name: words[name]}, folder)]
        return list(dict.fromkeys(alone)) or _lines(error)


def unknown(name: object, known: frozenset[str]) -> str:
    """The fault of a name that no option has."""
    shown = str(name)[:40]
    close = difflib.get_close_matches(shown, known, 1)
    hint = f"did you mean {close[0]}?" if close else "leave it out"
    return f"{shown!r} is no option; {hint}"


def one_line(text: str) -> str:
    """A text without line breaks, cut where it is long."""
    return re.sub(r"\s+", " ", text).strip()[:300]


def _faults(words: Mapping[str, Any], folder: Path) -> list[str]:
    try:
        _read(words, folder)
    except (ValidationError, OptionError) as error:
        # An option that only clashes with another's default is judged with the others.
        return _lines(error)
    return []


def _read(words: Mapping[str, Any], folder: Path) -> Settings:
    return _model().validate_python(_as_values(words, folder))


def _as_values(words: Mapping[str, Any], folder: Path) -> dict[str, Any]:
    values = dict(words)
    for name in PAIRS:
        if isinstance(values.get(name), str):
            values[name] = pair(name, values[name])
    packs = values.get("packs")
    if isinstance(packs, str):
        packs = [part.strip() for part in packs.split(";") if part.strip()]
    if isinstance(packs, list | tuple):
        values["packs"] = tuple(folder / p if isinstance(p, str | Path) else p for p in packs)
    if isinstance(values.get("texture"), str | Path):
        values["texture"] = folder / values["texture"]
    return values


def _lines(error: ValidationError | OptionError) -> list[str]:
    if isinstance(error, OptionError):
        return [str(error)]
    return [
        f"{'.'.join(str(part) for part in fault['loc'])}: {one_line(fault['msg'])}"
        for fault in error.errors(include_url=False, include_input=False)
    ]
