"""The page's own elements in the browser; each has a JavaScript file beside this one."""

from typing import Any

from nicegui.element import Element
from nicegui.events import GenericEventArguments


class _VueElement(Element):
    def show(self, **props: Any) -> None:
        """Set properties of the element; only sends a message if one of them has changed."""
        changed = {key: value for key, value in props.items() if self.props.get(key) != value}
        if changed:
            self.props.update(changed)
            self.update()


class Palette(_VueElement, component="palette.js"):
    """A palette of dyes, one of them marked; emits `dye` with a name."""


class PatternGrid(_VueElement, component="patterns.js"):
    """All patterns in the chosen dyes; emits `pattern` with a name, and `swaps`."""


class LayerList(_VueElement, component="layers.js"):
    """The layers, topmost first; emits `choose` with a number, and `act` with what to do."""


def value_of(event: GenericEventArguments) -> Any:
    """What an element emitted."""
    return event.args
