"""The design in every style; the browser asks for a picture when the panel shows it."""

from functools import partial

from nicegui import ui
from nicegui.element import Element

from drapery.studio.art import style_address
from drapery.studio.session import Session
from drapery.studio.translation import translated
from drapery.studio.widgets import hint, on, set_props, translated_text
from drapery.styles import find_style, style_names


def build(session: Session) -> None:
    """A button for each style; a second press leaves the style."""
    buttons: dict[str, Element] = {}
    pictures: dict[str, Element] = {}

    def press(name: str, _: object) -> None:
        session.adjust(style=() if session.settings.style == (name,) else (name,))

    def show_pressed() -> None:
        for name, button in buttons.items():
            pressed = session.settings.style == (name,)
            set_props(button, {"aria-pressed": str(pressed).lower()})

    def show_pictures() -> None:
        for name, picture in pictures.items():
            set_props(picture, {"src": style_address(session, name)})

    with ui.element("div").classes("styles").props('role="group"') as group:
        group.props["aria-label"] = translated("Styles")
        for name in style_names():
            with ui.element("button").classes("style").props("type=button") as button:
                button.props.update(
                    {"data-style": name, "title": translated(find_style(name).description)}
                )
                pictures[name] = ui.element("img").props('loading=lazy alt=""')
                translated_text(name.replace("-", " "))
            buttons[name] = on(button, "click", partial(press, name))
    hint(
        "Most styles are drawn by the renderer: in place of the live cloth you see a picture, which"
        " moves after some seconds."
    )
    session.follow(show_pressed, "settings")
    session.follow(show_pictures, "sketch", "packs")
