"""The list of the shortcuts of `studio.js` and of the viewer."""

from html import escape

from nicegui import ui

from drapery.studio.translation import translated

_KEYS = {
    "Design": (
        ("Ctrl+Z", "undo"),
        ("Ctrl+Shift+Z, Ctrl+Y", "redo"),
        ("N", "new banner"),
        ("R", "random design"),
        ("B", "banner or shield"),
        ("/", "find a pattern; Enter adds it"),
        ("Ctrl+V", "read a design from the clipboard"),
    ),
    "The chosen layer": (
        ("Alt+Up, Alt+Down", "move it"),
        ("H", "hide or show it"),
        ("Ctrl+D", "duplicate it"),
        ("Delete", "remove it"),
        ("Escape", "clear the choice: dyes are for the next layer"),
    ),
    "The wind": (
        ("W A S D, arrows", "direction"),
        ("Q, E", "weaker, stronger"),
        ("Space", "on or off"),
    ),
    "The live banner, when it has the focus": (
        ("Shift+arrows", "turn the view"),
        ("+, -", "zoom in, zoom out"),
        ("Home", "reset the view"),
    ),
    "The page": (("Tab, Shift+Tab", "next part, part before"), ("?", "this list")),
}


def build() -> None:
    """A dialog that `?` opens."""
    groups = "".join(
        f"<section><h3>{_text(group)}</h3><dl>{_rows(keys)}</dl></section>"
        for group, keys in _KEYS.items()
    )
    dialog = ui.html(
        f'<h2>{_text("Keyboard shortcuts")}</h2><div class="keys">{groups}</div>'
        f'<button type="button" class="button main">{_text("Close")}</button>',
        sanitize=False,
        tag="dialog",
    )
    dialog.classes("studio-dialog").props('id="shortcuts"')
    dialog.props["aria-label"] = translated("Keyboard shortcuts")


def _text(english: str) -> str:
    return escape(translated(english))


def _rows(keys: tuple[tuple[str, str], ...]) -> str:
    return "".join(f"<dt>{_key(key)}</dt><dd>{_text(does)}</dd>" for key, does in keys)


def _key(key: str) -> str:
    return ", ".join(f"<kbd>{escape(each)}</kbd>" for each in key.split(", "))
