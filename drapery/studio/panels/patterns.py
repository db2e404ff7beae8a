"""The patterns of the packs over the design."""

from drapery.studio.components import editor_part
from drapery.studio.panels.start import build_examples
from drapery.studio.session import Session


def build(session: Session) -> None:
    """The editor's grid; a click adds the pattern as a layer, or changes the chosen one."""
    build_examples(session)
    editor_part("patterns")
