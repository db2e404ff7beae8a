"""A ready-made scene with the design and the wind of the page, where the scene has such."""

from collections.abc import Iterator
from dataclasses import dataclass, fields, replace

from drapery import Banner, Settings
from drapery.banner import write_banner
from drapery.scenes import SceneEntry, find_scene
from drapery.settings import MAX_WIND

DESIGN_PARAMETERS = frozenset({"design", "middle"})
"""The parameters of scenes that are designs; `middle` is one of three."""
WIND_PARAMETERS = frozenset({"wind", "breeze"})
"""The parameters of scenes that are speeds of the wind [m/s]."""


@dataclass(frozen=True)
class SceneChoice:
    """A scene. words: the parameters that it takes from the page, as text, by name."""

    name: str
    words: tuple[tuple[str, str], ...] = ()


def scene_choice(name: str, banner: Banner | None, settings: Settings) -> SceneChoice:
    """The scene of this name with a design and the wind of the settings. Raises OptionError."""
    words = {}
    for parameter in _parameters(find_scene(name)):
        if parameter in DESIGN_PARAMETERS and banner is not None:
            words[parameter] = write_banner(replace(banner, kind="banner"), "shorthand")
        elif parameter in WIND_PARAMETERS:
            words[parameter] = f"{min(settings.wind_speed, MAX_WIND):g}"
    return SceneChoice(name, tuple(words.items()))


def what_follows(name: str) -> str:
    """A sentence that says what a scene takes from the page. Raises OptionError."""
    parameters = {*_parameters(find_scene(name))}
    design, wind = parameters & DESIGN_PARAMETERS, parameters & WIND_PARAMETERS
    shown = "your banner" if design else "a cloth of its own"
    return f"This scene shows {shown}, in {'your wind' if wind else 'a wind of its own'}."


def _parameters(scene: SceneEntry) -> Iterator[str]:
    for field in fields(scene.parameters()):
        is_speed = field.metadata.get("unit") == "m/s"
        if field.name in DESIGN_PARAMETERS or (field.name in WIND_PARAMETERS and is_speed):
            yield field.name
