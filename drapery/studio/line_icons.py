"""Pictures of lines for buttons and tabs: the page loads no font of icons for them."""

from nicegui import ui

LINES = {
    "close": "M6 6l12 12M18 6 6 18",
    "compare": "M12 3v18M9 6H4v12h5M15 6h5v12h-5",
    "contrast": "M12 3a9 9 0 1 0 0 18 9 9 0 0 0 0-18M12 3v18M15 6.5v11M18 9v6",
    "copy": "M8 8h12v12H8zM4 16V4h12",
    "delete": "M4 7h16M9 7V4h6v3M6 7l1 13h10l1-13M10 11v5M14 11v5",
    "done": "M5 13l5 5L20 6",
    "down": "M12 4v16M6 14l6 6 6-6",
    "download": "M12 4v11M8 11l4 4 4-4M5 20h14",
    "edit": "M4 20l1-4L16 5l3 3L8 19zM14 7l3 3",
    "embed": "M8 11l8-4M8 13l8 4M6 10a2 2 0 1 0 0 4 2 2 0 0 0 0-4"
    "M18 4a2 2 0 1 0 0 4 2 2 0 0 0 0-4M18 16a2 2 0 1 0 0 4 2 2 0 0 0 0-4",
    "export": "M12 15V3M8 7l4-4 4 4M5 11v9h14v-9",
    "fault": "M12 3a9 9 0 1 0 0 18 9 9 0 0 0 0-18M12 7.5V13M12 16.5h.01",
    "keyboard": "M3 6h18v12H3zM7 10h.01M11 10h.01M15 10h.01M17 14h.01M10 14h4M7 14h.01",
    "layers": "M12 3 3 8l9 5 9-5zM3 12l9 5 9-5M3 16l9 5 9-5",
    "letters": "M3 19 7.5 5 12 19M4.5 14h6M15 5h3a3 3 0 0 1 0 6.5h-3zM15 11.5h3.5a3.7 3.7 0"
    " 0 1 0 7.5H15z",
    "library": "M5 4h4v16H5zM9 4h4v16H9zM15.5 5l3-.8 3 15-3 .8z",
    "loom": "M4 3v18M20 3v18M4 7h16M4 17h16M8.5 7v10M12 7v10M15.5 7v10",
    "motion": "M3 7h9M16 7h5M14 5v4M3 12h3M10 12h11M8 10v4M3 17h11M18 17h3M16 15v4",
    "packs": "M4 8l8-4 8 4v8l-8 4-8-4zM4 8l8 4 8-4M12 12v8",
    "palette": "M12 3a9 9 0 1 0 0 18c1.7 0 2-1.2 1.4-2.4-.7-1.4.1-3.1 1.8-3.1H18a3 3 0 0 0"
    " 3-3C21 7 17 3 12 3M7.5 12h.01M9.5 7.5h.01M15 7.5h.01",
    "patterns": "M4 4h6v6H4zM14 4h6v6h-6zM4 14h6v6H4zM14 14h6v6h-6z",
    "pause": "M8 5v14M16 5v14",
    "picture": "M3 5h18v14H3zM3 16l5-5 5 5 3-3 5 5M16 9h.01",
    "rest": "M4 12a8 8 0 1 0 2.5-5.8M4 3v4.5h4.5",
    "save": "M4 4h13l3 3v13H4zM8 4v5h7V4M8 20v-7h8v7",
    "start": "M12 3l2 7 7 2-7 2-2 7-2-7-7-2 7-2z",
    "steps": "M12 7.5V12l3.5 2M4 12a8 8 0 1 0 2.5-5.8M4 3v4.5h4.5",
    "styles": "M20.5 3.5 11 13M9 13c-3 0-4 2-4 4s-1 3-2 3c3 1.5 9 1 9-4a3 3 0 0 0-3-3z",
    "text": "M8 7l-5 5 5 5M16 7l5 5-5 5M14 4l-4 16",
    "up": "M12 20V4M6 10l6-6 6 6",
    "warning": "M12 4 2.5 20h19zM12 10v4.5M12 17.5h.01",
}
"""The paths of the pictures in a square of 24 units, by the names of panels, of the tones of
notices, and of what buttons do."""


def line_icon(name: str) -> ui.icon:
    """A picture of LINES, hidden from screen readers."""
    return ui.icon(LINES[name]).props('aria-hidden="true"')
