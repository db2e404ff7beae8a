"""An item object: `{id:"minecraft:red_banner",count:1,components:{…}}`.

This is how chests, saves and `/data get` hold items. Before 1.20.5 they had `Count` and `tag`.
"""

from drapery.banner.design import Banner
from drapery.banner.formats.snbt import write_snbt
from drapery.banner.formats.tree import DataTree, names
from drapery.banner.formats.trees import recognises as is_tree

NAME = "item"
TITLE = "item object in SNBT or JSON"
EXAMPLE = (
    '{id:"minecraft:white_banner",count:1,components:{"minecraft:banner_patterns":'
    '[{pattern:{asset_id:"acme:anvil",translation_key:"pattern.acme.anvil"},color:"red"}]}}'
)
SOURCE = "https://minecraft.wiki/w/Item_format"


def recognises(text: str) -> bool:
    """Whether the text is a tree. The forms of other trees are tried before this one."""
    return is_tree(text)


def write(banner: Banner) -> str:
    """The item object (1.20.5+)."""
    return write_snbt(item_object(banner))


def item_object(banner: Banner) -> dict[str, DataTree]:
    """The item object as a tree."""
    components: dict[str, DataTree] = {}
    if banner.layers:
        components["minecraft:banner_patterns"] = names(banner.layers)
    if banner.kind == "shield":
        components["minecraft:base_color"] = banner.base
    identifier = "shield" if banner.kind == "shield" else f"{banner.base}_banner"
    return {"id": f"minecraft:{identifier}", "count": 1} | (
        {"components": components} if components else {}
    )
