"""Commands of every Java version, and the item and block arguments that they hold.

A command is split into words as the game splits it, and only the words that define a banner are
read: the item that it gives, the block that it places, the tags of what it summons or changes.
What a command only tests or removes (`clear`, `execute if`, `fill … replace red_banner`) is not a
banner.
"""

import re
from collections.abc import Iterator
from contextlib import suppress
from dataclasses import dataclass, replace

from drapery.banner.design import Banner
from drapery.banner.dyes import DYES
from drapery.banner.formats import loot
from drapery.banner.formats.found import FoundBanner, find_banners
from drapery.banner.formats.item_details import ItemDetails, read_details
from drapery.banner.formats.leftovers import (
    PARAMETER,
    STATES,
    check_literal,
    check_read,
    looks_like_design,
)
from drapery.banner.formats.snbt import Brackets, Part, parse_command, parse_snbt
from drapery.banner.formats.tree import (
    OLD_BANNERS,
    DataTree,
    banner_from_block_entity,
    banner_from_components,
    banner_from_tag,
    bare,
    is_banner_id,
    is_shield_id,
    under,
)
from drapery.banner.names import shown
from drapery.errors import DesignError

_ARGUMENTS = frozenset({"give", "item", "replaceitem", "setblock", "fill"})
"""The commands whose argument is an item or a block that they make."""

_TREES = frozenset({"summon", "data", "entitydata", "blockdata", "loot"})
"""The commands whose compounds describe what they make."""

_TESTS = frozenset({"clear", "clone", "testfor", "testforblock"})
"""The commands that only look for banners, or remove them."""

_EDITS_WORDS = """
/center /curve /cyl /faces /fill /fillr /hcyl /hpyramid /hsphere /line /outline /overlay /pyramid
/replace /replacenear /set /sphere /walls
"""
EDITS = frozenset(_EDITS_WORDS.split())
"""The commands of WorldEdit that place blocks. They begin with two slashes."""

COMMANDS = _ARGUMENTS | EDITS | _TREES | _TESTS | {"execute", "return"}
"""The commands that may hold a banner."""


@dataclass(frozen=True)
class Word:
    """A word of a command. Spaces within brackets and quotes do not end it.

    start: its place in the text.
    """

    text: str
    start: int

    @property
    def name(self) -> str:
        """The word up to its brackets, such as an item's id."""
        return re.split(r"[\[{]", self.text, maxsplit=1)[0]


def command_of(text: str) -> str | None:
    """The command that a text begins with, without slash and namespace, or None."""
    name = first_word(text)
    return name if name in COMMANDS else None


def first_word(text: str) -> str:
    """The first word of a text, as commands are named: without slash and namespace."""
    word = text.lstrip()[:40].split(maxsplit=1)[:1]
    return word[0].removeprefix("/").removeprefix("minecraft:").lower() if word else ""


def read_command(text: str, *, line: int = 1) -> list[FoundBanner]:
    """All banners in one command, or in an item or block argument without a command.

    `/give @p minecraft:white_banner[…] 1`, `setblock ~ ~ ~ red_banner[rotation=4]{…}`,
    `red_banner{…}`, `summon item_frame ~ ~ ~ {Item:{…}}`.

    line: the number of the text's first line, for errors.

    Raises DesignError with the place, also if there is no banner.
    """
    try:
        return _some_of_command(text, line)
    except DesignError:
        whole = _WRAP.sub("", text)
        if whole != text:
            with suppress(DesignError):
                return _some_of_command(whole, line)
        raise


_WRAP = re.compile(r"(?<=[\w:])\r?\n(?=\w)")
"""A line break within a word, where a window or a message broke the line at its width."""


def _some_of_command(text: str, line: int) -> list[FoundBanner]:
    found = banners_of_command(text, line=line)
    if not found:
        raise DesignError(_nothing(text))
    return found


def banners_of_command(text: str, *, line: int = 1) -> list[FoundBanner]:
    """As `read_command`, but the list is empty for a command that has nothing to do with designs.

    Raises DesignError for a design that cannot be read.
    """
    words = _words(text)
    run = _innermost(words)
    made = list(_made(text, run, line))
    if not made and _leaves_design(words, run):
        raise DesignError(_nothing(text))
    return made


def _leaves_design(words: list[Word], run: list[Word]) -> bool:
    """Whether a command that makes no banner has layers outside of what it tests or removes."""
    if not run:
        return not _is_test(words) and any(looks_like_design(word.text) for word in words)
    name = first_word(run[0].text)
    if name in _TESTS:
        return False
    rest = [word.text for word in _defining(run, name) if word.text[0] != "@"]
    return looks_like_design(" ".join(rest))


def _is_test(words: list[Word]) -> bool:
    return not {"if", "unless"}.isdisjoint(word.text for word in words)


def banners_of_message(text: str, *, line: int = 1) -> list[FoundBanner]:
    """The banners with layers in what a command shows, such as `tellraw`: items, and commands to
    click.

    Raises DesignError for a message that cannot be read.
    """
    found: list[FoundBanner] = []
    for word in filter(_may_hold, _words(text)):
        if _is_item(word):
            parts = _parsed(text, word.start, word, line)
            found.append(FoundBanner(_argument(word.name, parts[1:]), bare(word.name)))
        elif word.text[0] not in "\"'":  # a tree, or a particle such as item{item:{…}}
            tree = Word(word.text[len(word.name) :], word.start + len(word.name))
            found += _in_tree(_tree(text, tree, line), "tellraw", False)
    return [one for one in found if one.banner.layers]


_MOST_TREES = 100
"""Most words of a command with a banner in brackets. Each takes time with the text's length."""


def _words(text: str) -> list[Word]:
    """The words of a command. Raises DesignError for too many with a banner in brackets."""
    words = split_words(text)
    if sum(map(_may_hold, words)) > _MOST_TREES:
        raise DesignError(
            f"the command has over {_MOST_TREES} words with banners in brackets; split it"
        )
    return words


_TOKEN = re.compile(r"""\s+|[\[{]|[\]}]|["']|[^\s\[\]{}"']+""")
_STRINGS = {
    '"': re.compile(r'"[^"\\]*(?:\\.[^"\\]*)*"', re.DOTALL),
    "'": re.compile(r"'[^'\\]*(?:\\.[^'\\]*)*'", re.DOTALL),
}


def split_words(text: str) -> list[Word]:
    """The words of a command. Where a bracket or quote is not closed, the rest is one word."""
    words: list[Word] = []
    at, start, depth = 0, -1, 0
    while at < len(text):
        token = _TOKEN.match(text, at)
        assert token is not None
        piece, end = token[0], token.end()
        if depth == 0 and piece.isspace():
            if start >= 0:
                words.append(Word(text[start:at], start))
            start = -1
        else:
            if piece in _STRINGS and (depth or start < 0):
                string = _STRINGS[piece].match(text, at)
                end = string.end() if string else len(text)
            start = at if start < 0 else start
            depth = max(0, depth + (piece in ("[", "{")) - (piece in ("]", "}")))
        at = end
    if start >= 0:
        words.append(Word(text[start:], start))
    return words


def _innermost(words: list[Word]) -> list[Word]:
    """The command that is run in the end, by `execute … run`, `return run` or the old `execute`.

    The words are empty if nothing is run.
    """
    at = 0
    while at < len(words) and first_word(words[at].text) in ("execute", "return"):
        target = words[at + 1].text if at + 1 < len(words) else ""
        if target.startswith("@"):
            # Up to 1.12: execute @p ~ ~ ~ [detect ~ ~ ~ stone 0] give …
            detects = words[at + 5 : at + 6]
            at += 11 if detects and detects[0].text == "detect" else 5
            continue
        while at < len(words) and words[at].text != "run":
            at += 1
        at += 1
    return words[at:]


def _made(text: str, words: list[Word], line: int) -> Iterator[FoundBanner]:
    """What a command makes: its item or block argument, otherwise the banners in its compounds."""
    if not words:
        return
    name = first_word(words[0].text)
    if name in _TESTS or (name not in COMMANDS and not _is_argument(words)):
        return
    rest = _defining(words, name)
    if name not in _TREES:
        for word in rest:
            if _is_item(word):
                parts = _parsed(text, word.start, rest[-1], line)
                details = _details(words, name, parts[1:])
                yield FoundBanner(_argument(word.name, parts[1:]), bare(word.name), details)
                return
            if PARAMETER.search(word.name) and word.name.endswith("_banner"):
                check_literal(word.name, "item", "base dye")
    for place, word in enumerate(rest):
        is_tree = name in COMMANDS and word.text[0] in "{["
        if name not in COMMANDS or (_may_hold(word) and (is_tree or name not in _TREES)):
            old = _is_old(name, rest, place)
            parts = [_tree(text, word, line)] if is_tree else _parsed(text, word.start, word, line)
            for part in parts:
                if not isinstance(part, str):
                    yield from _in_tree(part, name, old)


def _is_argument(words: list[Word]) -> bool:
    """Whether these words are an item or block argument without a command."""
    return _is_item(words[0]) or words[0].text[0] in "[{" or _may_hold(words[0])


def _defining(words: list[Word], name: str) -> list[Word]:
    """The words of a command that say what it makes."""
    if name not in COMMANDS:
        return words
    texts = [word.text for word in words]
    if name == "item" and "with" in texts:
        return words[texts.index("with") + 1 :]
    if name == "fill" and "replace" in texts:
        cut = texts.index("replace")
        if not texts[cut + 1 : cut + 2] or texts[cut + 1][0] != "{":
            return words[1:cut]
    if name in ("/replace", "/replacenear") and len(words) > 2:
        return words[-1:]  # after the blocks that are replaced
    if name == "data" and "value" in texts:
        return words[texts.index("value") + 1 :]
    if name == "data" and texts[1:2] in (["get"], ["remove"]):
        return []
    return words[1:]


def _parsed(text: str, start: int, last: Word, line: int) -> list[Part]:
    """The parts from a place to the end of a word. Columns of errors are those of the text."""
    return parse_command(_cut(text, start, last), line=line)


def _tree(text: str, word: Word, line: int) -> DataTree:
    """The compound or list that a word is."""
    return parse_snbt(_cut(text, word.start, word), line=line)


def _cut(text: str, start: int, last: Word) -> str:
    """The text from a place to the end of a word, with blanks before it."""
    rows, columns = text.count("\n", 0, start), start - text.rfind("\n", 0, start) - 1
    return "\n" * rows + " " * columns + text[start : last.start + len(last.text)]


def _is_item(word: Word) -> bool:
    return is_banner_id(word.name) or is_shield_id(word.name)


def _may_hold(word: Word) -> bool:
    """Whether a word has brackets or braces in which a banner is named."""
    low = word.text.lower()
    return ("[" in low or "{" in low) and (
        "banner" in low or "shield" in low or looks_like_design(low)
    )


def _in_tree(tree: DataTree, command: str, old: bool) -> list[FoundBanner]:
    """The banners of a compound, of a list, or of components."""
    found = list(_found_in(tree, command, old))
    check_read(tree, (len(one.banner.layers) for one in found))
    return found


def _found_in(tree: DataTree, command: str, old: bool) -> Iterator[FoundBanner]:
    if isinstance(tree, Brackets):
        tree = dict(tree)
    if old or _has_old_items(tree):
        _give_damage(tree)
    is_block = command in ("data", "blockdata", "") and isinstance(tree, dict) and "id" not in tree
    if loot.matches(tree):
        yield from loot.find(tree)
    elif is_block and "Base" in tree and tree.get("Patterns"):
        yield FoundBanner(banner_from_block_entity(tree))
    else:
        _parse_tags(tree)
        yield from find_banners(tree, details=True)
        yield from _in_strings(tree)


def _parse_tags(tree: DataTree) -> None:
    """Parse the tags that messages hold as text, as in `{id:"red_banner",tag:"{…}"}`."""
    for node in _compounds(tree):
        tag = node.get("tag")
        if isinstance(tag, str) and (is_banner_id(node.get("id")) or is_shield_id(node.get("id"))):
            node["tag"] = parse_snbt(tag)


def _in_strings(tree: DataTree) -> Iterator[FoundBanner]:
    """The designs of commands within a tree: of command blocks and of messages to click on."""
    for node in _compounds(tree):
        for key, value in node.items():
            if isinstance(value, str) and command_of(value) and looks_like_design(value):
                for one in banners_of_command(value):
                    yield replace(one, where=f"{under('', key)} {one.where}")


_OLD_ENTITIES_WORDS = """
commandblock_minecart ender_crystal evocation_fangs evocation_illager eye_of_ender_signal
fireworks_rocket illusion_illager snowman villager_golem vindication_illager xp_bottle xp_orb
"""
_OLD_ENTITIES = frozenset(_OLD_ENTITIES_WORDS.split())
"""Ids of entities that 1.13 renamed. Up to 1.10 ids had capitals."""


def _is_old(command: str, words: list[Word], place: int) -> bool:
    """Whether a compound is of Java up to 1.12, where the numbers of dyes are inverted."""
    if command in ("entitydata", "blockdata"):
        return True
    if command == "summon":
        name = words[0].name.removeprefix("minecraft:")
        return name != name.lower() or name in _OLD_ENTITIES
    before = words[place - 1].text if place else ""
    return words[place].text[0] == "{" and (before.isdecimal() or before in _MODES)


def _has_old_items(tree: DataTree) -> bool:
    """Whether a tree has items with a damage value or a key that versions up to 1.12 had."""
    return any(
        ("Damage" in node and "id" in node)
        or "ench" in node
        or isinstance(node.get("Equipment"), list)
        for node in _compounds(tree)
    )


def _give_damage(tree: DataTree) -> None:
    """Add the damage value that old items may leave out, by which the reader knows them."""
    for node in _compounds(tree):
        if is_shield_id(node.get("id")) and "tag" in node:
            node.setdefault("Damage", 0)


def _compounds(tree: DataTree) -> Iterator[dict[str, DataTree]]:
    nodes = [tree]
    while nodes:
        node = nodes.pop()
        if isinstance(node, dict):
            yield node
            nodes.extend(node.values())
        elif isinstance(node, list):
            nodes.extend(node)


_OLD_BLOCKS = OLD_BANNERS - {"banner"}
"""Ids of blocks up to 1.12, which are not items."""


def _argument(identifier: str, rest: list[Part]) -> Banner:
    """The banner or shield of an argument, from its id and what follows in the command."""
    _check_rest(rest)
    brackets = next((part for part in rest if isinstance(part, Brackets)), None)
    tag = next((p for p in rest if isinstance(p, dict) and not isinstance(p, Brackets)), None)
    if tag is not None and brackets and not STATES.issuperset(brackets):
        raise DesignError(
            f"{bare(identifier)}: it has both [components] and a {{tag}}; write the layers in one"
        )
    is_old = bool(rest) and isinstance(rest[0], str)
    if bare(identifier) in OLD_BANNERS or (is_shield_id(identifier) and is_old and tag is not None):
        data = _old_data(rest)
        is_block = bare(identifier) in _OLD_BLOCKS  # its number is its rotation
        data = None if is_block else 0 if data is None and is_old else data
        return banner_from_tag(identifier, tag, data=data)
    if tag is not None:
        return banner_from_tag(identifier, tag)
    components: DataTree = None if brackets is None else dict(brackets)
    return banner_from_components(identifier, components)


_BLOCK_KEYS = frozenset({"patterns", "Patterns"})
"""Keys of a banner's block entity, which an item has deeper in its tag."""


def _details(words: list[Word], command: str, rest: list[Part]) -> ItemDetails | None:
    """What a command says of its item beside the design; None for a block."""
    brackets = next((part for part in rest if isinstance(part, Brackets)), Brackets())
    tag = next((p for p in rest if isinstance(p, dict) and not isinstance(p, Brackets)), {})
    is_block = (brackets and STATES.issuperset(brackets)) or not tag.keys().isdisjoint(_BLOCK_KEYS)
    if command in ("setblock", "fill", *EDITS) or is_block:
        return None
    count = next((int(part) for part in rest if _is_count(part)), 1)
    target = words[1].text if command == "give" and len(words) > 2 else ItemDetails.target
    return read_details(dict(brackets), tag, count, PARAMETER.sub(r"$(\1)", target))


def _is_count(part: Part) -> bool:
    return isinstance(part, str) and part.isdecimal() and len(part) < 10


_MODES = frozenset({"destroy", "hollow", "keep", "outline", "replace", "strict"})


def _check_rest(rest: list[Part]) -> None:
    """Raise DesignError for words after the argument other than counts, states and modes."""
    for part in rest:
        if not isinstance(part, str) or part.isdecimal() or "=" in part:
            continue
        if part in _MODES:
            return
        check_literal(part, "item", "count")
        raise DesignError(
            f"{_position(part)}unexpected {shown(part)} after the item: write layers in its"
            ' brackets, as in [banner_patterns=[{pattern:"creeper",color:"lime"}]]'
        )


def _old_data(rest: list[Part]) -> int | None:
    """The dye number in `banner 1 15 {…}`, which follows the count."""
    words = [str(part) for part in rest[:2] if isinstance(part, str)]
    return int(words[1]) if len(words) == 2 and words[1].isdecimal() and len(words[1]) < 4 else None


_GIVE_IT = "give the command that makes it, such as /give"


def _nothing(text: str) -> str:
    """The error for a command without a banner that it makes."""
    words = split_words(text)
    inner = _innermost(words)
    name = first_word(inner[0].text) if inner else ""
    if name in _TESTS:
        return f"{name} makes no banner; {_GIVE_IT}"
    if not inner and not _is_test(words):
        return f"{first_word(text)} runs no command; write run and the command after it"
    if inner != words and not any(map(_is_item, inner)):
        return f"{first_word(text)} makes no banner, it only tests for it; {_GIVE_IT}"
    if near := _nearest(words):
        return f"no banner in the command: {near}"
    if looks_like_design(text) and not any(map(_is_item, words)):
        return (
            "no banner in the command: it has layers, but not the id that names the base dye; write"
            " them as in minecraft:white_banner[banner_patterns=[…]]"
        )
    if first_word(text) in ("execute", "return", "fill", "item", "data"):
        return "no banner in the command: it makes none; give the command that makes it"
    return (
        "no banner in the command: it needs an item such as"
        " minecraft:white_banner[banner_patterns=[…]]"
    )


def _nearest(words: list[Word]) -> str:
    import difflib

    known = [f"{dye}_banner" for dye in DYES] + ["shield"]
    for word in words[:20]:
        if len(word.name) < 60 and not _is_item(word):
            close = difflib.get_close_matches(bare(word.name), known, 1, 0.7)
            if close:
                return f"{shown(word.name)} is not an item of the game; did you mean '{close[0]}'?"
    return ""


def _position(part: Part) -> str:
    return f"column {part.column}: " if hasattr(part, "column") else ""
