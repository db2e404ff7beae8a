"""The page's own elements in the browser; each has a JavaScript file beside this one."""

from nicegui.element import Element


class Palette(Element, component="palette.js"):
    """A palette of dyes, one of them marked; emits `dye` with a name."""


class PatternGrid(Element, component="patterns.js"):
    """All patterns in the chosen dyes; emits `pattern` with a name, and `swaps`."""


class LayerList(Element, component="layers.js"):
    """The layers, topmost first; emits `choose` with a number, and `act` with what to do."""
