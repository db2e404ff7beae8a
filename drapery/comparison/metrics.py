"""Measures of the difference between two pictures."""

from dataclasses import asdict, dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from drapery.errors import OptionError
from drapery.render import Pixels

MATTE = 128
"""Grey under transparent pixels [sRGB] for metrics without alpha."""


@dataclass(frozen=True)
class Difference:
    """The difference between a picture and the expected one.

    pixels: number of pixels of each picture. changed: number of pixels that differ.
    max_error, mean_error: largest and average error over the channels of all pixels, 0..255.
    ssim: structural similarity (Wang et al. 2004), 1 for equal pictures.
    flip: mean FLIP error (Andersson et al. 2020), 0 for equal pictures.
    The last two are None unless `measure` is called with `perceptual`.
    """

    pixels: int
    changed: int
    max_error: int
    mean_error: float
    ssim: float | None = None
    flip: float | None = None

    @property
    def same(self) -> bool:
        return self.changed == 0

    def as_dict(self) -> dict[str, float | int | None]:
        return asdict(self)


def errors(expected: Pixels, actual: Pixels) -> NDArray[np.uint8]:
    """The largest channel error of each pixel, shape [H, W].

    The colour of transparent pixels does not count. Raises OptionError if the sizes differ.
    """
    if expected.shape != actual.shape:
        raise OptionError(
            f"the pictures' sizes differ: {_size(expected)} and {_size(actual)};"
            " compare pictures of one size"
        )
    difference = np.abs(seen(expected).astype(np.int16) - seen(actual))
    worst: NDArray[np.uint8] = difference.max(axis=-1).astype(np.uint8)
    return worst


def measure(
    expected: Pixels, actual: Pixels, *, slack: int = 0, perceptual: bool = False
) -> Difference:
    """Measure a picture, [H, W, 4] uint8 sRGB with straight alpha, against the expected one.

    slack: a pixel counts as changed if the error of a channel is greater than this, 0..255.
    perceptual: SSIM and FLIP as well; they take longer and need the `compare` extra.
    Raises OptionError if the sizes differ or the extra is not installed.
    """
    worst = errors(expected, actual)
    exact = np.abs(seen(expected).astype(np.int16) - seen(actual))
    return Difference(
        pixels=worst.size,
        changed=int(np.count_nonzero(worst > slack)),
        max_error=int(worst.max(initial=0)),
        mean_error=float(exact.mean(dtype=np.float64)) if exact.size else 0.0,
        ssim=_ssim(expected, actual) if perceptual else None,
        flip=_flip(expected, actual) if perceptual else None,
    )


def seen(pixels: Pixels) -> Pixels:
    """Pictures with the colour of transparent pixels set to 0, shape [..., 4]."""
    seen: Pixels = pixels * (pixels[..., 3:] > 0)
    return seen


def _size(pixels: Pixels) -> str:
    return f"{pixels.shape[1]}x{pixels.shape[0]}"


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
