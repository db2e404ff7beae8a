"""Banners on a wall that show one picture together: as a picture, a function, and a schematic."""

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np

from drapery.banner import Banner, CraftingItem, crafting_items
from drapery.banner.formats.block_box import AIR, BlockBox
from drapery.banner.formats.snbt import write_snbt
from drapery.banner.formats.tree import names
from drapery.banner.packs import Packs
from drapery.errors import OptionError, counted
from drapery.match.art import HEIGHT, WIDTH
from drapery.match.picture import PITCH
from drapery.pictures import face_pixels
from drapery.render import Frame

MAX_BANNERS = 1024

WALL = "minecraft:spruce_planks"
"""The block behind each banner."""


@dataclass(frozen=True)
class Mural:
    """Banners on a wall, seen from the south.

    across: banners in a row.
    down: rows.
    banners: row by row from the top.

    Raises OptionError for another number of banners.
    """

    across: int
    down: int
    banners: tuple[Banner, ...]

    def __post_init__(self) -> None:
        check_mural_size(self.across, self.down)
        if len(self.banners) != self.across * self.down:
            raise OptionError(
                f"{counted(len(self.banners), 'banner')} cannot fill {self.across} x {self.down}"
            )

    def picture(self, packs: Packs, *, scale: int = 4) -> Frame:
        """The plain faces as they hang.

        packs: resource packs, see `drapery.packs.open_packs`.
        scale: pixels for each texel.

        Raises PackError for a texture that cannot be used.
        """
        size = (self.down - 1) * PITCH[1] + HEIGHT, (self.across - 1) * PITCH[0] + WIDTH
        pixels = np.zeros((size[0] * scale, size[1] * scale, 4), np.uint8)
        for number, banner in enumerate(self.banners):
            row, column = divmod(number, self.across)
            y, x = row * PITCH[1] * scale, column * PITCH[0] * scale
            face = face_pixels(banner, packs, scale)
            pixels[y : y + HEIGHT * scale, x : x + WIDTH * scale] = face
        return Frame(pixels)

    def function(self) -> str:
        """The commands of a function that builds it, from its lower left corner to the east."""
        lines = []
        for (x, y), banner in zip(self._places(), self.banners, strict=True):
            entity = write_snbt({"patterns": names(banner.layers)}) if banner.layers else ""
            lines.append(f"setblock ~{x} ~{y} ~ {WALL}")
            lines.append(f"setblock ~{x} ~{y} ~1 {_block(banner)}{entity}")
        return "\n".join(lines) + "\n"

    def schematic(self, form: Literal["schem", "schem3", "litematic"] = "schem") -> bytes:
        """The file of the wall with the banners in front of it, in a form of schematics.

        form: `schem` is Sponge's version 2, `schem3` its version 3.
        """
        from drapery.banner.formats.binary import BOX_WRITERS

        return BOX_WRITERS[form](self._build())

    def _build(self) -> BlockBox:
        """The wall at the north, and the banners at its south."""
        states = [AIR, WALL, *dict.fromkeys(map(_block, self.banners))]
        blocks = np.zeros((2 * self.down, 2, self.across), np.int64)
        banners = {}
        for (x, y), banner in zip(self._places(), self.banners, strict=True):
            blocks[y, 0, x], blocks[y, 1, x] = 1, states.index(_block(banner))
            banners[x, y, 1] = banner
        return BlockBox(tuple(states), blocks, banners)

    def materials(self) -> tuple[CraftingItem, ...]:
        """All that the banners take to make by hand; each pattern item is made once."""
        return shared_materials(self.banners)

    def _places(self) -> list[tuple[int, int]]:
        """East and up of each banner's block from the lower left corner [blocks]."""
        rows = range(2 * self.down - 1, 0, -2)
        return [(x, y) for y in rows for x in range(self.across)]


def check_mural_size(across: int, down: int) -> None:
    """Check how many banners a mural has.

    across: banners in a row.
    down: rows.

    Raises OptionError for more than a mural may have, or none.
    """
    if across < 1 or down < 1 or across * down > MAX_BANNERS:
        raise OptionError(
            f"a mural has 1 to {MAX_BANNERS} banners, not {across} x {down}; change its size"
        )


def shared_materials(banners: Sequence[Banner]) -> tuple[CraftingItem, ...]:
    """What banners take together; a pattern item and the loom are used for all of them."""
    every = [item for banner in banners for item in crafting_items(banner)]
    spent = ("wool", "stick", "dye", "shield")
    counts: Counter[str] = Counter()
    for item in every:
        if item.item.split("_")[-1] in spent:
            counts[item.item] += item.count
    once = {item.item: item for item in every if item.item not in counts}
    made = sum(item.source.startswith("crafted") for item in once.values())
    if "paper" in once:
        once["paper"] = CraftingItem("paper", made)
    return (*(CraftingItem(name, count) for name, count in counts.items()), *once.values())


def _block(banner: Banner) -> str:
    return f"minecraft:{banner.base}_wall_banner[facing=south]"
