"""Ready-made scenes and comparisons in styles."""

from contextlib import nullcontext
from pathlib import Path

import numpy as np
import pytest
from conftest import Run
from PIL import Image

from drapery.render import Camera, Frame, Scene, draw_scene
from drapery.scenes import Clip, find_scene, scene_frames
from drapery.scenes.picture_grid import ClipPicture
from drapery.scenes.styling import styled_pictures
from drapery.style.tailoring import ClothModel
from drapery.styles import STEPS, Style, StyleStep, find_style


def words(*styles: str | Style, count: int = 1, size: int = 120) -> list[np.ndarray]:
    """The pixels of the first frames of the scene `blocky`, as words."""
    entry = find_scene("blocky")
    clip = Clip((size, size), count)
    given = entry.parameters({"pixel_snap": "no"})
    frames = scene_frames(entry, given, clip, "soft", style=styles)
    return [frame.pixels.copy().view(np.uint32)[..., 0] for frame in frames]


def test_a_scene_without_steps_is_the_plain_scene() -> None:
    assert np.array_equal(words(), words(Style("nothing")))


def test_a_style_changes_light_shape_material_and_picture_of_a_scene() -> None:
    entry = find_scene("blocky")
    (plain,) = entry.play(entry.parameters({"pixel_snap": "no"}), Clip((80, 80), 1))
    drawn: list[Scene] = []

    def draw(scene: Scene) -> Scene:
        drawn.append(scene)
        return scene

    shapes = tuple(step for step in find_style("few-bends").steps if step.kind == "shape")
    style = Style("few", shapes + find_style("felt").steps, light="flat")
    (grid,) = styled_pictures([plain], style, draw)  # type: ignore[arg-type]
    before, after = plain.pictures[0].models[-1], grid.pictures[0].models[-1]
    assert isinstance(after, ClothModel)
    assert len(after.mesh.triangles) != len(before.mesh.triangles)
    assert after.materials[0].layers[0].texels.shape != before.materials[0].layers[0].texels.shape
    assert not grid.pictures[0].light.directions and not drawn


def test_poses_are_held_in_scenes() -> None:
    style = Style("held", (StyleStep("motion", STEPS["motion"]["hold"], {"every": 2}),))
    first, second, third, *_ = words(style, count=8)
    assert np.array_equal(first, second) and not np.array_equal(second, third)


def test_each_picture_of_a_grid_is_steady_by_itself() -> None:
    frames = words("pixel-art", count=3)
    assert len(frames) == 3 and frames[0].shape == (120, 120)


@pytest.mark.parametrize(
    ("name", "said"),
    [
        ("banner", None),
        ("cape-pixel", "only its picture steps change something"),
        ("freefall", None),
        ("skirt", "no rectangle of cloth"),
        ("stress", "no rectangle of cloth"),
    ],
)
def test_scenes_of_every_kind_take_styles(name: str, said: str | None) -> None:
    entry = find_scene(name)
    text = {"side": "2"} if name == "stress" else {}
    clip, steps = Clip((64, 64), 1), find_style("cel") | find_style("tattered")
    with pytest.warns(UserWarning, match=said) if said else nullcontext():
        given = entry.parameters(text)
        (frame,) = scene_frames(entry, given, clip, "soft", last=True, style=steps)
    assert frame.pixels.shape == (64, 64, 4)


def test_the_command_for_scenes_takes_styles(drapery: Run, tmp_path: Path) -> None:
    clip = ("--seconds", "0.1", "--size", "64x64")
    for name in ("game", "cel"):
        target = tmp_path / f"{name}.png"
        code, _, said = drapery("scene", "blocky", "--style", name, *clip, "-o", target)
        assert code == 0, said
    pictures = [np.asarray(Image.open(tmp_path / f"{name}.png")) for name in ("game", "cel")]
    assert not np.array_equal(*pictures)


def test_a_comparison_draws_each_style(drapery: Run, tmp_path: Path) -> None:
    size = ("--size", "40x50", "-o", tmp_path / "both.png")
    code, out, said = drapery("compare", "white", "--style", "game", "--style", "cel", *size)
    assert code == 1, said
    assert "game" in out and "cel" in out
    assert (tmp_path / "both.png").is_file()
    code, _, said = drapery("compare", "white", "red", "--style", "game", "--style", "cel")
    assert code == 2 and "designs and styles would vary" in said


@pytest.mark.parametrize("name", ["julia", "cape-pixel"])
def test_frames_that_a_scene_draws_itself_take_picture_steps(name: str) -> None:
    def step(name: str, **given: object) -> StyleStep:
        return StyleStep("picture", STEPS["picture"][name], given)

    entry, clip = find_scene(name), Clip((96, 64), 3)
    style = Style("few", (step("pixels", size=4), step("shade"), step("limit", colours=4)))
    plain, drawn = (
        [frame.pixels for frame in scene_frames(entry, entry.parameters({}), clip, "soft", style=s)]
        for s in ((), style)
    )
    assert [each.shape for each in drawn] == [each.shape for each in plain]
    if name == "julia":  # the other scene is a grid, whose parts change one by one
        assert len({bytes(pixel) for each in drawn for pixel in each.reshape(-1, 4)}) <= 4
    assert not np.array_equal(drawn[-1], plain[-1])


@pytest.mark.parametrize(
    ("picture", "style", "said"),
    [
        (Frame(np.zeros((2, 2, 4), np.uint8)), "ink", "ink: only its picture steps change some"),
        (Scene((), Camera((0, 0, 3), (0, 0, 0)), (8, 8)), "boards", "no rectangle of cloth"),
    ],
)
def test_steps_that_change_nothing_are_told(picture: ClipPicture, style: str, said: str) -> None:
    with pytest.warns(UserWarning, match=said):
        list(styled_pictures([picture], find_style(style), draw_scene))
