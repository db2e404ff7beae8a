"""Function files (`.mcfunction`), and any text of several commands: one command on a line.

Comments and commands that hold no items are skipped; a line that ends in a backslash, or within
brackets, goes on in the next one; a macro line begins with `$` and has parameters such as `$(dye)`.
"""

import re
from collections.abc import Callable
from dataclasses import replace
from functools import lru_cache
from typing import NamedTuple

from drapery.banner.design import Banner
from drapery.banner.formats import give
from drapery.banner.formats.commands import (
    COMMANDS,
    banners_of_command,
    banners_of_message,
    first_word,
)
from drapery.banner.formats.found import FoundBanner
from drapery.banner.formats.leftovers import PARAMETER, literal_macro, looks_like_design
from drapery.banner.formats.several import MAX_READ, left_out_error
from drapery.banner.names import shown
from drapery.errors import DesignError

NAME = "function"
TITLE = "function file, or several commands, one on a line"
EXAMPLE = (
    '$give @s minecraft:white_banner[banner_patterns=[{pattern:"creeper",color:"lime"}],'
    'item_name="$(name)"]'
)
SOURCE = "https://minecraft.wiki/w/Function_(Java_Edition)"

MAX_COMMANDS = 20_000
"""Most commands with a banner in one text."""

MAX_BROKEN = 1000
"""Most commands of one text that cannot be read. Each takes half a millisecond."""

NOTHING = "there is no banner in the commands: paste a /give command"

_OTHERS_WORDS = """
advancement attribute ban ban-ip banlist bossbar camera camerashake clearspawnpoint clone damage
datapack debug defaultgamemode deop dialog dialogue difficulty effect enchant event experience
fillbiome fog forceload function gamemode gamerule help inputpermission jfr kick kill list
locate me mobevent msg music op pardon particle perf place playanimation playsound publish
random recipe reload ride rotate save-all save-off save-on say schedule scoreboard seed
setidletimeout setworldspawn spawnpoint spectate spreadplayers stop stopsound stopwatch
structure tag team teammsg teleport tell tellraw tick tickingarea time title titleraw tm
toggledownfall tp transfer trigger version w waypoint weather whitelist worldborder xp
"""
_OTHERS = frozenset(_OTHERS_WORDS.split())
"""The commands of both editions that hold no banner."""

_SPOKEN = frozenset({"me", "msg", "say", "scoreboard", "team", "teammsg", "tell", "tm", "w"})
"""The commands whose words may talk of banners."""

_SHOWN = frozenset({"bossbar", "dialog", "particle", "tellraw", "title", "titleraw"})
"""The commands that show messages or items, in which an item or a command may hold a design."""


_KNOWN = COMMANDS | _OTHERS
_OPENING = COMMANDS | _SHOWN
"""The commands whose brackets may be closed in a later line."""


def recognises(text: str) -> bool:
    """Whether the text is a macro or a message, or several lines of which one may hold a banner."""
    if text.lstrip().startswith("$"):
        return first_word(text.lstrip()[1:]) in COMMANDS
    if "\n" not in text.strip():
        return first_word(text) in _SHOWN and looks_like_design(text)
    known = holding = 0
    for _, word, _ in commands_of(text):
        holding += word in COMMANDS
        known += word in COMMANDS or word in _OTHERS or word.startswith("#")
        if holding and known > 1:
            return True
    return holding > 0 and first_word(text) in COMMANDS and "\\\n" in text.replace("\r", "")


def has_only_commands(text: str) -> bool:
    """Whether every line is a comment, a macro or a command of the game."""
    return all(
        word in COMMANDS or word in _OTHERS or line.lstrip().startswith(("#", "$", "//"))
        for _, word, line in commands_of(text)
    )


def read(text: str) -> list[FoundBanner]:
    """All banners of the commands. Raises DesignError for the first broken line, and for none."""
    errors: list[DesignError] = []
    found = find(text, errors.append)
    if errors or not found:
        raise errors[0] if errors else DesignError(NOTHING)
    return found


def find(text: str, on_error: Callable[[DesignError], None]) -> list[FoundBanner]:
    """All banners of the commands, each with its line, which may be none.

    on_error: called with the error of one broken line, after which the search continues, and
        before these with one that says which commands were left out because of MAX_READ.

    Raises DesignError for over MAX_COMMANDS lines with a banner and for over MAX_BROKEN broken
    ones.
    """
    lines = [(number, line) for number, word, line in commands_of(text) if _may_hold(word, line)]
    if len(lines) > MAX_COMMANDS:
        raise DesignError(f"the text has {len(lines)} commands, over {MAX_COMMANDS}: split it")
    found: list[FoundBanner] = []
    known: dict[str, list[FoundBanner]] = {}
    broken: list[DesignError] = []
    left_out: list[int] = []
    characters = 0
    for number, line in lines:
        if line not in known:
            characters += len(line)
            if characters > MAX_READ:
                left_out.append(number)
                continue
        try:
            if line not in known:
                known[line] = _read_line(line, number)
            found += [replace(one, where=f"line {number} {one.where}") for one in known[line]]
        except DesignError as error:
            broken.append(DesignError(_with_line(str(error), number)))
            if len(broken) > MAX_BROKEN:
                raise DesignError(
                    f"{broken[0]}; {MAX_BROKEN} more commands cannot be read: correct them"
                ) from None
    if left_out:
        on_error(left_out_error(left_out))
    for each in broken:
        on_error(each)
    return found


def write(banner: Banner) -> str:
    """A command that gives the banner or shield to the player who runs the function (1.20.5+)."""
    return f"give @s {give.argument(banner)}"


class _Command(NamedTuple):
    """A command or a comment: the number of its first line, its first word, and its text."""

    number: int
    name: str
    text: str


@lru_cache(maxsize=1)
def commands_of(text: str) -> tuple[_Command, ...]:
    """The commands and comments of a text. One may have several lines.

    The last text is kept, since a text is looked at several times until it is read.
    """
    found: list[_Command] = []
    parts: list[str] = []
    start = _Start(0, "", 0)
    depth = 0
    for number, line in enumerate(text.split("\n"), 1):
        name = _command(line)
        if parts and not _goes_on(start, parts[-1], depth, line, name):
            found.append(_finished(start, parts))
            parts = []
        if not parts:
            start, depth = _Start(number, name, _indent(line)), 0
        if parts or line.strip():
            parts.append(line)
            if start.name in _OPENING:
                depth = max(0, depth + _opened(line))
    if parts:
        found.append(_finished(start, parts))
    return tuple(found)


class _Start(NamedTuple):
    """The first line of a command: its number, the command's name, and its indentation."""

    number: int
    name: str
    indent: int


def _finished(start: _Start, parts: list[str]) -> _Command:
    if len(parts) == 1:
        return _Command(start.number, start.name, parts[0])
    text = _joined(parts)
    return _Command(start.number, _command(text), text)


def _goes_on(start: _Start, before: str, depth: int, line: str, name: str) -> bool:
    """Whether a line, which begins with the word `name`, goes on the command of the line before it.

    depth: the open brackets of that command.
    """
    if _has_backslash(before):
        return not start.name.startswith("#")
    if name.startswith("#") or name in _KNOWN:
        return False
    return depth > 0 or (name != "" and start.name in COMMANDS and _indent(line) > start.indent)


def _indent(line: str) -> int:
    return len(line) - len(line.lstrip())


def _has_backslash(line: str) -> bool:
    return line.rstrip().endswith("\\")


_BRACKET = re.compile(r"""[\[\]{}]|"(?:[^"\\]|\\.)*(?:"|\\?\Z)|'(?:[^'\\]|\\.)*(?:'|\\?\Z)""")


def _opened(line: str) -> int:
    """How many more brackets a line opens than it closes, those in strings left out."""
    marks = [match[0] for match in _BRACKET.finditer(line)]
    return sum(mark in "[{" for mark in marks) - sum(mark in "]}" for mark in marks)


def _joined(parts: list[str]) -> str:
    """Lines as one command. A line break stays between them, except within a word."""
    pieces = [parts[0]]
    for part in parts[1:]:
        if _has_backslash(pieces[-1]):
            start = pieces[-1].rstrip()[:-1]
            pieces[-1] = start or " "
            in_word = (start[-1:].isalnum() or start[-1:] in "_:") and part.strip()[:1].isalnum()
            pieces.append(part.lstrip() if in_word else f"\n{part}")
        else:
            pieces.append(f"\n{part}")
    return "".join(pieces)


def _may_hold(word: str, line: str) -> bool:
    """Whether a line is a command with a banner, or another with what looks like a design."""
    low = line.lower()
    if word in COMMANDS and ("banner" in low or "shield" in low):
        return True
    return not word.startswith("#") and word not in _SPOKEN and looks_like_design(low)


def _command(line: str) -> str:
    return first_word(line.lstrip().removeprefix("$"))


def _read_line(line: str, number: int) -> list[FoundBanner]:
    """The banners of one line. Raises DesignError for a design that cannot be read."""
    if line.lstrip().startswith("$"):
        return _read_macro(literal_macro(line), number)
    return _read_command(line, number)


def _read_command(line: str, number: int) -> list[FoundBanner]:
    if line.rstrip().endswith("\\"):
        raise DesignError("the line ends with a backslash, but no line follows; remove it")
    word = first_word(line)
    if word in _SHOWN:
        return banners_of_message(line, line=number)
    if word not in COMMANDS:
        raise DesignError(f"the command {shown(word)} holds a design; give a /give command")
    return banners_of_command(line, line=number)


def _read_macro(line: str, number: int) -> list[FoundBanner]:
    try:
        return _read_command(line, number)
    except DesignError as error:
        message = PARAMETER.sub(r"$(\1)", str(error))
        if "macro" not in message and PARAMETER.search(line):
            message += "; the line is a macro: write out its parameters"
        raise DesignError(message) from None


def _with_line(message: str, number: int) -> str:
    if message.startswith("line "):
        return message
    return f"line {number}{', ' if message.startswith('column ') else ': '}{message}"
