"""What was found between a picture and the expected one."""

from collections.abc import Iterable
from dataclasses import asdict, dataclass
from typing import Any

from drapery.comparison.limits import Box


@dataclass(frozen=True)
class Difference:
    """The difference between a picture and the expected one.

    pixels: number of pixels of each picture.
    changed: number of pixels that differ.
    max_error: largest error over the channels of all pixels, 0..255; a part of 1 where both
        pictures have 16 bits a channel.
    mean_error: average error over the channels of all pixels, as `max_error`.
    beyond: number of pixels beyond the tolerance of a pixel.
    allowed: how many pixels may be beyond it.
    smoothed: number of pixels of smoothed edges that do not count.
    ignored: number of pixels that are left out.
    hidden: number of pixels of which only the colour behind full transparency differs.
    box: left, top, width and height of the area of the pixels that are beyond, or of all that
        differ if none is; None if none differs.
    exceeded: the perceptual limits that are exceeded, in words.
    unlike: what differs beside the pixels, in words: sizes, the number of frames, their times.
    frames: the numbers of the frames that do not agree, from 1; empty for stills. The counts of a
        loop are those of all its frames.
    ssim: structural similarity (Wang et al. 2004), 1 for equal pictures; None unless it was
        requested or is a limit.
    flip: mean FLIP error (Andersson et al. 2020), 0 for equal pictures; None as `ssim`.
    ciede2000: mean colour difference (Sharma, Wu, Dalal 2005), 0 for equal pictures; None as
        `ssim`.
    """

    pixels: int
    changed: int
    max_error: float
    mean_error: float
    beyond: int = 0
    allowed: int = 0
    smoothed: int = 0
    ignored: int = 0
    hidden: int = 0
    box: Box | None = None
    exceeded: tuple[str, ...] = ()
    unlike: tuple[str, ...] = ()
    frames: tuple[int, ...] = ()
    ssim: float | None = None
    flip: float | None = None
    ciede2000: float | None = None

    @property
    def same(self) -> bool:
        """Whether nothing differs to the eye."""
        return self.changed == 0 and not self.unlike

    @property
    def exact(self) -> bool:
        """Whether all bits are the same."""
        return self.same and self.hidden == 0 and self.ignored == 0

    @property
    def agrees(self) -> bool:
        """Whether the pictures agree within the tolerance."""
        return self.beyond <= self.allowed and not (self.exceeded or self.unlike or self.frames)

    @property
    def verdict(self) -> str:
        """ "same", "within" the tolerance, or "different"."""
        if not self.agrees:
            return "different"
        return "same" if self.same else "within"

    def as_dict(self) -> dict[str, Any]:
        return {"verdict": self.verdict, "same": self.same} | asdict(self)


def box_around(boxes: Iterable[Box]) -> Box | None:
    """The box around boxes; None if there are none."""
    found = list(boxes)
    if not found:
        return None
    left, top = min(box[0] for box in found), min(box[1] for box in found)
    right = max(box[0] + box[2] for box in found)
    return left, top, right - left, max(box[1] + box[3] for box in found) - top
