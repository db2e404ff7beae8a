"""A banner as a placed block, 1.20.5 and later: `/setblock ~ ~ ~ red_banner[rotation=8]{…}`.

The game copies this form with F3+I. The older spellings are read as well: `Patterns` with codes
and numbers (1.13 to 1.20.4), and `standing_banner 8 replace {Base:…}` (up to 1.12).
"""

from drapery.banner.design import Banner
from drapery.banner.formats.commands import EDITS, command_of
from drapery.banner.formats.snbt import write_snbt
from drapery.banner.formats.tree import names
from drapery.errors import DesignError

NAME = "setblock"
TITLE = "a placed block's command or argument"
EXAMPLE = (
    "/setblock ~ ~ ~ minecraft:red_wall_banner[facing=north]"
    '{patterns:[{pattern:"minecraft:creeper",color:"lime"}]}'
)
SOURCE = "https://minecraft.wiki/w/Commands/setblock"


def recognises(text: str) -> bool:
    """Whether the text is a command that places blocks."""
    return command_of(text) in ("setblock", "fill", *EDITS)


def write(banner: Banner) -> str:
    """The command that places the banner, standing. Raises DesignError for shields."""
    if banner.kind != "banner":
        raise DesignError("a shield is not a block and cannot be placed: write the form 'give'")
    entity = write_snbt({"patterns": names(banner.layers)}) if banner.layers else ""
    # The rotation that a block has by default went from 0 to 8 in 26.1.
    return f"/setblock ~ ~ ~ minecraft:{banner.base}_banner[rotation=0]{entity}"
