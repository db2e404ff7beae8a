"""Pictures that show where two pictures differ, alone or beside both of them."""

import numpy as np
from PIL import Image

from drapery.arrays import Channels, Pixels
from drapery.comparison.loops import left_out, padded
from drapery.comparison.metrics import BEYOND, SAME, difference_map, eight_bits, errors
from drapery.comparison.painting import (
    GAIN,
    LEAST,
    MOST,
    difference_image,
    shown_scale,
)
from drapery.comparison.tolerance import EXACT, Tolerance
from drapery.render import Frame, contact_sheet
from drapery.render.contact_images import checkered
from drapery.render.frame import enlarge


def difference_panel(
    expected: Channels,
    actual: Channels,
    gain: int = GAIN,
    *,
    tolerance: Tolerance = EXACT,
) -> Pixels:
    """The expected picture in faint grey with errors in red.

    What is within the tolerance is amber. Pictures of two sizes are shown one over the other, from
    their upper left corners.

    expected: sRGB with straight alpha, shape [H, W, 4].
    actual: the picture to compare, shape [H, W, 4].
    gain: errors are multiplied by it.
    tolerance: what counts as a difference.
    """
    old, new = padded(expected, actual)
    ignored = left_out(expected, actual, tolerance)
    kinds = difference_map(old, new, tolerance, ignored=ignored)
    old, new = eight_bits(old), eight_bits(new)
    beyond = np.flatnonzero(kinds == BEYOND)
    (worst,) = errors(*(each.reshape(1, -1, 4)[:, beyond] for each in (old, new)))
    strength = np.zeros(kinds.shape, np.uint8)
    strength.reshape(-1)[beyond] = np.clip(worst.astype(np.int32) * gain, LEAST, MOST)
    within = np.where((kinds != SAME) & (kinds != BEYOND), np.uint8(255), np.uint8(0))
    shown = checkered(Image.fromarray(old))
    panel = difference_image(shown, Image.fromarray(strength), Image.fromarray(within))
    return np.asarray(panel.convert("RGBA"))


def side_by_side(
    expected: Channels,
    actual: Channels,
    labels: tuple[str, str] = ("expected", "actual"),
    *,
    tolerance: Tolerance = EXACT,
) -> Frame:
    """Both pictures and their difference; small pictures are enlarged. See `difference_panel`.

    expected: sRGB with straight alpha, shape [H, W, 4].
    actual: the other picture, shape [H, W, 4].
    labels: those of the two pictures.
    tolerance: what counts as a difference.
    """
    panel = difference_panel(expected, actual, tolerance=tolerance)
    return joined_panels(expected, actual, panel, labels)


def joined_panels(
    expected: Channels,
    actual: Channels,
    panel: Pixels,
    labels: tuple[str, str] = ("expected", "actual"),
) -> Frame:
    """Both pictures and a panel of their difference, side by side.

    expected: sRGB with straight alpha, shape [H, W, 4].
    actual: the other picture, shape [H, W, 4].
    panel: the picture of the difference, shape [H, W, 4], uint8.
    labels: those of the two pictures.
    """
    scale = shown_scale(*panel.shape[:2])
    shown = (*map(eight_bits, padded(expected, actual)), panel)
    named = zip((*labels, "difference"), shown, strict=True)
    return contact_sheet(
        [(label, enlarge(Frame(picture), scale).pixels) for label, picture in named]
    )
