"""The display times of frames in whole ticks of a format."""

from collections.abc import Iterator
from fractions import Fraction
from itertools import count


def frame_delays(fps: float, ticks_per_second: int) -> Iterator[int]:
    """Each frame's time in ticks; their sum is never more than half a tick from the true time."""
    step = ticks_per_second / Fraction(fps)
    for frame in count():
        yield round(step * (frame + 1)) - round(step * frame)
