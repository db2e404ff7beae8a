"""The direction of the wind as the page shows it."""

import math

from drapery.cloth import Wind
from drapery.scenes import WIND_AXIS
from drapery.settings import Settings


def heading_of(settings: Settings) -> float:
    """To where the wind blows [degrees], -180..180: 0 is straight out of the front."""
    x, z = WIND_AXIS[0], WIND_AXIS[2]
    if isinstance(settings.wind, Wind):
        x, _, z = settings.wind.velocity
    elif settings.direction is not None:
        return (settings.direction + 180.0) % 360.0 - 180.0
    return math.degrees(math.atan2(x, z))
