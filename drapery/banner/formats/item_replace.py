"""A banner put in a slot: `/item replace entity @s armor.head with red_banner[…]`.

The older `/replaceitem entity @s slot.armor.head banner 1 15 {…}` is read as well.
"""

from drapery.banner.design import Banner
from drapery.banner.formats.commands import command_of
from drapery.banner.formats.give import argument

NAME = "item-replace"
TITLE = "a command that puts an item in a slot"
EXAMPLE = (
    "/item replace entity @s armor.head with minecraft:white_banner"
    '[banner_patterns=[{pattern:"creeper",color:"lime"}]]'
)
SOURCE = "https://minecraft.wiki/w/Commands/item"


def recognises(text: str) -> bool:
    """Whether the text is a command that fills slots."""
    return command_of(text) in ("item", "replaceitem")


def write(banner: Banner) -> str:
    """The command that puts the banner or shield on the player's head (1.20.5+)."""
    return f"/item replace entity @s armor.head with {argument(banner)}"
