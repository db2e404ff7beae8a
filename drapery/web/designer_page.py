"""The page of the designer for any static host: `drapery web --designer`."""

import gzip
import json
from collections.abc import Iterator
from pathlib import Path

from drapery.banner import game_titles
from drapery.packs import open_packs
from drapery.settings import Settings
from drapery.web.bundle import DESIGNER_ENTRY, DESIGNER_PUBLIC, WEB, bundled_module
from drapery.web.page import banner_files, check_package, kernel_file, write_files
from drapery.web.pattern_words import search_words
from drapery.web.tables import languages

MODULE = "drapery-designer.js"
PAGE = "index.html"


def write_designer(folder: Path, settings: Settings) -> None:
    """Write the page, the module of `<drapery-designer>` with its types, kernels and scenes.

    Raises OutputError, OptionError for what no package shows, and the errors of `scene_bytes`.
    """
    check_package(settings)
    write_files(folder, _files(settings))


def _files(settings: Settings) -> Iterator[tuple[str, bytes]]:
    packs = open_packs(settings.packs, format=settings.format)
    yield from banner_files(packs, settings)
    yield from kernel_file().items()
    yield "words.bin", _packed(search_words())
    for code, language in languages().items():
        dyes, patterns = game_titles(language["game"])
        shown = {"texts": language["texts"], "dyes": dyes, "patterns": patterns}
        yield f"{code}.bin", _packed(shown)
    yield MODULE, bundled_module(DESIGNER_ENTRY, DESIGNER_PUBLIC).encode()
    yield "drapery-designer.d.ts", (WEB / "designer" / "drapery-designer.d.ts").read_bytes()
    yield PAGE, (WEB / "designer.html").read_bytes()


def _packed(tree: object) -> bytes:
    text = json.dumps(tree, ensure_ascii=False, separators=(",", ":"))
    return gzip.compress(text.encode(), mtime=0)
