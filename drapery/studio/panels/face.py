"""The flat face: the design as banner websites show it, with exact texels."""

from itertools import count

from nicegui import ui

from drapery.studio.descriptions import described
from drapery.studio.session import Session
from drapery.studio.widgets import text_element


def build(session: Session) -> None:
    """The picture, which follows the design and the packs."""
    version = count()
    picture = ui.element("img").classes("face")
    # The change in words, for screen readers.
    announced = text_element("").classes("sr").props("role=status")

    def show_picture() -> None:
        # Each state has a new address, so the browser cannot show an old picture from its cache.
        picture.props["src"] = f"/face/{session.token}.png?v={next(version)}"
        picture.props["alt"] = described(session.sketch)
        picture.props["data-kind"] = session.sketch.kind
        picture.update()

    def show() -> None:
        show_picture()
        announced.set_text(described(session.sketch))

    show()
    session.listen("sketch", show)
    session.listen("packs", show)
    session.listen("preview", show_picture)
