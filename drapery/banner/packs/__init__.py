"""Resource packs: folders, zips and jars, stacked over our own art."""

from drapery.banner.packs.stack import Packs, open_packs

__all__ = ["Packs", "open_packs"]
