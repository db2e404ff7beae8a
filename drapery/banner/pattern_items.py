"""The pattern items that the loom needs beside a dye: which, where from, and since which version.

Recipes, trades and chests are those of Java Edition 26.1. `since` comes from the lists of items of
every version in https://github.com/PrismarineJS/minecraft-data.
"""

from dataclasses import dataclass


@dataclass(frozen=True)
class PatternItem:
    """An item that the loom needs for one pattern, and keeps.

    item: its id without `minecraft:`. ingredient: what it is crafted from beside paper, None if it
    cannot be crafted. found: where it comes from then. since: the version of Java Edition that
    added it. always: whether the loom has always needed it; otherwise older looms need no item.
    """

    item: str
    since: str
    ingredient: str | None = None
    found: str = ""
    always: bool = True

    @property
    def source(self) -> str:
        """Where the item comes from, in words."""
        if self.ingredient is None:
            return self.found
        words = f"crafted from paper and {self.ingredient}"
        return words if self.always else f"{words}; not needed before {self.since}"


PATTERN_ITEMS: dict[str, PatternItem] = {
    "creeper": PatternItem("creeper_banner_pattern", "1.14", "creeper_head"),
    "skull": PatternItem("skull_banner_pattern", "1.14", "wither_skeleton_skull"),
    "flower": PatternItem("flower_banner_pattern", "1.14", "oxeye_daisy"),
    "mojang": PatternItem("mojang_banner_pattern", "1.14", "enchanted_golden_apple"),
    "globe": PatternItem(
        "globe_banner_pattern", "1.14", found="a master cartographer sells it for 8 emeralds"
    ),
    "piglin": PatternItem(
        "piglin_banner_pattern", "1.16", found="it is in chests of bastion remnants"
    ),
    "flow": PatternItem(
        "flow_banner_pattern", "1.20.5", found="it is in ominous vaults of trial chambers"
    ),
    "guster": PatternItem(
        "guster_banner_pattern", "1.20.5", found="it is in vaults of trial chambers"
    ),
    "bricks": PatternItem("field_masoned_banner_pattern", "1.21.2", "bricks", always=False),
    "curly_border": PatternItem("bordure_indented_banner_pattern", "1.21.2", "vine", always=False),
}
"""The pattern item of each pattern that needs one, by the pattern's id."""
