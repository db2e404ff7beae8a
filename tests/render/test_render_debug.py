"""Lines, dots, maps and shadows are where and as large as they say."""

import numpy as np
import pytest
from render_shapes import FACING, painted, plain, quad

from drapery.errors import OptionError
from drapery.render.camera import Camera
from drapery.render.debug import (
    PIN_RED,
    RAMP,
    at_particles,
    edges_model,
    normals_model,
    pins_model,
    spring_stretch,
    springs_model,
    stretch_model,
)
from drapery.render.frame import Frame, enlarge
from drapery.render.light import GAME_LIGHT, UNLIT, lit_at
from drapery.render.lines import dot_model, line_model
from drapery.render.scene import Material, Model, Scene
from drapery.render.shadow import contact_shadow
from drapery.render.soft import draw_scene

WHITE = (255, 255, 255, 255)


def drawn(*models: Model, camera: Camera = FACING) -> np.ndarray:
    return draw_scene(Scene(models, camera, (100, 100), UNLIT)).pixels


@pytest.mark.parametrize("width", [1, 2, 6])
@pytest.mark.parametrize("near", [2.0, 40.0])
def test_a_line_is_as_wide_as_it_says_from_near_and_far(width: int, near: float) -> None:
    camera = Camera((0, 0, near), (0, 0, 0), fov=30, near=0.1, far=100)
    line = line_model(
        np.array([(-99, 0.001, 0), (99, 0.001, 0)]), np.array([[0, 1]]), WHITE, camera, 100, width
    )
    assert (drawn(line, camera=camera)[..., 3] > 0).sum(axis=0).tolist() == [width] * 100


def test_a_dot_is_a_square_of_its_width() -> None:
    seen = drawn(dot_model(np.array([(0.3, 0.1, 0)]), WHITE, FACING, 100, 7))[..., 3] > 0
    assert seen.sum() == 49 and seen.any(axis=0).sum() == seen.any(axis=1).sum() == 7


def test_lines_lie_on_their_surface_and_hide_behind_others() -> None:
    surface = Model(quad(-0.5, -0.5, 0.5, 0.5), (painted(9, 9, 9, 255),))
    edges = edges_model(surface.mesh, FACING, 100, (255, 0, 0, 255), 2)
    on_it = (drawn(surface, edges)[..., 0] == 255).sum()
    assert on_it > 300
    wall = Model(quad(-1, -1, 1, 1, z=1), (painted(9, 9, 9, 255),))
    assert not (drawn(surface, edges, wall)[..., 0] == 255).any()


def test_each_edge_is_drawn_once() -> None:
    edges = edges_model(quad(), FACING, 100)
    assert len(edges.mesh.triangles) == 2 * 5


def test_springs_have_the_colour_of_their_kind_and_pins_are_dots() -> None:
    points = np.array([(-0.8, 0.5, 0), (0.8, 0.5, 0), (-0.8, -0.5, 0), (0.8, -0.5, 0)])
    pairs, kinds = np.array([[0, 1], [0, 3], [2, 3]]), np.array([0, 1, 2], np.uint8)
    pixels = drawn(
        springs_model(points, pairs, kinds, FACING, 100, 3),
        pins_model(points, np.array([0, 1, 1, 1.0]), FACING, 100),
    )
    assert len(np.unique(pixels[pixels[..., 3] > 0], axis=0)) == 4
    assert tuple(pixels[25, 10]) == PIN_RED


def test_normals_stand_on_their_vertices() -> None:
    model = normals_model(quad(), 0.25, FACING, 100)
    assert len(model.mesh.triangles) == 2 * 4
    assert model.mesh.positions[:, 2].max() == pytest.approx(0.25, abs=0.05)


def test_stretch_is_read_from_the_colours() -> None:
    for value, colour in [(-0.2, RAMP[0]), (-0.1, RAMP[0]), (0.0, RAMP[2]), (0.1, RAMP[4])]:
        pixels = drawn(stretch_model(quad(), np.full(4, value), limit=0.1))
        assert np.abs(pixels[50, 50, :3] - colour).max() <= 2


def test_stretch_of_springs_goes_to_their_particles() -> None:
    points = np.array([(0, 0, 0), (1.1, 0, 0), (1.1, 0.7, 0)])
    pairs = np.array([[0, 1], [1, 2]])
    stretch = spring_stretch(points, pairs, np.ones(2))
    assert stretch == pytest.approx([0.1, -0.3])
    assert at_particles(stretch, pairs, 3) == pytest.approx([0.1, -0.3, -0.3])


def test_a_shadow_is_under_its_thing_and_darker_the_closer_it_is() -> None:
    alphas = []
    for height in (0.0, 0.2, 0.7, 1.5):
        thing = quad(-0.5, -0.5, 0.5, 0.5)
        thing.positions[:] = thing.positions[:, [0, 2, 1]] + (3, height + 1e-3, 5)
        model = contact_shadow(
            [Model(thing, (Material((plain(1, 2, 3, 255),)),))], 0.0, strength=0.8
        )
        texels = model.materials[0].layers[0].texels
        alphas.append(int(texels[..., 3].max()))
        low, high = model.mesh.positions.min(axis=0), model.mesh.positions.max(axis=0)
        assert (low + high)[[0, 2]] / 2 == pytest.approx((3, 5))
        assert not texels[[0, -1]].any() and not texels[:, [0, -1]].any()
    assert alphas == sorted(alphas, reverse=True) and alphas[0] == 204 and alphas[-1] == 0


def test_a_shadow_has_the_shape_of_its_thing() -> None:
    """A thing at one end of a scene darkens that end, in both directions of the floor."""
    for x, z in ((1, 1), (-1, 1), (1, -1)):
        flat, post = quad(-2, -2, 2, 2), quad(-0.3, -0.3, 0.3, 0.3)
        flat.positions[:] = flat.positions[:, [0, 2, 1]] + (0, 5, 0)  # too high for a shadow
        post.positions[:] = post.positions[:, [0, 2, 1]] + (x, 0.01, z)
        worn = (Material((plain(1, 2, 3, 255),)),)
        model = contact_shadow([Model(flat, worn), Model(post, worn)], 0.0)
        alpha = model.materials[0].layers[0].texels[..., 3].astype(float)
        rows, columns = np.indices(alpha.shape)
        middle = [(alpha * axis).sum() / alpha.sum() for axis in (columns, rows)]
        assert np.array(middle) / 16 - np.array(alpha.shape[::-1]) / 32 == pytest.approx(
            (x, z), abs=0.1
        )


def test_light_levels_darken_and_colour() -> None:
    assert lit_at(GAME_LIGHT, 0, 15).tint == pytest.approx((1, 1, 1))
    assert lit_at(GAME_LIGHT, 15, 0).tint == pytest.approx((1, 1, 1))
    levels = [sum(lit_at(GAME_LIGHT, level, 0).tint) for level in range(16)]
    assert levels == sorted(levels)
    red, green, blue = lit_at(GAME_LIGHT, 9, 0).tint
    assert red > green > blue > 0
    red, green, blue = lit_at(GAME_LIGHT, 0, 15, daylight=0).tint
    assert blue > green > red > 0


def test_enlarging_keeps_pixels_square() -> None:
    pixels = np.random.default_rng(0).integers(0, 256, (3, 5, 4), dtype=np.uint8)
    large = enlarge(Frame(pixels), 4).pixels
    assert (
        large.shape == (12, 20, 4)
        and (large.reshape(3, 4, 5, 4, 4) == pixels[:, None, :, None]).all()
    )
    for times in (0, 9999):
        with pytest.raises(OptionError, match="5x3 cannot be enlarged"):
            enlarge(Frame(pixels), times)
