"""A loop has no seam: from the last frame to the first cloth moves as between other frames."""

import numpy as np
import pytest

from drapery import Banner, animate
from drapery.banner.packs import open_packs
from drapery.mesh import Array
from drapery.scenes import loop
from drapery.settings import Settings


def moves(settings: Settings, count: int, fps: float = 20.0) -> Array:
    """How far the cloth's fastest vertex moves from each frame to the next, the last to the first
    [m]; shape [count]."""
    scenes = loop(Banner(), open_packs(()), settings, count, fps)
    positions = np.stack([scene.models[-1].mesh.positions for scene in scenes])
    steps = np.linalg.norm(np.roll(positions, -1, axis=0) - positions, axis=-1)
    fastest: Array = steps.max(axis=1)
    return fastest


@pytest.mark.parametrize("wind", [0.0, 1.0, 4.0, 8.0, 12.0])
@pytest.mark.parametrize("seconds", [2.0, 4.0])
def test_the_seam_is_no_larger_than_the_steps_between_frames(wind: float, seconds: float) -> None:
    for seed in range(3):
        settings = Settings(wind=wind, seed=seed, grid=(8, 15))
        steps = moves(settings, round(20 * seconds))
        # The fastest moment of the loop may fall on the seam; a jump there would stand out.
        assert steps[-1] <= 1.1 * steps[:-1].max() + 1e-9


def test_wind_never_lets_the_cloth_rest() -> None:
    steps = moves(Settings(wind=4.0), 80)
    assert np.median(steps) > 1e-3


def test_the_games_own_sway_loops_too() -> None:
    steps = moves(Settings(pose="vanilla"), 100)
    assert steps[-1] <= steps[:-1].max() + 1e-9


def test_pictures_leave_no_seam() -> None:
    frames = animate(Banner.parse("white creeper:lime"), size=(96, 128), seconds=3)
    pixels = np.stack([frame.pixels for frame in frames]).astype(np.int16)
    between = np.abs(np.roll(pixels, -1, axis=0) - pixels).mean(axis=(1, 2, 3))
    assert between[-1] <= between[:-1].max()
