"""Named cameras: they show all of their subject, as large as they may, from where they say."""

import numpy as np
import pytest
from hypothesis import given, strategies as st
from render_shapes import painted, soup

from drapery.errors import OptionError
from drapery.render.camera import Camera, clip_matrix, view_matrix
from drapery.render.scene import Model, Scene
from drapery.render.soft import draw_scene
from drapery.render.views import VIEWS, frame_view, turntable


def on_picture(points: np.ndarray, camera: Camera, aspect: float) -> np.ndarray:
    """Places in the picture: -1..1 across, up and in depth."""
    matrix = clip_matrix(camera, (round(1000 * aspect), 1000))
    clip = np.einsum("ij,nj->ni", matrix[:, :3], points) + matrix[:, 3]
    return clip[:, :3] / clip[:, 3:]


@given(
    st.sampled_from(sorted(VIEWS)),
    st.integers(0, 2**32),
    st.sampled_from([0.25, 1.0, 2.5]),
    st.floats(0.01, 100),
)
def test_a_view_frames_its_subject(name: str, seed: int, aspect: float, scale: float) -> None:
    """All points are seen, and one of them touches the margin."""
    random = np.random.default_rng(seed)
    points = random.uniform(-5, 5, 3) + scale * random.uniform(0.1, 1, 3) * random.random((30, 3))
    seen = np.abs(on_picture(points, frame_view(name, points, aspect, margin=0.1), aspect))
    assert seen[:, :2].max() == pytest.approx(0.8, abs=0.01)
    assert seen[:, 2].max() <= 1


@pytest.mark.parametrize("name", ["front", "iso", "hero"])
@pytest.mark.parametrize("aspect", [0.5, 2.0])
def test_a_turntable_goes_once_around_and_loses_nothing(name: str, aspect: float) -> None:
    points = np.random.default_rng(2).uniform((1, 2, 3), (2, 5, 3.5), (50, 3))
    cameras = turntable(VIEWS[name], points, aspect, 24)
    for camera in cameras:
        assert np.abs(on_picture(points, camera, aspect)).max() <= 1
    backs = np.array([view_matrix(camera)[2, :3] for camera in cameras])
    turns = np.arctan2(backs[:, 0], backs[:, 2])
    steps = np.diff(np.unwrap(np.append(turns, turns[0])))
    assert steps == pytest.approx(np.full(24, 2 * np.pi / 24))
    assert len({round(camera.position[1], 9) for camera in cameras}) == 1


def test_the_gui_view_is_the_games_item_pose() -> None:
    """Turned by 20 degrees about y, then by 30 about x, before a camera that looks along -z."""
    x, y = np.radians(30), np.radians(20)
    about_x = np.array([(1, 0, 0), (0, np.cos(x), -np.sin(x)), (0, np.sin(x), np.cos(x))])
    about_y = np.array([(np.cos(y), 0, np.sin(y)), (0, 1, 0), (-np.sin(y), 0, np.cos(y))])
    camera = frame_view("gui", np.array([(0, 0, 0), (1, 2, 1)], float), 1.0)
    assert view_matrix(camera)[:3, :3] == pytest.approx(about_x @ about_y)
    assert camera.height is not None


def test_a_view_that_is_none_and_a_subject_that_is_none() -> None:
    with pytest.raises(OptionError, match="view 'side' is not known; use one of: front, back"):
        frame_view("side", np.zeros((2, 3)), 1.0)
    for points in (np.zeros((0, 3)), np.array([[np.nan, 0, 0]])):
        with pytest.raises(OptionError, match="nothing to frame"):
            frame_view("front", points, 1.0)


@pytest.mark.parametrize("name", sorted(VIEWS))
def test_the_picture_has_its_margins(name: str) -> None:
    points = np.random.default_rng(3).random((40, 3, 3))
    camera = frame_view(name, points, 1.0)
    scene = Scene((Model(soup(points), (painted(255, 0, 0, 255),)),), camera, (200, 200))
    rows, columns = np.nonzero(draw_scene(scene).pixels[..., 3])
    edges = [rows.min(), columns.min(), 199 - rows.max(), 199 - columns.max()]
    assert min(edges) == pytest.approx(10, abs=1.5)
