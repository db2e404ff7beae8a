"""What a design takes to make by hand: wool, dyes, a stick, and pattern items, with counts.

Banners are made as https://minecraft.wiki/w/Banner tells, of Java Edition 26.1; pattern items stand
in `drapery.banner.pattern_items`.
"""

from collections import Counter
from dataclasses import dataclass

from drapery.banner.design import Banner
from drapery.banner.pattern_items import PATTERN_ITEMS

_WOOL = 6


@dataclass(frozen=True)
class CraftingItem:
    """An item that a design takes.

    item: its id without `minecraft:`.
    count: how many.
    consumed: whether it is used up; a pattern item is not.
    source: where an item that cannot be crafted comes from, or what a pattern item is crafted from.
    """

    item: str
    count: int
    consumed: bool = True
    source: str = ""


def crafting_items(banner: Banner) -> tuple[CraftingItem, ...]:
    """All that a banner or a shield takes, from wool to pattern items.

    Dyes are counted for all layers, also beyond the six of a loom: ask `fits_loom`. Pattern items
    stand after their paper and what they are crafted from. A pattern of a data pack takes its dye.
    """
    items = [CraftingItem(f"{banner.base}_wool", _WOOL), CraftingItem("stick", 1)]
    if banner.kind == "shield":
        items.append(CraftingItem("shield", 1))
    dyes = Counter(layer.dye for layer in banner.layers)
    items += [CraftingItem(f"{dye}_dye", count) for dye, count in dyes.items()]
    patterns = dict.fromkeys(layer.pattern for layer in banner.layers)
    needed = [PATTERN_ITEMS[pattern] for pattern in patterns if pattern in PATTERN_ITEMS]
    ingredients = [one.ingredient for one in needed if one.ingredient]
    if ingredients:
        items.append(CraftingItem("paper", len(ingredients)))
    items += [CraftingItem(ingredient, 1) for ingredient in ingredients]
    items += [CraftingItem(one.item, 1, consumed=False, source=one.source) for one in needed]
    return (*items, *([CraftingItem("loom", 1, consumed=False)] if banner.layers else []))
