"""Files of palettes: GIMP's .gpl, and .hex with one colour a line, as Lospec offers them."""

import re
from pathlib import Path

from drapery.errors import OptionError, shown
from drapery.user_files import read_user_file

MAX_BYTES = 1 << 16
"""The longest file [bytes]."""
MAX_COLOURS = 256
"""The most colours of a palette."""

ENDINGS = (".gpl", ".hex")
"""How the names of palettes end."""


def read_palette(path: str | Path) -> tuple[str, ...]:
    """The colours of a .gpl or .hex file, such as `#5a3c1e`.

    Raises OptionError that names the file, the line and the remedy.
    """
    target = Path(path)
    if target.suffix.lower() not in ENDINGS:
        raise OptionError(f"palette {shown(str(path))} is of an unknown type; use .gpl or .hex")
    name, shorter = f"palette {path}", "a palette is shorter"
    data = read_user_file(target, MAX_BYTES, name=name, shorter=shorter)
    lines = data.decode("utf-8-sig", errors="replace").splitlines()
    colours = _gpl(lines, path) if target.suffix.lower() == ".gpl" else _hex(lines, path)
    if not 2 <= len(colours) <= MAX_COLOURS:
        raise OptionError(f"palette {path} has {len(colours)} colours; use 2 to {MAX_COLOURS}")
    return colours


def _gpl(lines: list[str], path: str | Path) -> tuple[str, ...]:
    if not lines or lines[0].strip() != "GIMP Palette":
        raise OptionError(f"palette {path} line 1: it is not 'GIMP Palette'; export it as .gpl")
    colours = []
    for number, line in enumerate(lines[1:], 2):
        if re.match(r"\s*(#|$|(Name|Columns|Channels):)", line):
            continue
        found = re.match(r"\s*(\d{1,3})\s+(\d{1,3})\s+(\d{1,3})(?:\s|$)", line)
        levels = [int(text) for text in found.groups()] if found else [256]
        if max(levels) > 255:
            raise _fault(path, number, line, "three levels from 0 to 255 and a name")
        colours.append(f"#{bytes(levels).hex()}")
    return tuple(colours)


def _hex(lines: list[str], path: str | Path) -> tuple[str, ...]:
    colours = []
    for number, line in enumerate(lines, 1):
        text = line.strip().removeprefix("#")
        if not text:
            continue
        if not re.fullmatch(r"[0-9a-fA-F]{6}", text):
            raise _fault(path, number, line, "six hexadecimal digits such as 5a3c1e")
        colours.append(f"#{text.lower()}")
    return tuple(colours)


def _fault(path: str | Path, number: int, line: str, remedy: str) -> OptionError:
    return OptionError(
        f"palette {path} line {number}: {shown(line.strip())} is not a colour; use {remedy}"
    )
