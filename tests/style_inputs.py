"""What steps of styles are given: cloth in waves, and a drawn picture."""

import numpy as np

from drapery.cloth import grid
from drapery.mesh import Array
from drapery.render import Buffers
from drapery.style import FLAG_MAPPING, FLAG_SIZE
from drapery.style.grids import grid_shell
from drapery.styles import Canvas, Piece

TEXEL = 1 / 24
"""A texel of a flag [m]."""


def rippled(rows: int = 9, columns: int = 5) -> tuple[Piece, Array]:
    """A flag that hangs in shallow waves."""
    rest = grid(columns, rows, *FLAG_SIZE).rest_positions
    waves = 0.1 * np.sin(4 * rest[:, 1:2] + 2 * rest[:, :1]) * [0.2, 0.1, 1]
    return Piece(grid_shell(rows, columns, FLAG_MAPPING), TEXEL, TEXEL, FLAG_SIZE), rest + waves


def canvas(height: int = 30, width: int = 40) -> Canvas:
    """A ramp of colours, whose left half shows a model."""
    pixels = np.full((height, width, 4), 255, np.uint8)
    pixels[..., 0] = np.arange(width) * 6
    pixels[..., 1] = np.arange(height)[:, None] * 8
    shown = np.broadcast_to(np.arange(width) < width // 2, (height, width))
    normal = np.where(shown[..., None], np.float32([0, 0, 1]), np.float32(0))
    depth = np.where(shown, np.float32(3), np.float32(np.inf))
    model, uv = np.where(shown, 0, -1).astype(np.int32), np.zeros((height, width, 2), np.float32)
    return Canvas(pixels, lambda: Buffers(depth, normal, model, uv, model))
