"""The history as a strip of small faces; a click goes to a state."""

from zlib import crc32

from nicegui import ui

from drapery.studio.descriptions import described
from drapery.studio.session import Session
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
                step = ui.element("button").classes("step").props("type=button")
                step.props.update({"aria-label": words, "title": words})
                step.props["aria-current"] = "step" if place == now else "false"
                step.on("click", lambda place=place: session.go_to(place))
                read = session.settings.packs, session.settings.format
                mark = crc32(repr((states[place], read)).encode())
                with step:
                    picture = ui.element("img").props('alt="" width=20 height=40')
                    picture.props["src"] = f"/past/{session.token}/{place}.png?v={mark:x}"

    show()
    session.listen("sketch", show)
    session.listen("packs", show)
