"""The command or the Python code that makes the same file as an export."""

import json
import shlex
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any

from drapery import Banner, Settings
from drapery.banner import write_banner
from drapery.option import Option
from drapery.settings import LOOP_OPTIONS, NAMED_OPTIONS

STILLS = ("png",)
LOOPS = ("gif", "apng", "webp", "mp4")
KINDS = (*STILLS, "face", *LOOPS, "glb", "json")
"""The kinds of files: `face` is the flat face without cloth, `json` is the design itself."""

PICTURE_OPTIONS = tuple(NAMED_OPTIONS)
SCALE = Option("scale", "Pixels of a texel", int, 8, bounds=(1, 256), unit="pixels")
"""The option `--scale` of `drapery flat`."""
MODEL_OPTIONS = (
    *("packs", "format", "kind", "texture", "pose", "placement", "rotation", "facing"),
    *("view", "grid", "solver", "fabric", "pins", "contact", "wind", "direction", "gusts"),
    *("time", "seed", "style", "thickness"),
)
"""Options of `drapery model`; the others have no effect on a 3-D file."""
FACE_OPTIONS = ("packs", "format")

_SAFE = frozenset("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789 _-:./,#")


@dataclass(frozen=True)
class ExportRequest:
    """The description of a file to make.

    kind: one of KINDS. seconds, fps: for a loop. scale: pixels per texel, for a face.
    """

    banner: Banner | None
    settings: Settings
    kind: str = "png"
    seconds: float = LOOP_OPTIONS["seconds"].default
    fps: float = LOOP_OPTIONS["fps"].default
    scale: int = SCALE.default


def file_name(request: ExportRequest, stem: str = "banner") -> str:
    """The name of the file, for example `banner.png`."""
    return f"{stem}.{'png' if request.kind == 'face' else request.kind}"


def options_for(request: ExportRequest) -> Settings:
    """The options of this kind of file; the others have their default."""
    settings = request.settings
    return Settings(**{name: getattr(settings, name) for name in _names(request)})


def as_command(
    request: ExportRequest, called: Mapping[str, str] | None = None, stem: str = "banner"
) -> str:
    """The command that writes the file, quoted for a shell.

    called: the user's names of packs, by path.
    """
    design = [] if request.banner is None else [_quoted(write_banner(request.banner, "text"))]
    out = _quoted(file_name(request, stem))
    if request.kind == "json":
        return " ".join(["drapery show", *design, "--as json", ">", out])
    words = [f"drapery {_COMMANDS.get(request.kind, 'animate')}", *design, "-o", out]
    words += [_quoted(word) for word in _flags(request, called or {})]
    return " ".join(words)


def as_python(
    request: ExportRequest, called: Mapping[str, str] | None = None, stem: str = "banner"
) -> str:
    """Lines of Python that write the file."""
    banner = [] if request.banner is None else ["banner"]
    out = _text(file_name(request, stem))
    named = _named(request, called or {})
    names, lines = _PYTHON.get(request.kind, _loop)(request, banner, named, out)
    if banner and request.banner is not None:
        names = [*names, "drapery.Banner"]
        text = _text(write_banner(request.banner, "text"))
        lines = [f"banner = Banner.parse({text})", *lines]
    return "\n".join([*_imports(names), "", *lines, ""])


_COMMANDS = {"png": "render", "face": "flat", "glb": "model"}


def _names(request: ExportRequest) -> tuple[str, ...]:
    if request.kind == "json":
        return ()
    return {"glb": MODEL_OPTIONS, "face": FACE_OPTIONS}.get(request.kind, PICTURE_OPTIONS)


def _changed(request: ExportRequest, called: Mapping[str, str]) -> dict[str, Any]:
    """This kind's options that differ from their default; packs have the user's names."""
    values = {name: getattr(request.settings, name) for name in _names(request)}
    changed = {
        name: value for name, value in values.items() if value != NAMED_OPTIONS[name].default
    }
    if "packs" in changed:
        changed["packs"] = [called.get(str(pack), str(pack)) for pack in changed["packs"]]
    if "texture" in changed:
        changed["texture"] = str(changed["texture"])
    return changed


def _timing(request: ExportRequest) -> dict[str, Any]:
    if request.kind == "face":
        return {} if request.scale == SCALE.default else {"scale": request.scale}
    if request.kind in STILLS:
        return {}
    chosen = {"seconds": request.seconds, "fps": request.fps}
    return {name: value for name, value in chosen.items() if value != LOOP_OPTIONS[name].default}


def _flags(request: ExportRequest, called: Mapping[str, str]) -> Iterator[str]:
    for name, value in (_timing(request) | _changed(request, called)).items():
        option = {**NAMED_OPTIONS, **LOOP_OPTIONS, "scale": SCALE}[name]
        flag = option.command_flag
        if option.several:
            for each in value:
                yield from (flag, each)
        elif value is True:
            yield flag
        else:
            yield from (flag, option.to_text(value) if option.parts else plain(value))


def plain(value: object) -> str:
    """The value in short form: 4 for 4.0; without rounding."""
    return repr(value).removesuffix(".0") if isinstance(value, float) else str(value)


def _quoted(word: str) -> str:
    """The word quoted for a shell; in double quotes if possible, as Windows knows no others."""
    if word and _SAFE.issuperset(word):
        return f'"{word}"' if {" ", "#"}.intersection(word) else word
    return shlex.quote(word)


def _text(value: object) -> str:
    """The value as Python code; strings have double quotes."""
    return json.dumps(value, ensure_ascii=False) if isinstance(value, str) else repr(value)


def _named(request: ExportRequest, called: Mapping[str, str]) -> list[str]:
    """Keyword arguments as Python code, for example `view="iso"`."""
    changed = _changed(request, called)
    if "packs" in changed:
        changed["packs"] = _Listed(changed["packs"])
    return [f"{name}={_text(value)}" for name, value in changed.items()]


class _Listed(list[str]):
    """A list whose representation has its strings in double quotes."""

    def __repr__(self) -> str:
        return f"[{', '.join(map(_text, self))}]"


def _imports(names: list[str]) -> list[str]:
    """Import lines for full names, one line for each module."""
    modules: dict[str, list[str]] = {}
    for name in sorted(names):
        module, _, short = name.rpartition(".")
        modules.setdefault(module, []).append(short)
    return [f"from {module} import {', '.join(modules[module])}" for module in modules]


_Code = tuple[list[str], list[str]]
"""The full names to import, and the lines that use them."""


def _still(request: ExportRequest, banner: list[str], named: list[str], out: str) -> _Code:
    return ["drapery.draw"], [f"{_call('draw', banner, named)}.save({out})"]


def _loop(request: ExportRequest, banner: list[str], named: list[str], out: str) -> _Code:
    return ["drapery.animate"], [f"{_call('animate', banner, _times(request) + named)}.save({out})"]


def _face(request: ExportRequest, banner: list[str], named: list[str], out: str) -> _Code:
    drawn = _call("draw_face", banner, _times(request) + named)
    return ["drapery.draw_face"], [f"{drawn}.save({out})"]


def _design(request: ExportRequest, banner: list[str], named: list[str], out: str) -> _Code:
    names = ["drapery.banner.write_banner", "pathlib.Path"]
    return names, [f'Path({out}).write_text(write_banner(banner) + "\\n")']


def _model(request: ExportRequest, banner: list[str], named: list[str], out: str) -> _Code:
    arguments = [*(banner or ["None"]), out]
    return ["drapery.save_model"], [_call("save_model", arguments, _times(request) + named)]


def _times(request: ExportRequest) -> list[str]:
    return [f"{name}={_text(value)}" for name, value in _timing(request).items()]


def _call(function: str, arguments: list[str], named: list[str]) -> str:
    return f"{function}({', '.join([*arguments, *named])})"


_PYTHON = {"png": _still, "face": _face, "glb": _model, "json": _design}
