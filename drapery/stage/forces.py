"""The wind of a picture, and the forces on the cloth in it."""

import math
from dataclasses import replace
from functools import lru_cache

import numpy as np

from drapery.cloth import FABRICS, Cloth, Fabric, Force, Gravity, Wind
from drapery.render.vectors import unit
from drapery.settings import Settings

WIND_AXIS = (0.35, 0.0, 1.0)
"""Where the wind blows to unless a direction is given: to the front and a little to the right."""
RIPPLES, VORTICES = 2.5, 0.75
"""Ripples and vortices of a picture's wind, over the strength of its gusts."""
RIPPLE_SIZE = 0.5
"""Middle length of the ripples [m]: of eddies behind a pole or bar 1/12 to 1/8 m thick."""
AIR = 1.2 * RIPPLE_SIZE / math.pi
"""Mass of the air that moves with the cloth under such a ripple [kg/m²]: its density over the wave
number, on each face (Lamb, "Hydrodynamics", § 231)."""
LEE = 0.4
"""Behind a wall the wind across it keeps this part of its speed. Backflow behind a step reaches
over 20 % of the free flow: Eaton, Johnston, AIAA J. 19 (1981)."""
LEAST_GUSTS, ALONG = 1e-3, 1e-6
"""The least gusts of a wind that runs along flat cloth, and the part of it across the cloth up to
which it does: steady, it would leave the cloth perfectly flat at any speed."""


def flow(speed: float, direction: float | None) -> tuple[float, float, float]:
    """The mean wind on a body that is not turned [m/s].

    speed: of the wind [m/s].
    direction: where it blows to [degrees], see `Settings`.
    """
    along = unit(np.array(WIND_AXIS))
    if direction is not None:
        heading = math.radians(direction)
        along = np.array([math.sin(heading), 0.0, math.cos(heading)])
    x, y, z = speed * along
    return float(x), float(y), float(z)


def wind_of(settings: Settings, period: float | None = None) -> Wind:
    """The wind of the settings, in the frame of the panels; its ripples are as strong as its gusts.

    settings: the options of the picture.
    period: it repeats after this time [s]; all else of a Wind that is given stays.
    """
    given, gusts = settings.wind, settings.gusts
    if isinstance(given, Wind):
        return given if period is None else replace(given, period=period)
    x, y, z = flow(given, settings.direction)
    return Wind(
        (x, y, z),
        gusts=max(gusts, LEAST_GUSTS if abs(z) < ALONG * given else 0.0),
        seed=settings.seed,
        period=period,
        ripples=RIPPLES * gusts * _ripple_share(settings.fabric),
        ripple_size=RIPPLE_SIZE,
        vortices=VORTICES * gusts,
    )


def wind_on_wearer(settings: Settings, speed: float, period: float | None = None) -> Wind:
    """The wind of the settings in the frame of a wearer, which sheds no eddies of a pole.

    settings: the options of the picture; a Wind of theirs stays as it is.
    speed: at which the wearer walks to its front [m/s].
    period: see `wind_of`.
    """
    wind = wind_of(settings, period)
    if isinstance(settings.wind, Wind):
        return wind
    x, y, z = wind.velocity
    return replace(wind, velocity=(x, y, z - speed), ripples=0.0, vortices=0.0)


def _ripple_share(fabric: str | Fabric) -> float:
    """The ripples on a fabric over those on wool, 1 for heavier ones.

    A ripple also moves the air beside the cloth, so cloth of a sixth of the mass is accelerated
    2.5 times as much, not six times.
    """
    density = (FABRICS[fabric] if isinstance(fabric, str) else fabric).density
    moved, wool = (mass / (mass + AIR) for mass in (density, FABRICS["wool"].density))
    return min(1.0, moved / wool)


def forces_of(settings: Settings, wind: Wind) -> tuple[Force, ...]:
    """All forces on the cloth: gravity, the wind at the cloth, and those that the settings add."""
    lee = lee_of(settings)
    return (Gravity(), wind if lee == 1.0 else in_lee(wind, lee), *settings.forces)


def lee_of(settings: Settings) -> float:
    """The share of the free wind across the cloth, along the z of its panel, that reaches it.

    A wall shelters its banner, unless the settings have a Wind of their own.
    """
    sheltered = settings.placement == "wall" and not isinstance(settings.wind, Wind)
    return LEE if sheltered else 1.0


@lru_cache(maxsize=64)
def in_lee(wind: Wind, lee: float) -> Wind:
    """The wind of which this share across the cloth is left; the same object for the same wind."""
    x, y, z = wind.velocity
    return replace(wind, velocity=(x, y, lee * z))


def in_wind(cloth: Cloth, wind: Wind) -> tuple[Force, ...]:
    """Gravity and the wind on a cloth. The drag of a fabric is that in moving air, so it pulls
    cloth along: drag * (wind - v) is a constant push beside the drag in still air."""
    x, y, z = wind.velocity
    drag = cloth.drag
    return (Gravity(), wind, *((Gravity((drag * x, drag * y, drag * z)),) if drag else ()))
