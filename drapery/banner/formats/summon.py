"""An entity that holds banners: `/summon item_frame ~ ~ ~ {Item:{id:"minecraft:red_banner"}}`.

Frames, dropped items, armour stands and mobs with a banner, in the spelling of every version.
"""

from drapery.banner.design import Banner
from drapery.banner.formats.commands import command_of
from drapery.banner.formats.item import item_object
from drapery.banner.formats.snbt import write_snbt

NAME = "summon"
TITLE = "a command that summons an entity with banners"
EXAMPLE = (
    '/summon minecraft:item_frame ~ ~ ~ {Item:{id:"minecraft:white_banner",count:1,'
    'components:{"minecraft:banner_patterns":[{pattern:"creeper",color:"lime"}]}}}'
)
SOURCE = "https://minecraft.wiki/w/Commands/summon"


def recognises(text: str) -> bool:
    """Whether the text is a command that makes or changes an entity."""
    return command_of(text) in ("summon", "data", "entitydata")


def write(banner: Banner) -> str:
    """The command that summons a frame holding the banner or shield (1.20.5+)."""
    return f"/summon minecraft:item_frame ~ ~ ~ {write_snbt({'Item': item_object(banner)})}"
