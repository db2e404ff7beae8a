"""A banner's block entity in SNBT, after the block's id, which names the base dye.

`minecraft:red_banner{patterns:[…]}`. Up to 1.12 the entity had `Base` and no id before it.
"""

from drapery.banner.design import Banner
from drapery.banner.formats import commands, trees
from drapery.banner.formats.found import FoundBanner
from drapery.banner.formats.setblock import write as write_command
from drapery.banner.formats.tree import is_banner_id

NAME = "block-entity"
TITLE = "block entity in SNBT, after its block's id"
EXAMPLE = 'minecraft:red_banner[rotation=8]{patterns:[{pattern:"minecraft:creeper",color:"lime"}]}'
SOURCE = "https://minecraft.wiki/w/Banner"


def recognises(text: str) -> bool:
    """Whether the text is a tree or a block's id with one."""
    identifier, brace, entity = text.strip().partition("{")
    return (
        bool(brace)
        and "atterns:" in entity[:9]
        and (trees.recognises(text) or is_banner_id(identifier))
    )


def read(text: str) -> list[FoundBanner]:
    """The banner of the entity. Raises DesignError if the base dye is missing."""
    return trees.read(text) if trees.recognises(text) else commands.read_command(text)


def write(banner: Banner) -> str:
    """The block's id and its entity (1.20.5+). Raises DesignError for shields."""
    return write_command(banner).removeprefix("/setblock ~ ~ ~ ")
