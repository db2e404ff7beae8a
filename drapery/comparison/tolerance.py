"""How far two pictures may differ and still agree."""

import math
from dataclasses import dataclass

from drapery.errors import OptionError

Box = tuple[int, int, int, int]
"""Left, top, width and height [px]."""


@dataclass(frozen=True)
class Tolerance:
    """How far a picture may differ; by default not at all. Raises OptionError out of range.

    channel: channel errors up to this value, 0..255, do not count.
    pixels: the number of pixels of each frame that may have larger errors, 0 or more.
    ratio: the share of the pixels of each frame that may, 0..1; the larger of both numbers holds.
    colour: a pixel counts only if its perceived difference is above this, 0..1; None for any.
        Kotsarenko and Ramos (2010), "Measuring perceived color difference using YIQ NTSC
        transmission color space in mobile applications"; no two colours differ by more than 1.
    antialiasing: whether pixels of smoothed edges count; see `drapery.comparison.antialiasing`.
    ignore: boxes of pixels that do not count.
    flip, ciede2000: the largest mean FLIP error and mean colour difference. ssim: the least
        structural similarity. None for any.
    """

    channel: int = 0
    pixels: int = 0
    ratio: float = 0.0
    colour: float | None = None
    antialiasing: bool = True
    ignore: tuple[Box, ...] = ()
    flip: float | None = None
    ssim: float | None = None
    ciede2000: float | None = None

    def __post_init__(self) -> None:
        if not (0 <= self.channel <= 255 and self.pixels >= 0):
            raise OptionError(
                f"tolerance {self.channel} of {self.pixels} pixels is out of range;"
                " use 0 to 255, and 0 or more pixels"
            )
        for name, most in {"ratio": 1, "colour": 1, "flip": 1, "ssim": 1, "ciede2000": 200}.items():
            value = getattr(self, name)
            if value is not None and not (math.isfinite(value) and 0 <= value <= most):
                raise OptionError(f"{name} {value} is out of range; use 0 to {most}")
        for box in self.ignore:
            if len(box) != 4 or min(box) < 0 or 0 in box[2:]:
                raise OptionError(
                    f"ignored box {box} is not left, top, width, height in pixels; use 0 or more,"
                    " and at least 1 for the size"
                )

    @property
    def perceptual(self) -> bool:
        """Whether a limit needs the perceptual measures."""
        return any(limit is not None for limit in (self.flip, self.ssim, self.ciede2000))

    def allowed(self, pixels: int) -> int:
        """How many of a frame's pixels may be beyond the tolerance of a pixel."""
        return max(self.pixels, math.floor(self.ratio * pixels + 1e-9))

    def limits(self) -> dict[str, object]:
        """The limits that differ from those of an exact comparison, by their names."""
        exact = Tolerance()
        return {name: value for name, value in vars(self).items() if value != getattr(exact, name)}


EXACT = Tolerance()
"""The tolerance of a comparison in which each difference counts."""
