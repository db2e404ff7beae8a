"""Controls of the live banner: wind, cloth, placement and light."""

import math
from collections.abc import Iterator
from contextlib import contextmanager

from nicegui import ui

from drapery.settings import OPTIONS, ROTATIONS
from drapery.studio.panels.fields import Fields
from drapery.studio.session import Session
from drapery.studio.translation import translated
from drapery.studio.widgets import translated_text
from drapery.studio.wind_heading import heading_of

GRIDS = ((3, 5), (5, 9), (7, 13), (9, 17), (13, 25), (16, 31), (17, 33), (25, 49), (33, 65))
NOON = 12.0


def build(session: Session) -> None:
    """Four groups of controls."""
    fields = Fields(session)
    with ui.element("div").classes("motion"):
        with _group("Wind"):
            _wind(session, fields)
        with _group("Cloth"):
            fields.option("pins", "Held at")
            fields.option("thickness", "Thickness", step=0.25)
            with _advanced():
                _simulation(session, fields)
        with _group("Placement"):
            _placement(session, fields)
        with _group("Light"):
            _light(session, fields)
    session.follow(fields.refresh, "settings", "scene")


@contextmanager
def _group(title: str) -> Iterator[None]:
    with ui.element("div").classes("motion-group").props("role=group") as group:
        group.props["aria-label"] = translated(title)
        translated_text(title, "h3")
        yield


@contextmanager
def _advanced() -> Iterator[None]:
    with ui.element("details").classes("advanced"):
        translated_text("Advanced", "summary")
        yield


def _wind(session: Session, fields: Fields) -> None:
    viewport = session.viewport
    fields.option("wind", "Speed", step=0.1)
    fields.slider(
        "Direction",
        OPTIONS["direction"],
        1,
        lambda: round(heading_of(session.settings)),
        lambda heading: session.adjust(direction=heading),
        "{:.0f}°".format,
        min=-180,
        max=180,
    )
    fields.option("gusts", "Gusts", step=0.05)
    fields.tick("Wind on", lambda: viewport.request.on, lambda on: viewport.update(on=bool(on)))


def _simulation(session: Session, fields: Fields) -> None:
    fields.option("solver", "Solver")
    # The list must contain the current grid, because a link can set any grid.
    grids = sorted({*GRIDS, tuple(session.settings.grid)})
    titles = {OPTIONS["grid"].to_text(grid): " × ".join(map(str, grid)) for grid in grids}
    fields.option("grid", "Grid", titles)
    fields.option("contact", "Contact")


def _placement(session: Session, fields: Fields) -> None:
    def rotate(number: int) -> None:
        """Turn the banner; a wall banner turns to the nearest of four sides."""
        if session.settings.placement == "wall":
            sides = OPTIONS["facing"].choices
            session.adjust(facing=sides[round(number / 4) % len(sides)])
        else:
            session.adjust(rotation=number)

    fields.option("placement", "Placement", rotation=0, facing=None, turntable=False)
    fields.slider(
        "Rotation",
        OPTIONS["rotation"],
        1,
        lambda: round(session.settings.turned * ROTATIONS / 360),
        rotate,
        lambda number: f"{number * 360 / ROTATIONS:g}°",
    )
    fields.option("pose", "Flag")
    fields.option("shadow", "Shadow")


def _light(session: Session, fields: Fields) -> None:
    chosen = hour_of(session.settings.daylight)

    def hour() -> float:
        # Morning and evening have the same light: the chosen hour is stored beside it.
        daylight = session.settings.daylight
        return chosen if daylight_at(chosen) == daylight else hour_of(daylight)

    def choose(value: float) -> None:
        nonlocal chosen
        chosen = value
        session.adjust(daylight=daylight_at(chosen))

    fields.slider(
        "Time of day",
        OPTIONS["daylight"],
        0.25,
        hour,
        choose,
        lambda hour: f"{int(hour)}:{int(hour % 1 * 60):02d}",
        max=24,
    )
    fields.option("block_light", "Torch light", step=1)
    with _advanced():
        fields.option("sky_light", "Sky light", step=1)
        fields.tick(
            "Shaded",
            lambda: session.settings.light == "game",
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
