"""Buttons and switches of the page: plain elements, each with its label."""

from collections.abc import Callable, Hashable, Mapping
from functools import partial
from typing import Any, Generic, TypeVar

from nicegui import ui
from nicegui.element import Element
from nicegui.events import GenericEventArguments

from drapery.studio.line_icons import line_icon
from drapery.studio.notices import errors_shown
from drapery.studio.translation import translated

Press = Callable[[], object]
ElementT = TypeVar("ElementT", bound=Element)


def on(element: ElementT, event: str, call: Callable[[Any], object], **how: Any) -> ElementT:
    """Call this with what an element emits; its user sees a DraperyError. how: as `Element.on`."""

    def handle(emitted: GenericEventArguments) -> object:
        with errors_shown():
            return call(emitted.args)

    return element.on(event, handle, **how)


def button(
    label: str, press: Press | None = None, *, icon: str = "", text: str = "", key: str = ""
) -> Element:
    """A button. label: its accessible name; icon, text: what it shows; key: its shortcut.

    press: None for a button that `studio.js` serves. Label and text are translated.
    """
    label = translated(label)
    element = ui.element("button").classes("button").props("type=button")
    element.props.update({"aria-label": label, "title": f"{label} ({key})" if key else label})
    with element:
        if icon:
            line_icon(icon)
        if text:
            translated_text(text)
    return element if press is None else on(element, "click", lambda _: press())


def hint(text: str) -> ui.label:
    """A paragraph that explains, in the user's language."""
    return translated_text(text, "p").classes("hint")


def set_props(element: Element, props: Mapping[str, Any]) -> None:
    """Set properties of an element; it is only sent if one of them has changed."""
    if any(element.props.get(name) != value for name, value in props.items()):
        element.props.update(props)
        element.update()


def text_element(text: str, tag: str = "span") -> ui.label:
    """An element with this text, which is never read as HTML."""
    element = ui.label(text)
    element.tag = tag
    return element


def translated_text(text: str, tag: str = "span") -> ui.label:
    """An element with a text of the page in the user's language."""
    return text_element(translated(text), tag)


class KeptElements(Generic[ElementT]):
    """The children of an element, by keys that say all that each of them is made for.

    A child whose key is still wanted stays, because a click on one that is replaced is lost. What
    else it shows is set in the children that `show` returns.
    """

    def __init__(self, parent: Element) -> None:
        self._parent = parent
        self._children: dict[Hashable, ElementT] = {}

    def show(self, wanted: Mapping[Any, Callable[[], ElementT]]) -> list[ElementT]:
        """Show children in this order, and return them. wanted: what makes each, by its key."""
        before, self._children = self._children, {}
        for key, make in wanted.items():
            child = before.pop(key, None)
            if child is None:
                with self._parent:
                    child = make()
            self._children[key] = child
        for child in before.values():
            child.delete()
        for place, child in enumerate(self._children.values()):
            if self._parent.default_slot.children[place] is not child:
                child.move(target_index=place)
        return [*self._children.values()]


class SegmentedControl:
    """A row of buttons; exactly one of them is pressed.

    options: the choices by name, with their titles. choose: takes the name that was pressed.
    """

    def __init__(self, label: str, options: Mapping[str, str], choose: Callable[[str], Any]):
        def press(name: str, _: object) -> None:
            choose(name)

        self._buttons: dict[str, Element] = {}
        with ui.element("div").classes("segments") as group:
            group.props("role=group").props.update({"aria-label": translated(label)})
            for name, title in options.items():
                element = translated_text(title, "button").props("type=button")
                on(element, "click", partial(press, name))
                self._buttons[name] = element

    def show(self, chosen: str, *, enabled: bool = True) -> None:
        """Mark the chosen button. enabled: whether another one can be pressed."""
        for name, element in self._buttons.items():
            pressed = str(name == chosen).lower()
            set_props(element, {"aria-pressed": pressed, "disabled": not enabled})
