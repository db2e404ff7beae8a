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
from drapery.lazy import import_lazily

if TYPE_CHECKING:
    from drapery.banner.blazon.writing import alt_text as alt_text
    from drapery.banner.crafting import (
        CraftingItem as CraftingItem,
        crafting_items as crafting_items,
    )
    from drapery.banner.design import (
        LOOM_LAYERS as LOOM_LAYERS,
        MAX_LAYERS as MAX_LAYERS,
        Banner as Banner,
        Layer as Layer,
    )
    from drapery.banner.dyes import DYE_NAMES as DYE_NAMES, DYES as DYES, Dye as Dye
    from drapery.banner.formats.form import BinaryForm as BinaryForm, Form as Form
    from drapery.banner.formats.found import (
        FoundBanner as FoundBanner,
        find_banners as find_banners,
    )
    from drapery.banner.formats.give_details import (
        GIVE_FORMS as GIVE_FORMS,
        not_kept as not_kept,
        write_give as write_give,
    )
    from drapery.banner.formats.item_details import (
        ItemDetails as ItemDetails,
        plain_text as plain_text,
    )
    from drapery.banner.formats.languages import (
        game_languages as game_languages,
        game_titles as game_titles,
    )
    from drapery.banner.formats.reading import read_designs as read_designs
    from drapery.banner.formats.registry import (
        FORMS as FORMS,
        binary_forms as binary_forms,
        choose_banner as choose_banner,
        parse_banner as parse_banner,
        parse_banners as parse_banners,
        recognise as recognise,
        write_banner as write_banner,
        write_blocks as write_blocks,
    )
    from drapery.banner.formats.studio_link import (
        hidden_layers as hidden_layers,
        pack_link as pack_link,
        unpack_link as unpack_link,
    )
    from drapery.banner.letters import (
        letter_banners as letter_banners,
        letter_characters as letter_characters,
    )
    from drapery.banner.loom import (
        LoomStep as LoomStep,
        fits_loom as fits_loom,
        loom_steps as loom_steps,
        simplify as simplify,
    )
    from drapery.banner.names import dye_name as dye_name, pattern_id as pattern_id
    from drapery.banner.patterns import (
        PATTERN_NAMES as PATTERN_NAMES,
        PATTERNS as PATTERNS,
        Pattern as Pattern,
    )
    from drapery.banner.plain import read_design as read_design
    from drapery.banner.sprites import (
        FLAG_REGIONS as FLAG_REGIONS,
        SHIELD_REGIONS as SHIELD_REGIONS,
        SheetRegion as SheetRegion,
        composite as composite,
        flag_layers as flag_layers,
        shield_layers as shield_layers,
    )
    from drapery.banner.tables import reader_tables as reader_tables
else:
    import_lazily(__name__)


use_parser(parse_design)
