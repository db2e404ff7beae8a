"""Whole-number noise: the same on every machine, and of no generator's version."""

import numpy as np
from numpy.typing import NDArray

Field = NDArray[np.int64]

_WORD = 0xFFFFFFFF


def scatter(x: Field, y: Field, seed: int) -> Field:
    """An even-looking value in 0..65535 for each whole (x, y), shape of their broadcast."""
    word = (x * 374761393 + y * 668265263 + seed * 1274126177) & _WORD
    word = ((word ^ (word >> 13)) * 1103515245) & _WORD
    word = ((word ^ (word >> 15)) * 695872825) & _WORD
    return (word ^ (word >> 16)) & 0xFFFF


def grid(width: int, height: int) -> tuple[Field, Field]:
    """Whole coordinates of a face: x as a row [1, width], y as a column [height, 1]."""
    return np.arange(width)[None, :], np.arange(height)[:, None]
