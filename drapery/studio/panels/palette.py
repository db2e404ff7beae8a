"""The sixteen dyes, for the chosen layer or for the next one."""

from drapery.banner import DYES, Dye
from drapery.studio.components import Palette
from drapery.studio.descriptions import (
    MIDDLE_LUMINANCE,
    dye_colour,
    dye_title,
    luminance,
    pattern_title,
)
from drapery.studio.session import Session
from drapery.studio.sketch import place_of
from drapery.studio.translation import translated
from drapery.studio.widgets import on, set_props


def build(session: Session) -> None:
    """The palette; its heading says what a click dyes."""
    palette = Palette()

    def show() -> None:
        chosen = session.selection.shown_dye
        set_props(palette, {"chosen": chosen, "heading": _heading(session)})

    palette.props["dyes"] = [_swatch(dye) for dye in DYES.values()]
    on(palette, "dye", lambda dye: session.selection.press_dye(str(dye)))
    session.follow(show, "selection")


def _heading(session: Session) -> str:
    if session.selection.chosen == "field":
        return translated("Dye of the field")
    if session.selection.chosen is None:
        return translated("Dye of the next layer")
    place = place_of(session.sketch, session.selection.chosen)
    pattern = pattern_title(session.sketch.strokes[place].pattern)
    text = translated("Dye of layer {number}: {pattern}")
    return text.format(number=place + 1, pattern=pattern)


def _swatch(dye: Dye) -> dict[str, str]:
    return {
        "name": dye.name,
        "title": dye_title(dye.name),
        "colour": dye_colour(dye),
        "ink": "#000" if luminance(dye) > MIDDLE_LUMINANCE else "#fff",
    }
