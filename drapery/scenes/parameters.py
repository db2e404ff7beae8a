"""Parameters of scenes: the fields of frozen dataclasses, each described by an `Option`."""

from collections.abc import Mapping
from dataclasses import Field, dataclass, field, fields
from typing import Any, TypeVar

from drapery.errors import OptionError, shown
from drapery.option import Option
from drapery.settings import MAX_WIND

MAX_SCENE_GRID = 65
"""The most particles along one side of a cloth in a scene."""

MAX_DRAG = 20.0
"""The highest drag of the air [1/s]."""

P = TypeVar("P", bound="SceneParameters")


def parameter(
    default: Any,
    help: str,
    bounds: tuple[float, float] | None = None,
    unit: str = "",
    choices: tuple[str, ...] = (),
) -> Any:
    """A field of a scene's parameters. The bounds of a tuple apply to each of its numbers."""
    is_number = not isinstance(default, str | bool)
    assert bounds is not None or not is_number, f"the parameter {help!r} has no bounds"
    metadata = {"help": help, "bounds": bounds, "unit": unit, "choices": choices}
    return field(default=default, metadata=metadata)


def grid_parameter(default: tuple[int, int], help: str, least: int = 2) -> Any:
    """Particles across and down a cloth."""
    return parameter(default, help, (least, MAX_SCENE_GRID), "particles")


def wind_parameter(default: float, help: str = "Mean speed of the wind") -> Any:
    """A speed of the wind [m/s]."""
    return parameter(default, help, (0, MAX_WIND), "m/s")


def drag_parameter(default: float) -> Any:
    """The drag of the air [1/s]."""
    return parameter(default, "Drag of the air", (0, MAX_DRAG), "1/s")


def thickness_parameter(default: float = 1.0) -> Any:
    """The thickness of a cloth in texels."""
    return parameter(default, "Thickness of the cloth", (0, 8), "texels")


def thickness_in_metres(default: float) -> Any:
    """The thickness of a cloth in metres."""
    return parameter(default, "Thickness of the cloth", (0, 0.5), "m")


def seed_parameter() -> Any:
    """The seed of a scene's random numbers."""
    return parameter(0, "Number that selects a sequence of gusts", (0, 2**32 - 1))


@dataclass(frozen=True)
class SceneParameters:
    """The base of all scenes' parameters.

    Raises OptionError that names the parameter.
    """

    def __post_init__(self) -> None:
        for each in fields(self):
            object.__setattr__(self, each.name, _checked(each, getattr(self, each.name)))


def read_parameters(kind: type[P], words: Mapping[str, str], scene: str) -> P:
    """Parameters some of which are given as text. Raises OptionError."""
    known = {each.name: each for each in fields(kind)}
    given: dict[str, Any] = {}
    for word, text in words.items():
        found = known.get(word.replace("-", "_"))
        if found is None:
            raise OptionError(
                f"scene {scene} has no parameter {shown(word)}; it has: {', '.join(known)}"
            )
        given[found.name] = _parsed(found, text)
    return kind(**given)


def _option(each: Field[Any]) -> Option:
    """A field as an option; for a tuple, the option of each of its numbers."""
    first = each.default[0] if isinstance(each.default, tuple) else each.default
    kind: Any = type(first)
    return Option(each.name, type=kind, default=first, **each.metadata)


def _checked(each: Field[Any], value: Any) -> Any:
    option = _option(each)
    if not isinstance(each.default, tuple):
        return option.check(value)
    if not isinstance(value, tuple | list) or len(value) != len(each.default):
        raise _wrong_count(each, value)
    return tuple(option.check(number) for number in value)


def _parsed(each: Field[Any], text: str) -> Any:
    option = _option(each)
    if not isinstance(each.default, tuple):
        return option.parse(text)
    parts = text.lower().replace("x", ",").split(",")
    if len(parts) != len(each.default):
        raise _wrong_count(each, text)
    return tuple(option.parse(part) for part in parts)


def _wrong_count(each: Field[Any], value: object) -> OptionError:
    default: Any = each.default
    count, example = len(default), "x".join(map(str, default))
    return OptionError(
        f"{each.name} {shown(value)} is not {count} numbers; write it like {example}"
    )
