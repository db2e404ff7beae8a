"""The options that several commands share, made from the table of options."""

import inspect
from collections.abc import Callable, Mapping, Sequence
from functools import wraps
from pathlib import Path
from types import MappingProxyType
from typing import TYPE_CHECKING, Annotated, Any, TypeVar, cast

import typer

from drapery.option import Option, Output, Subject
from drapery.settings import LOOP_OPTIONS, NAMED_OPTIONS, Options, Settings, applicable

if TYPE_CHECKING:
    from drapery import Banner

DesignArgument = Annotated[
    str,
    typer.Argument(
        metavar="DESIGN",
        help="A banner: a /give command, an item, JSON, a URL, 'white creeper:lime', a file, or -.",
        show_default=False,
    ),
]
OptionalDesign = Annotated[
    str | None,
    typer.Argument(
        metavar="DESIGN",
        help="A banner or shield: a /give command, an item, JSON, a URL, 'white creeper:lime',"
        " a file, or -. Leave it out for a cape, elytra or plain shield.",
        show_default=False,
    ),
]
FromOption = Annotated[
    str | None,
    typer.Option(
        "--from", metavar="FORM", help="The form of DESIGN.", show_default="found from its text"
    ),
]
NumberOption = Annotated[
    int | None,
    typer.Option(metavar="N", help="Number of the banner, from 1, if DESIGN holds several."),
]


def from_table(name: str) -> Any:
    """A typer option from the tables: its flag, help, limits and default."""
    return _typer_option(NAMED_OPTIONS.get(name) or LOOP_OPTIONS[name])


def _typer_option(option: Option) -> Any:
    return typer.Option(
        option.command_flag,
        metavar=option.metavar,
        help=option.describe(),
        show_default=option.default_text or True,
    )


PackOption = Annotated[list[Path] | None, from_table("packs")]
FormatOption = Annotated[int | None, from_table("format")]
ViewOption = Annotated[str, from_table("view")]
SizeOption = Annotated[str, from_table("size")]
WindOption = Annotated[float, from_table("wind")]
StyleOption = Annotated[list[str] | None, from_table("style")]
BackgroundOption = Annotated[str, from_table("background")]
BackendOption = Annotated[str, from_table("backend")]
SecondsOption = Annotated[float, from_table("seconds")]
FpsOption = Annotated[float, from_table("fps")]
QualityOption = Annotated[
    int | None,
    typer.Option(
        metavar="1-100",
        help="Of a WebP or AVIF that may lose something.",
        show_default="WebP loses nothing, AVIF a little",
    ),
]

Command = TypeVar("Command", bound=Callable[..., None])
_SOURCE = {"design": OptionalDesign, "form": FromOption, "number": NumberOption}
OF_PICTURES = (*_SOURCE, *NAMED_OPTIONS)
"""What `pictured` leaves out of a command with the options of a loop alone."""


def pictured(
    output: Output | None = None,
    subject: Subject | None = None,
    *,
    without: Sequence[str] = (),
    more: Mapping[str, Option] = MappingProxyType({}),
) -> Callable[[Command], Command]:
    """Add the options of a picture or loop to a command that takes any keyword, after its own.

    The command gets those that are given.

    output, subject: only the options that apply to them; a subject with a file of its own takes no
        design either. without: options that it leaves out. An option that the command declares is
        not replaced. more: options of another table, which come first.
    """

    def extend(command: Command) -> Command:
        own = dict(inspect.signature(command).parameters)
        del own["words"]
        source = {name: _parameter(name, None, kind) for name, kind in _SOURCE.items()}
        if subject is not None and subject.kind in ("garment", "player"):
            source = {}
        table = {n: o for n, o in LOOP_OPTIONS.items() if o.applies(subject, output)} | {**more}
        table |= {name: NAMED_OPTIONS[name] for name in applicable(subject, output)}
        shared = source | {name: _from_option(option) for name, option in table.items()}
        added = {n: p for n, p in shared.items() if n not in own and n not in without}
        optional = [name for name in (*NAMED_OPTIONS, *LOOP_OPTIONS) if name in added]
        context = next((n for n, p in own.items() if p.annotation is typer.Context), "")
        if not context:
            added["ctx"] = _parameter("ctx", inspect.Parameter.empty, typer.Context)

        @wraps(command)
        def run(**words: Any) -> None:
            called = words[context] if context else words.pop("ctx")
            unset = {name for name in optional if not is_given(called, name)}
            command(**{name: word for name, word in words.items() if name not in unset})

        every = [p.replace(kind=p.KEYWORD_ONLY) for p in (own | added).values()]
        run.__signature__ = inspect.Signature(every)  # type: ignore[attr-defined]
        run.__annotations__ |= {name: p.annotation for name, p in added.items()}
        return cast(Command, run)

    return extend


def is_given(context: typer.Context, name: str) -> bool:
    """Whether an option stands on the command line."""
    source = context.get_parameter_source(name)
    return source is not None and source.name != "DEFAULT"


def check_given(context: typer.Context, out: str, *, without: Sequence[str] = ()) -> None:
    """Raise OptionError for an option that is given and that what `out` holds does not show: a
    still picture, a page of live cloth, or a 3-D file, which may have one pose and 0 seconds.

    without: options that the command takes for every file.
    """
    from drapery.errors import OptionError
    from drapery.file_formats import known_format

    format = known_format(out, "still", "loop", "model", "page")
    kind = format.kind() if format else None
    options = {**LOOP_OPTIONS, **NAMED_OPTIONS} if kind == "page" else LOOP_OPTIONS
    for name, option in options.items():
        refusal = None if kind == "data" else option.refusal(output=kind)
        if format and kind == "model" and not format.moving and context.params.get(name):
            refusal = f"{name} does nothing for {format.name}, which holds one pose; leave it out"
        if refusal is not None and name not in without and is_given(context, name):
            raise OptionError(f"{out}: {refusal}")


def _from_option(option: Option) -> inspect.Parameter:
    kind: Any = option.type
    default = option.default
    if option.parts:
        kind, default = str, option.to_text(default)
    elif option.several:
        kind, default = list[kind], None
    if default is None:
        kind |= None
    return _parameter(option.name, default, Annotated[kind, _typer_option(option)])


def _parameter(name: str, default: object, kind: object) -> inspect.Parameter:
    return inspect.Parameter(name, inspect.Parameter.KEYWORD_ONLY, default=default, annotation=kind)


def options_of(words: Mapping[str, Any]) -> Options:
    """The picture options among a command's words, as `draw` takes them. Raises OptionError."""
    chosen = {name: option for name, option in NAMED_OPTIONS.items() if name in words}
    # typer gives None for an empty list.
    values = {
        name: option.parse((words[name] or ()) if option.several else words[name])
        for name, option in chosen.items()
    }
    return cast(Options, values)


def loop_options_of(words: Mapping[str, Any]) -> dict[str, Any]:
    """The options of a loop that are given among a command's words, as `animate` takes them."""
    return {name: words[name] for name in LOOP_OPTIONS if words.get(name) is not None}


def settings_of(words: Mapping[str, Any]) -> Settings:
    """The settings of the picture options among a command's words. Raises OptionError."""
    return Settings().changed(**options_of(words))


def design_of(words: Mapping[str, Any]) -> "Banner | None":
    """The design among a command's words, or None. Raises DesignError."""
    from drapery.banner import read_design

    text = words["design"]
    if text is None:
        return None
    return read_design(text, form=words["form"], number=words["number"])
