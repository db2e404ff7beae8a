"""Java 1.13 to 1.20.4: `white_banner{BlockEntityTag:{Patterns:[{Pattern:"cre",Color:5}]}}`."""

from collections.abc import Mapping
from types import MappingProxyType

from drapery.banner.design import Banner, Layer
from drapery.banner.dyes import DYES
from drapery.banner.formats.give import recognises as is_command
from drapery.banner.formats.snbt import write_snbt
from drapery.banner.formats.tree import DataTree
from drapery.banner.names import shown
from drapery.banner.patterns import PATTERNS
from drapery.errors import DesignError

NAME = "give-legacy"
TITLE = "Java 1.13-1.20.4 command or item argument"
EXAMPLE = (
    "/give @p minecraft:white_banner{BlockEntityTag:{Patterns:["
    '{Pattern:"cre",Color:5},{Pattern:"bo",Color:15}]}}'
)
SOURCE = "https://minecraft.wiki/w/Item_format/Before_1.20.5"


def recognises(text: str) -> bool:
    """Whether the text is a command or an item, with a tag as before 1.20.5."""
    return "BlockEntityTag" in text and is_command(text)


def write(banner: Banner) -> str:
    """The command that gives the banner or shield to the nearest player.

    Raises DesignError for patterns that came after 1.20.4.
    """
    return f"/give @p {argument(banner)}"


def argument(banner: Banner, more: Mapping[str, DataTree] = MappingProxyType({})) -> str:
    """The item argument: id and tag. more: other entries of the tag."""
    layers = legacy_layers(banner.layers, "1.20.4")
    if banner.kind == "shield":
        base = {"Base": DYES[banner.base].number}
        return f"minecraft:shield{write_snbt(tag(base | _patterns(layers)) | dict(more))}"
    whole = (tag(_patterns(layers)) if layers else {}) | dict(more)
    return f"minecraft:{banner.base}_banner" + (write_snbt(whole) if whole else "")


def tag(entity: dict[str, DataTree]) -> dict[str, DataTree]:
    """An item's tag that holds a block entity."""
    return {"BlockEntityTag": entity}


def _patterns(layers: list[DataTree]) -> dict[str, DataTree]:
    return {"Patterns": layers} if layers else {}


def legacy_layers(
    layers: tuple[Layer, ...], version: str, *, inverted: bool = False, lacks: tuple[str, ...] = ()
) -> list[DataTree]:
    """Layers as `[{"Pattern": code, "Color": number}, …]`.

    inverted: numbers count from black. lacks: patterns that the version does not have yet.

    Raises DesignError for patterns without a code in that version.
    """
    return [
        {
            "Pattern": _code(layer, number, version, lacks),
            "Color": 15 - DYES[layer.dye].number if inverted else DYES[layer.dye].number,
        }
        for number, layer in enumerate(layers, 1)
    ]


def _code(layer: Layer, number: int, version: str, lacks: tuple[str, ...]) -> str:
    pattern = PATTERNS.get(layer.pattern)
    if pattern is None or pattern.code is None or layer.pattern in lacks:
        raise DesignError(
            f"layer {number}: Java {version} has no pattern {shown(layer.pattern)};"
            " write the form 'give' or leave the layer out"
        )
    return pattern.code
