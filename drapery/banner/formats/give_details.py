"""A `/give` command with what the design does not have: who gets it, how many, name and lore."""

import json
from collections.abc import Callable

from drapery.banner.design import Banner
from drapery.banner.formats import give, give_legacy, give_old
from drapery.banner.formats.item_details import ItemDetails, is_plain, plain_text
from drapery.banner.formats.snbt import write_snbt
from drapery.banner.formats.tree import DataTree
from drapery.banner.names import shown
from drapery.errors import DesignError

GIVE_FORMS = (give.NAME, give_legacy.NAME, give_old.NAME)
"""The forms that `write_give` writes."""


def write_give(banner: Banner, form: str, details: ItemDetails) -> str:
    """The command that gives an item.

    banner: its design.
    form: one of GIVE_FORMS.
    details: what the command says beside the design.

    Raises DesignError for another form, and as its writer.
    """
    count = f" {details.count}" if details.count > 1 else ""
    if form == give.NAME:
        argument = give.argument(banner, _components(details))
        return f"/give {details.target} {argument}{count}"
    if form == give_legacy.NAME:
        argument = give_legacy.argument(banner, _tag(details, _as_json))
        return f"/give {details.target} {argument}{count}"
    if form == give_old.NAME:
        entity = give_old.block_entity(banner)
        tag = write_snbt({"BlockEntityTag": entity} | _tag(details, plain_text))
        return f"/give {details.target} minecraft:banner {details.count} {entity['Base']} {tag}"
    raise DesignError(f"form {shown(form)} is not a give command; use {', '.join(GIVE_FORMS)}")


def not_kept(details: ItemDetails, form: str) -> str:
    """One line that names what a form does not keep of an item's details; "" if it keeps all.

    details: those of the item.
    form: one of GIVE_FORMS.
    """
    lost = [*details.left_out]
    if form not in GIVE_FORMS:
        lost += ["the name"] if details.name else []
        lost += ["the lore"] if details.lore else []
        lost += [f"the count {details.count}"] if details.count != 1 else []
        lost += [f"the player {details.target}"] if details.target != ItemDetails.target else []
    if form == give_old.NAME and not all(map(is_plain, (details.name, *details.lore))):
        lost.append("the looks of name and lore")
    if form != give.NAME:
        lost += map(_named, details.components)
    if form not in (give_legacy.NAME, give_old.NAME):
        lost += map(_named, details.tag)
    more = f" and {len(lost) - _MOST_NAMED} more" if len(lost) > _MOST_NAMED else ""
    named = ", ".join(lost[:_MOST_NAMED]) + more
    return f"the form {shown(form)} does not keep {named}" if lost else ""


_MOST_NAMED = 8


def _named(key: str) -> str:
    return shown(key.removeprefix("minecraft:"), 40)


def _as_json(line: DataTree) -> str:
    tree = {"text": line} if isinstance(line, str) else _json_tree(line)
    return json.dumps(tree, ensure_ascii=False, separators=(",", ":"))


def _json_tree(tree: DataTree) -> DataTree:
    """A tree of SNBT for JSON: `true`, which is a number there, is a truth value here."""
    if isinstance(tree, dict):
        return {key: _json_tree(value) for key, value in tree.items()}
    if isinstance(tree, list):
        return [_json_tree(value) for value in tree]
    is_truth = write_snbt(tree) in ("true", "false", "1b", "0b") and not isinstance(tree, str)
    return bool(tree) if is_truth else tree


def _components(details: ItemDetails) -> dict[str, DataTree]:
    """Components of an item since 1.20.5."""
    as_text: Callable[[DataTree], DataTree] = _as_json if details.json_text else _as_is
    named: dict[str, DataTree] = {"custom_name": as_text(details.name)} if details.name else {}
    named |= {"lore": [as_text(line) for line in details.lore]} if details.lore else {}
    return named | dict(details.components)


def _as_is(line: DataTree) -> DataTree:
    return line


def _tag(details: ItemDetails, as_text: Callable[[DataTree], str]) -> dict[str, DataTree]:
    """The entries of a tag before 1.20.5, with those of `display` for name and lore."""
    entries: dict[str, DataTree] = {"Name": as_text(details.name)} if details.name else {}
    entries |= {"Lore": [as_text(line) for line in details.lore]} if details.lore else {}
    others = dict(details.tag)
    entries |= others.pop("display", {})
    return others | ({"display": entries} if entries else {})
