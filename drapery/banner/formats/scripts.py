"""Calls in the scripts of mods: finds the end of an argument, and reads an item with its tag."""

import re
from bisect import bisect_left
from collections.abc import Callable

from drapery.banner.design import Banner
from drapery.banner.formats.commands import read_command
from drapery.banner.formats.snbt import parse_snbt
from drapery.banner.formats.tree import banner_from_tag, bare, is_banner_id, is_shield_id
from drapery.errors import DesignError

MAX_DEPTH = 64
"""Most brackets inside each other in the arguments of a call."""

_TOKEN = re.compile(r""""(?:[^"\\]|\\.)*"|'(?:[^'\\]|\\.)*'|[()\[\]{},]""", re.DOTALL)
_DESIGN = re.compile("BlockEntityTag|Patterns|banner_patterns|base_color")
_OPEN, _CLOSE = "([{", ")]}"


def arguments(text: str, start: int) -> tuple[list[str], int] | None:
    """The arguments of a call, whose bracket opens before `start`, and where it ends.

    None if the call is not closed. Raises DesignError for brackets that nest too deeply.
    """
    found: list[str] = []
    depth, begin = 0, start
    for match in _TOKEN.finditer(text, start):
        token = match[0]
        if token in _OPEN:
            depth += 1
            if depth > MAX_DEPTH:
                raise DesignError(f"{places(text)(begin)}: brackets nest over {MAX_DEPTH} deep")
        elif depth == 0 and token in (",", ")"):
            found.append(text[begin : match.start()].strip())
            begin = match.end()
            if token == ")":
                return found, begin
        elif token in _CLOSE:
            depth -= 1
    return None


def bracketed(text: str, start: int) -> str | None:
    """The part of a text from the bracket at `start` to the one that closes it; None without one.

    Raises DesignError for brackets that nest too deeply.
    """
    depth = 0
    for match in _TOKEN.finditer(text, start):
        depth += (match[0] in _OPEN) - (match[0] in _CLOSE)
        if depth > MAX_DEPTH:
            raise DesignError(f"{places(text)(start)}: brackets nest over {MAX_DEPTH} deep")
        if depth == 0:
            return text[start : match.end()]
    return None


def literal(argument: str) -> str | None:
    """The text in an argument's quotes, with its escapes resolved; None for another argument."""
    if len(argument) < 2 or argument[0] not in "'\"`" or argument[-1] != argument[0]:
        return None
    return re.sub(r"\\(.)", r"\1", argument[1:-1], flags=re.DOTALL)


def banner_of(identifier: str, tag: str | None, at: str) -> Banner | None:
    """The banner of an item's name and its tag in SNBT, or None for other items.

    A shield without a design counts as another item. Raises DesignError that begins with the
    place `at`.
    """
    name = bare(identifier)
    if not (is_banner_id(name) or (is_shield_id(name) and _DESIGN.search(tag or ""))):
        return None
    try:
        if tag is None or tag.startswith("["):
            return read_command(identifier + (tag or ""))[0].banner
        return banner_from_tag(name, parse_snbt(tag))
    except DesignError as error:
        raise DesignError(f"{at}: {error}") from None


def places(text: str) -> Callable[[int], str]:
    """A function that names a place in a text as messages do: `line 3`."""
    ends = [match.start() for match in re.finditer("\n", text)]
    return lambda place: f"line {bisect_left(ends, place) + 1}"
