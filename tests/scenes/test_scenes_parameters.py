"""Parameters of scenes: with any values a scene plays or raises OptionError."""

from collections.abc import Iterator
from dataclasses import fields
from typing import Any

import pytest

from drapery.errors import DraperyError, OptionError
from drapery.render.scene import Scene
from drapery.scenes.catalogue import Clip, find_scene, scene_names
from drapery.scenes.parameters import SceneParameters

SLOW = {
    "rows",
    "grid",
    "left_grid",
    "middle_grid",
    "right_grid",
    "left",
    "right",
    "side",
    "settle",
    "panels",
}
"""Parameters whose highest values take too long for a test."""
SMALL = {
    "banner": {"left_grid": "2x3", "middle_grid": "3x5", "right_grid": "2x3"},
    "cape-pixel": {"grid": "2x3"},
    "skirt": {"panels": "4", "rows": "2"},
    "stress": {"side": "2", "settle": "0.1"},
    "freefall": {"grid": "4x4"},
    "wireframe": {"left": "3x3", "right": "4x4"},
}
CLIP = Clip((24, 24), 1, 20.0)


def numeric_fields(name: str) -> Iterator[Any]:
    return (f for f in fields(find_scene(name).parameters()) if f.metadata["bounds"] is not None)


def filled(field: Any, number: float) -> Any:
    """The number in the shape of the field's value."""
    if isinstance(field.default, tuple):
        return tuple(type(each)(number) for each in field.default)
    return type(field.default)(number)


def played(name: str, **values: Any) -> None:
    scene = find_scene(name)
    words = {k: v for k, v in SMALL.get(name, {}).items() if k not in values}
    small = scene.parameters(words)
    given = {f.name: getattr(small, f.name) for f in fields(small)} | values
    pictures = list(scene.play(type(small)(**given), CLIP))
    assert len(pictures) == CLIP.count
    scenes = [each for one in pictures for each in getattr(one, "pictures", (one,))]
    models = [model for each in scenes if isinstance(each, Scene) for model in each.models]
    assert all(model.name for model in models)  # in 3-D files


@pytest.mark.parametrize("name", scene_names())
def test_numbers_beyond_their_bounds_are_refused(name: str) -> None:
    scene = find_scene(name)
    for field in numeric_fields(name):
        least, most = field.metadata["bounds"]
        far = (least - 1, most + 1, -1e20, 1e20, 10**400, -(10**400))
        for number in (*far, float("inf"), float("nan")):
            values = (number,) * len(field.default) if isinstance(field.default, tuple) else number
            with pytest.raises(OptionError, match=field.name):
                type(scene.parameters())(**{field.name: values})
        for text in ("", "many", "1e999", "nan", "1x2x3x4", "-" * 5000):
            with pytest.raises(OptionError):
                scene.parameters({field.name: text})


@pytest.mark.filterwarnings("ignore:pins or colliders pull cloth")  # as some bounds do
@pytest.mark.parametrize("name", scene_names())
@pytest.mark.parametrize("end", [0, 1], ids=["lowest", "highest"])
def test_the_bounds_can_be_played(name: str, end: int) -> None:
    fields_of_play = [f for f in numeric_fields(name) if end == 0 or f.name not in SLOW]
    try:
        played(name, **{f.name: filled(f, f.metadata["bounds"][end]) for f in fields_of_play})
    except OptionError as error:
        assert "\n" not in str(error)


@pytest.mark.parametrize("name", scene_names())
@pytest.mark.parametrize("text", ["no such thing", "../../etc", "\0", "é" * 300])
def test_any_text_is_played_or_refused_in_one_line(name: str, text: str) -> None:
    for field in (f for f in fields(find_scene(name).parameters()) if isinstance(f.default, str)):
        try:
            played(name, **{field.name: text})
        except DraperyError as error:
            assert "\n" not in str(error)


def test_fine_grids_fold_too() -> None:
    played("fold", grid=(17, 33))


def test_a_parameter_of_another_type_is_refused() -> None:
    kind = type(find_scene("banner").parameters())
    for values in ({"wind": "much"}, {"left_grid": 3}, {"left": 5}, {"seed": 1.5}, {"wind": True}):
        with pytest.raises(OptionError, match=next(iter(values))):
            kind(**values)
    assert issubclass(kind, SceneParameters)
