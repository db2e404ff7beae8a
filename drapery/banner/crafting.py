"""What a design takes to make by hand: wool, dyes, a stick, and pattern items, with counts.

The recipes are those of https://minecraft.wiki/w/Banner and https://minecraft.wiki/w/Banner_Pattern,
Java Edition 1.21.
"""

from collections import Counter
from dataclasses import dataclass

from drapery.banner.design import Banner

_CRAFTED = {
    "creeper": ("creeper_banner_pattern", "creeper_head"),
    "skull": ("skull_banner_pattern", "wither_skeleton_skull"),
    "flower": ("flower_banner_pattern", "oxeye_daisy"),
    "mojang": ("mojang_banner_pattern", "enchanted_golden_apple"),
    "bricks": ("field_masoned_banner_pattern", "bricks"),
    "curly_border": ("bordure_indented_banner_pattern", "vine"),
}
"""The pattern item of a pattern, and what it is crafted from beside paper."""

_FOUND = {
    "globe": ("globe_banner_pattern", "a cartographer sells it"),
    "piglin": ("piglin_banner_pattern", "it is in chests of bastion remnants"),
    "flow": ("flow_banner_pattern", "it is in vaults of trial chambers"),
    "guster": ("guster_banner_pattern", "it is in vaults of trial chambers"),
}
"""The pattern item of a pattern, and where it is found."""

_WOOL = 6


@dataclass(frozen=True)
class CraftingItem:
    """An item that a design takes.

    item: its id without `minecraft:`. count: how many. consumed: whether it is used up; a pattern
    item is not. source: where an item that cannot be crafted comes from, or what a pattern item is
    crafted from.
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
    crafted = [_CRAFTED[pattern] for pattern in patterns if pattern in _CRAFTED]
    if crafted:
        items.append(CraftingItem("paper", len(crafted)))
    items += [CraftingItem(part, 1) for _, part in crafted]
    items += [CraftingItem(i, 1, False, f"crafted from paper and {part}") for i, part in crafted]
    found = [_FOUND[pattern] for pattern in patterns if pattern in _FOUND]
    items += [CraftingItem(item, 1, False, source) for item, source in found]
    return (*items, *([CraftingItem("loom", 1, False)] if banner.layers else []))
