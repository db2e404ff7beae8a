"""pyrender shows LabPBR maps: slopes, metal and glow; the outline stays that of any backend."""

import numpy as np
import pytest
from relief_shapes import LEVEL, WHITE, board, scene_of, slope

from drapery.errors import BackendError
from drapery.render import gl
from drapery.render.light import Light
from drapery.render.scene import Scene, TextureLayer
from drapery.style.block import turn

FROM_ABOVE = Light(((0.0, 1.0, 1.0),), 0.3, 0.6)


@pytest.fixture(scope="module", autouse=True)
def opengl() -> None:
    try:
        gl.describe()
    except BackendError as error:
        pytest.skip(f"OpenGL is not compared: {error}")


def matter(smooth: int = 0, metal: int = 0, glow: int = 255) -> np.ndarray:
    return np.broadcast_to(np.array([smooth, metal, 0, glow], np.uint8), (4, 4, 4))


def shade(*layers: TextureLayer) -> float:
    """The mean of a board's middle under a lamp from above."""
    pixels = gl.draw_scene(scene_of(board(), *layers, light=FROM_ABOVE)).pixels
    assert (pixels[..., 3] == 255).all()
    return float(pixels[2:6, 2:6, :3].mean())


GREY = np.full_like(WHITE, 140)
GREY[..., 3] = 255


def test_slopes_face_the_lamp_or_turn_away() -> None:
    shades = [
        shade(TextureLayer(GREY, normal=slope(0, down))) for down in (-0.6, -0.3, 0, 0.3, 0.6)
    ]
    assert shades == sorted(shades, reverse=True) and shades[0] > shades[-1] + 40


def test_a_level_dull_map_is_near_the_games_own_shade() -> None:
    plain = shade(TextureLayer(GREY))
    assert shade(TextureLayer(GREY, normal=LEVEL)) == pytest.approx(plain, rel=0.12)


def test_metal_reflects_and_glow_shines() -> None:
    dull = shade(TextureLayer(GREY, normal=LEVEL, specular=matter()))
    assert shade(TextureLayer(GREY, normal=LEVEL, specular=matter(metal=255))) < dull - 10
    glowing = [
        shade(TextureLayer(GREY, normal=LEVEL, specular=matter(glow=g))) for g in (0, 120, 254)
    ]
    assert glowing == sorted(glowing) and glowing[0] == pytest.approx(dull, abs=1)
    assert glowing[2] > dull + 20


def test_it_covers_the_same_pixels() -> None:
    for degrees in (0, 30, 70):
        flat, mapped = (
            gl.draw_scene(scene_of(turn(board(), degrees), TextureLayer(WHITE, normal=normal)))
            for normal in (None, LEVEL)
        )
        assert np.array_equal(flat.pixels[..., 3], mapped.pixels[..., 3])


def test_it_takes_turns_with_scenes_that_have_no_maps() -> None:
    def both() -> list[bytes]:
        scenes: list[Scene] = [
            scene_of(board(), TextureLayer(GREY)),
            scene_of(board(), TextureLayer(GREY, normal=LEVEL)),
        ]
        return [gl.draw_scene(scene).pixels.tobytes() for scene in scenes]

    assert both() == both()
