"""From a picture to the banner that looks most like it.

    from drapery.match import fit_picture, match, read_pixels

    picture = fit_picture(read_pixels("flag.png"))
    best, *others = match(picture.face, weights=picture.weights)
    print(best.banner, best.error)

`Matcher` prepares a stack of packs once for many faces, and `Mural` shows one picture on many
banners. Names are loaded when they are first used.
"""

from typing import TYPE_CHECKING

from drapery.lazy import import_lazily

if TYPE_CHECKING:
    from drapery.match.mural import (
        Mural as Mural,
        check_mural_size as check_mural_size,
        shared_materials as shared_materials,
    )
    from drapery.match.perspective import find_corners as find_corners, flat_face as flat_face
    from drapery.match.photo import match_photo as match_photo
    from drapery.match.picture import (
        FITS as FITS,
        PICTURE_FORMATS as PICTURE_FORMATS,
        WEIGHTINGS as WEIGHTINGS,
        PictureFace as PictureFace,
        decode_pixels as decode_pixels,
        fit_mural as fit_mural,
        fit_picture as fit_picture,
        nearest_dye as nearest_dye,
        read_pixels as read_pixels,
    )
    from drapery.match.search import (
        EFFORT as EFFORT,
        Match as Match,
        Matcher as Matcher,
        MatchProgress as MatchProgress,
        match as match,
    )
    from drapery.match.sheet import matches_sheet as matches_sheet
else:
    import_lazily(__name__)
