"""Renderers by name, and those that others add."""

from importlib.metadata import EntryPoint

import numpy as np
import pytest

from drapery.errors import BackendError
from drapery.render import backends, doctor
from drapery.render.frame import Frame
from drapery.render.gl import platform as gl_platform
from drapery.render.scene import Scene
from drapery.render.soft import draw_scene


def blank(scene: Scene) -> Frame:
    return Frame(np.zeros((scene.size[1], scene.size[0], 4), np.uint8))


@pytest.fixture
def added(monkeypatch: pytest.MonkeyPatch) -> None:
    points = [
        EntryPoint("blank", f"{__name__}:blank", backends.GROUP),
        EntryPoint("broken", "no_such_module:draw", backends.GROUP),
        EntryPoint("soft", "no_such_module:draw", backends.GROUP),
    ]
    monkeypatch.setattr("importlib.metadata.entry_points", lambda group: points)


def test_auto_is_our_own_rasteriser() -> None:
    assert backends.backend("auto") is backends.backend("soft") is draw_scene


def test_an_installed_package_adds_one(added: None) -> None:
    assert backends.backend("blank") is blank
    assert backends.backend_names() == ["soft", "pyrender", "blank", "broken"]


def test_nobody_takes_the_place_of_ours(added: None) -> None:
    assert backends.backend("soft") is draw_scene


def test_one_that_cannot_be_loaded_says_whose_it_is(added: None) -> None:
    with pytest.raises(BackendError, match="'broken' of no_such_module:draw cannot be loaded"):
        backends.backend("broken")


def test_a_name_that_is_none() -> None:
    with pytest.raises(BackendError, match="'vulkan' is not known; use one of: auto, soft, pyr"):
        backends.backend("vulkan")


def test_the_doctor_draws_before_it_says_works(monkeypatch: pytest.MonkeyPatch) -> None:
    """A backend that another package adds is tried in a process of its own, like ours."""
    monkeypatch.setattr(doctor, "added_backends", lambda: {"vulkan": "drapery-vulkan"})
    monkeypatch.setattr(doctor, "ENCODE", "raise ImportError('libx264 is missing')")
    monkeypatch.setattr(doctor, "DRAW_GL", "print('a driver')")
    soft, pyrender, vulkan, video = doctor.backend_report()
    assert soft.works and "this package's own" in soft.detail
    assert pyrender == ("pyrender", True, "a driver", "")
    assert not vulkan.works and "'vulkan' is not known" in vulkan.detail
    assert vulkan.remedy == "pip install --upgrade drapery-vulkan"
    assert not video.works and "libx264 is missing" in video.detail


def test_the_doctor_sees_a_triangle_that_is_wrong() -> None:
    with pytest.raises(ValueError, match="wrongly"):
        doctor.check_triangle(Frame(np.zeros((16, 16, 4), np.uint8)))


@pytest.mark.parametrize(
    ("platform", "library", "package"),
    [("egl", "libGL.so.1", "libegl1 libgl1"), ("osmesa", "libOSMesa.so.8", "libosmesa6")],
)
def test_a_platform_that_is_asked_for_names_its_own_library(
    platform: str, library: str, package: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("PYOPENGL_PLATFORM", platform)
    monkeypatch.setattr(gl_platform, "loaded_library", lambda name: None)
    said = rf"on {platform}, which PYOPENGL_PLATFORM names \({library} is missing.*{package}$"
    with pytest.raises(BackendError, match=said) as raised:
        gl_platform.choose_platform()
    monkeypatch.setattr(doctor, "run_program", lambda program: (False, str(raised.value)))
    report = doctor.backend_report()[1]
    assert report.remedy.endswith(package) and library in report.detail
    assert package not in report.detail
