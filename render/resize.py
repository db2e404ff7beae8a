"""Larger pictures of the same pixels."""

from drapery.errors import OptionError
from drapery.render.frame import Frame

MAX_SIDE = 16384


def enlarge(frame: Frame, times: int) -> Frame:
    """The frame with each pixel as a square of times x times pixels.

    Raises OptionError if the result would be wider or higher than MAX_SIDE.
    """
    height, width = frame.pixels.shape[:2]
    if times < 1 or max(height, width) * times > MAX_SIDE:
        raise OptionError(
            f"a picture of {width}x{height} cannot be enlarged {times} times;"
            f" use 1 to {max(1, MAX_SIDE // max(height, width))}"
        )
    return Frame(frame.pixels.repeat(times, axis=0).repeat(times, axis=1))
