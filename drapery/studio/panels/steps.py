"""The history as a strip of small faces; a click goes to a state."""

from collections.abc import Callable, Hashable
from functools import partial

from nicegui import ui
from nicegui.element import Element

from drapery.studio.art import face_address
from drapery.studio.descriptions import described
from drapery.studio.design_buttons import design_button
from drapery.studio.session import Session
from drapery.studio.sketch import Sketch, banner_of
from drapery.studio.translation import translated
from drapery.studio.widgets import KeptElements

SHOWN = 12
"""The most states on the strip: those around the current one."""


def build(session: Session) -> None:
    """The strip, once there is more than one state."""
    strip = ui.element("div").classes("steps-strip").props('role="group"')
    strip.props["aria-label"] = translated("History")

    def step(place: int, sketch: Sketch, current: bool) -> Element:
        words = translated("Step {number}: {design}").format(
            number=place + 1, design=described(sketch)
        )
        banner, press = banner_of(sketch), partial(session.go_to, place)
        button = design_button(session, "step", banner, press, label=words, side=20)
        button.props["aria-current"] = "step" if current else "false"
        return button

    def show() -> None:
        states, now = session.history.states, len(session.history.past)
        first = max(0, min(now - SHOWN // 2, len(states) - SHOWN))
        shown = range(first, min(len(states), first + SHOWN)) if len(states) > 1 else ()
        wanted: dict[Hashable, Callable[[], Element]] = {}
        for place in shown:
            sketch, current = states[place], place == now
            face = face_address(session, banner_of(sketch), 2)  # it changes with the packs
            wanted[place, sketch, current, face] = partial(step, place, sketch, current)
        kept.show(wanted)

    kept = KeptElements(strip)

    session.follow(show, "sketch", "packs")
