"""The type of finished pixels, and the protocol of objects that have them."""

from typing import Protocol

import numpy as np
from numpy.typing import NDArray

Pixels = NDArray[np.uint8]
"""sRGB with straight alpha, shape [H, W, 4], top row first."""


class HasPixels(Protocol):
    """A finished picture for the encoders, such as a `Frame`."""

    @property
    def pixels(self) -> Pixels: ...
