"""`drapery match`: the banners that look most like a picture."""

import json
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, Literal

import typer

from drapery.commands import options as o
from drapery.commands.notices import progress, say
from drapery.commands.options import is_given
from drapery.errors import counted

if TYPE_CHECKING:
    from drapery.arrays import Texels
    from drapery.match import Match, Matcher, Mural, PictureFace
    from drapery.packs import Packs

MURAL_EFFORT = 8
"""The effort for each banner of a mural, unless one is given."""

MURAL_ENDINGS = (".schem", ".litematic", ".mcfunction")

NOT_FOR_MURALS = ("alternatives", "mask", "weighting", "photo", "corners", "as_json")
NOT_FOR_PHOTOS = ("effort", "fit", "crop", "background", "mask", "weighting")
"""Parameters of the command that murals and photos do not use."""

PictureArgument = Annotated[
    Path, typer.Argument(metavar="PICTURE", help="A PNG, JPEG or WebP file.")
]
OutOption = Annotated[
    list[Path] | None,
    typer.Option(
        "-o",
        "--out",
        metavar="FILE",
        help="The picture beside the banners, or a page. With --mural: a picture,"
        " .mcfunction, .schem or .litematic; several files may be given.",
    ),
]
LayersOption = Annotated[
    int, typer.Option(metavar="N", help="The most layers (0 to 16); the loom makes 6.")
]
AlternativesOption = Annotated[int, typer.Option(metavar="N", help="The most designs (1 to 64).")]
EffortOption = Annotated[
    int | None,
    typer.Option(metavar="N", help="How many attempts are made to improve the designs."),
]
FitOption = Annotated[
    Literal["cover", "contain", "stretch"],
    typer.Option(help="How a picture of another shape is fitted to the banner."),
]
CropOption = Annotated[
    str | None,
    typer.Option(metavar="L,T,R,B", help="The part of the picture to use, in pixels."),
]
BackgroundOption = Annotated[
    str,
    typer.Option(metavar="COLOUR", help="Behind transparent pixels; transparent ignores them."),
]
MaskOption = Annotated[
    Path | None,
    typer.Option(metavar="FILE", help="A picture that is bright where pixels count."),
]
WeightingOption = Annotated[
    Literal["even", "centre", "edges", "rare"],
    typer.Option(
        "--weights",
        help="Which part of the picture counts most: its centre, edges, or rare colours.",
    ),
]
MuralOption = Annotated[
    str | None,
    typer.Option(metavar="WxH", help="Show the picture on a grid of banners, such as 4x3."),
]
PhotoOption = Annotated[
    bool,
    typer.Option("--photo", help="The picture is a photo of a banner in front of one colour."),
]
CornersOption = Annotated[
    tuple[str, str, str, str] | None,
    typer.Option(
        metavar="X,Y X,Y X,Y X,Y",
        help="The flag's corners in a photo, in pixels: upper left, upper right, lower right,"
        " lower left.",
    ),
]
FormOption = Annotated[
    str | None,
    typer.Option(
        "--as",
        metavar="FORM",
        help="Print the best design as give, json, ... With --mural: schem or schem3, the version"
        " of a .schem file.",
    ),
]
JsonOption = Annotated[
    bool, typer.Option("--json", help="Print the designs and their errors as JSON.")
]


def run(
    context: typer.Context,
    picture: PictureArgument,
    out: OutOption = None,
    layers: LayersOption = 6,
    alternatives: AlternativesOption = 5,
    effort: EffortOption = None,
    fit: FitOption = "cover",
    crop: CropOption = None,
    background: BackgroundOption = "transparent",
    mask: MaskOption = None,
    weighting: WeightingOption = "even",
    mural: MuralOption = None,
    photo: PhotoOption = False,
    corners: CornersOption = None,
    written: FormOption = None,
    as_json: JsonOption = False,
    packs: o.PackOption = None,
    format: o.FormatOption = None,
) -> None:
    """Find the banners that look most like a picture.

    Ctrl-C keeps the best that were found, except for a photo.
    """
    from drapery.match import read_pixels
    from drapery.packs import open_packs

    is_photo = photo or corners is not None
    if mural is not None:
        _refuse(context, NOT_FOR_MURALS, "a mural")
        _check_version(written, out or [])
    elif is_photo:
        _refuse(context, NOT_FOR_PHOTOS, "a photo")
    size = None if mural is None else _checked_size(mural)
    _check_targets(out or [], is_mural=size is not None)
    opened = open_packs(tuple(packs or ()), format=format)
    pixels = read_pixels(picture)
    framing = {
        "fit": fit,
        "crop": _box(crop),
        "background": _colour(background),
        "name": picture.name,
    }
    wanted: dict[str, Any] = {"layers": layers}
    if effort is not None:
        wanted["effort"] = effort
    if size is not None:
        made = _matched_mural(pixels, size, opened, framing, wanted)
        _save_mural(made, out or [], opened, written)
    else:
        wanted["alternatives"] = alternatives
        if is_photo:
            face, found = _seen_in_photo(pixels, corners, opened, wanted)
        else:
            shown = None if mask is None else read_pixels(mask)
            face, found = _seen_in_picture(
                pixels, opened, {**framing, "mask": shown, "weighting": weighting}, wanted
            )
        _print_matches(found, written, as_json)
        _save_sheets(face, found, out or [], opened)
    for line in opened.warnings():
        say(line)


def _refuse(context: typer.Context, names: tuple[str, ...], what: str) -> None:
    """Raises OptionError for the first of some options that was given."""
    from drapery.errors import OptionError

    flags = {parameter.name: parameter.opts[-1] for parameter in context.command.params}
    for name in names:
        if is_given(context, name):
            raise OptionError(f"{flags[name]} does not apply to {what}; leave it out")


def _check_version(form: str | None, paths: list[Path]) -> None:
    """Raises OptionError for a form that no file of a mural has."""
    from drapery.errors import OptionError
    from drapery.option import one_of

    if form is None:
        return
    one_of("--as of a mural", form, ("schem", "schem3"))
    if not any(path.suffix.lower() == ".schem" for path in paths):
        raise OptionError(f"--as {form} is the version of a .schem file; add -o wall.schem")


def _check_targets(paths: list[Path], *, is_mural: bool) -> None:
    """Raises OptionError or RenderError for a file that cannot be written."""
    from drapery.errors import OptionError
    from drapery.file_formats import endings_of
    from drapery.output_files import check_writable
    from drapery.render.encode import check_target

    for path in paths:
        if not is_mural:
            check_target(path, "still", "page")
        elif not path.name.lower().endswith((*MURAL_ENDINGS, *endings_of("still"))):
            known = ", ".join((*MURAL_ENDINGS, *endings_of("still")))
            raise OptionError(f"{path.name} ends in none of {known}; use one")
        else:
            check_writable(path)


def _seen_in_picture(
    pixels: "Texels", packs: "Packs", framing: dict[str, Any], wanted: dict[str, Any]
) -> "tuple[Texels, tuple[Match, ...]]":
    """The face that is seen in a picture, and the designs."""
    from drapery.match import Matcher, fit_picture

    seen = fit_picture(pixels, **framing)
    _check_colours(seen, framing["name"])
    return seen.face, _found(Matcher(packs), seen, wanted)


def _seen_in_photo(
    pixels: "Texels",
    corners: tuple[str, str, str, str] | None,
    packs: "Packs",
    wanted: dict[str, Any],
) -> "tuple[Texels, tuple[Match, ...]]":
    """The face that is seen in a photo, and the designs."""
    from drapery.match import find_corners, flat_face, match_photo

    picture = pixels[..., :3]
    places = find_corners(picture) if corners is None else tuple(map(_corner, corners))
    found = match_photo(picture, places, packs=packs, **wanted)
    return flat_face(picture, places), tuple(found)


def _found(matcher: "Matcher", seen: "PictureFace", wanted: dict[str, Any]) -> "tuple[Match, ...]":
    """The designs; after Ctrl-C those that were found until then."""
    found: tuple[Match, ...] = ()
    steps = 100
    try:
        with progress("match", steps) as update:
            for state in matcher.iter_matches(seen.face, weights=seen.weights, **wanted):
                found = state.matches
                update(round(steps * state.share), steps)
    except KeyboardInterrupt:
        if not found:
            raise
        say("stopped; these are the best designs so far")
    return found


def _print_matches(found: "tuple[Match, ...]", form: str | None, as_json: bool) -> None:
    from drapery.banner import write_banner

    if form is not None:
        print(write_banner(found[0].banner, form))
    elif as_json:
        print(json.dumps([_fields(one) for one in found], indent=1))
    else:
        for one in found:
            print(f"{one.error:.4f}\t{write_banner(one.banner, 'shorthand')}")


def _save_sheets(
    face: "Texels", found: "tuple[Match, ...]", paths: list[Path], packs: "Packs"
) -> None:
    from drapery.match import matches_sheet

    for path in paths:
        matches_sheet(face, found, packs).save(path)


def _matched_mural(
    pixels: "Texels",
    size: tuple[int, int],
    packs: "Packs",
    framing: dict[str, Any],
    wanted: dict[str, Any],
) -> "Mural":
    """The banners of a mural, each found by itself.

    After Ctrl-C those that were not yet found have one colour, so that the command ends soon.
    """
    from drapery.match import Match, Matcher, Mural, fit_mural

    faces = fit_mural(pixels, *size, **framing)
    matcher, found = Matcher(packs), list[Match]()
    chosen = {"effort": MURAL_EFFORT, **wanted, "alternatives": 1}
    try:
        with progress("mural", len(faces)) as update:
            for seen in faces:
                found += matcher.match(seen.face, weights=seen.weights, **chosen)
                update(len(found), len(faces))
    except KeyboardInterrupt:
        if not found:
            raise
        count = f"{len(found)} of {counted(len(faces), 'banner')}"
        say(f"stopped; {count} found, the others have one colour")
        for seen in faces[len(found) :]:
            found += matcher.match(seen.face, weights=seen.weights, layers=0, alternatives=1)
    return Mural(*size, tuple(one.banner for one in found))


def _save_mural(made: "Mural", paths: list[Path], packs: "Packs", form: str | None) -> None:
    """Print the materials of a mural, and write its files. form: of `.schem`."""
    from drapery.output_files import replacing

    for item in made.materials():
        print(f"{item.count}\t{item.item}")
    for path in paths:
        ending = path.suffix.lower()
        if ending not in MURAL_ENDINGS:
            made.picture(packs).save(path)
            continue
        if ending == ".mcfunction":
            data = made.function().encode()
        elif ending == ".litematic":
            data = made.schematic("litematic")
        else:
            data = made.schematic("schem3" if form == "schem3" else "schem")
        with replacing(path) as target:
            target.write_bytes(data)


def _fields(one: "Match") -> dict[str, Any]:
    from drapery.banner import fits_loom, write_banner

    return {
        "error": round(one.error, 6),
        "text": write_banner(one.banner, "shorthand"),
        "base": one.banner.base,
        "layers": [{"pattern": each.pattern, "dye": each.dye} for each in one.banner.layers],
        "fits_loom": fits_loom(one.banner),
    }


def _check_colours(seen: "PictureFace", name: str) -> None:
    """Raises OptionError for a picture of one colour."""
    from drapery.errors import OptionError
    from drapery.match import nearest_dye

    shown = seen.face[seen.weights > 0]
    if (shown == shown[0]).all():
        dye = nearest_dye(shown[0])
        raise OptionError(
            f"{name} has one colour only; the nearest dye is {dye}: use the design {dye!r}"
        )


def _colour(text: str) -> tuple[int, int, int] | None:
    from drapery.settings import background_colour

    *rgb, alpha = background_colour(text)
    return (rgb[0], rgb[1], rgb[2]) if alpha else None


def _corner(text: str) -> tuple[float, float]:
    from drapery.errors import OptionError

    try:
        x, y = map(float, text.split(","))
    except ValueError:
        raise OptionError(
            f"--corners {text[:40]!r} is not two numbers;"
            ' use such as --corners "52,21" "118,30" "112,171" "47,160"'
        ) from None
    return x, y


def _box(text: str | None) -> tuple[int, int, int, int] | None:
    from drapery.errors import OptionError

    if text is None:
        return None
    numbers = [part.strip() for part in text.split(",")]
    if len(numbers) != 4 or not all(part.isdecimal() and len(part) < 10 for part in numbers):
        raise OptionError(
            f"--crop {text[:40]!r} is not four whole numbers; use such as 0,0,100,200"
        )
    left, top, right, bottom = map(int, numbers)
    return left, top, right, bottom


def _checked_size(text: str) -> tuple[int, int]:
    """The size of a mural, such as 4x3. Raises OptionError."""
    from drapery.errors import OptionError
    from drapery.match import check_mural_size

    first, times, second = text.lower().partition("x")
    if not (times and all(part.isdecimal() and len(part) < 10 for part in (first, second))):
        raise OptionError(f"--mural {text[:40]!r} is not two whole numbers; use such as 4x3")
    size = int(first), int(second)
    check_mural_size(*size)
    return size
