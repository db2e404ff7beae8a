"""The page's own elements in the browser; each is a file of script beside this one."""

from typing import Any

from nicegui.element import Element
from nicegui.events import GenericEventArguments


class _Shown(Element):
    def show(self, **props: Any) -> None:
        """Give the element other properties; nothing is sent where none has changed."""
        changed = {key: value for key, value in props.items() if self.props.get(key) != value}
        if changed:
            self.props.update(changed)
            self.update()


class Palette(_Shown, component="palette.js"):
    """Dyes of which one is marked; emits `dye` with a name."""


class PatternGrid(_Shown, component="patterns.js"):
    """All patterns in the chosen dyes; emits `pattern` with a name, and `swaps`."""


class LayerList(_Shown, component="layers.js"):
    """The layers, topmost first; emits `choose` with a number, and `act` with what to do."""


def value_of(event: GenericEventArguments) -> Any:
    """What an element emitted."""
    return event.args
