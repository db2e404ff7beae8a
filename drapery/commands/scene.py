"""`drapery scene`: the ready-made scenes, each by one command."""

from collections.abc import Iterator, Mapping, Sequence
from typing import Annotated, Any

import typer

from drapery.commands import options as o
from drapery.commands.notices import compile_notice, progress

CONTEXT = {"allow_extra_args": True, "ignore_unknown_options": True}
"""Options that the command does not know are parameters of the scene: `--script FILE`."""

_OF_MOMENTS = ("seconds", "fps")
"""Options of a loop that files without motion have too: they say which moment is the last."""


@o.pictured("loop", without=o.OF_PICTURES)
def run(
    context: typer.Context,
    name: Annotated[
        str | None, typer.Argument(metavar="NAME", help="Which scene.", show_default=False)
    ] = None,
    out: Annotated[
        str | None,
        typer.Option(
            "-o", "--out", metavar="TARGET", help="A picture, animation, folder or 3-D file (.glb)."
        ),
    ] = None,
    show_list: Annotated[bool, typer.Option("--list", help="List all scenes.")] = False,
    parameter: Annotated[
        list[str] | None,
        typer.Option("-p", "--set", metavar="NAME=VALUE", help="A parameter of the scene."),
    ] = None,
    seconds: Annotated[
        float | None, typer.Option(help="Length of the animation in seconds; 4 for most scenes.")
    ] = None,
    fps: Annotated[
        float | None, typer.Option(help="Frames per second; 20 for most scenes.")
    ] = None,
    size: o.SizeOption = "480x480",
    style: o.StyleOption = None,
    backend: o.BackendOption = "auto",
    **words: Any,
) -> None:
    """Play a ready-made scene; a still picture shows its last moment.

    A scene's parameters are options too: `--steps 4`, `--pixel-snap`.
    """
    from drapery.errors import OptionError
    from drapery.render.encode import check_target

    if show_list:
        _show_list()
    elif name is None:
        raise OptionError("no scene is given; `drapery scene --list` lists them all")
    elif out is None:
        _show_parameters(name)
    else:
        kind = check_target(out, "still", "loop", "model").kind()
        o.check_given(context, out, without=_OF_MOMENTS)
        parameters = [*(parameter or []), *_as_parameters(context.args)]
        timed = o.loop_options_of({"seconds": seconds, "fps": fps, **words})
        _play(name, out, kind, parameters, timed, size, backend, style or ())


def _play(
    name: str,
    out: str,
    kind: str,
    parameters: list[str],
    timed: Mapping[str, Any],
    size: str,
    backend: str,
    style: Sequence[str],
) -> None:
    """Write a scene. kind: of the file. timed: the given options of a loop, by name."""
    from dataclasses import replace

    from drapery.render import save_animation
    from drapery.scenes import Clip, find_scene, scene_frames
    from drapery.settings import OPTIONS

    scene, words = find_scene(name), _words(parameters)
    clip = Clip.timed(OPTIONS["size"].parse(size), replace(scene.clip.timing, **timed))
    with compile_notice(), progress("frames", clip.count) as tick:
        given = scene.parameters(words)
        if kind == "model":
            _refuse_looks(out, style, backend)
            _save_model(scene.play(given, clip), name, out, clip.fps)
            return
        drawn = scene_frames(scene, given, clip, backend, last=kind == "still", style=style)
        if kind == "still":
            next(drawn).save(out)
        else:
            save_animation(drawn, clip.fps, out, total=clip.count, progress=tick)


def _refuse_looks(out: str, style: Sequence[str], backend: str) -> None:
    """Raise OptionError for options that change pictures alone."""
    from drapery.errors import OptionError

    given = {"style": bool(style), "backend": backend != "auto"}
    for option in (each for each, is_given in given.items() if is_given):
        raise OptionError(f"{out}: {option} does nothing for a 3-D file; leave it out")


def _save_model(pictures: Iterator[object], name: str, out: str, fps: float) -> None:
    """Write the scenes of a loop, or in a format without motion the last of them."""
    from collections import deque

    from drapery.errors import OptionError
    from drapery.file_formats import format_of
    from drapery.render import Scene, save_scenes

    def checked() -> Iterator[Scene]:
        for picture in pictures:
            if not isinstance(picture, Scene):
                raise OptionError(f"scene {name} is several pictures, no 3-D scene; use .png")
            yield picture

    is_moving = format_of(out, "model").moving
    save_scenes(checked() if is_moving else deque(checked(), maxlen=1), out, fps=fps)


def _as_parameters(arguments: list[str]) -> list[str]:
    """`--steps 4`, `--steps=4` and `--pixel-snap` as NAME=VALUE. Raises OptionError."""
    from drapery.errors import OptionError

    found: list[str] = []
    for argument in arguments:
        if argument.startswith("--") and len(argument) > 2:
            found.append(argument[2:])
        elif found and "=" not in found[-1]:
            found[-1] += f"={argument}"
        else:
            raise OptionError(f"argument {argument!r} follows no option; write --NAME VALUE")
    return [word if "=" in word else f"{word}=yes" for word in found]


def _words(parameters: list[str]) -> dict[str, str]:
    from drapery.errors import OptionError

    for parameter in parameters:
        if "=" not in parameter:
            raise OptionError(f"parameter {parameter!r} has no value; write NAME=VALUE")
    pairs = (parameter.split("=", 1) for parameter in parameters)
    return {name.strip(): value.strip() for name, value in pairs}


def _show_list() -> None:
    from drapery.scenes import find_scene, scene_names

    for name in scene_names():
        print(f"{name:16} {find_scene(name).summary}")


def _show_parameters(name: str) -> None:
    from dataclasses import fields

    from drapery.scenes import find_scene

    scene = find_scene(name)
    print(scene.summary)
    defaults = scene.parameters()
    for field in fields(defaults):
        print(f"  {field.name} = {getattr(defaults, field.name)}")
