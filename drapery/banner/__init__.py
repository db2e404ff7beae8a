"""Designs of banners, the text and file forms that hold them, and the sheets of their texels.

    from drapery.banner import FLAG_REGIONS, composite, flag_layers, parse_banner, write_banner
    from drapery.packs import open_packs

    banner = parse_banner("white creeper:lime border:black")
    print(write_banner(banner, "give"))
    sheet = composite(flag_layers(banner, open_packs(())))  # uint8 [64, 64, 4]
    front = FLAG_REGIONS["front"].crop(sheet)  # uint8 [40, 20, 4]

Texels are 8-bit sRGB with straight alpha, the top row first. Names are loaded when they are first
used.
"""

from typing import TYPE_CHECKING

from drapery.banner.design import use_parser
from drapery.banner.plain import parse_design
from drapery.lazy import lazy_names

if TYPE_CHECKING:
    from drapery.banner.blazon.writing import alt_text
    from drapery.banner.crafting import CraftingItem, crafting_items
    from drapery.banner.design import LOOM_LAYERS, MAX_LAYERS, Banner, Layer
    from drapery.banner.dyes import DYE_NAMES, DYES, Dye
    from drapery.banner.formats.form import BinaryForm, Form
    from drapery.banner.formats.found import FoundBanner, find_banners
    from drapery.banner.formats.give_details import GIVE_FORMS, not_kept, write_give
    from drapery.banner.formats.item_details import ItemDetails, plain_text
    from drapery.banner.formats.languages import game_languages, game_titles
    from drapery.banner.formats.reading import read_designs
    from drapery.banner.formats.registry import (
        FORMS,
        binary_forms,
        choose_banner,
        parse_banner,
        parse_banners,
        recognise,
        write_banner,
        write_blocks,
    )
    from drapery.banner.formats.studio_link import hidden_layers, pack_link, unpack_link
    from drapery.banner.letters import letter_banners, letter_characters
    from drapery.banner.loom import LoomStep, fits_loom, loom_steps, simplify
    from drapery.banner.names import dye_name, pattern_id
    from drapery.banner.patterns import PATTERN_NAMES, PATTERNS, Pattern
    from drapery.banner.plain import read_design
    from drapery.banner.sprites import (
        FLAG_REGIONS,
        SHIELD_REGIONS,
        SheetRegion,
        composite,
        flag_layers,
        shield_layers,
    )
    from drapery.banner.tables import reader_tables

__all__ = [
    "DYES",
    "DYE_NAMES",
    "FLAG_REGIONS",
    "FORMS",
    "GIVE_FORMS",
    "LOOM_LAYERS",
    "MAX_LAYERS",
    "PATTERNS",
    "PATTERN_NAMES",
    "SHIELD_REGIONS",
    "Banner",
    "BinaryForm",
    "CraftingItem",
    "Dye",
    "Form",
    "FoundBanner",
    "ItemDetails",
    "Layer",
    "LoomStep",
    "Pattern",
    "SheetRegion",
    "alt_text",
    "binary_forms",
    "choose_banner",
    "composite",
    "crafting_items",
    "dye_name",
    "find_banners",
    "fits_loom",
    "flag_layers",
    "game_languages",
    "game_titles",
    "hidden_layers",
    "letter_banners",
    "letter_characters",
    "loom_steps",
    "not_kept",
    "pack_link",
    "parse_banner",
    "parse_banners",
    "pattern_id",
    "plain_text",
    "read_design",
    "read_designs",
    "reader_tables",
    "recognise",
    "shield_layers",
    "simplify",
    "unpack_link",
    "write_banner",
    "write_blocks",
    "write_give",
]

__getattr__, __dir__ = lazy_names(
    __name__,
    {
        "banner.blazon.writing": ("alt_text",),
        "banner.crafting": ("CraftingItem", "crafting_items"),
        "banner.design": ("LOOM_LAYERS", "MAX_LAYERS", "Banner", "Layer"),
        "banner.dyes": ("DYES", "DYE_NAMES", "Dye"),
        "banner.formats.form": ("BinaryForm", "Form"),
        "banner.formats.found": ("FoundBanner", "find_banners"),
        "banner.formats.give_details": ("GIVE_FORMS", "not_kept", "write_give"),
        "banner.formats.item_details": ("ItemDetails", "plain_text"),
        "banner.formats.languages": ("game_languages", "game_titles"),
        "banner.formats.studio_link": ("hidden_layers", "pack_link", "unpack_link"),
        "banner.formats.reading": ("read_designs",),
        "banner.formats.registry": (
            "FORMS",
            "binary_forms",
            "choose_banner",
            "parse_banner",
            "parse_banners",
            "recognise",
            "write_banner",
            "write_blocks",
        ),
        "banner.letters": ("letter_banners", "letter_characters"),
        "banner.loom": ("LoomStep", "fits_loom", "loom_steps", "simplify"),
        "banner.names": ("dye_name", "pattern_id"),
        "banner.patterns": ("PATTERNS", "PATTERN_NAMES", "Pattern"),
        "banner.plain": ("read_design",),
        "banner.sprites": (
            "FLAG_REGIONS",
            "SHIELD_REGIONS",
            "SheetRegion",
            "composite",
            "flag_layers",
            "shield_layers",
        ),
        "banner.tables": ("reader_tables",),
    },
)


use_parser(parse_design)
