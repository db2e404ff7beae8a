"""What `import drapery` offers: documented names, loaded late, typed, and the same every way."""

import inspect
import subprocess
import sys
from importlib import import_module
from pathlib import Path

import numpy as np
import pytest
from public_api import PACKAGES

import drapery
from drapery import (
    Banner,
    DesignError,
    DraperyError,
    Frame,
    OptionError,
    Settings,
    animate,
    compare,
    draw,
    iter_frames,
    save_model,
)

pytestmark = pytest.mark.usefixtures("untraced_processes")

DESIGN = Banner.parse("white creeper:lime")
ROOT = Path(__file__).parents[1]
SMALL = Settings(size=(24, 32))


@pytest.mark.parametrize("module", PACKAGES)
def test_every_public_name_is_there_and_documented(module: str) -> None:
    package = import_module(module)
    assert len(set(package.__all__)) == len(package.__all__)
    for name in package.__all__:
        value = getattr(package, name)
        if inspect.isclass(value) or inspect.isfunction(value):
            assert value.__doc__, f"{module}.{name} has no docstring"


def test_dir_lists_the_public_names() -> None:
    assert dir(drapery) == sorted(drapery.__all__)
    with pytest.raises(AttributeError, match="has no attribute 'drow'"):
        drapery.drow  # type: ignore[attr-defined] # noqa: B018


def test_names_are_loaded_when_they_are_used() -> None:
    code = "from drapery import Settings; Settings()"
    heavy = "{'numba', 'scipy', 'trimesh', 'numpy', 'PIL'} & set(sys.modules)"
    ran = subprocess.run(
        [sys.executable, "-c", f"import sys; {code}; print({heavy})"],
        capture_output=True,
        text=True,
        check=True,
    )
    assert ran.stdout.strip() == "set()"


def test_every_error_is_a_drapery_error() -> None:
    for name in drapery.__all__:
        if name.endswith("Error"):
            assert issubclass(getattr(drapery, name), DraperyError)


def test_settings_and_options_draw_the_same() -> None:
    by_name = draw(DESIGN, size=(24, 32), wind=6)
    assert np.array_equal(draw(DESIGN, SMALL, wind=6).pixels, by_name.pixels)
    assert not np.array_equal(draw(DESIGN, SMALL).pixels, by_name.pixels)


def test_frames_are_streamed_as_animate_draws_them() -> None:
    whole = animate(DESIGN, SMALL, seconds=0.3, fps=10)
    frames = iter_frames(DESIGN, SMALL, seconds=0.3, fps=10)
    assert iter(frames) is frames
    assert [np.array_equal(a.pixels, b.pixels) for a, b in zip(whole, frames, strict=True)] == (
        [True] * 3
    )


def test_streaming_refuses_bad_arguments_at_the_call() -> None:
    with pytest.raises(OptionError, match="fps 0 is out of range"):
        iter_frames(DESIGN, SMALL, fps=0)
    with pytest.raises(OptionError, match="wind 99 is out of range"):
        iter_frames(DESIGN, SMALL, wind=99)


def test_a_text_is_not_a_banner_and_a_mapping_not_settings() -> None:
    with pytest.raises(DesignError, match="'white' is not a Banner; read a text"):
        draw("white")  # type: ignore[arg-type]
    with pytest.raises(OptionError, match="are not Settings; give options by name"):
        draw(DESIGN, {"size": (9, 9)})  # type: ignore[arg-type]


def test_a_model_waves_unless_it_is_one_pose(tmp_path: Path) -> None:
    save_model(DESIGN, tmp_path / "waving.glb", SMALL, seconds=0.2, fps=10)
    save_model(DESIGN, tmp_path / "still.glb", SMALL, seconds=0)
    assert b"weights" in (tmp_path / "waving.glb").read_bytes()
    assert b"weights" not in (tmp_path / "still.glb").read_bytes()


def test_two_designs_are_compared_layer_by_layer() -> None:
    found = compare(DESIGN, Banner.parse("white creeper:green"), SMALL)
    assert not found.difference.same and found.culprit is not None
    assert found.line().startswith("the first and the second: ")
    assert isinstance(found.sheet(), Frame)
    assert compare(draw(DESIGN, SMALL), draw(DESIGN, SMALL)).difference.same


def test_a_checkout_is_a_package_without_an_installation() -> None:
    """Python that is started in a checkout finds it before the package that is installed."""
    program = "import sys\n"
    program += "sys.meta_path[:] = [f for f in sys.meta_path if 'editable' not in str(f).lower()]\n"
    program += (
        "from drapery import Banner, assets, render\nprint(*assets.__path__, *render.__path__)"
    )
    command = [sys.executable, "-c", program]
    run = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=True)
    assert run.stdout.split() == [str(ROOT / "assets"), str(ROOT / "render")]
