"""The difference of two pictures of any sizes, and of loops, frame by frame."""

import math
from collections.abc import Iterator
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from drapery.arrays import Channels
from drapery.comparison.difference import Difference, box_around
from drapery.comparison.ignored import ignored_pixels
from drapery.comparison.metrics import measure
from drapery.comparison.picture import Picture, times
from drapery.comparison.tolerance import EXACT, Tolerance
from drapery.comparison.words import named_frames
from drapery.errors import counted


def measure_pictures(
    expected: Picture,
    actual: Picture,
    tolerance: Tolerance = EXACT,
    *,
    perceptual: bool = False,
) -> Difference:
    """Measure a picture against the expected one; see `measure`.

    Pictures of other sizes or lengths are different; what both have is compared.

    expected: a still or a loop.
    actual: the still or loop to measure.
    tolerance: what counts as a difference.
    perceptual: measures SSIM, FLIP and CIEDE2000 too.

    Raises OptionError for a mask of another size than both, or a box outside the larger picture.
    """
    unlike = tuple(_unlike(expected, actual))
    found = [
        measure(old, new, tolerance, ignored=ignored, perceptual=perceptual)
        for old, new, ignored in _pairs(expected, actual, tolerance)
    ]
    return replace(_joined(found), unlike=unlike)


def _pairs(
    expected: Picture, actual: Picture, tolerance: Tolerance
) -> Iterator[tuple[Channels, Channels, NDArray[np.bool_] | None]]:
    # All frames of a picture have one size.
    ignored = left_out(expected.frames[0], actual.frames[0], tolerance)
    for old, new in zip(expected.frames, actual.frames, strict=False):
        yield *padded(old, new), ignored


def left_out(a: Channels, b: Channels, tolerance: Tolerance) -> NDArray[np.bool_] | None:
    """Which pixels of two padded pictures do not count; None if all do. Raises OptionError."""
    height, width = (max(sizes) for sizes in zip(a.shape[:2], b.shape[:2], strict=True))
    mask = tolerance.mask
    if mask is not None and mask.shape in (a.shape[:2], b.shape[:2]):
        mask = np.pad(mask, ((0, height - mask.shape[0]), (0, width - mask.shape[1])))
    return ignored_pixels((height, width), tolerance.ignore, mask)


def padded(a: Channels, b: Channels) -> tuple[Channels, Channels]:
    """Two pictures with transparent pixels to the right and below, so that their sizes agree.

    a: the first picture, shape [H, W, 4].
    b: the second picture, shape [H, W, 4].
    """
    if a.shape == b.shape:
        return a, b
    height, width = (max(sizes) for sizes in zip(a.shape[:2], b.shape[:2], strict=True))
    both = []
    for pixels in (a, b):
        room = (0, height - pixels.shape[0]), (0, width - pixels.shape[1]), (0, 0)
        both.append(np.pad(pixels, room))
    return both[0], both[1]


def _unlike(a: Picture, b: Picture) -> Iterator[str]:
    """What differs beside the pixels."""
    if a.size != b.size:
        sizes = (f"{width}x{height}" for width, height in (a.size, b.size))
        yield f"the sizes {' and '.join(sizes)}"
    if len(a.frames) != len(b.frames):
        yield f"{counted(len(a.frames), 'frame')} and {counted(len(b.frames), 'frame')}"
    elif a.delays and b.delays:
        # A file holds the time of a frame as a fraction of small numbers.
        pairs = enumerate(zip(a.delays, b.delays, strict=True), 1)
        other = [number for number, times in pairs if not math.isclose(*times, rel_tol=1e-3)]
        if other:
            first = other[0] - 1
            yield (
                f"the time of {named_frames(other)}"
                f" ({1000 * a.delays[first]:.4g} and {1000 * b.delays[first]:.4g} ms)"
            )
        if a.plays != b.plays:
            yield f"played {times(a.plays)} and {times(b.plays)}"


def _joined(found: list[Difference]) -> Difference:
    """The difference of a loop from those of its frames; of a still its own."""
    if len(found) == 1:
        return found[0]
    pixels = sum(each.pixels for each in found)
    return Difference(
        pixels=pixels,
        changed=sum(each.changed for each in found),
        max_error=max(each.max_error for each in found),
        mean_error=sum(each.mean_error * each.pixels for each in found) / pixels,
        beyond=sum(each.beyond for each in found),
        allowed=sum(each.allowed for each in found),
        smoothed=sum(each.smoothed for each in found),
        ignored=sum(each.ignored for each in found),
        hidden=sum(each.hidden for each in found),
        box=box_around(each.box for each in found if each.box and (each.beyond or not _any(found))),
        exceeded=next((each.exceeded for each in found if each.exceeded), ()),
        frames=tuple(number for number, each in enumerate(found, 1) if not each.agrees),
        ssim=_worst([each.ssim for each in found], least=True),
        flip=_worst([each.flip for each in found]),
        ciede2000=_worst([each.ciede2000 for each in found]),
    )


def _any(found: list[Difference]) -> bool:
    return any(each.beyond for each in found)


def _worst(values: list[float | None], least: bool = False) -> float | None:
    known = [value for value in values if value is not None]
    return (min if least else max)(known) if known else None
