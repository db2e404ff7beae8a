"""The history as a strip of small faces; a click goes to a state."""

from functools import partial

from nicegui import ui

from drapery.studio.descriptions import described
from drapery.studio.design_buttons import design_button
from drapery.studio.session import Session
from drapery.studio.sketch import banner_of
from drapery.studio.translation import translated

SHOWN = 12
"""The most states on the strip: those around the current one."""


def build(session: Session) -> None:
    """The strip, once there is more than one state."""
    strip = ui.element("div").classes("steps-strip").props('role="group"')
    strip.props["aria-label"] = translated("History")

    def show() -> None:
        states, now = session.history.states, len(session.history.past)
        strip.clear()
        if len(states) < 2:
            return
        first = max(0, min(now - SHOWN // 2, len(states) - SHOWN))
        with strip:
            for place in range(first, min(len(states), first + SHOWN)):
                words = translated("Step {number}: {design}").format(
                    number=place + 1, design=described(states[place])
                )
                banner, press = banner_of(states[place]), partial(session.go_to, place)
                step = design_button(session, "step", banner, press, label=words, side=20)
                step.props["aria-current"] = "step" if place == now else "false"

    session.follow(show, "sketch", "packs")
