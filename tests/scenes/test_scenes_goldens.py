"""A reviewed picture of each scene, and the sizes of scenes of several pictures."""

import pytest
from scene_helpers import still

from drapery.render.frame import Frame
from drapery.scenes.catalogue import Clip, find_scene, scene_names
from drapery.testing.plugin import Golden

FRAMES = {
    "banner": 8,
    "cape-pixel": 32,
    "freefall": 14,
    "hall": 24,
    "julia": 60,
    "sail": 16,
    "fold": 56,
}
"""The number of frames of the clip whose last is the golden; 3 for other scenes."""
CORNERS = dict.fromkeys(("four-corners", "three-corners", "two-corners"), 12)
WORDS = {"stress": {"side": "5", "settle": "0.5"}, "freefall": {"grid": "12x12"}}


@pytest.mark.parametrize("name", scene_names())
def test_a_scene_looks_as_it_did(name: str, golden: Golden) -> None:
    frames = {**FRAMES, **CORNERS}.get(name, 3)
    golden(still(name, frames, **WORDS.get(name, {})))


@pytest.mark.parametrize("name", ["julia", "cape-pixel", "vanilla"])
@pytest.mark.parametrize("size", [(96, 61), (33, 120)])
def test_pictures_of_parts_are_of_the_size_asked_for(name: str, size: tuple[int, int]) -> None:
    scene = find_scene(name)
    first = next(scene.play(scene.parameters(), Clip(size, 1)))
    if isinstance(first, Frame):
        assert first.pixels.shape[:2] == (size[1], size[0])
    else:
        pixels = [p.pixels.shape[1::-1] if isinstance(p, Frame) else p.size for p in first.pictures]
        assert pixels[0][0] * first.columns in range(size[0] - 1, size[0] + 1)
