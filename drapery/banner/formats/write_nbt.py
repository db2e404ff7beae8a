"""Writing binary NBT, by nbtlib: plain trees to bytes, banners to the trees of Java 1.21."""

import gzip
import io
from typing import TYPE_CHECKING, Any, Literal

from drapery.banner.design import Banner
from drapery.banner.formats.tree import DataTree, names
from drapery.errors import DesignError

if TYPE_CHECKING:
    from nbtlib import Base

DATA_VERSION = 3953
"""The version of Java 1.21. Later versions read its banners too."""


def encode(
    tree: dict[str, DataTree], order: Literal["big", "little"] = "big", name: str = ""
) -> bytes:
    """The bytes of a tree; Java's compressed, Bedrock's not. name: of the root.

    Ints are written as TAG_Int and bools as TAG_Byte; nbtlib's own tags are written unchanged.
    """
    from nbtlib import Compound

    raw = io.BytesIO()
    Compound({name: tag(tree)}).write(raw, order)
    # A file is the one entry of a compound, without the tag that would close the compound.
    data = raw.getvalue()[:-1]
    # No time in the header, so that equal trees are equal files.
    return gzip.compress(data, mtime=0) if order == "big" else data


def tag(tree: DataTree) -> "Base":
    """A plain tree as nbtlib's tags."""
    import nbtlib

    if isinstance(tree, nbtlib.Base):
        return tree
    if isinstance(tree, dict):
        return nbtlib.Compound({key: tag(value) for key, value in tree.items()})
    if isinstance(tree, list):
        return nbtlib.List([tag(value) for value in tree])
    kinds: dict[type, Any] = {bool: nbtlib.Byte, int: nbtlib.Int, str: nbtlib.String}
    return kinds[type(tree)](tree)


def block_entity(banner: Banner) -> dict[str, DataTree]:
    """A banner's block entity; the block's id names the base dye."""
    layers = names(banner.layers)
    return {"id": "minecraft:banner"} | ({"patterns": layers} if layers else {})


def placeable(banner: Banner) -> Banner:
    """The same banner. Raises DesignError for a shield, which cannot be placed as a block."""
    if banner.kind == "shield":
        raise DesignError("a shield is not a block; write it as an item, or its design as a banner")
    return banner
