"""Measures of how much two pictures are perceived to differ."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from drapery.errors import OptionError
from drapery.render import Pixels

MATTE = 128
"""Grey under transparent pixels [sRGB] for measures without alpha."""


def perceptual_measures(expected: Pixels, actual: Pixels) -> dict[str, float]:
    """SSIM, FLIP and CIEDE2000 of two pictures of one size, [H, W, 4], by their names.

    Raises OptionError if the extra `compare` is not installed.
    """
    return {
        "ssim": _ssim(expected, actual),
        "flip": _flip(expected, actual),
        "ciede2000": _ciede2000(expected, actual),
    }


def over_matte(pixels: Pixels, matte: int = MATTE) -> NDArray[np.uint8]:
    """The picture over a grey background, shape [H, W, 3]."""
    alpha = pixels[..., 3:].astype(np.uint16)
    mixed = (pixels[..., :3] * alpha + matte * (255 - alpha) + 127) // 255
    return mixed.astype(np.uint8)


def _ssim(expected: Pixels, actual: Pixels) -> float:
    try:
        from skimage import metrics
    except ImportError:
        raise _missing("SSIM") from None
    side = min(7, *expected.shape[:2])
    window = side if side % 2 else side - 1
    if window < 3:
        return float(np.array_equal(over_matte(expected), over_matte(actual)))
    similarity: Any = metrics.structural_similarity  # its types are incomplete
    pictures = over_matte(expected), over_matte(actual)
    return float(similarity(*pictures, channel_axis=-1, win_size=window))


def _flip(expected: Pixels, actual: Pixels) -> float:
    try:
        import flip_evaluator
    except ImportError:
        raise _missing("FLIP") from None
    pictures = (over_matte(p).astype(np.float32) / 255 for p in (expected, actual))
    _, mean, _ = flip_evaluator.evaluate(*pictures, "LDR")
    return float(mean)


def _missing(metric: str) -> OptionError:
    return OptionError(f'{metric} needs more packages: pip install "drapery[compare]"')


def _ciede2000(expected: Pixels, actual: Pixels) -> float:
    try:
        from skimage import color
    except ImportError:
        raise _missing("CIEDE2000") from None
    labs = (color.rgb2lab(over_matte(picture)) for picture in (expected, actual))
    difference: Any = color.deltaE_ciede2000  # it has no types
    return float(np.mean(difference(*labs)))
