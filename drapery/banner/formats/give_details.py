"""A `/give` command with what the design does not have: who gets it, how many, name and lore.

Names and lore are text components, whose form depends on the version of Java Edition: SNBT since
1.21.5, JSON from 1.13 on, plain text before that (https://minecraft.wiki/w/Text_component_format).
"""

import json
import re
from collections.abc import Callable
from dataclasses import dataclass

from drapery.banner.design import Banner
from drapery.banner.formats import give, give_legacy, give_old
from drapery.banner.formats.snbt import write_snbt
from drapery.banner.formats.tree import DataTree
from drapery.banner.names import shown
from drapery.errors import DesignError

GIVE_FORMS = (give.NAME, give_legacy.NAME, give_old.NAME)
"""The forms that `write_give` writes."""
MAX_COUNT = 1600
"""The most items of one command: a hundred stacks of sixteen."""
MAX_LINES = 256
"""The most lines of lore that the game keeps."""

_TARGET = re.compile(r"@[aenprs](\[[^\n]{0,200}\])?|[\w-]{1,36}", re.ASCII)


@dataclass(frozen=True)
class ItemDetails:
    """What a command says beside the design. Raises DesignError.

    target: a selector such as `@a[distance=..5]`, or the name of a player. count: how many items.
    name: the item's custom name. lore: the lines below it. json_text: write name and lore as JSON,
    as Java Edition 1.20.5 to 1.21.4 reads them; it applies only to the form `give`.
    """

    target: str = "@p"
    count: int = 1
    name: str = ""
    lore: tuple[str, ...] = ()
    json_text: bool = False

    def __post_init__(self) -> None:
        if not _TARGET.fullmatch(self.target):
            raise DesignError(
                f"{shown(self.target)} is not a player; write @p, @a, @s, a selector or a name"
            )
        if not 1 <= self.count <= MAX_COUNT:
            raise DesignError(f"{self.count} items cannot be given; use 1 to {MAX_COUNT}")
        if len(self.lore) > MAX_LINES:
            raise DesignError(f"lore has {len(self.lore)} lines; use at most {MAX_LINES}")
        if not all(line.isprintable() for line in (self.name, *self.lore)):
            raise DesignError("name and lore have characters without a shape; leave them out")


def write_give(banner: Banner, form: str, details: ItemDetails) -> str:
    """The command in one of GIVE_FORMS. Raises DesignError for another form, and as its writer."""
    count = f" {details.count}" if details.count > 1 else ""
    if form == give.NAME:
        argument = give.argument(banner, _components(details))
        return f"/give {details.target} {argument}{count}"
    if form == give_legacy.NAME:
        argument = give_legacy.argument(banner, _display(details, _as_json))
        return f"/give {details.target} {argument}{count}"
    if form == give_old.NAME:
        entity = give_old.block_entity(banner)
        tag = write_snbt({"BlockEntityTag": entity} | _display(details, str))
        return f"/give {details.target} minecraft:banner {details.count} {entity['Base']} {tag}"
    raise DesignError(f"form {shown(form)} is not a give command; use {', '.join(GIVE_FORMS)}")


def _as_json(line: str) -> str:
    return json.dumps({"text": line}, ensure_ascii=False, separators=(",", ":"))


def _components(details: ItemDetails) -> dict[str, DataTree]:
    """Components of an item since 1.20.5."""
    as_text = _as_json if details.json_text else str
    named: dict[str, DataTree] = {"custom_name": as_text(details.name)} if details.name else {}
    return named | ({"lore": [as_text(line) for line in details.lore]} if details.lore else {})


def _display(details: ItemDetails, as_text: Callable[[str], str]) -> dict[str, DataTree]:
    """The tag's entry for name and lore before 1.20.5."""
    entries: dict[str, DataTree] = {"Name": as_text(details.name)} if details.name else {}
    entries |= {"Lore": [as_text(line) for line in details.lore]} if details.lore else {}
    return {"display": entries} if entries else {}
