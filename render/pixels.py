"""The type of finished pixels, and of whatever has them."""

from typing import Protocol

import numpy as np
from numpy.typing import NDArray

Pixels = NDArray[np.uint8]
"""sRGB with straight alpha, shape [H, W, 4], top row first."""


class HasPixels(Protocol):
    """A finished picture, as the encoders take it; `Frame` is one."""

    @property
    def pixels(self) -> Pixels: ...
