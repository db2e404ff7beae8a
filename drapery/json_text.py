"""JSON from users: one reader with a bound on its depth, whose messages are the same with any
version of Python."""

import json
import re
from typing import Any

MAX_DEPTH = 200
"""The most lists and objects inside one another."""


class JSONTextError(ValueError):
    """A text that is not JSON. Its message goes on after a name: `, line 2, column 7: ...`."""


def parse_json(text: str, *, strict: bool = True) -> Any:
    """The value of a text of JSON.

    strict: whether texts with control characters in them are refused.
    Raises JSONTextError for what is not JSON, nests over MAX_DEPTH deep, or has a number of more
    digits than Python reads.
    """
    _check_depth(text)
    try:
        return json.loads(text, strict=strict)
    except json.JSONDecodeError as error:
        place = f", line {error.lineno}, column {error.colno}"
        raise JSONTextError(f"{place}: {_fault(text, error.pos)}") from None
    except ValueError:
        raise JSONTextError(": a number with too many digits; shorten it") from None


def _fault(text: str, at: int) -> str:
    """What is wrong at a place."""
    if not text[at:].strip():
        return "the text ends too early; complete the JSON"
    return f"{text[at]!r} cannot stand here; correct the JSON"


def _check_depth(text: str) -> None:
    if text.count("[") + text.count("{") <= MAX_DEPTH:
        return
    depth = 0
    for found in _TOKENS.finditer(text):
        token = found.group()
        depth += (token in ("[", "{")) - (token in ("]", "}"))
        if depth > MAX_DEPTH:
            line = text.count("\n", 0, found.start()) + 1
            raise JSONTextError(
                f", line {line}: lists and objects are nested too deep; use at most {MAX_DEPTH}"
            )


_TOKENS = re.compile(r'"(?:[^"\\]|\\.)*+"?|[][{}]', re.DOTALL)
"""Texts, whose brackets do not count, and brackets."""
