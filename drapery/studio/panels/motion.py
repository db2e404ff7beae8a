"""Controls of the live banner: wind, cloth, placement and light."""

import math
from typing import get_args

from nicegui import ui

from drapery.cloth import SOLVERS
from drapery.settings import MAX_LIGHT, MAX_WIND, ROTATIONS, Facing, Placement
from drapery.studio.panels.controls import Controls
from drapery.studio.session import Session
from drapery.studio.wind_controls import wind_controls_of

GRIDS = ((3, 5), (5, 9), (7, 13), (9, 17), (13, 25), (17, 33), (25, 49), (33, 65))
PINS = {
    None: "its own",
    "top": "top",
    "corners": "2 corners",
    "three-corners": "3 corners",
    "four-corners": "4 corners",
    "none": "nothing",
}
NOON = 12.0


def build(session: Session) -> None:
    """Four groups of controls."""
    controls = Controls(session)
    with ui.element("div").classes("motion"):
        for title, draw in (
            ("Wind", _wind),
            ("Cloth", _cloth),
            ("Place", _place),
            ("Light", _light),
        ):
            with (
                ui.element("div")
                .classes("motion-group")
                .props(f'role="group" aria-label="{title}"')
            ):
                ui.element("h3").add_slot("default", title)
                draw(session, controls)
    controls.follow()


def _wind(session: Session, controls: Controls) -> None:
    controls.slider(
        "Speed",
        (0, MAX_WIND / 2, 0.1),
        lambda: session.settings.wind,
        lambda speed: session.adjust(wind=float(speed)),
        "{:.1f} m/s".format,
    )
    controls.slider(
        "Direction",
        (-180, 180, 1),
        lambda: round(wind_controls_of(session.settings).heading),
        lambda heading: session.adjust(direction=float(heading)),
        "{:.0f}°".format,
    )
    controls.slider(
        "Gusts",
        (0, 1.5, 0.05),
        lambda: session.settings.gusts,
        lambda gusts: session.adjust(gusts=float(gusts)),
        "{:.2f}".format,
    )
    controls.switch(
        "Wind on",
        lambda: session.viewport.request.on,
        lambda on: session.viewport.update(on=bool(on)),
    )


def _cloth(session: Session, controls: Controls) -> None:
    controls.select(
        "Solver",
        {name: name for name in SOLVERS},
        lambda: session.settings.solver,
        lambda name: session.adjust(solver=name),
    )
    # The list must hold the present grid, which a link may have set.
    grids = dict.fromkeys((*GRIDS, tuple(session.settings.grid)))
    controls.select(
        "Grid",
        {f"{columns}x{rows}": f"{columns} × {rows}" for columns, rows in sorted(grids)},
        lambda: "{}x{}".format(*session.settings.grid),
        lambda text: session.adjust(grid=tuple(map(int, text.split("x")))),
    )
    controls.select(
        "Held at",
        PINS,
        lambda: session.settings.pins,
        lambda pins: session.adjust(pins=pins),
    )
    controls.slider(
        "Thickness",
        (0, 4, 0.25),
        lambda: session.settings.thickness,
        lambda texels: session.adjust(thickness=float(texels)),
        lambda texels: f"{texels:g} texel" + "s" * (texels != 1),
    )


def _place(session: Session, controls: Controls) -> None:
    words = {"standing": "pole", "wall": "wall", "item": "item slot"}
    controls.select(
        "Placement",
        {name: words[name] for name in get_args(Placement)},
        lambda: session.settings.placement,
        lambda name: session.adjust(placement=name, rotation=0, facing=None),
    )
    controls.slider(
        "Rotation",
        (0, ROTATIONS - 1, 1),
        lambda: _rotation(session),
        lambda number: _rotate(session, int(number)),
        lambda number: f"{number * 360 / ROTATIONS:g}°",
    )
    controls.select(
        "Flag",
        {"cloth": "cloth", "vanilla": "the game's"},
        lambda: session.settings.pose,
        lambda pose: session.adjust(pose=pose),
    )
    controls.switch(
        "Shadow", lambda: session.settings.shadow, lambda on: session.adjust(shadow=bool(on))
    )


def _rotation(session: Session) -> int:
    """In sixteenths of a turn, for standing and wall banners alike."""
    return round(session.settings.turned * ROTATIONS / 360)


def _rotate(session: Session, number: int) -> None:
    """Turn the banner; on a wall, to the nearest of four sides."""
    if session.settings.placement == "wall":
        sides = get_args(Facing)
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
    )
    _level(session, controls, "Sky light", "sky_light")
    _level(session, controls, "Torch light", "block_light")
    controls.switch(
        "Shaded",
        lambda: session.settings.light == "game",
        lambda on: session.adjust(light="game" if on else "flat"),
    )


def _level(session: Session, controls: Controls, label: str, option: str) -> None:
    controls.slider(
        label,
        (0, MAX_LIGHT, 1),
        lambda: getattr(session.settings, option),
        lambda level: session.adjust(**{option: int(level)}),
    )


def daylight_at(hour: float) -> float:
    """The brightness of the sky at an hour 0..24: 1 about noon, 0 at night, between at dusk."""
    return min(1.0, max(0.0, 0.5 + 2 * math.cos(math.tau * (hour - NOON) / 24)))


def hour_of(daylight: float) -> float:
    """The hour from noon to midnight whose sky has this brightness, in quarters of an hour."""
    if daylight >= 1.0:
        return NOON
    if daylight <= 0.0:
        return 24.0
    return round(4 * (NOON + 24 * math.acos((daylight - 0.5) / 2) / math.tau)) / 4
