"""What a command or an item says beside its design: who gets it, how many, its name, its lore.

Names and lore are text components, whose form depends on the version of Java Edition: SNBT since
1.21.5, JSON from 1.13 on, plain text before that (https://minecraft.wiki/w/Text_component_format).
"""

import json
import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field

from drapery.banner.formats.leftovers import holds_expression
from drapery.banner.formats.tree import DataTree, bare, get
from drapery.banner.names import shown
from drapery.errors import DesignError

MAX_COUNT = 1600
"""The most items of one command: a hundred stacks of sixteen."""
MAX_LINES = 256
"""The most lines of lore that the game keeps."""
MAX_DEPTH = 64
"""The deepest tree that is written again."""

_TARGET = re.compile(r"@[aenprs](\[[^\n]{0,200}\])?|[\w-]{1,36}", re.ASCII)
_DESIGN = ("banner_patterns", "base_color")


@dataclass(frozen=True)
class ItemDetails:
    """What a command says beside the design.

    target: a selector such as `@a[distance=..5]`, or the name of a player.
    count: how many items.
    name: the item's custom name, a text or a component such as `{"text": "Flag", "color": "red"}`.
    lore: the lines below the name.
    json_text: write name and lore as JSON, as Java Edition 1.20.5 to 1.21.4 reads them; it applies
        only to the form `give`.
    components: the item's others (since 1.20.5), by name; the value of one that is removed is None.
    tag: other entries of the item's tag (up to 1.20.4).
    left_out: what the text said that is not here, in words.

    Raises DesignError for a value that a command cannot hold.
    """

    target: str = "@p"
    count: int = 1
    name: DataTree = ""
    lore: tuple[DataTree, ...] = ()
    json_text: bool = False
    components: Mapping[str, DataTree] = field(default_factory=dict)
    tag: Mapping[str, DataTree] = field(default_factory=dict)
    left_out: tuple[str, ...] = ()

    def __post_init__(self) -> None:
        if not _TARGET.fullmatch(self.target):
            raise DesignError(
                f"{shown(self.target)} is not a player; write @p, @a, @s, a selector or a name"
            )
        if not 1 <= self.count <= MAX_COUNT:
            raise DesignError(f"{self.count} items cannot be given; use 1 to {MAX_COUNT}")
        if len(self.lore) > MAX_LINES:
            raise DesignError(f"lore has {len(self.lore)} lines; use at most {MAX_LINES}")
        if not all(line.isprintable() for line in (self.name, *self.lore) if isinstance(line, str)):
            raise DesignError("name and lore have characters without a shape; leave them out")

    @property
    def title(self) -> str:
        """The name as plain text, or the item's own name, or ""."""
        return plain_text(self.name) or plain_text(get(dict(self.components), "item_name")[1])


def plain_text(component: DataTree) -> str:
    """The words of a text component without their looks; "" for what has none."""
    if isinstance(component, str):
        return component
    if isinstance(component, list):
        return "".join(map(plain_text, component))
    if not isinstance(component, dict):
        return ""
    own = component.get("text", component.get("fallback", ""))
    return plain_text(own) + plain_text(component.get("extra"))


def is_plain(component: DataTree) -> bool:
    """Whether a text component is nothing but words."""
    return isinstance(component, str) or (
        isinstance(component, dict) and component.keys() <= {"text"}
    )


def details_of_item(item: dict[str, DataTree]) -> ItemDetails:
    """The details of an item object of any version: `{id, count, components}` or with a `tag`."""
    _, components = get(item, "components")
    count = item.get("count", item.get("Count", 1))
    return read_details(components if components is not None else {}, item.get("tag") or {}, count)


def read_details(
    components: DataTree, tag: DataTree, count: object = 1, target: str = "@p"
) -> ItemDetails:
    """The details in an item's components or tag; what cannot be kept stands in `left_out`."""
    left_out: list[str] = []
    if not _TARGET.fullmatch(target):
        left_out.append(f"the player {shown(target)}")
        target = "@p"
    if not isinstance(count, int) or not 1 <= count <= MAX_COUNT:
        left_out.append(f"the count {shown(count)}")
        count = 1
    left_out += _in_block_entity(_mapping(tag))
    known = {**_mapping(components)}
    old = {**_mapping(tag)}
    for entries in (known, old):
        for key in [key for key, value in entries.items() if _is_deep(value)]:
            del entries[key]
            left_out.append(f"{shown(key)}, which is nested over {MAX_DEPTH} deep")
        for key in [key for key, value in entries.items() if holds_expression(value)]:
            del entries[key]
            left_out.append(f"{shown(key)}, which holds an expression")
    name, lore, json_text = _from_components(known)
    if not name and not lore:
        name, lore = _from_tag(old)
    if len(lore) > MAX_LINES:
        left_out.append(f"lines of lore after the {MAX_LINES}th")
    lines = tuple(_checked(line) for line in lore[:MAX_LINES])
    return ItemDetails(
        target, int(count), _checked(name), lines, json_text, known, old, tuple(left_out)
    )


def _mapping(tree: DataTree) -> dict[str, DataTree]:
    return tree if isinstance(tree, dict) else {}


def _from_components(known: dict[str, DataTree]) -> tuple[DataTree, list[DataTree], bool]:
    """Name and lore, taken out of the components with the design; and whether they are JSON."""
    for key in list(known):
        if bare(key) in _DESIGN:
            del known[key]
    name, lore = (_taken(known, key) for key in ("custom_name", "lore"))
    lines = lore if isinstance(lore, list) else [] if lore is None else [lore]
    parsed = [_parsed(line) for line in (name, *lines) if line is not None]
    json_text = any(was_json for _, was_json in parsed)
    texts = [text for text, _ in parsed]
    return ("" if name is None else texts.pop(0)), texts, json_text


def _from_tag(old: dict[str, DataTree]) -> tuple[DataTree, list[DataTree]]:
    """Name and lore, taken out of the tag with the design."""
    old.pop("BlockEntityTag", None)
    display = {**_mapping(old.pop("display", {}))}
    name, lore = display.pop("Name", ""), display.pop("Lore", [])
    if display:
        old["display"] = display
    lines = lore if isinstance(lore, list) else [lore]
    return _parsed(name)[0], [_parsed(line)[0] for line in lines]


_READ = frozenset({"Base", "Patterns", "id", "patterns"})
"""Keys of a banner's block entity that give the design."""


def _in_block_entity(tag: dict[str, DataTree]) -> list[str]:
    """What the block entity in a tag says beside the design."""
    entity = _mapping(tag.get("BlockEntityTag"))
    return [f"BlockEntityTag.{key[:40]}" for key in entity if key not in _READ]


def _taken(entries: dict[str, DataTree], key: str) -> DataTree:
    spelt, value = get(entries, key)
    entries.pop(spelt, None)
    return value


def _parsed(text: DataTree) -> tuple[DataTree, bool]:
    """A text component, and whether it was JSON in a text."""
    if not isinstance(text, str) or text.lstrip()[:1] not in ("{", "[", '"'):
        return text, False
    try:
        tree = json.loads(text)
    except (ValueError, RecursionError):
        return text, False
    return (text, False) if _is_deep(tree) else (tree, True)


def _checked(text: DataTree) -> DataTree:
    """The component; one of characters without a shape is written with escapes, in a compound."""
    return {"text": text} if isinstance(text, str) and not text.isprintable() else text


def _is_deep(tree: DataTree) -> bool:
    level = [tree]
    for _ in range(MAX_DEPTH):
        level = [child for node in level for child in _children(node)]
        if not level:
            return False
    return True


def _children(node: DataTree) -> Iterator[DataTree]:
    if isinstance(node, dict):
        yield from node.values()
    elif isinstance(node, list):
        yield from node
