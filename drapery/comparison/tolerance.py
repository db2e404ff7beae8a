"""How far two pictures may differ and still agree."""

import math
from dataclasses import dataclass, fields
from typing import TYPE_CHECKING, Any

from drapery.comparison.limits import LIMIT_OPTIONS, Box, is_box
from drapery.errors import OptionError

if TYPE_CHECKING:
    from drapery.arrays import Mask


@dataclass(frozen=True, eq=False)
class Tolerance:
    """How far a picture may differ; by default not at all.

    channel: channel errors up to this value, 0..255, do not count.
    pixels: the number of pixels of each frame that may have larger errors, 0 or more.
    ratio: the share of the pixels of each frame that may, 0..1; the larger of both numbers holds.
    colour: a pixel counts only if its perceived difference is above this, 0..1; None for any.
        Kotsarenko and Ramos (2010), "Measuring perceived color difference using YIQ NTSC
        transmission color space in mobile applications"; no two colours differ by more than 1.
    antialiasing: whether pixels of smoothed edges count; see `drapery.comparison.antialiasing`.
    ignore: boxes of pixels that do not count.
    mask: further pixels that do not count, shape [H, W].
    flip: the largest mean FLIP error; None for any.
    ssim: the least structural similarity; None for any.
    ciede2000: the largest mean colour difference; None for any.

    Raises OptionError for a limit out of range.
    """

    channel: int = 0
    pixels: int = 0
    ratio: float = 0.0
    colour: float | None = None
    antialiasing: bool = True
    ignore: tuple[Box, ...] = ()
    mask: "Mask | None" = None
    flip: float | None = None
    ssim: float | None = None
    ciede2000: float | None = None

    def __post_init__(self) -> None:
        for name, value in self._named().items():
            if name not in ("ignore", "mask"):
                LIMIT_OPTIONS[name].check(value)
        for box in self.ignore:
            if not is_box(box) or min(box) < 0 or 0 in box[2:]:
                raise OptionError(
                    f"ignore {box} is not a box: left, top, width, height in pixels; use 0 or more,"
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
        """The limits that differ from those of an exact comparison, by the names of options.

        A mask is the number of its pixels.
        """
        given = self._named()
        if self.mask is not None:
            given["mask"] = int(self.mask.sum())
        return {name: v for name, v in given.items() if v != LIMIT_OPTIONS[name].default}

    def _named(self) -> dict[str, Any]:
        """The limits by the names of options."""
        values = {field.name: getattr(self, field.name) for field in fields(self)}
        return {"tolerance": values.pop("channel")} | values


EXACT = Tolerance()
"""The tolerance of a comparison in which each difference counts."""
