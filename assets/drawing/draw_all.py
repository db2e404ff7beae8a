"""Draws all our art into a folder: `python -m assets.drawing.draw_all [FOLDER]`, in a checkout."""

import json
import sys
from pathlib import Path

from assets.drawing import banner, shield
from assets.drawing.blocks import BLOCKS
from assets.drawing.canvas import Texels
from assets.drawing.figure import DANCER, TRAVELLER, cape_sheet, figure_sheet
from assets.drawing.png import encode
from drapery.banner.patterns import PATTERN_NAMES
from drapery.errors import DraperyError, OutputError

TEXTURES = "minecraft/textures"

PACK_FORMAT = 34
"""The resource packs of Java 1.21."""


def banner_sheets() -> dict[str, Texels]:
    """The banner's sheets by their path within the textures."""
    sheets = {f"entity/banner/{name}.png": banner.pattern_sheet(name) for name in PATTERN_NAMES}
    return {"entity/banner_base.png": banner.base_sheet(), **sheets}


def shield_sheets() -> dict[str, Texels]:
    """The shield's sheets by their path within the textures."""
    bases = {
        "entity/shield_base.png": shield.base_sheet(),
        "entity/shield_base_nopattern.png": shield.plain_sheet(),
    }
    sheets = {f"entity/shield/{name}.png": shield.shield_sheet(name) for name in PATTERN_NAMES}
    return {**bases, **sheets}


def block_textures() -> dict[str, Texels]:
    """The textures of blocks by their path within the textures."""
    return {f"block/{name}.png": draw() for name, draw in BLOCKS.items()}


def figure_sheets() -> dict[str, Texels]:
    """The skins of the figures in our scenes by their path within the textures."""
    return {
        "entity/player/traveller.png": figure_sheet(TRAVELLER),
        "entity/player/dancer.png": figure_sheet(DANCER),
        "entity/player/cape.png": cape_sheet(),
    }


def all_sheets() -> dict[str, Texels]:
    """Every texture of our art by its path within the textures."""
    return {**banner_sheets(), **shield_sheets(), **block_textures(), **figure_sheets()}


def pack_description() -> str:
    """The text of `pack.mcmeta`."""
    pack = {"pack_format": PACK_FORMAT, "description": "Drapery's own banners, shields and blocks"}
    return json.dumps({"pack": pack}, indent=2) + "\n"


def all_files() -> dict[str, bytes]:
    """Every file of the art by its path in the folder, in a fixed order."""
    pictures = {f"{TEXTURES}/{path}": encode(sheet) for path, sheet in all_sheets().items()}
    return {"pack.mcmeta": pack_description().encode(), **pictures}


def write_art(folder: Path) -> list[Path]:
    """Write every file of the art under `folder`; returns their paths.

    Raises OutputError for a file that cannot be written.
    """
    written = []
    for name, content in all_files().items():
        target = folder / name
        try:
            target.parent.mkdir(parents=True, exist_ok=True)
            target.write_bytes(content)
        except OSError as fault:
            raise OutputError(f"{target}: {fault.strerror}; choose a folder to write in") from fault
        written.append(target)
    return written


def main(arguments: list[str]) -> int:
    """Draw into the folder that the first argument names, or into the checkout's `assets`."""
    folder = Path(arguments[0]) if arguments else Path(__file__).parents[1]
    try:
        written = write_art(folder)
    except DraperyError as fault:
        print(fault, file=sys.stderr)
        return 2
    print(f"{len(written)} files drawn in {folder}")
    return 0


if __name__ == "__main__":
    raise SystemExit(main(sys.argv[1:]))
