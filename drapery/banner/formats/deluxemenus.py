"""An item of DeluxeMenus: `material: RED_BANNER` and `banner_meta: ['LIME;CREEPER']`."""

from drapery.banner.design import Banner
from drapery.banner.formats.found import FoundBanner
from drapery.banner.formats.yaml_items import (
    LayerLayout,
    has_key,
    layer_texts,
    material,
    read_list,
    write_yaml,
)

NAME = "deluxemenus"
TITLE = "item of the plugin DeluxeMenus, YAML"
EXAMPLE = "material: RED_BANNER\nbanner_meta:\n- LIME;CREEPER\n- BLACK;BORDER"
SOURCE = "https://github.com/HelpChat/DeluxeMenus"
LAYOUT = LayerLayout("DeluxeMenus", ("material",), ("banner_meta",), ";", True)


def recognises(text: str) -> bool:
    """Whether a line of the text begins with this plugin's key."""
    return has_key(text, *LAYOUT.layers)


def read(text: str) -> list[FoundBanner]:
    """All banners of the text. Raises DesignError with the place."""
    return read_list(text, LAYOUT)


def write(banner: Banner) -> str:
    """The keys of an item. Raises DesignError for the patterns of data packs."""
    tree = {"material": material(banner)}
    if banner.kind == "shield":
        tree["base_color"] = banner.base.upper()
    return write_yaml(tree | {"banner_meta": layer_texts(banner, LAYOUT)})
