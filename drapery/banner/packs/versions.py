"""The formats of resource packs: one row for each, with the versions of the game that have it.

Numbers count resource-pack formats. From 65 on they have minor numbers, which only add: a pack for
97.0 works in 97.1. Data packs count on their own.

https://minecraft.wiki/w/Pack_format
"""

from dataclasses import dataclass


@dataclass(frozen=True)
class PackFormat:
    """One format.

    number: its major number.
    game: the versions of the game.
    date: when the first of them came out, as YYYY-MM-DD.
    changed: what it changed for banners, shields, players and their packs.
    minor: the highest minor number of these versions.
    """

    number: int
    game: str
    date: str
    changed: str = ""
    minor: int = 0


PACK_FORMATS = (
    PackFormat(1, "1.6 - 1.8", "2013-07-01", "banners since 1.8; their sheets are masks"),
    PackFormat(2, "1.9 - 1.10", "2016-02-29", "shields, with sheets of their own"),
    PackFormat(3, "1.11 - 1.12", "2016-11-14", "names of files in lower case"),
    PackFormat(4, "1.13 - 1.14", "2018-07-18", "`block` and `item` in place of `blocks`, `items`"),
    PackFormat(5, "1.15 - 1.16.1", "2019-12-10", "sheets have an alpha of their own, no masks"),
    PackFormat(6, "1.16.2 - 1.16.5", "2020-08-11"),
    PackFormat(7, "1.17", "2021-06-08"),
    PackFormat(8, "1.18", "2021-11-30"),
    PackFormat(9, "1.19 - 1.19.2", "2022-06-07", "`filter` hides files of lower packs"),
    PackFormat(12, "1.19.3", "2022-12-07", "atlases name the folders of sheets"),
    PackFormat(13, "1.19.4", "2023-03-14", "trims of armour, with palettes"),
    PackFormat(15, "1.20 - 1.20.1", "2023-06-07"),
    PackFormat(18, "1.20.2", "2023-09-21", "overlays; packs for a range of formats"),
    PackFormat(22, "1.20.3 - 1.20.4", "2023-12-05"),
    PackFormat(32, "1.20.5 - 1.20.6", "2024-04-23", "data packs define patterns"),
    PackFormat(34, "1.21 - 1.21.1", "2024-06-13"),
    PackFormat(42, "1.21.2 - 1.21.3", "2024-10-22", "armour and elytra in `entity/equipment`"),
    PackFormat(46, "1.21.4", "2024-12-03"),
    PackFormat(55, "1.21.5", "2025-03-25", "saddles in `entity/equipment`"),
    PackFormat(63, "1.21.6", "2025-06-17", "harnesses of happy ghasts"),
    PackFormat(64, "1.21.7 - 1.21.8", "2025-06-30"),
    PackFormat(69, "1.21.9 - 1.21.10", "2025-09-30", "minor numbers; profiles name textures"),
    PackFormat(75, "1.21.11", "2025-12-09", "saddles and armour of nautiluses"),
    PackFormat(84, "26.1", "2026-03-24", "bases in `entity/banner`, `entity/shield`"),
    PackFormat(88, "26.2", "2026-06-16"),
    PackFormat(97, "26.3", "2026-09-15", "palettes in `palettes`; `trim_overrides`", minor=1),
)
"""All formats that versions of the game have, oldest first. Numbers between were of snapshots."""

NEWEST_FORMAT = PACK_FORMATS[-1].number
"""The newest resource format known here; packs only for newer ones are read as this one."""

NEWEST_DATA_FORMAT = 121
"""The newest format of data packs known here, of the same version."""


def last_before(game: str) -> int:
    """The last format before the one that a version of the game brought."""
    (place,) = (n for n, each in enumerate(PACK_FORMATS) if each.game.split(" - ")[0] == game)
    return PACK_FORMATS[place - 1].number


LAST_MASK_FORMAT = last_before("1.15")
"""The last format whose sheets are masks."""

LAST_RGBA_MASK_FORMAT = last_before("1.13")
"""The last format that reads masks of one mode only: eight bits a channel, with alpha."""

LAST_WITHOUT_MINOR = last_before("1.21.9")
"""The last format before minor numbers, `min_format` and `max_format`."""
