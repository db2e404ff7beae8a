"""The wind of the live cloth: sliders or keys set it, and it changes without a jump."""

from collections.abc import Iterable
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np

from drapery.cloth import Wind
from drapery.scenes import WIND_AXIS, wind_of
from drapery.settings import MAX_GUSTS, MAX_WIND, Settings

DEFAULT_HEADING = float(np.degrees(np.arctan2(WIND_AXIS[0], WIND_AXIS[2])))
"""The direction to which a picture's wind blows [degrees]; 0 is straight out of the front."""
TURN_RATE = 150.0
"""How fast the keys turn the wind [degrees/s]."""
SPEED_RATE = 5.0
"""How fast the keys change the wind's speed [m/s²]."""
KEY_DIRECTIONS = {"w": 180.0, "s": 0.0, "a": -90.0, "d": 90.0}
"""The direction of each key, seen by the viewer: away, towards, left, right [degrees]."""
KEYS = (*KEY_DIRECTIONS, "q", "e")
PHASES = 1 << 16
"""The number of gust phases that `carried_on` compares."""


@dataclass(frozen=True)
class WindControls:
    """The wind. settings: the options that affect it, as numbers. on: whether it blows."""

    settings: Settings = field(default_factory=Settings)
    on: bool = True

    @property
    def speed(self) -> float:
        """Mean speed of the wind while it blows [m/s]."""
        return self.settings.wind_speed

    @property
    def heading(self) -> float:
        """The direction to which the wind blows [degrees], -180..180; 0 is away from the front."""
        direction = self.settings.direction
        return DEFAULT_HEADING if direction is None else around(direction)

    @property
    def wind(self) -> Wind:
        """The wind on a cloth, in the cloth's frame; bit-identical to the wind of pictures."""
        return wind_of(self.settings if self.on else self.settings.changed(wind=0.0))

    def changed(self, **options: Any) -> "WindControls":
        """The controls with other values of options. Raises OptionError."""
        return replace(self, settings=self.settings.changed(**options))


def wind_controls_of(settings: Settings, on: bool = True) -> WindControls:
    """The wind of a picture; for a `Wind` object, the values that these controls can set."""
    wind = settings.wind
    if isinstance(wind, Wind):
        x, _, z = wind.velocity
        heading = float(np.degrees(np.arctan2(x, z)))
        speed, gusts = min(_speed(wind), MAX_WIND), min(wind.gusts, MAX_GUSTS)
        known = Settings(wind=speed, direction=heading, gusts=gusts, seed=wind.seed % 2**32)
        return WindControls(known, on)
    return WindControls(settings.only("wind"), on)


def steered(
    controls: WindControls, keys: Iterable[str], azimuth: float, seconds: float
) -> WindControls:
    """The controls after keys have been held for a time [s].

    w, a, s, d turn the wind away from the viewer, to the left, towards the viewer, to the right;
    q and e make it weaker and stronger. azimuth: the viewer's azimuth about the banner [degrees].
    """
    pressed = set(keys)
    towards = [
        np.radians(azimuth + KEY_DIRECTIONS[key]) for key in KEY_DIRECTIONS if key in pressed
    ]
    x, z = sum(map(np.sin, towards)), sum(map(np.cos, towards))
    if x * x + z * z > 1e-6:
        rest = around(float(np.degrees(np.arctan2(x, z))) - controls.heading)
        limit = TURN_RATE * seconds
        heading = around(controls.heading + min(max(rest, -limit), limit))
        controls = controls.changed(direction=heading)
    rise = SPEED_RATE * seconds * (("e" in pressed) - ("q" in pressed))
    return controls.changed(wind=min(max(controls.speed + rise, 0.0), MAX_WIND))


def around(degrees: float) -> float:
    """The same direction as -180..180."""
    return (degrees + 180.0) % 360.0 - 180.0


def carried_on(before: Wind, after: Wind, time: float) -> Wind:
    """A wind that replaces another at a time [s] and continues its gusts and swell.

    Gusts travel with the wind, so a change of only the speed would jump to other gusts. Several
    phases continue the swell; the result has the one of them that continues the gusts best.
    """
    phase = float(np.asarray(before.phases))
    old, new = (_speed(wind) / wind.gust_size for wind in (before, after))
    if new in (0.0, old) or old == 0.0:
        return replace(after, phases=phase)
    later = phase + after.sine_period * np.arange(PHASES)
    # The gust pattern repeats after a length of 4096 gust sizes.
    apart = (time + later) * new - (time + phase) * old
    apart -= 4096.0 * np.round(apart / 4096.0)
    return replace(after, phases=float(later[np.argmin(np.abs(apart))]))


def _speed(wind: Wind) -> float:
    return float(np.sqrt(np.sum(np.square(wind.velocity))))
