"""What comes and goes on the screen within three frames of a loop: few pixels."""

import numpy as np
import pytest

from drapery import Banner, Settings, animate
from drapery.styles import find_style

FAR, NEAR = 48, 24
"""Levels by which a pixel that flickers differs at least, and the frames beside it at most."""


SKULL, CREEPER = "red skull:white border:yellow gradient_up:blue", "white creeper:lime border:black"


@pytest.mark.parametrize(
    ("name", "written", "most"),
    [
        *((name, SKULL, 0.002) for name in ("boards", "cel", "hatched", "ink")),
        ("cel", CREEPER, 0.0025),
    ],
)
def test_lines_and_tones_move_so_slowly_that_few_pixels_flicker(
    name: str, written: str, most: float
) -> None:
    style = find_style(name)
    apart = max([1, *(dict(step.parameters).get("every", 1) for step in style.steps)])
    design = Banner.parse(written)
    settings = Settings(size=(96, 96))
    loop = animate(design, settings, style=style, seconds=2.0, fps=20.0)
    pixels = np.stack([frame.pixels for frame in loop.frames]).astype(np.float64)
    bright = (pixels[..., :3] * [0.299, 0.587, 0.114]).sum(axis=-1)
    before, after = np.roll(bright, apart, axis=0), np.roll(bright, -apart, axis=0)
    shown = (pixels[..., 3] > 0).all(axis=0)
    leaves = np.minimum(abs(bright - before), abs(bright - after)) > FAR
    flickers = leaves & (abs(before - after) < NEAR)
    assert flickers[:, shown].mean() < most
