"""An item of MythicMobs: `Id: red_banner` and `BannerLayers: ['LIME CREEPER']`."""

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

NAME = "mythicmobs"
TITLE = "item of the plugin MythicMobs, YAML"
EXAMPLE = "Banner:\n  Id: red_banner\n  BannerLayers:\n  - LIME CREEPER\n  - BLACK BORDER"
SOURCE = "https://git.mythiccraft.io/mythiccraft/MythicMobs/-/wikis/Items/Banner-Layers"
LAYOUT = LayerLayout("MythicMobs", ("Id",), ("BannerLayers",), " ", True)


def recognises(text: str) -> bool:
    """Whether a line of the text begins with this plugin's key."""
    return has_key(text, *LAYOUT.layers)


def read(text: str) -> list[FoundBanner]:
    """All banners of the text. Raises DesignError with the place."""
    return read_list(text, LAYOUT)


def write(banner: Banner) -> str:
    """The item. Raises DesignError for the patterns of data packs."""
    tree: dict[str, object] = {"Id": material(banner).lower()}
    if banner.kind == "shield":
        tree["Options"] = {"Color": banner.base.upper()}
    return write_yaml({"Banner": tree | {"BannerLayers": layer_texts(banner, LAYOUT)}})
