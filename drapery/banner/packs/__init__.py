"""Resource packs: folders, zips, jars and packs in memory, over our own art."""

from drapery.banner.packs.stack import Packs, open_packs

__all__ = ["Packs", "open_packs"]
