"""Controls of the live banner: wind, cloth, placement and light."""

import math

from nicegui import ui

from drapery.settings import OPTIONS, ROTATIONS
from drapery.studio.descriptions import option_help
from drapery.studio.panels.controls import Controls
from drapery.studio.session import Session
from drapery.studio.translation import translated
from drapery.studio.widgets import translated_text
from drapery.studio.wind_controls import wind_controls_of

GRIDS = ((3, 5), (5, 9), (7, 13), (9, 17), (13, 25), (16, 31), (17, 33), (25, 49), (33, 65))
NOON = 12.0


def build(session: Session) -> None:
    """Four groups of controls."""
    controls = Controls(session)
    with ui.element("div").classes("motion"):
        for title, draw in (
            ("Wind", _wind),
            ("Cloth", _cloth),
            ("Placement", _placement),
            ("Light", _light),
        ):
            with (
                ui.element("div")
                .classes("motion-group")
                .props(f'role="group" aria-label="{translated(title)}"')
            ):
                ui.element("h3").add_slot("default", translated(title))
                draw(session, controls)
    controls.follow()


def _wind(session: Session, controls: Controls) -> None:
    controls.number("wind", "Speed", 0.1)
    controls.slider(
        "Direction",
        (-180, 180, 1),
        lambda: round(wind_controls_of(session.settings).heading),
        lambda heading: session.adjust(direction=float(heading)),
        "{:.0f}°".format,
        option_help(OPTIONS["direction"]),
    )
    controls.number("gusts", "Gusts", 0.05)
    viewport = session.viewport
    controls.switch("Wind on", lambda: viewport.request.on, lambda on: viewport.update(on=bool(on)))


def _cloth(session: Session, controls: Controls) -> None:
    controls.choice("pins", "Held at")
    controls.number("thickness", "Thickness", 0.25)
    with ui.element("details").classes("advanced"):
        translated_text("Advanced", "summary")
        _simulation(session, controls)


def _simulation(session: Session, controls: Controls) -> None:
    controls.choice("solver", "Solver")
    # The list must contain the current grid, because a link can set any grid.
    grids = dict.fromkeys((*GRIDS, tuple(session.settings.grid)))
    option = OPTIONS["grid"]
    controls.select(
        "Grid",
        {option.to_text(grid): " × ".join(map(str, grid)) for grid in sorted(grids)},
        lambda: option.to_text(session.settings.grid),
        lambda text: session.adjust(grid=option.parse(text)),
    )
    controls.choice("contact", "Contact")


def _placement(session: Session, controls: Controls) -> None:
    controls.choice("placement", "Placement", rotation=0, facing=None, turntable=False)
    controls.slider(
        "Rotation",
        (0, ROTATIONS - 1, 1),
        lambda: _rotation(session),
        lambda number: _rotate(session, int(number)),
        lambda number: f"{number * 360 / ROTATIONS:g}°",
        option_help(OPTIONS["rotation"]),
    )
    controls.choice("pose", "Flag")
    controls.flag("shadow", "Shadow")


def _rotation(session: Session) -> int:
    """The rotation in sixteenths of a turn, for standing banners and wall banners."""
    return round(session.settings.turned * ROTATIONS / 360)


def _rotate(session: Session, number: int) -> None:
    """Turn the banner; a wall banner turns to the nearest of four sides."""
    if session.settings.placement == "wall":
        sides = OPTIONS["facing"].choices
        session.adjust(facing=sides[round(number / 4) % len(sides)])
    else:
        session.adjust(rotation=number)


def _light(session: Session, controls: Controls) -> None:
    chosen = [hour_of(session.settings.daylight)]

    def hour() -> float:
        # Morning and evening have the same light: the chosen hour is stored beside it.
        daylight = session.settings.daylight
        return chosen[0] if daylight_at(chosen[0]) == daylight else hour_of(daylight)

    def choose(value: float) -> None:
        chosen[0] = float(value)
        session.adjust(daylight=daylight_at(chosen[0]))

    controls.slider(
        "Time of day",
        (0, 24, 0.25),
        hour,
        choose,
        lambda hour: f"{int(hour)}:{int(hour % 1 * 60):02d}",
        option_help(OPTIONS["daylight"]),
    )
    controls.number("block_light", "Torch light", 1)
    with ui.element("details").classes("advanced"):
        translated_text("Advanced", "summary")
        controls.number("sky_light", "Sky light", 1)
        controls.switch(
            "Shaded",
            lambda: session.settings.lighting == "game",
            lambda on: session.adjust(light="game" if on else "flat"),
        )


def daylight_at(hour: float) -> float:
    """The brightness of the sky at an hour 0..24: 1 around noon, 0 at night, between at dusk."""
    return min(1.0, max(0.0, 0.5 + 2 * math.cos(math.tau * (hour - NOON) / 24)))


def hour_of(daylight: float) -> float:
    """The hour from noon to midnight with this sky brightness, in steps of a quarter of an hour."""
    if daylight >= 1.0:
        return NOON
    if daylight <= 0.0:
        return 24.0
    return round(4 * (NOON + 24 * math.acos((daylight - 0.5) / 2) / math.tau)) / 4
