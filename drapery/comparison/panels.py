"""Pictures that show where two pictures differ, alone or beside both of them."""

import numpy as np

from drapery.comparison.loops import left_out, padded
from drapery.comparison.metrics import BEYOND, difference_map, eight_bits, errors
from drapery.comparison.tolerance import EXACT, Tolerance
from drapery.picture_pixels import Channels
from drapery.render import Frame, Pixels, contact_sheet, enlarge, on_checker

_WITHIN = np.array((240, 178, 40))
"""The colour of pixels that differ within the tolerance: amber."""
_FAINT = (210 + np.arange(3 * 255 + 1) / 3 * 45 / 255).astype(np.uint8)
"""The faint grey of a pixel, by the sum of its red, green and blue."""


def difference_panel(
    expected: Channels,
    actual: Channels,
    gain: int = 8,
    *,
    tolerance: Tolerance = EXACT,
) -> Pixels:
    """The expected picture in faint grey with errors in red, multiplied by `gain`.

    What is within the tolerance is amber. Pictures of two sizes are shown one over the other, from
    their upper left corners.
    """
    old, new = padded(expected, actual)
    ignored = left_out(expected, actual, tolerance)
    kinds = difference_map(old, new, tolerance, ignored=ignored)
    old, new = eight_bits(old), eight_bits(new)
    panel = np.full(old.shape, 255, np.uint8)
    shown = on_checker(old)
    brightness = shown[..., 0].astype(np.uint16) + shown[..., 1] + shown[..., 2]
    panel[..., :3] = _FAINT[brightness][..., None]
    places = np.flatnonzero(kinds)
    beyond = places[kinds.reshape(-1)[places] == BEYOND]
    (worst,) = errors(*(each.reshape(1, -1, 4)[:, beyond] for each in (old, new)))
    strength = np.clip(worst.astype(np.int32) * gain, 96, 255)
    pixels = panel.reshape(-1, 4)
    pixels[places, :3] = _WITHIN
    pixels[beyond, :3] = np.stack([255 - strength // 8, *[224 - strength * 224 // 255] * 2], -1)
    return panel


def side_by_side(
    expected: Channels,
    actual: Channels,
    labels: tuple[str, str] = ("expected", "actual"),
    *,
    tolerance: Tolerance = EXACT,
) -> Frame:
    """Both pictures and their difference; small pictures are enlarged. See `difference_panel`."""
    panel = difference_panel(expected, actual, tolerance=tolerance)
    return joined_panels(expected, actual, panel, labels)


def joined_panels(
    expected: Channels,
    actual: Channels,
    panel: Pixels,
    labels: tuple[str, str] = ("expected", "actual"),
) -> Frame:
    """Both pictures and a panel of their difference."""
    scale = max(1, 256 // max(panel.shape[:2]))
    shown = (*map(eight_bits, padded(expected, actual)), panel)
    named = zip((*labels, "difference"), shown, strict=True)
    return contact_sheet(
        [(label, enlarge(Frame(picture), scale).pixels) for label, picture in named]
    )
