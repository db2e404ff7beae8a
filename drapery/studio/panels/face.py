"""The flat face: the design as banner websites show it, on a banner and on a shield."""

from drapery.studio.components import editor_part
from drapery.studio.descriptions import described
from drapery.studio.session import Session
from drapery.studio.widgets import button, set_props, text_element


def build(session: Session) -> None:
    """The picture, which the page's editor draws, and a small one of the other kind."""
    picture = editor_part("face").classes("face").props("role=img")
    switch = button("Banner or shield", key="B").classes("face-other")
    switch.props["data-act"] = "kind"
    with switch:
        editor_part("other")
    # The change in words, for screen readers.
    announced = text_element("").classes("unseen").props("role=status")

    def show() -> None:
        words = described(session.sketch)
        set_props(picture, {"aria-label": words})
        announced.set_text(words)

    session.follow(show, "sketch")
