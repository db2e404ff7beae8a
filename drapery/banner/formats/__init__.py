"""The text and file forms of a banner, one module for each form."""

from drapery.banner.formats.found import FoundBanner, find_banners
from drapery.banner.formats.reading import read_designs
from drapery.banner.formats.registry import (
    FORMS,
    parse_banner,
    parse_banners,
    recognise,
    write_banner,
)

__all__ = [
    "FORMS",
    "FoundBanner",
    "find_banners",
    "parse_banner",
    "parse_banners",
    "read_designs",
    "recognise",
    "write_banner",
]
