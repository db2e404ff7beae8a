"""The flat face: the design as banner websites show it, on a banner and on a shield."""

from drapery.studio.components import editor_part
from drapery.studio.session import Session
from drapery.studio.widgets import button


def build(session: Session) -> None:
    """The picture, which the page's editor draws, and a small one of the other kind."""
    editor_part("face").classes("face")
    switch = button("Banner or shield", key="B").classes("face-other")
    switch.props["data-act"] = "kind"
    with switch:
        editor_part("other")
