"""TOML from users: one reader with a bound on its length, and the line of a field in its text."""

import re
import tomllib
from pathlib import Path
from typing import Any

from drapery.errors import OptionError

Place = tuple[int | str, ...]
"""Where a field is: the names of tables and fields, and the numbers of items in lists, from 0."""


def read_toml(path: str | Path, max_bytes: int, kind: str) -> tuple[dict[str, Any], str]:
    """The contents of a file, and its text.

    kind: what the file describes, for messages, such as `a style`.
    Raises OptionError for a file that cannot be read, is longer than max_bytes, or is not TOML.
    """
    try:
        with Path(path).open("rb") as file:
            data = file.read(max_bytes + 1)
    except OSError as error:
        raise OptionError(f"{path} cannot be read: {error.strerror}; check the path") from None
    if len(data) > max_bytes:
        raise OptionError(f"{path} has over {max_bytes} bytes; {kind} is shorter")
    try:
        text = data.decode("utf-8")
        return tomllib.loads(text), text
    except UnicodeDecodeError:
        raise OptionError(f"{path} is not text in UTF-8; save it as UTF-8") from None
    except (tomllib.TOMLDecodeError, RecursionError) as error:
        raise OptionError(f"{path} is not TOML: {error}; correct that line") from None


def locate(path: str | Path, text: str, place: Place) -> str:
    """The file and the line of a field; only the file if the line is not found."""
    line = line_of(text, place)
    return f"{path}" if line is None else f"{path} line {line}"


def line_of(text: str, place: Place) -> int | None:
    """The line of a field, from 1; that of its table where the table lacks the field.

    place: a field; or a table and a field; or a list of tables, the number of one, and a field.
    None where the text has neither.
    """
    lines, (head, *inner) = text.splitlines(), place
    heads = [n for n, line in enumerate(lines) if _is_head(line, str(head))]
    number = inner[0] if inner and isinstance(inner[0], int) else 0
    if not heads:
        return _key_line(lines, 0, head)
    if number >= len(heads):
        return None
    start = heads[number]
    names = [part for part in inner if isinstance(part, str)]
    return (names and _key_line(lines, start + 1, names[0])) or start + 1


def _key_line(lines: list[str], start: int, name: int | str) -> int | None:
    """The line of `name = ...` from a line on, before the next table."""
    for number in range(start, len(lines)):
        if lines[number].lstrip().startswith("["):
            return None
        if re.match(rf"\s*[\"']?{re.escape(str(name))}[\"']?\s*=", lines[number]):
            return number + 1
    return None


def _is_head(line: str, name: str) -> bool:
    return re.match(rf"\s*\[{{1,2}}\s*{re.escape(name)}\s*\]", line) is not None
