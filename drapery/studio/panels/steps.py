"""The history as a strip of small faces; a click goes to a state."""

from functools import partial

from nicegui import ui

from drapery.studio.descriptions import described
from drapery.studio.design_buttons import DesignButton, DesignList
from drapery.studio.session import Session
from drapery.studio.sketch import Sketch, banner_of
from drapery.studio.translation import translated
from drapery.studio.widgets import set_props

SHOWN = 12
"""The most states on the strip: those around the current one."""


def build(session: Session) -> None:
    """The strip, once there is more than one state."""
    strip = ui.element("div").classes("steps-strip").props('role="group"')
    strip.props["aria-label"] = translated("History")

    def step(place: int, sketch: Sketch) -> DesignButton:
        words = translated("Step {number}: {design}").format(
            number=place + 1, design=described(sketch)
        )
        banner, press = banner_of(sketch), partial(session.go_to, place)
        return DesignButton(session, "step", banner, press, label=words, side=20)

    def show() -> None:
        states, now = session.history.states, len(session.history.past)
        first = max(0, min(now - SHOWN // 2, len(states) - SHOWN))
        shown = range(first, min(len(states), first + SHOWN)) if len(states) > 1 else ()
        buttons = kept.show({(at, states[at]): partial(step, at, states[at]) for at in shown})
        for place, button in zip(shown, buttons, strict=True):
            set_props(button, {"aria-current": "step" if place == now else "false"})

    kept = DesignList(strip)
    session.follow(show, "sketch", "packs")
