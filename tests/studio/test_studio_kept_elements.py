"""The studio keeps elements of its lists in place: a click on one that is replaced is lost.

In a browser, the mouse button may go down on an element and come up on the one in its place.
"""

import ast
from pathlib import Path

import pytest

STUDIO = Path(__file__).parents[2] / "drapery" / "studio"
SOURCES = sorted(STUDIO.rglob("*.py"))
BUILT_ANEW = {
    ("document.py", "self._at_close"): "functions, no elements",
    ("document.py", "self._listeners"): "functions, no elements",
    ("exports.py", "self"): "exports, no elements",
    ("session.py", "self._kept"): "work of closed pages, no elements",
    ("panels/export.py", "self._warnings"): "lines of text without a button",
    ("panels/library.py", "self._undo"): "a new offer, which a click on the last must not take",
    ("widgets.py", "child"): "KeptElements itself: what is wanted no longer",
}
"""What may be emptied or removed, and why."""


def emptied(source: str) -> list[str]:
    """What a source empties, removes, or builds anew by a decorator of NiceGUI."""
    found = []
    for node in ast.walk(ast.parse(source)):
        if isinstance(node, ast.Call) and isinstance(node.func, ast.Attribute):
            called = node.func
            if called.attr in ("clear", "delete") and not node.args and not node.keywords:
                found.append(ast.unparse(called.value))
        if isinstance(node, ast.Attribute) and node.attr in ("refreshable", "refreshable_method"):
            found.append(ast.unparse(node))
    return found


@pytest.mark.parametrize("path", SOURCES, ids=lambda path: path.relative_to(STUDIO).as_posix())
def test_no_list_is_built_anew(path: Path) -> None:
    name = path.relative_to(STUDIO).as_posix()
    wrong = [each for each in emptied(path.read_text("utf-8")) if (name, each) not in BUILT_ANEW]
    assert not wrong, f"{name} builds {wrong} anew; use widgets.KeptElements"


def test_each_exception_is_still_there() -> None:
    for name, what in BUILT_ANEW:
        assert what in emptied((STUDIO / name).read_text("utf-8")), (name, what)


def test_the_sweep_finds_a_list_that_is_built_anew() -> None:
    assert emptied("row.clear()\n@ui.refreshable\ndef show(): pass") == ["row", "ui.refreshable"]
