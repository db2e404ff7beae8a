"""Java 1.8 to 1.12: `/give @p banner 1 15 {BlockEntityTag:{Base:15,Patterns:[…]}}`.

Dyes count from black (0) to white (15), as the dye items did. The second number is the base dye;
`Base` in the tag takes precedence.
"""

from drapery.banner.design import Banner
from drapery.banner.dyes import DYES
from drapery.banner.formats.commands import command_of
from drapery.banner.formats.give_legacy import legacy_layers
from drapery.banner.formats.snbt import write_snbt
from drapery.banner.formats.tree import DataTree, bare
from drapery.errors import DesignError

NAME = "give-1.12"
TITLE = "Java 1.8-1.12 command, dyes inverted"
EXAMPLE = (
    "/give @p minecraft:banner 1 15 {BlockEntityTag:{Base:15,Patterns:["
    '{Pattern:"cre",Color:10},{Pattern:"bo",Color:0}]}}'
)
SOURCE = "https://minecraft.wiki/w/Item_format/Before_1.20.5"

LACKS = ("globe", "piglin")
"""Patterns with a code that came after 1.12."""


def recognises(text: str) -> bool:
    """Whether one of the first words of a command is the banner's old id."""
    words = text.strip()[:400].split()[:12]
    return any(bare(word) == "banner" for word in words) and (
        command_of(text) is not None or bare(words[0]) == "banner"
    )


def write(banner: Banner) -> str:
    """The command that gives the banner to the nearest player.

    Raises DesignError for shields, since later versions would read their text as their own, and
    for patterns that came after 1.12.
    """
    entity = block_entity(banner)
    return f"/give @p minecraft:banner 1 {entity['Base']} {write_snbt({'BlockEntityTag': entity})}"


def block_entity(banner: Banner) -> dict[str, DataTree]:
    """The block entity: `{"Base": …, "Patterns": […]}`, dyes inverted."""
    if banner.kind != "banner":
        raise DesignError("this form cannot hold shields: write the form 'give' or 'give-legacy'")
    layers = legacy_layers(banner.layers, "1.12", inverted=True, lacks=LACKS)
    return {"Base": 15 - DYES[banner.base].number} | ({"Patterns": layers} if layers else {})
