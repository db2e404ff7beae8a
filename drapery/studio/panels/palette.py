"""The sixteen dyes, for what is chosen or for the next layer."""

from drapery.banner.dyes import DYES, Dye
from drapery.studio.components import Palette, value_of
from drapery.studio.notices import faults
from drapery.studio.selection import Selection, desk_of
from drapery.studio.session import Session
from drapery.studio.sketch import place_of
from drapery.studio.words import dye_words, pattern_words


def build(session: Session) -> None:
    """The palette, whose heading says what a click dyes."""
    desk = desk_of(session)
    palette = Palette()

    def show() -> None:
        palette.show(chosen=desk.shown_dye, heading=_heading(session, desk))

    def press(dye: object) -> None:
        with faults():
            desk.press_dye(str(dye))

    palette.show(dyes=[_swatch(dye) for dye in DYES.values()])
    palette.on("dye", lambda event: press(value_of(event)))
    show()
    desk.listen(show)


def _heading(session: Session, desk: Selection) -> str:
    if desk.chosen == "field":
        return "Dye of the field"
    if desk.chosen is None:
        return "Dye of the next layer"
    place = place_of(session.sketch, desk.chosen)
    return f"Dye of layer {place + 1}: {pattern_words(session.sketch.strokes[place].pattern)}"


def _swatch(dye: Dye) -> dict[str, str]:
    return {
        "name": dye.name,
        "title": dye_words(dye.name),
        "colour": colour_of(dye),
        "ink": "#000" if _luminance(dye) > 0.18 else "#fff",
    }


def colour_of(dye: Dye) -> str:
    """The dye as CSS writes it."""
    return "#{:02x}{:02x}{:02x}".format(*dye.rgb)


def _luminance(dye: Dye) -> float:
    """Relative luminance of sRGB, WCAG 2.2; black and white contrast alike at 0.18."""
    red, green, blue = (
        part / 12.92 if part <= 0.04045 else ((part + 0.055) / 1.055) ** 2.4
        for part in (channel / 255 for channel in dye.rgb)
    )
    return 0.2126 * red + 0.7152 * green + 0.0722 * blue
