"""The quick way to pass: a picture of Pillow or a file beside its golden, without numpy.

Most goldens of most runs pass. What does not pass here is checked by `drapery.testing.check`.
"""

import sys
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING, Any

from drapery.comparison import measure_files
from drapery.errors import DraperyError
from drapery.testing.naming import approved_paths

if TYPE_CHECKING:
    from PIL.Image import Image

    from drapery.comparison import Tolerance


def passes(path: Path, source: Any, tolerance: "Tolerance") -> bool:
    """Whether a picture agrees with its golden or with another approved picture.

    path: of the golden. source: what the fixture `golden` takes. False says nothing: the picture
    is of another kind, differs, or cannot be read.
    """
    picture = _picture(source)
    if picture is None or path.suffix != ".png":
        return False
    try:
        for approved in approved_paths(path):
            difference = measure_files(approved, picture, tolerance)
            if difference is None:
                return False
            if difference.agrees:
                return True
    except DraperyError:
        return False  # in words, with the file and the remedy, by the usual check
    return False


def _picture(source: Any) -> "Path | Image | None":
    if isinstance(source, (str, PathLike)):
        return Path(source)
    pillow = sys.modules.get("PIL.Image")  # not loaded, there is no picture of it
    return source if pillow is not None and isinstance(source, pillow.Image) else None
