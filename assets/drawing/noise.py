"""Integer noise: the same on every machine and with every version of numpy."""

import numpy as np
from numpy.typing import NDArray

Field = NDArray[np.int64]

_WORD = 0xFFFFFFFF


def scatter(x: Field, y: Field, seed: int) -> Field:
    """A hash in 0..65535 for each integer (x, y), in the shape of their broadcast."""
    word = (x * 374761393 + y * 668265263 + seed * 1274126177) & _WORD
    word = ((word ^ (word >> 13)) * 1103515245) & _WORD
    word = ((word ^ (word >> 15)) * 695872825) & _WORD
    return (word ^ (word >> 16)) & 0xFFFF


def grid(width: int, height: int) -> tuple[Field, Field]:
    """Whole coordinates of a face: x as a row [1, width], y as a column [height, 1]."""
    return np.arange(width)[None, :], np.arange(height)[:, None]


def speckle(width: int, height: int, seed: int) -> Field:
    """A separate random value for each texel, shape [height, width]."""
    x, y = grid(width, height)
    return scatter(x, y, seed)


def blurred(values: Field, across: int, down: int) -> Field:
    """Sums over windows of `across` x `down` texels that wrap around, so that tiles still meet."""
    wide = sum((np.roll(values, shift, 1) for shift in range(across)), np.zeros_like(values))
    return sum((np.roll(wide, shift, 0) for shift in range(down)), np.zeros_like(values))


def ranked(values: Field, shares: tuple[int, ...]) -> Field:
    """Tone numbers by rank: the lowest shares[0] parts get 0, the next shares[1] parts 1, ..."""
    order = np.argsort(values, axis=None, kind="stable")
    bounds = np.cumsum(shares) * values.size // sum(shares)
    tones = np.empty(values.size, np.int64)
    tones[order] = np.searchsorted(bounds, np.arange(values.size), side="right")
    return tones.reshape(values.shape)
