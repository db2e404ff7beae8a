"""The flat face: the design as banner sites show it, exact to the texel."""

from itertools import count

from nicegui import ui

from drapery.studio.session import Session
from drapery.studio.widgets import words
from drapery.studio.words import in_words


def build(session: Session) -> None:
    """The picture, drawn anew whenever the design or the packs change."""
    version = count()
    picture = ui.element("img").classes("face")
    # What has changed, for those who do not see it.
    told = words("").classes("sr").props("role=status")

    def show() -> None:
        # A new address for every state: the browser may not show an old one.
        picture.props["src"] = f"/face/{session.token}.png?v={next(version)}"
        picture.props["alt"] = in_words(session.sketch)
        picture.props["data-kind"] = session.sketch.kind
        picture.update()
        told.set_text(in_words(session.sketch))

    show()
    session.listen("sketch", show)
    session.listen("packs", show)
