"""From a picture to the banner that looks most like it.

    from drapery.match import fit_picture, match, read_picture

    picture = fit_picture(read_picture("flag.png"))
    best, *others = match(picture.face, weights=picture.weights)
    print(best.banner, best.error)

`Matcher` prepares a stack of packs once for many faces, and `Mural` shows one picture on many
banners. Names are loaded when they are first used.
"""

from typing import TYPE_CHECKING

from drapery.lazy import lazy_names

if TYPE_CHECKING:
    from drapery.match.mural import Mural, check_mural_size, shared_materials
    from drapery.match.perspective import find_corners, flat_face
    from drapery.match.photo import match_photo
    from drapery.match.picture import (
        FITS,
        PICTURE_FORMATS,
        WEIGHTINGS,
        PictureFace,
        decode_picture,
        fit_mural,
        fit_picture,
        nearest_dye,
        read_picture,
    )
    from drapery.match.search import EFFORT, Match, Matcher, MatchProgress, match
    from drapery.match.sheet import matches_sheet

__all__ = [
    "EFFORT",
    "FITS",
    "PICTURE_FORMATS",
    "WEIGHTINGS",
    "Match",
    "MatchProgress",
    "Matcher",
    "Mural",
    "PictureFace",
    "check_mural_size",
    "decode_picture",
    "find_corners",
    "fit_mural",
    "fit_picture",
    "flat_face",
    "match",
    "match_photo",
    "matches_sheet",
    "nearest_dye",
    "read_picture",
    "shared_materials",
]

__getattr__, __dir__ = lazy_names(
    __name__,
    {
        "match.mural": ("Mural", "check_mural_size", "shared_materials"),
        "match.perspective": ("find_corners", "flat_face"),
        "match.photo": ("match_photo",),
        "match.picture": (
            "PICTURE_FORMATS",
            "FITS",
            "WEIGHTINGS",
            "PictureFace",
            "decode_picture",
            "fit_mural",
            "fit_picture",
            "nearest_dye",
            "read_picture",
        ),
        "match.search": ("EFFORT", "Match", "MatchProgress", "Matcher", "match"),
        "match.sheet": ("matches_sheet",),
    },
)
