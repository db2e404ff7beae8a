"""Resource packs: open them, stack them, make them from arrays, and list their contents.

`open_packs` stacks folders, zips, client jars and packs in memory over our own art. The result can
be used wherever a path of a pack can:

    heart = MemoryPack(patterns={"mymod:heart": array})  # uint8 [64, 64, 4], or a mask [64, 64]
    packs = open_packs(["faithful.zip", heart])
    sheet = packs.sheet("mymod:heart")
"""

from drapery.banner.packs import Packs, open_packs
from drapery.banner.packs.contents import PackReport, describe_packs
from drapery.banner.packs.memory import MemoryPack
from drapery.banner.packs.pack import Pack, open_pack
from drapery.banner.packs.png import png_size, read_png
from drapery.banner.packs.sources import PackSource
from drapery.banner.packs.stack import PackLike
from drapery.banner.packs.versions import LAST_MASK_FORMAT, PACK_FORMATS, PackFormat

__all__ = [
    "LAST_MASK_FORMAT",
    "PACK_FORMATS",
    "MemoryPack",
    "Pack",
    "PackFormat",
    "PackLike",
    "PackReport",
    "PackSource",
    "Packs",
    "describe_packs",
    "open_pack",
    "open_packs",
    "png_size",
    "read_png",
]
