"""A text with one design on each line, in any form of text."""

import re
from collections.abc import Callable
from dataclasses import replace

from drapery.banner.formats.commands import EDITS, command_of
from drapery.banner.formats.found import FoundBanner
from drapery.banner.names import shown
from drapery.errors import DesignError, counted

MAX_LINES = 20_000
"""Most designs of one text, one per line."""

MAX_READ = 1 << 18
"""Most characters of different lines or commands that are read in one text: a thousand commands
with six layers. A reader takes 5 to 20 microseconds for each."""

_BULLET = re.compile(r"\s*(?:[-*•]|[0-9]{1,4}[.)])\s+")
_YAML_KEY = re.compile(r"['\"]?[\w -]{1,40}['\"]?:")
_COMMENTS = ("#", "//", "--")


def find_in_lines(
    text: str, read: Callable[[str], list[FoundBanner]], errors: list[DesignError]
) -> list[FoundBanner]:
    """The banners of all lines, or an empty list if the text is not a list of designs.

    Empty lines, comments and keys of YAML without a value are skipped, and bullets removed. It is a
    list if its only line that is left can be read, or if at least two can and no more lines cannot;
    the errors of these are added to `errors`, after one that says which were left out because of
    MAX_READ.
    """
    lines = [(n, line.strip()) for n, line in enumerate(text.split("\n"), 1) if _is_design(line)]
    one_line = "\n" not in text.strip() and not _BULLET.match(text)
    if one_line or not 0 < len(lines) <= MAX_LINES:
        return []
    found: list[FoundBanner] = []
    faults: list[DesignError] = []
    left_out: list[int] = []
    known: dict[str, list[FoundBanner]] = {}
    good = characters = 0
    for number, line in lines:
        if line not in known:
            characters += len(line)
            if characters > MAX_READ:
                left_out.append(number)
                continue
        try:
            read_line = known.get(line) or read(_BULLET.sub("", line, count=1) or line)
            known[line] = read_line
        except DesignError as error:
            faults.append(DesignError(f"line {number} {shown(line, 30)}: {error}"))
            if len(faults) > 20 + 2 * good:
                return []
        else:
            good += 1
            found += [replace(f, where=_at(number, f.where)) for f in read_line]
    if good < min(2, len(lines)) or len(faults) > good:
        return []
    errors += [left_out_error(left_out)] if left_out else []
    errors += faults
    return found


def left_out_error(numbers: list[int]) -> DesignError:
    """What is said of lines that are left out because of MAX_READ. numbers: theirs."""
    return DesignError(
        f"line {numbers[0]} and on: {counted(len(numbers), 'design')} left out, because different"
        f" lines have over {MAX_READ} characters: split the text"
    )


def _at(number: int, where: str) -> str:
    """A place in a line as one in the text."""
    return f"line {number} {where.removeprefix('line 1').lstrip()}".rstrip()


def _is_design(line: str) -> bool:
    line = line.strip()
    if _YAML_KEY.fullmatch(line):
        return False
    is_edit = "banner" in line and command_of(line) in EDITS
    return bool(line) and (is_edit or not line.startswith(_COMMENTS))
