"""Skins for tests."""

import numpy as np


def marked(height: int = 64, unit: int = 1) -> np.ndarray:
    """A skin whose texels say where they are: red is x, green is y."""
    rows, columns = np.mgrid[0:height, 0:64]
    texels = np.stack([columns * 4, rows * 4, 0 * rows, 255 + 0 * rows], axis=-1).astype(np.uint8)
    return np.kron(texels, np.ones((unit, unit, 1), np.uint8))
