"""An item of CommandPanels: `material: RED_BANNER` and `banner: ['LIME,CREEPER']`."""

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
from drapery.errors import DesignError

NAME = "commandpanels"
TITLE = "item of the plugin CommandPanels, YAML"
EXAMPLE = "material: RED_BANNER\nbanner:\n- lime,creeper\n- black,border"
SOURCE = "https://github.com/rockyhawk64/CommandPanels"
LAYOUT = LayerLayout("CommandPanels", ("material",), ("banner",), ",", True, bukkit=False)


def recognises(text: str) -> bool:
    """Whether lines of the text begin with this plugin's two keys."""
    return has_key(text, *LAYOUT.items) and has_key(text, *LAYOUT.layers)


def read(text: str) -> list[FoundBanner]:
    """All banners of the text. Raises DesignError with the place."""
    return read_list(text, LAYOUT)


def write(banner: Banner) -> str:
    """The keys of an item. Raises DesignError for shields and the patterns of data packs."""
    if banner.kind != "banner":
        raise DesignError("CommandPanels gives shields no base: write another form, such as 'give'")
    return write_yaml({"material": material(banner), "banner": layer_texts(banner, LAYOUT)})
