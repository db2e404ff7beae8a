"""A prize of CrazyCrates: `DisplayItem: red_banner` and `DisplayPatterns: ['creeper:lime']`.

The list was called `Patterns`. In a prize's `Items` it is a mapping, `settings.patterns`.
"""

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

NAME = "crazycrates"
TITLE = "prize of the plugin CrazyCrates, YAML"
EXAMPLE = "DisplayItem: red_banner\nDisplayPatterns:\n- creeper:lime\n- border:black"
SOURCE = "https://github.com/Crazy-Crew/CrazyCrates"
LAYOUT = LayerLayout(
    "CrazyCrates",
    ("DisplayItem", "material", "Item"),
    ("DisplayPatterns", "settings.patterns", "Patterns"),
    ":",
    False,
    bukkit=False,
)


def recognises(text: str) -> bool:
    """Whether lines of the text begin with this plugin's keys."""
    if has_key(text, "DisplayPatterns"):
        return True
    lists = "{" not in text and has_key(text, "Patterns", "patterns")
    return lists and has_key(text, *LAYOUT.items)


def read(text: str) -> list[FoundBanner]:
    """All banners of the text. Raises DesignError with the place."""
    return read_list(text, LAYOUT)


def write(banner: Banner) -> str:
    """The keys of a prize. Raises DesignError for shields and the patterns of data packs."""
    if banner.kind != "banner":
        raise DesignError("CrazyCrates gives shields no base: write another form, such as 'give'")
    texts = layer_texts(banner, LAYOUT)
    return write_yaml({"DisplayItem": material(banner).lower(), "DisplayPatterns": texts})
