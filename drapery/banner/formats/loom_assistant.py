"""A design of the mod Loom Assistant: `{"banner_color": "white", "layers": [{pattern, color}]}`.

A pack of the mod holds one file for each design; `description` is the name that it shows.
"""

import json

from drapery.banner.design import Banner
from drapery.banner.formats.tree import DataTree, read_layers, under
from drapery.banner.names import dye_name, is_custom
from drapery.errors import DesignError

NAME = "loom-assistant"
TITLE = "JSON of the mod Loom Assistant"
EXAMPLE = (
    '{"description": "Creeper", "banner_color": "white",'
    ' "layers": [{"pattern": "minecraft:creeper", "color": "lime"}]}'
)
SOURCE = "https://github.com/magicus/loom-assistant/blob/main/BANNERPACK.md"


def recognises(text: str) -> bool:
    """Whether the text is JSON with this form's key."""
    return text.lstrip().startswith(("{", "[")) and '"banner_color"' in text


def matches(tree: DataTree) -> bool:
    """Whether a tree is of this form."""
    return isinstance(tree, dict) and "banner_color" in tree


def from_tree(tree: dict[str, DataTree], at: str = "") -> Banner:
    """The banner of the JSON's tree. Raises DesignError naming the place."""
    layers = read_layers(tree.get("layers"), under(at, "layers"))
    return Banner(dye_name(tree["banner_color"], under(at, "banner_color")), layers)


def write(banner: Banner) -> str:
    """The JSON of the design. Raises DesignError for shields."""
    if banner.kind != "banner":
        raise DesignError("Loom Assistant has no shields: write another form, such as 'give'")
    layers = [
        {
            "pattern": layer.pattern if is_custom(layer.pattern) else f"minecraft:{layer.pattern}",
            "color": layer.dye,
        }
        for layer in banner.layers
    ]
    return json.dumps({"description": "Banner", "banner_color": banner.base, "layers": layers})
