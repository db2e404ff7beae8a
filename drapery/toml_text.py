"""TOML from users: one reader with bounds, and the line of a field in its text.

The parser needs memory and time by the square of the depth of a key, so the text is scanned before.
"""

import re
import tomllib
from pathlib import Path
from typing import Any

from drapery.errors import OptionError
from drapery.user_files import read_user_file

MAX_DEPTH = 32
"""The most parts of a dotted name, and the most lists and tables inside one another."""
MAX_WORD = 100
"""The most characters of a number, or of a name without quotes."""

Place = tuple[int | str, ...]
"""Where a field is: the names of tables and fields, and the numbers of items in lists, from 0."""


def read_toml(path: str | Path, max_bytes: int, kind: str) -> tuple[dict[str, Any], str]:
    """The contents of a file, and its text.

    kind: what the file describes, for messages, such as `a style`.
    Raises OptionError for a file that cannot be read, is longer than max_bytes, or is not TOML.
    """
    data = read_user_file(path, max_bytes, shorter=f"{kind} is shorter")
    try:
        text = data.decode("utf-8-sig")
    except UnicodeDecodeError:
        raise OptionError(f"{path} is not text in UTF-8; save it as UTF-8") from None
    return parse_toml(text, path), text


def parse_toml(text: str, where: object) -> dict[str, Any]:
    """The value of a text of TOML.

    where: the name of the file, for messages. Raises OptionError for a text that is not TOML, or
    that exceeds MAX_DEPTH or MAX_WORD.
    """
    _check_bounds(text, where)
    try:
        return tomllib.loads(text)
    except (ValueError, RecursionError) as error:
        raise OptionError(f"{where}{_at(error)} is not TOML; correct it there") from None


def _at(error: Exception) -> str:
    """The place of a fault, which Python 3.14 gives and versions before have in their text only."""
    line, column = getattr(error, "lineno", None), getattr(error, "colno", None)
    if line is None and (found := re.search(r"line (\d+), column (\d+)", str(error))):
        line, column = found.groups()
    return "" if line is None else f" line {line}, column {column}"


def _check_bounds(text: str, where: object) -> None:
    """Raise OptionError for names, lists and tables that nest too deeply, and for long words."""
    parts = depth = 0
    for found in _TOKENS.finditer(text):
        token = found.group()
        if len(token) > MAX_WORD and found.lastgroup == "word":
            fault = f"a word without quotes has over {MAX_WORD} characters; shorten it"
        elif token == ".":
            parts += 1
            fault = f"a name has over {MAX_DEPTH} parts; shorten it" if parts >= MAX_DEPTH else ""
        elif found.lastgroup == "mark":
            parts, fault = 0, ""
            depth = max(0, depth + (token in "[{") - (token in "]}"))
            if depth > MAX_DEPTH:
                fault = f"lists and tables nest over {MAX_DEPTH} deep; flatten them"
        else:
            continue
        if fault:
            line = text.count("\n", 0, found.start()) + 1
            raise OptionError(f"{where} line {line}: {fault}")


_TOKENS = re.compile(
    r"""
    \"{3}(?:[^"\\]|\\.|"(?!""))*+"{0,5} | '{3}(?:[^']|'(?!''))*+'{0,5}  # texts of many lines
    | "(?:[^"\\\n]|\\.)*+"? | '[^'\n]*+'? | \#[^\n]*+  # texts of a line, comments
    | (?P<word>[\w+-]++) | (?P<dot>\.) | (?P<mark>[][{}=,\n])
    """,
    re.VERBOSE | re.DOTALL,
)


def locate(path: str | Path, text: str, place: Place) -> str:
    """The file and the line of a field; only the file if the line is not found."""
    line = line_of(text, place)
    return f"{path}" if line is None else f"{path} line {line}"


def line_of(text: str, place: Place) -> int | None:
    """The line of a field, from 1; the line of its table where the table lacks the field.

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
