"""One step of a style: a plain function and its checked parameters."""

import json
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import lru_cache
from inspect import Parameter, signature
from typing import TYPE_CHECKING, Any, Literal, TypeVar, get_args, get_origin, get_type_hints

from drapery.errors import OptionError, shown
from drapery.option import limits, one_of
from drapery.styles.colours import COLOUR_PATTERN

if TYPE_CHECKING:
    from pydantic import BaseModel
    from pydantic.fields import FieldInfo

StepKind = Literal["motion", "shape", "material", "picture"]
"""What a step changes: how cloth moves, its shape, its material, or the picture."""
STEP_KINDS: tuple[StepKind, ...] = get_args(StepKind)
"""The kinds of steps, in the order in which they are applied."""

StepFunction = Callable[..., Any]
Function = TypeVar("Function", bound=StepFunction)


def over_time(function: Function) -> Function:
    """Decorate a picture step that takes and returns the canvases of all frames of a loop, a list.

    A picture that does not move is a loop of one frame.
    """
    vars(function)["over_time"] = True
    return function


def costs(cost: int) -> Callable[[Function], Function]:
    """Decorate a step that takes `cost` times as long as a plain one, which a chain counts.

    A plain step takes about 0.1 µs for each pixel of a picture, 0.02 s for a large sheet of texels.
    """

    def decorated(function: Function) -> Function:
        vars(function)["cost"] = cost
        return function

    return decorated


@dataclass(frozen=True)
class StyleStep:
    """A function of one kind, and the values of its parameters.

    The function takes what it changes and keyword parameters with defaults, and returns the result:

        motion: Piece, positions of all moments [m], shape [F, N, 3] -> positions
        shape: Piece, positions of one moment [m], shape [N, 3] -> Piece and positions, or Mesh
        material: Material -> Material, of the cloth
        picture: Canvas -> Canvas; or see `over_time`

    kind: what it changes: `motion`, `shape`, `material` or `picture`.
    function: a function as above. Annotate each parameter with pydantic's `Field`, such as
        `Annotated[int, Field(ge=1, le=60, description="...")]`.
    parameters: their values; those left out have their defaults.

    Raises OptionError that names the parameter and its limits.
    """

    kind: StepKind
    function: StepFunction
    parameters: Mapping[str, Any] | tuple[tuple[str, Any], ...] = ()

    def __post_init__(self) -> None:
        one_of("kind of step", self.kind, STEP_KINDS)
        given = dict(self.parameters)
        if faults := parameter_faults(self.kind, self.function, given):
            raise OptionError(f"step {self.name}: {next(iter(faults.values()))}")
        model = parameter_model(self.kind, self.function)(**given)
        values = tuple((name, getattr(model, name)) for name in type(model).model_fields)
        object.__setattr__(self, "parameters", values)

    @property
    def name(self) -> str:
        """The name of the function, as it stands in files."""
        return self.function.__name__.replace("_", "-")

    @property
    def over_time(self) -> bool:
        """Whether the step changes all frames of a loop together; see the decorator."""
        return bool(getattr(self.function, "over_time", False))

    @property
    def cost(self) -> int:
        """How many times as long as a plain step it takes; see `costs`."""
        return int(getattr(self.function, "cost", 1))

    def apply(self, *values: Any) -> Any:
        """What the step makes of what it changes; see `function`."""
        return self.function(*values, **dict(self.parameters))


@lru_cache(maxsize=256)
def parameter_model(kind: StepKind, function: StepFunction) -> "type[BaseModel]":
    """The parameters of a step's function as a pydantic model that refuses unknown names."""
    from pydantic import ConfigDict, create_model

    hints = get_type_hints(function, include_extras=True)
    taken = ("piece", "positions") if kind in ("motion", "shape") else (kind,)
    every = [*signature(function).parameters.values()]
    own = every[len(taken) :]
    if sum(each.kind is not Parameter.KEYWORD_ONLY for each in every) < len(taken):
        name = function.__name__
        raise OptionError(f"step {name}: a step of {kind} takes {' and '.join(taken)} first")
    bare = [each.name for each in own if each.default is Parameter.empty]
    if bare:
        raise OptionError(f"step {function.__name__}: give {bare[0]} a default value")
    fields: dict[str, Any] = {each.name: (hints.get(each.name, Any), each.default) for each in own}
    config = ConfigDict(extra="forbid")
    model: type[BaseModel] = create_model(function.__name__, __config__=config, **fields)
    return model


def parameter_faults(
    kind: StepKind, function: StepFunction, given: Mapping[str, Any]
) -> dict[str, str]:
    """What is wrong with values of parameters: a message for each name; empty if nothing is."""
    from pydantic import ValidationError

    model = parameter_model(kind, function)
    try:
        model(**given)
    except ValidationError as error:
        return {
            str(fault["loc"][0]): _message(model, str(fault["loc"][0]), given)
            for fault in error.errors()
        }
    return {}


def _message(model: "type[BaseModel]", name: str, given: Mapping[str, Any]) -> str:
    if name not in model.model_fields:
        known = ", ".join(model.model_fields) or "none, it has no parameters"
        return f"{name} is not a parameter; use one of: {known}"
    field = model.model_fields[name]
    allowed = parameter_limits(field)
    return f"{name} {shown(given[name])} cannot be used; use {allowed}"


def parameter_limits(field: "FieldInfo") -> str:
    """The values that a parameter may have, such as `1 to 60`."""
    kind = field.annotation
    if get_origin(kind) is Literal:
        *first, last = map(str, get_args(kind))
        return f"{', '.join(first)} or {last}"
    bounds = {
        side: value
        for rule in field.metadata
        for side in ("ge", "le")
        if (value := getattr(rule, side, None)) is not None
    }
    if {"ge", "le"} <= set(bounds):
        return ("whole numbers " if kind is int else "") + limits(bounds["ge"], bounds["le"])
    if any(getattr(rule, "pattern", None) == COLOUR_PATTERN for rule in field.metadata):
        return "a colour like #5a3c1e"
    if kind in _KINDS:
        return _KINDS[kind]
    sides = [getattr(rule, "min_length", None) for rule in field.metadata]
    sides += [getattr(rule, "max_length", None) for rule in field.metadata]
    counts = [side for side in sides if side is not None]
    many = f"{counts[0]} to {counts[-1]}" if len(counts) > 1 else "a list of"
    return f"{many} colours like #5a3c1e"


_KINDS: dict[object, str] = {
    bool: "true or false",
    int: "a whole number",
    float: "a number",
    str: "a text",
}


def parameter_lines(step: StyleStep) -> list[str]:
    """The parameters of a step, one a line: name, value, meaning and limits."""
    model = parameter_model(step.kind, step.function)
    return [
        f"{name} = {as_toml(value)}  # {model.model_fields[name].description or name}"
        f" ({parameter_limits(model.model_fields[name])})"
        for name, value in dict(step.parameters).items()
    ]


def as_toml(value: Any) -> str:
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, str):
        return json.dumps(value, ensure_ascii=False)
    if isinstance(value, tuple):
        return f"[{', '.join(map(as_toml, value))}]"
    return repr(value)
