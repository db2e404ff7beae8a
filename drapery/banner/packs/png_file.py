"""A PNG file that a user names, beside those of packs."""

from pathlib import Path

from drapery.arrays import Texels
from drapery.banner.packs.png import read_png
from drapery.banner.packs.stack import MAX_PNG
from drapery.user_files import read_user_file


def read_png_file(path: Path, name: str) -> Texels:
    """The texels of a PNG file, shape [H, W, 4].

    name: the file's name in errors. Raises OptionError for one that cannot be read or is too
    large, and PackError as `read_png` does.
    """
    remedy, shorter = "give a PNG file", "shrink it"
    return read_png(read_user_file(path, MAX_PNG, name=name, remedy=remedy, shorter=shorter), name)
