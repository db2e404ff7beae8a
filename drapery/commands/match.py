"""`drapery match`: the banners that look most like a picture."""

import json
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, Literal

import typer

from drapery.commands import options as o
from drapery.commands.notices import progress, say

if TYPE_CHECKING:
    from drapery.match import Match, Matcher, PictureFace
    from drapery.packs import Packs, Texels

MURAL_EFFORT = 8
"""The effort for each banner of a mural, unless one is given."""

MURAL_ENDINGS = (".schem", ".mcfunction", ".png")


def run(
    picture: Annotated[Path, typer.Argument(metavar="PICTURE", help="A PNG, JPEG or WebP file.")],
    out: Annotated[
        list[Path] | None,
        typer.Option(
            "-o",
            "--out",
            metavar="FILE",
            help="The picture beside the banners, as .png or .html. With --mural: .png,"
            " .mcfunction or .schem; several files may be given.",
        ),
    ] = None,
    layers: Annotated[
        int, typer.Option(metavar="N", help="The most layers (0 to 16); the loom makes 6.")
    ] = 6,
    alternatives: Annotated[int, typer.Option(metavar="N", help="The most designs (1 to 64).")] = 5,
    effort: Annotated[
        int | None,
        typer.Option(metavar="N", help="How many attempts are made to improve the designs."),
    ] = None,
    fit: Annotated[
        Literal["cover", "contain", "stretch"],
        typer.Option(help="How a picture of another shape is fitted to the banner."),
    ] = "cover",
    crop: Annotated[
        str | None,
        typer.Option(metavar="L,T,R,B", help="The part of the picture to use, in pixels."),
    ] = None,
    background: Annotated[
        str,
        typer.Option(metavar="COLOUR", help="Behind transparent pixels; transparent ignores them."),
    ] = "transparent",
    mask: Annotated[
        Path | None,
        typer.Option(metavar="FILE", help="A picture that is bright where pixels count."),
    ] = None,
    weighting: Annotated[
        Literal["even", "centre", "edges"],
        typer.Option("--weights", help="Which part of the picture counts most."),
    ] = "even",
    mural: Annotated[
        str | None,
        typer.Option(metavar="WxH", help="Show the picture on so many banners, such as 4x3."),
    ] = None,
    photo: Annotated[
        bool,
        typer.Option("--photo", help="The picture is a photo of a banner before one colour."),
    ] = False,
    corners: Annotated[
        tuple[str, str, str, str] | None,
        typer.Option(
            metavar="X,Y X,Y X,Y X,Y",
            help="The flag's corners in a photo, in pixels: upper left, upper right, lower right,"
            " lower left.",
        ),
    ] = None,
    written: Annotated[
        str | None,
        typer.Option("--as", metavar="FORM", help="Print the best design as give, json, ..."),
    ] = None,
    as_json: Annotated[
        bool, typer.Option("--json", help="Print the designs and their errors as JSON.")
    ] = False,
    packs: o.PackOption = None,
    format: o.FormatOption = None,
) -> None:
    """Find the banners that look most like a picture. Ctrl-C shows the best that were found."""
    from drapery.banner import write_banner
    from drapery.match import Matcher, fit_picture, matches_sheet, read_picture
    from drapery.packs import open_packs
    from drapery.sheets import check_sheet_target

    if mural is not None:
        given = {
            "--as": written is not None,
            "--json": as_json,
            "--mask": mask is not None,
            "--weights": weighting != "even",
            "--photo": photo,
            "--corners": corners is not None,
        }
        _refuse("a mural", given)
        _mural(picture, mural, out or [], layers, effort, fit, crop, background, packs, format)
        return
    for path in out or ():
        check_sheet_target(path)
    opened = open_packs(tuple(packs or ()), format=format)
    pixels = read_picture(picture)
    if photo or corners:
        unused = {
            "--fit": fit != "cover",
            "--crop": crop is not None,
            "--background": background != "transparent",
            "--mask": mask is not None,
            "--weights": weighting != "even",
            "--effort": effort is not None,
        }
        _refuse("a photo", unused)
        face, found = _seen_in_photo(pixels, corners, opened, layers, alternatives)
    else:
        seen = fit_picture(
            pixels,
            fit=fit,
            crop=_box(crop),
            background=_colour(background),
            mask=None if mask is None else read_picture(mask),
            weighting=weighting,
            name=picture.name,
        )
        _check_colours(seen, picture.name)
        wanted: dict[str, Any] = {"layers": layers, "alternatives": alternatives}
        if effort is not None:
            wanted["effort"] = effort
        face, found = seen.face, _found(Matcher(opened), seen, wanted)
    if written is not None:
        print(write_banner(found[0].banner, written))
    elif as_json:
        print(json.dumps([_fields(one) for one in found], indent=1))
    else:
        for one in found:
            print(f"{one.error:.4f}\t{write_banner(one.banner, 'text')}")
    for path in out or ():
        matches_sheet(face, found, opened).save(path)
    _warn(opened)


def _seen_in_photo(
    pixels: "Texels",
    corners: tuple[str, str, str, str] | None,
    packs: "Packs",
    layers: int,
    alternatives: int,
) -> "tuple[Texels, tuple[Match, ...]]":
    """The face that is seen in a photo, and the designs."""
    from drapery.match import find_corners, flat_face, match_photo

    picture = pixels[..., :3]
    places = find_corners(picture) if corners is None else tuple(map(_corner, corners))
    found = match_photo(picture, places, layers=layers, packs=packs, alternatives=alternatives)
    return flat_face(picture, places), tuple(found)


def _corner(text: str) -> tuple[float, float]:
    from drapery.errors import OptionError

    try:
        x, y = map(float, text.split(","))
    except ValueError:
        raise OptionError(
            f"--corners {text[:40]!r} is not two numbers; use such as --corners 52,21 118,30"
            " 112,171 47,160"
        ) from None
    return x, y


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


def _refuse(what: str, given: dict[str, bool]) -> None:
    """Raises OptionError for the first option that was given and is not used."""
    from drapery.errors import OptionError

    for name, used in given.items():
        if used:
            raise OptionError(f"{name} does not apply to {what}; leave it out")


def _mural(
    picture: Path,
    size: str,
    out: list[Path],
    layers: int,
    effort: int | None,
    fit: Literal["cover", "contain", "stretch"],
    crop: str | None,
    background: str,
    packs: list[Path] | None,
    format: int | None,
) -> None:
    from drapery.errors import OptionError
    from drapery.match import Matcher, Mural, check_mural_size, fit_mural, read_picture
    from drapery.packs import open_packs
    from drapery.render import check_writable, replacing

    across, down = _pair(size)
    check_mural_size(across, down)
    for path in out:
        if path.suffix.lower() not in MURAL_ENDINGS:
            raise OptionError(f"{path.name} ends in none of {', '.join(MURAL_ENDINGS)}; use one")
        check_writable(path)
    opened = open_packs(tuple(packs or ()), format=format)
    faces = fit_mural(
        read_picture(picture),
        across,
        down,
        fit=fit,
        crop=_box(crop),
        background=_colour(background),
        name=picture.name,
    )
    matcher, banners = Matcher(opened), []
    attempts = MURAL_EFFORT if effort is None else effort
    with progress("mural", len(faces)) as update:
        for number, seen in enumerate(faces, 1):
            (best,) = matcher.match(
                seen.face, weights=seen.weights, layers=layers, alternatives=1, effort=attempts
            )
            banners.append(best.banner)
            update(number, len(faces))
    made = Mural(across, down, tuple(banners))
    for item in made.materials():
        print(f"{item.count}\t{item.item}")
    for path in out:
        ending = path.suffix.lower()
        if ending == ".png":
            made.picture(opened).save(path)
            continue
        data = made.schematic() if ending == ".schem" else made.function().encode()
        with replacing(path) as target:
            target.write_bytes(data)
    _warn(opened)


def _fields(one: "Match") -> dict[str, Any]:
    from drapery.banner import fits_loom, write_banner

    return {
        "error": round(one.error, 6),
        "text": write_banner(one.banner, "text"),
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


def _box(text: str | None) -> tuple[int, int, int, int] | None:
    from drapery.errors import OptionError

    if text is None:
        return None
    numbers = [part.strip() for part in text.split(",")]
    if len(numbers) != 4 or not all(part.isdecimal() for part in numbers):
        raise OptionError(
            f"--crop {text[:40]!r} is not four whole numbers; use such as 0,0,100,200"
        )
    left, top, right, bottom = map(int, numbers)
    return left, top, right, bottom


def _pair(text: str) -> tuple[int, int]:
    from drapery.errors import OptionError

    first, times, second = text.lower().partition("x")
    if not (times and first.isdecimal() and second.isdecimal()):
        raise OptionError(f"--mural {text[:40]!r} is not two whole numbers; use such as 4x3")
    return int(first), int(second)


def _warn(packs: "Packs") -> None:
    for line in packs.warnings():
        say(line)
