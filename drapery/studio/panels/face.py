"""The flat face: the design as banner websites show it, on a banner and on a shield."""

from itertools import count

from nicegui import ui

from drapery.studio.descriptions import described
from drapery.studio.selection import OTHER_KIND
from drapery.studio.session import Session
from drapery.studio.widgets import button, text_element


def build(session: Session) -> None:
    """The picture, which follows the design and the packs, and a small one of the other kind."""
    version = count()
    picture = ui.element("img").classes("face")
    switch = button("Banner or shield", session.selection.switch_kind, key="B").classes(
        "face-other"
    )
    with switch:
        other = ui.element("img").props('alt=""')
    # The change in words, for screen readers.
    announced = text_element("").classes("sr").props("role=status")

    def show_picture() -> None:
        # Each state has a new address, so the browser cannot show an old picture from its cache.
        mark = next(version)
        sketch = session.sketch
        for element, kind in ((picture, sketch.kind), (other, OTHER_KIND[sketch.kind])):
            element.props["src"] = f"/face/{session.token}.png?kind={kind}&v={mark}"
            element.props["data-kind"] = kind
        picture.props["alt"] = described(sketch)
        for element in (picture, other):
            element.update()

    def show() -> None:
        show_picture()
        announced.set_text(described(session.sketch))

    show()
    session.listen("sketch", show)
    session.listen("packs", show)
    session.listen("preview", show_picture)
