"""The page of the designer for any static host: `drapery web --designer`."""

import gzip
import json
from collections.abc import Iterable, Iterator, Mapping
from itertools import product
from pathlib import Path

from drapery.banner import Banner, game_titles
from drapery.packs import Packs, open_packs
from drapery.settings import Settings
from drapery.web.bundle import DESIGNER_ENTRY, DESIGNER_PUBLIC, WEB, beside, bundled_module
from drapery.web.page import (
    ARMS,
    FROM_BEHIND,
    FROM_FRONT,
    FROM_LEFT,
    SHIELD,
    banner_files,
    check_package,
    kernel_file,
    posed_player,
    seen_settings,
    write_files,
)
from drapery.web.pattern_words import search_words
from drapery.web.scene_file import scene_bytes, still_player_bytes
from drapery.web.tables import languages

MODULE = "drapery-designer.js"
TYPES = "drapery-designer.d.ts"
BANNER_TYPES = "drapery-banner.d.ts"
PAGE = "index.html"
EARLY = "drapery-early.js"
"""The script of the page that keeps what is dropped or pasted before the module has come."""
WORN_AS = {"cape": FROM_BEHIND, "tabard": FROM_FRONT, SHIELD: FROM_LEFT}
"""How a player in a skin of the user's has the design, and how far it is turned."""


def write_designer(folder: Path, settings: Settings) -> None:
    """Write the page, the module of `<drapery-designer>` with its types, kernels and scenes.

    Raises OutputError, OptionError for what no package shows, and the errors of `scene_bytes`.
    """
    check_package(settings)
    write_files(folder, _files(settings))


def _files(settings: Settings) -> Iterator[tuple[str, bytes]]:
    packs = open_packs(settings.packs, format=settings.format)
    files = designer_files(dict(banner_files(packs, settings)) | dict(wearers(packs, settings)))
    yield from files.items()
    yield from module_files(files)
    yield PAGE, (WEB / "designer.html").read_bytes()
    yield EARLY, (WEB / "designer" / "early.js").read_bytes()


def wearers(packs: Packs, settings: Settings) -> Iterator[tuple[str, bytes]]:
    """The names and contents of scenes of a player with both arms and each of WORN_AS, whose skin
    and design the designer replaces. It loads one of them once a skin is dropped."""
    for (worn, rotation), arms in product(WORN_AS.items(), ARMS):
        player = posed_player(worn, "stand", arms, overlay="whole")
        seen = seen_settings(player, settings, rotation=rotation)
        name = f"wearer-{worn}{'-slim' if arms == 'slim' else ''}.bin"
        if worn == SHIELD:
            yield name, still_player_bytes(player, packs, seen)
        else:
            yield name, scene_bytes(player.with_design(Banner()), packs, seen)


def designer_files(scenes: Mapping[str, bytes]) -> dict[str, bytes]:
    """What the designer loads, by name: these scenes, their kernels, words and languages."""
    files = {**scenes, **kernel_file(scenes)}
    files["words.bin"] = _packed(search_words())
    for code, language in languages().items():
        dyes, patterns = game_titles(language["game"])
        shown = {"texts": language["texts"], "dyes": dyes, "patterns": patterns}
        files[f"{code}.bin"] = _packed(shown)
    return files


def module_files(names: Iterable[str]) -> Iterator[tuple[str, bytes]]:
    """The module of the designer, which loads files of these names beside it, and its types."""
    yield MODULE, bundled_module(DESIGNER_ENTRY, DESIGNER_PUBLIC, beside(names)).encode()
    yield TYPES, (WEB / "designer" / TYPES).read_bytes()
    yield BANNER_TYPES, (WEB / "component" / BANNER_TYPES).read_bytes()


def _packed(tree: object) -> bytes:
    text = json.dumps(tree, ensure_ascii=False, separators=(",", ":"))
    return gzip.compress(text.encode(), mtime=0)
