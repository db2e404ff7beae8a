"""A PNG file that a user names, beside those of packs."""

from pathlib import Path

from drapery.banner.packs.checks import reason
from drapery.banner.packs.png import Texels, read_png
from drapery.banner.packs.stack import MAX_PNG
from drapery.errors import OptionError


def read_png_file(path: Path, name: str) -> Texels:
    """The texels of a PNG file, shape [H, W, 4].

    name: the file's name in errors. Raises OptionError for one that cannot be read or is too
    large, and PackError as `read_png` does.
    """
    try:
        with path.open("rb") as file:
            data = file.read(MAX_PNG + 1)
    except (OSError, ValueError) as error:
        raise OptionError(f"{name} cannot be read ({reason(error)}); give a PNG file") from error
    if len(data) > MAX_PNG:
        raise OptionError(f"{name} is over {MAX_PNG} bytes; shrink it")
    return read_png(data, name)
