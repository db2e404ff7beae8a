"""Commands of every Java version, and the item and block arguments that they hold.

Only the parts of a command that define the banner are read: the word that names a banner or
shield, the brackets and braces after it, and, up to 1.12, the numbers between them.
"""

from collections.abc import Iterator

from drapery.banner.design import Banner
from drapery.banner.dyes import DYES
from drapery.banner.formats.found import FoundBanner, find_banners
from drapery.banner.formats.snbt import Brackets, Part, parse_command
from drapery.banner.formats.tree import (
    OLD_BANNERS,
    DataTree,
    banner_from_components,
    banner_from_tag,
    bare,
    is_banner_id,
    is_shield_id,
)
from drapery.banner.names import shown
from drapery.errors import DesignError

COMMANDS = frozenset(
    {
        *("give", "item", "replaceitem", "loot", "clear"),
        *("setblock", "fill", "summon", "data", "entitydata", "execute"),
    }
)
"""The commands that may hold a banner."""


def command_of(text: str) -> str | None:
    """The command that a text begins with, without slash and namespace, or None."""
    word = text.lstrip()[:40].split(maxsplit=1)[:1]
    name = word[0].removeprefix("/").removeprefix("minecraft:").lower() if word else ""
    return name if name in COMMANDS else None


def read_command(text: str, *, line: int = 1) -> list[FoundBanner]:
    """All banners in one command, or in an item or block argument without a command.

    `/give @p minecraft:white_banner[…] 1`, `setblock ~ ~ ~ red_banner[rotation=4]{…}`,
    `red_banner{…}`, `summon item_frame ~ ~ ~ {Item:{…}}`.

    line: the number of the text's first line, for errors.

    Raises DesignError with the place, also if there is no banner.
    """
    parts = _last_run(parse_command(text, line=line))
    found = list(_found(parts))
    if not found:
        raise DesignError(f"no banner in the command{_nearest(parts)}")
    return found


def _last_run(parts: list[Part]) -> list[Part]:
    """The command after `execute … run`; the filters before may name other banners."""
    runs = [place for place, part in enumerate(parts) if part == "run"]
    return parts[runs[-1] + 1 :] or parts if runs else parts


def _found(parts: list[Part]) -> Iterator[FoundBanner]:
    """The item or block argument of a banner; otherwise the banners in compounds and components."""
    for place, part in enumerate(parts):
        if isinstance(part, str) and (is_banner_id(part) or is_shield_id(part)):
            yield FoundBanner(_argument(str(part), parts[place + 1 :]), bare(part))
            return
    for place, part in enumerate(parts):
        if isinstance(part, dict) and not _is_selector(parts, place):
            yield from find_banners(dict(part))


def _is_selector(parts: list[Part], place: int) -> bool:
    before = parts[place - 1] if place else ""
    return isinstance(parts[place], Brackets) and str(before).startswith("@")


def _argument(identifier: str, rest: list[Part]) -> Banner:
    """The banner or shield of an argument, from its id and what follows in the command."""
    _check_rest(rest)
    brackets = rest[0] if rest and isinstance(rest[0], Brackets) else None
    tag = next((p for p in rest if isinstance(p, dict) and not isinstance(p, Brackets)), None)
    if bare(identifier) in OLD_BANNERS:
        return banner_from_tag(identifier, tag, data=_old_data(rest))
    if tag is not None:
        return banner_from_tag(identifier, tag)
    components: DataTree = None if brackets is None else dict(brackets)
    return banner_from_components(identifier, components)


_MODES = frozenset({"destroy", "hollow", "keep", "outline", "replace", "strict"})


def _check_rest(rest: list[Part]) -> None:
    """Raise DesignError for words after the argument other than counts, states and modes."""
    for part in rest:
        if not isinstance(part, str) or part.isdecimal() or "=" in part:
            continue
        if part in _MODES:
            return
        raise DesignError(
            f"{_position(part)}unexpected {shown(part)} after the item: write layers in its"
            ' brackets, as in [banner_patterns=[{pattern:"creeper",color:"lime"}]]'
        )


def _old_data(rest: list[Part]) -> int | None:
    """The dye number in `banner 1 15 {…}`, which follows the count."""
    words = [str(part) for part in rest[:2] if isinstance(part, str)]
    return int(words[1]) if len(words) == 2 and words[1].isdecimal() and len(words[1]) < 4 else None


def _nearest(parts: list[Part]) -> str:
    import difflib

    known = [f"{dye}_banner" for dye in DYES] + ["shield"]
    for part in parts[:20]:
        if isinstance(part, str) and len(part) < 60:
            close = difflib.get_close_matches(bare(part), known, 1, 0.7)
            if close:
                return f": {shown(part)} is not an item of the game; did you mean '{close[0]}'?"
    return ": it needs an item such as minecraft:white_banner[banner_patterns=[…]]"


def _position(part: Part) -> str:
    return f"column {part.column}: " if hasattr(part, "column") else ""
