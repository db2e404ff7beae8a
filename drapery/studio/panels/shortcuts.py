"""The list of shortcuts, as `studio.js` and the viewer know them."""

from html import escape

from nicegui import ui

_KEYS = {
    "Design": (
        ("Ctrl+Z", "undo"),
        ("Ctrl+Shift+Z, Ctrl+Y", "redo"),
        ("R", "a design by chance"),
        ("B", "banner or shield"),
        ("M", "survival or commands"),
        ("/", "find a pattern; Enter lays it on"),
        ("Ctrl+V", "read a design from the clipboard"),
    ),
    "The chosen layer": (
        ("Alt+Up, Alt+Down", "move it"),
        ("H", "hide or show it"),
        ("Ctrl+D", "duplicate it"),
        ("Delete", "remove it"),
        ("Escape", "let it go: dyes are for the next layer"),
    ),
    "The wind": (
        ("W A S D, arrows", "where it blows to"),
        ("Q, E", "weaker, stronger"),
        ("Space", "on or off"),
    ),
    "The live banner, when it has the focus": (
        ("Shift+arrows", "walk round it"),
        ("+, -", "nearer, further off"),
        ("Home", "as it was"),
    ),
    "The page": (("Tab, Shift+Tab", "from part to part"), ("?", "this list")),
}


def build() -> None:
    """A dialog that `?` opens."""
    groups = "".join(
        f"<section><h3>{group}</h3><dl>{_rows(keys)}</dl></section>"
        for group, keys in _KEYS.items()
    )
    dialog = ui.html(
        f'<h2>Keyboard shortcuts</h2><div class="keys">{groups}</div>'
        '<button type="button" class="button primary">Close</button>',
        sanitize=False,
        tag="dialog",
    )
    dialog.props('id="shortcuts" aria-label="Keyboard shortcuts"')


def _rows(keys: tuple[tuple[str, str], ...]) -> str:
    return "".join(f"<dt>{_key(key)}</dt><dd>{escape(does)}</dd>" for key, does in keys)


def _key(key: str) -> str:
    return ", ".join(f"<kbd>{escape(each)}</kbd>" for each in key.split(", "))
