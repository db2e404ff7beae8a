"""Commands whose values are read without pydantic.

typer checks each value, defaults too, with a type adapter of pydantic. Its import and the adapters
took 0.12 s of the 0.75 s of the processor that a picture took.
"""

from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import Any, get_args, get_origin

from typer.core import TyperCommand, TyperGroup

from drapery.errors import OptionError

_TYPES = (str, int, float, Path)


class PlainCommand(TyperCommand):
    """A command of typer that converts texts to plain types itself.

    Other types, and texts that do not fit, are left to typer, which also words the error.
    Drapery's own bounds are checked later, see `Option.check`.
    """

    def get_params(self, ctx: Any) -> list[Any]:
        """Its parameters and `--help`."""
        return [_plain(each) for each in super().get_params(ctx)]

    def parse_args(self, ctx: Any, args: list[str]) -> list[str]:
        """The words that are left. Raises OptionError for an option without its value."""
        _check_values(self.get_params(ctx), args)
        return super().parse_args(ctx, args)


class PlainGroup(TyperGroup):
    """The same for a group of commands."""

    def get_params(self, ctx: Any) -> list[Any]:
        """Its parameters and `--help`."""
        return [_plain(each) for each in super().get_params(ctx)]


def _check_values(parameters: list[Any], words: list[str]) -> None:
    """Raise OptionError where another option stands in the place of an option's value."""
    options = {name: each for each in parameters for name in each.opts if name.startswith("-")}
    others = [name for each in parameters for name in each.secondary_opts]
    following = iter(words)
    for word in following:
        if word == "--":
            return
        option = options.get(word)
        if option is None or option.is_flag or option.count:
            continue
        value = next(following, "")
        if value in options or value in others or value.startswith("--"):
            about = f" ({option.help.split('.')[0]})" if option.help else ""
            kind = option.metavar or "VALUE"
            raise OptionError(
                f"{word} takes a value{about}, but {value} follows it; write {word} {kind} {value}"
            )


def _plain(parameter: Any) -> Any:
    if "process_value" not in vars(parameter):
        parameter.process_value = partial(_process, parameter, parameter.process_value)
    return parameter


def _process(parameter: Any, usual: Callable[[Any, Any], Any], context: Any, value: Any) -> Any:
    """What `Parameter.process_value` of typer returns."""
    if parameter.required and parameter.value_is_missing(value):
        return usual(context, value)
    several = parameter.multiple or parameter.nargs == -1
    try:
        value = _converted(parameter.type_descriptor.annotation, value, several)
    except (AttributeError, ValueError):  # a later typer may have no `type_descriptor`
        return usual(context, value)
    return parameter.callback(context, parameter, value) if parameter.callback else value


def _converted(kind: Any, value: Any, several: bool = False) -> Any:
    """The value in its type. Raises ValueError for other types and texts that do not fit."""
    if value is None:
        return () if several else None
    if several and get_origin(kind) is list:
        (each,) = get_args(kind)
        return [_converted(each, one) for one in value]
    if kind in _TYPES and isinstance(value, str):
        return kind(value)
    if type(value) is kind or (kind is Path and isinstance(value, Path)):
        return value
    raise ValueError
