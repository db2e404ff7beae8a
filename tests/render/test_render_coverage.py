"""Every sample belongs to one triangle: no gaps and no overlaps along shared edges."""

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st
from render_shapes import FACING, mesh, painted, soup

from drapery.render.camera import Camera
from drapery.render.scene import Model, Scene
from drapery.render.soft import draw_scene

VEIL = painted(200, 100, 50, 100, alpha="blend")
"""Where two triangles cover a sample, it is seen: its alpha is no longer 100."""


def alpha(model: Model, camera: Camera = FACING, size: tuple[int, int] = (96, 96)) -> np.ndarray:
    return draw_scene(Scene((model,), camera, size)).pixels[..., 3]


def shuffled_grid(seed: int, cells: int, on_centres: bool) -> Model:
    """A square torn into triangles with wandering corners, wound and ordered at random."""
    random = np.random.default_rng(seed)
    u, v = np.meshgrid(*[np.linspace(-0.9, 0.9, cells + 1)] * 2)
    step = 1.8 / cells
    wander = random.uniform(-0.15, 0.15, (2, cells + 1, cells + 1)) * step
    wander[0, :, [0, -1]] = wander[1, [0, -1], :] = 0
    points = np.stack([u + wander[0], v + wander[1], 0 * u], axis=-1).reshape(-1, 3)
    if on_centres:  # corners and edges run through the centres of pixels
        points[:, :2] = (np.rint(points[:, :2] * 48) + 0.5) / 48
    a = (np.arange(cells)[:, None] * (cells + 1) + np.arange(cells)).ravel()
    b, c, d = a + 1, a + cells + 1, a + cells + 2
    triangles = np.concatenate([np.stack([a, b, c], 1), np.stack([b, d, c], 1)])
    random.shuffle(triangles)
    backwards = random.random(len(triangles)) < 0.5
    triangles[backwards] = triangles[backwards][:, ::-1]
    turns = random.integers(0, 3, len(triangles))
    triangles = np.take_along_axis(triangles, (np.arange(3) + turns[:, None]) % 3, axis=1)
    return Model(mesh(points, triangles), (VEIL,))


@settings(max_examples=40, deadline=None)
@given(st.integers(0, 2**32), st.integers(1, 12), st.booleans())
def test_a_torn_square_covers_each_sample_once(seed: int, cells: int, on_centres: bool) -> None:
    seen = alpha(shuffled_grid(seed, cells, on_centres))
    assert set(np.unique(seen)) == {0, 100}
    inner = seen[8:-8, 8:-8]
    assert (inner == 100).all()


@settings(max_examples=20, deadline=None)
@given(st.integers(0, 2**32), st.booleans())
def test_a_torn_square_in_perspective_too(seed: int, behind: bool) -> None:
    """Seen askew, and with `behind`, reaching behind the camera, so it is clipped."""
    camera = Camera((0.3, -0.8, 0.25), (0, 0.4, 0), fov=70, near=0.1)
    if not behind:
        camera = Camera((0.7, -1.6, 1.1), (0, 0, 0), fov=70, near=0.1)
    assert set(np.unique(alpha(shuffled_grid(seed, 12, False), camera))) <= {0, 100}


@pytest.mark.parametrize("spokes", [3, 4, 7, 16, 360])
@pytest.mark.parametrize("centre", [(0.0, 0.0), (1 / 96, 1 / 96), (0.013, -0.27)])
def test_a_closed_fan_covers_once(spokes: int, centre: tuple[float, float]) -> None:
    angle = 2 * np.pi * np.arange(spokes) / spokes
    rim = np.stack([0.8 * np.cos(angle), 0.8 * np.sin(angle), 0 * angle], axis=1)
    points = np.concatenate([[(*centre, 0)], rim])
    numbers = np.arange(spokes)
    triangles = np.stack([0 * numbers, 1 + numbers, 1 + (numbers + 1) % spokes], axis=1)
    seen = alpha(Model(mesh(points, triangles), (VEIL,)))
    assert set(np.unique(seen)) == {0, 100}


def test_two_triangles_beside_one_another_cover_what_they_cover_alone() -> None:
    """Coverage is a matter of each triangle: sums of single pictures equal the whole."""
    random = np.random.default_rng(4)
    corners = random.uniform(-1, 1, (200, 4, 3)) * (1, 1, 0)
    for four in corners:
        alone = [
            alpha(Model(soup(four[None, part]), (VEIL,))) > 0 for part in ([0, 1, 2], [0, 1, 3])
        ]
        sides = np.cross(four[1] - four[0], four[2:] - four[0])[:, 2]
        if sides[0] * sides[1] < 0:  # on opposite sides of the edge 0-1
            assert not (alone[0] & alone[1]).any()


def test_a_rectangle_between_centres_covers_exactly_the_samples_within() -> None:
    """Edges through the centres of samples: left and lower ones are inside, the others not."""
    left, right, bottom, top = 2.5, 5.5, 1.5, 6.5
    x0, x1, y0, y1 = (2 * edge / 8 - 1 for edge in (left, right, bottom, top))
    points = [(x0, y0, 0), (x1, y0, 0), (x1, y1, 0), (x0, y1, 0)]
    seen = alpha(Model(mesh(points, [(0, 1, 2), (0, 2, 3)]), (VEIL,)), size=(8, 8)) > 0
    expected = np.zeros((8, 8), bool)
    expected[8 - 6 : 8 - 1, 2:5] = True  # rows 1 to 5 counted from below, columns 2 to 4
    assert (seen == expected).all()


def test_slivers_leave_no_wrong_depth() -> None:
    """Triangles seen nearly from their edge stay between what is before and behind them."""
    random = np.random.default_rng(5)
    slivers = random.uniform(-1, 1, (4000, 3, 3))
    slivers[:, 2] = slivers[:, 0] + (slivers[:, 1] - slivers[:, 0]) * random.random((4000, 1))
    slivers[:, 2, :2] += random.normal(0, 1e-3, (4000, 2))
    square = [(-1, -1, 2), (1, -1, 2), (1, 1, 2), (-1, 1, 2)]
    front = mesh(square, [(0, 1, 2), (0, 2, 3)])
    models = (
        Model(soup(slivers), (painted(255, 0, 0, 255),)),
        Model(front, (painted(0, 255, 0, 255),)),
    )
    pixels = draw_scene(Scene(models, FACING, (256, 256))).pixels
    assert (pixels == (0, 255, 0, 255)).all()
