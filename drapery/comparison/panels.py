"""Pictures that show where two pictures differ, alone or beside both of them."""

import numpy as np

from drapery.comparison.loops import left_out, padded
from drapery.comparison.metrics import BEYOND, SAME, difference_map, eight_bits, errors
from drapery.comparison.tolerance import EXACT, Tolerance
from drapery.picture_pixels import Channels
from drapery.render import Frame, Pixels, contact_sheet, enlarge, on_checker

_WITHIN = np.array((240, 178, 40))
"""The colour of pixels that differ within the tolerance: amber."""


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
    worst = errors(old, new).astype(np.int32)
    luminance = on_checker(old)[..., :3].astype(np.int32).mean(axis=-1)
    faint = (210 + luminance * 45 / 255).astype(np.int32)
    strength = np.clip(worst * gain, 96, 255)
    panel = np.repeat(faint[..., None], 4, axis=-1)
    panel[..., 3] = 255
    red = np.stack([255 - strength // 8, *[224 - strength * 224 // 255] * 2], axis=-1)
    panel[..., :3] = np.where((kinds == BEYOND)[..., None], red, panel[..., :3])
    panel[(kinds != BEYOND) & (kinds != SAME), :3] = _WITHIN
    return panel.astype(np.uint8)


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
