"""Java 1.20.5 and later: `/give @p minecraft:white_banner[banner_patterns=[…]]`.

Version 1.21.5 changed other components (`tooltip_display`, names as SNBT); they do not affect the
banner, and the grammar reads both spellings.
"""

from collections.abc import Mapping
from types import MappingProxyType

from drapery.banner.design import Banner
from drapery.banner.formats.commands import command_of
from drapery.banner.formats.snbt import write_snbt
from drapery.banner.formats.tree import DataTree, is_banner_id, is_shield_id, names

NAME = "give"
TITLE = "Java 1.20.5+ command or item argument"
EXAMPLE = (
    '/give @p minecraft:white_banner[banner_patterns=[{pattern:"creeper",color:"lime"},'
    '{pattern:"border",color:"black"}]]'
)
SOURCE = "https://minecraft.wiki/w/Data_component_format"


def recognises(text: str) -> bool:
    """Whether the text begins with a command, or with an item's id right before its components."""
    identifier, bracket, _ = text.replace("{", "[", 1).partition("[")
    components_alone = text.lstrip().startswith("[")
    argument = bool(bracket) and _is_item(identifier)
    return argument or components_alone or command_of(text) is not None


def write(banner: Banner) -> str:
    """The command that gives the banner or shield to the nearest player."""
    return f"/give @p {argument(banner)}"


def argument(banner: Banner, more: Mapping[str, DataTree] = MappingProxyType({})) -> str:
    """The item argument: id and components. more: other components of the item."""
    shield = banner.kind == "shield"
    components = [f'base_color="{banner.base}"'] if shield else []
    if banner.layers:
        components.append(f"banner_patterns={write_snbt(names(banner.layers))}")
    components += [_component(name, value) for name, value in more.items()]
    item = "minecraft:shield" if shield else f"minecraft:{banner.base}_banner"
    return f"{item}[{','.join(components)}]" if components else item


def _component(name: str, value: DataTree) -> str:
    """`name=value`, or `!name` of a component that is removed."""
    return name if value is None else f"{name}={write_snbt(value)}"


def _is_item(word: str) -> bool:
    return is_shield_id(word) or is_banner_id(word)
