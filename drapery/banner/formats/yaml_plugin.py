"""An item of any other plugin in YAML: `type: white_banner` and layers below it in any usual form.

The base dye may also be a value such as `base-color: RED` beside the layers, without an item.
"""

import re

from drapery.banner.design import Banner
from drapery.banner.formats.found import FoundBanner
from drapery.banner.formats.yaml_items import LayerLayout, material, read_list, write_yaml

NAME = "yaml"
TITLE = "item of any other plugin, YAML"
EXAMPLE = """flag:
  type: white_banner
  banner-patterns:
    1:
      type: creeper
      color: lime"""
SOURCE = "https://github.com/Rosewood-Development/RoseGarden"
LAYOUT = LayerLayout(
    "a plugin",
    ("type", "material", "item", "id", "icon", "display-item", "banner"),
    ("banner-patterns", "banner_patterns", "patterns", "layers"),
    ":",
    True,
)
_START = re.compile(
    r"(?:[ \t\r]*(?:#[^\n]*|---)?\n)*[ \t]*(?:- )*['\"]?[\w. -]{1,80}['\"]?:(?:\s|\Z)"
)
_KEY = re.compile(
    r"(?:^[ \t-]*|[{,]\s*)['\"]?[\w-]{0,30}(?:pattern|layer|banner[-_]?meta)[\w-]{0,30}['\"]?:"
    r"(?:\s|\Z)",
    re.IGNORECASE | re.MULTILINE,
)


def recognises(text: str) -> bool:
    """Whether the text begins as YAML, and a line begins with a key of layers."""
    return _START.match(text) is not None and _KEY.search(text) is not None


def read(text: str) -> list[FoundBanner]:
    """All banners of the text. Raises DesignError with the place."""
    return read_list(text, LAYOUT)


def write(banner: Banner) -> str:
    """The item, with its layers by number."""
    tree: dict[str, object] = {"type": material(banner).lower()}
    if banner.kind == "shield":
        tree["base-color"] = banner.base
    layers = {
        number: {"type": layer.pattern, "color": layer.dye}
        for number, layer in enumerate(banner.layers, 1)
    }
    return write_yaml({"flag": tree | {"banner-patterns": layers}})
