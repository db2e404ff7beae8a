"""A landscape of pixels that repeats as its camera moves along it."""

import numpy as np

from drapery.arrays import Pixels
from drapery.scenes.hero_run import DISTANCE

SKY, HILL, GRASS, EARTH = (146, 192, 232), (122, 172, 206), (104, 162, 84), (120, 86, 62)
GROUND_HEIGHT = 8
"""Height of the ground in the picture [pixels]."""


def landscape(width: int, height: int, ran: float) -> Pixels:
    """Sky, hills that move at half the speed, and ground with stones. ran: the distance run."""
    canvas = np.empty((height, width, 4), np.uint8)
    canvas[..., 3] = 255
    canvas[..., :3] = SKY
    x, y = np.arange(width), np.arange(height)[:, None]
    top = height - GROUND_HEIGHT
    far = (x + round(ran / 2)) % (DISTANCE // 2) / (DISTANCE // 2)
    near = (x + round(ran)) % 20
    hills = top - 5 - np.round(16 * np.abs(far - 0.5)) - np.round(6 * np.abs(far * 3 % 1 - 0.5))
    canvas[y >= hills, :3] = HILL
    canvas[top:, :, :3] = EARTH
    tufts = np.array([3, 2, 2, 3, 4, 3, 2, 2, 3, 3, 2, 4, 3, 2, 2, 2, 3, 4, 3, 2])[near]
    canvas[(y >= top) & (y < top + tufts), :3] = GRASS
    stone = (y >= top + 6) & (y < top + 8) & np.isin(near, (5, 6, 7))
    canvas[stone, :3] = np.array(EARTH) * 3 // 4
    return canvas
