"""Buffers: what lies in the middle of each pixel beside its colour."""

from dataclasses import fields, replace

import numpy as np
import pytest

from drapery.mesh import Mesh
from drapery.render import (
    Buffers,
    Camera,
    Light,
    Material,
    Model,
    Scene,
    TextureLayer,
    backend,
    draw_buffers,
    draw_scene,
)
from drapery.render.backends import draw_with_buffers
from drapery.render.light import GAME_LIGHT, STUDIO_LIGHT

WHITE = np.full((1, 1, 4), 255, np.uint8)


def square(z: float, alpha: str = "opaque") -> Model:
    """A square of 2 m across x and y at a depth, seen from +z."""
    corners = np.array([[-1, 1, z], [1, 1, z], [-1, -1, z], [1, -1, z]], np.float32)
    normals = np.tile(np.array([0, 0, 1], np.float32), (4, 1))
    uvs = np.array([[0.0, 0], [1, 0], [0, 1], [1, 1]])
    mesh = Mesh(corners, normals, np.array([[0, 2, 1], [1, 2, 3]], np.int32), uvs)
    return Model(mesh, (Material((TextureLayer(WHITE),), alpha),))  # type: ignore[arg-type]


@pytest.mark.parametrize("height", [None, 4.0])
def test_buffers_hold_depth_normal_model_and_uv(height: float | None) -> None:
    camera = Camera((0, 0, 5), (0, 0, 0), height=height, fov=60)
    scene = Scene((square(-1.0), square(1.0)), camera, (80, 80))
    found = draw_buffers(scene)
    assert found.depth[40, 40] == pytest.approx(4.0, abs=1e-4)
    assert np.allclose(found.normal[found.coverage], [0, 0, 1])
    assert found.model[40, 40] == 1
    assert found.uv[40, 40] == pytest.approx([0.5, 0.5], abs=0.02)
    assert found.model[0, 0] == -1
    assert np.isinf(found.depth[0, 0])


def test_coverage_is_what_the_picture_covers() -> None:
    scene = Scene((square(0.0),), Camera((1.5, 2, 3), (0, 0, 0)), (70, 90))
    assert np.array_equal(draw_buffers(scene).coverage, draw_scene(scene).pixels[..., 3] > 0)


def test_surfaces_before_the_near_plane_are_cut() -> None:
    scene = Scene((square(0.0),), Camera((0.1, 0.3, 0.1), (0, 0.2, -1)), (40, 40))
    found = draw_buffers(scene)
    assert np.array_equal(found.coverage, draw_scene(scene).pixels[..., 3] > 0)
    assert np.allclose(found.normal[found.coverage], [0, 0, 1])


def test_surfaces_that_blend_are_left_out() -> None:
    scene = Scene((square(-1.0), square(1.0, "blend")), Camera((0, 0, 5), (0, 0, 0)), (40, 40))
    assert set(np.unique(draw_buffers(scene).model)) == {-1, 0}


def test_buffers_have_the_same_bits_for_any_number_of_threads() -> None:
    scene = Scene((square(-1.0), square(1.0)), Camera((1, 2, 5), (0, 0, 0)), (130, 130))
    one, three = (draw_buffers(scene, threads=threads) for threads in (1, 3))
    assert_same(one, three)


def assert_same(one: Buffers, other: Buffers) -> None:
    for each in fields(Buffers):
        assert np.array_equal(getattr(one, each.name), getattr(other, each.name)), each.name


@pytest.mark.parametrize("light", [GAME_LIGHT, STUDIO_LIGHT])
@pytest.mark.parametrize("position", [(1, 2, 5), (0.1, 0.3, 0.1)])
@pytest.mark.parametrize("samples", [1, 4])
def test_buffers_of_a_picture_are_those_without_one(
    samples: int, position: tuple[float, float, float], light: Light
) -> None:
    models = square(-1.0), square(1.0, "blend"), square(0.5)
    camera = Camera(position, (0, 0.2, -1))
    scene = Scene(models, camera, (130, 90), light, samples=samples)  # type: ignore[arg-type]
    frame, make_buffers = draw_with_buffers(scene, backend("soft"))
    assert np.array_equal(frame.pixels, draw_scene(scene).pixels)
    assert_same(make_buffers(), draw_buffers(scene))


def test_equal_materials_have_one_number() -> None:
    one, other, third = square(-0.5), square(0.0), square(0.5)
    red = Material((TextureLayer(WHITE.copy(), (255, 0, 0)),))
    third = replace(third, materials=(red,))
    batch = replace(other.mesh, positions=np.stack([other.mesh.positions + x for x in (-3.0, 3.0)]))
    batch = replace(batch, normals=np.stack([other.mesh.normals] * 2))
    two = Model(batch, (red, *one.materials), np.array([1, 0], np.int32))
    camera = Camera((0, 0, 12), (0, 0, 0), fov=60)
    found = draw_buffers(Scene((one, two, third), camera, (80, 80)))
    assert {(m, n) for m, n in zip(found.model.flat, found.material.flat, strict=True)} == {
        (-1, -1),
        (2, 1),
        (1, 0),
        (1, 1),
    }


def test_a_backend_without_buffers_has_those_of_soft() -> None:
    scene = Scene((square(0.0),), Camera((1, 2, 5), (0, 0, 0)), (40, 40))
    frame, make_buffers = draw_with_buffers(scene, lambda given: draw_scene(given))
    assert np.array_equal(frame.pixels, draw_scene(scene).pixels)
    assert_same(make_buffers(), draw_buffers(scene))


def test_every_takes_the_middle_of_each_square() -> None:
    scene = Scene((square(0.0),), Camera((1, 2, 5), (0, 0, 0)), (80, 80))
    found = draw_buffers(scene)
    assert np.array_equal(found.every(4).model, found.model[2::4, 2::4])
