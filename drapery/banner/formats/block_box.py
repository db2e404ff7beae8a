"""A box of blocks with banners: what files of blocks are written from."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from drapery.banner.design import Banner
from drapery.banner.formats.blocks import Spot
from drapery.banner.formats.write_nbt import placeable
from drapery.errors import DesignError

AIR = "minecraft:air"
MAX_SIDE = 0x7FFF
"""The longest side of a schematic [blocks]."""


@dataclass(frozen=True, eq=False)
class BlockBox:
    """Blocks that fill a box.

    states: the palette, such as `minecraft:red_banner[rotation=0]`; air comes first, which readers
    of schematics expect. blocks: numbers of states, shape [height, length, width], int64.
    banners: by their places x, y, z from the lowest corner.
    """

    states: tuple[str, ...]
    blocks: NDArray[np.int64]
    banners: dict[Spot, Banner]

    @property
    def size(self) -> Spot:
        """Width, height and length [blocks]."""
        height, length, width = self.blocks.shape
        return width, height, length


def row_of(banners: Sequence[Banner]) -> BlockBox:
    """Standing banners in a row to the east, to read from the south.

    Raises DesignError for shields, which are not blocks, and for over MAX_SIDE banners.
    """
    if len(banners) > MAX_SIDE:
        raise DesignError(f"{len(banners)} banners do not fit in a schematic; write fewer at once")
    blocks = [f"minecraft:{placeable(banner).base}_banner[rotation=0]" for banner in banners]
    states = (AIR, *dict.fromkeys(blocks))
    numbers = np.array([[[states.index(block) for block in blocks]]], np.int64)
    return BlockBox(states, numbers, {(x, 0, 0): banner for x, banner in enumerate(banners)})


def state_tree(state: str) -> dict[str, str | dict[str, str]]:
    """A state as palettes of the game have it, `Name` and `Properties`."""
    name, _, rest = state.rstrip("]").partition("[")
    if not rest:
        return {"Name": name}
    return {"Name": name, "Properties": dict(each.split("=", 1) for each in rest.split(","))}
