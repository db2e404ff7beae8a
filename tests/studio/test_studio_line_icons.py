"""Every tab has a picture of lines."""

import re

from drapery.studio.line_icons import LINES
from drapery.studio.page import PANELS


def test_every_tab_has_a_picture_of_lines() -> None:
    tabs = {panel.name for panel in PANELS if panel.group}
    assert tabs | {"fault", "warning", "done"} < {*LINES}
    assert all(re.fullmatch(r"M[-\dMLHVChvlacsz .]+", path) for path in LINES.values())
    assert len({*LINES.values()}) == len(LINES)
