"""A picture as the command, or the lines of Python, that make the very same file."""

import json
import shlex
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any

from drapery.banner.design import Banner
from drapery.banner.formats import shorthand
from drapery.settings import NAMED_OPTIONS, Settings

STILLS = ("png",)
LOOPS = ("gif", "apng", "webp", "mp4")
KINDS = (*STILLS, "face", *LOOPS, "glb", "json")
"""What can be made: `face` is the plain flat face, `json` the design itself."""

PICTURE_OPTIONS = tuple(NAMED_OPTIONS)
MODEL_OPTIONS = (
    *("packs", "format", "kind", "texture", "pose", "placement", "rotation", "facing"),
    *("view", "grid", "solver", "pins", "wind", "direction", "gusts", "time", "seed"),
    "thickness",
)
"""Options of `drapery model`; the others mean nothing in a 3-D file."""
FACE_OPTIONS = ("packs", "format")

_SAFE = frozenset("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789 _-:./,#")


@dataclass(frozen=True)
class Order:
    """What is to be made.

    kind: one of KINDS. seconds, fps: of a loop. scale: pixels a texel of a face.
    """

    banner: Banner | None
    settings: Settings
    kind: str = "png"
    seconds: float = 4.0
    fps: float = 20.0
    scale: int = 8


def file_name(order: Order, stem: str = "banner") -> str:
    """The name of the file, as `banner.png`."""
    return f"{stem}.{'png' if order.kind == 'face' else order.kind}"


def options_for(order: Order) -> Settings:
    """The options that count for this kind of file; the others are at their default."""
    settings = order.settings
    return Settings(**{name: getattr(settings, name) for name in _names(order)})


def as_command(order: Order, called: Mapping[str, str] | None = None, stem: str = "banner") -> str:
    """The command that writes the file, quoted for a shell.

    called: what packs are called where their path says nothing to a person.
    """
    design = [] if order.banner is None else [_quoted(shorthand.write(order.banner))]
    out = _quoted(file_name(order, stem))
    if order.kind == "json":
        return " ".join(["drapery show", *design, "--as json", ">", out])
    words = [f"drapery {_COMMANDS.get(order.kind, 'animate')}", *design, "-o", out]
    words += [_quoted(word) for word in _flags(order, called or {})]
    return " ".join(words)


def as_python(order: Order, called: Mapping[str, str] | None = None, stem: str = "banner") -> str:
    """Lines of Python that write the file."""
    banner = [] if order.banner is None else ["banner"]
    out = _text(file_name(order, stem))
    named = _named(order, called or {})
    names, lines = _PYTHON.get(order.kind, _loop)(order, banner, named, out)
    if banner and order.banner is not None:
        names = [*names, "drapery.Banner"]
        lines = [f"banner = Banner.parse({_text(shorthand.write(order.banner))})", *lines]
    return "\n".join([*_imports(names), "", *lines, ""])


_COMMANDS = {"png": "render", "face": "flat", "glb": "model"}


def _names(order: Order) -> tuple[str, ...]:
    if order.kind == "json":
        return ()
    return {"glb": MODEL_OPTIONS, "face": FACE_OPTIONS}.get(order.kind, PICTURE_OPTIONS)


def _changed(order: Order, called: Mapping[str, str]) -> dict[str, Any]:
    """This kind of file's options that are off their default, packs as they are called."""
    plain, chosen = Settings(), options_for(order)
    changed = {
        name: getattr(chosen, name)
        for name in _names(order)
        if getattr(chosen, name) != getattr(plain, name)
    }
    if "packs" in changed:
        changed["packs"] = [called.get(str(pack), str(pack)) for pack in changed["packs"]]
    if "texture" in changed:
        changed["texture"] = str(changed["texture"])
    return changed


def _timing(order: Order) -> dict[str, Any]:
    if order.kind == "face":
        return {} if order.scale == 8 else {"scale": order.scale}
    if order.kind in STILLS:
        return {}
    plain = Order(None, order.settings)
    chosen = {"seconds": order.seconds, "fps": order.fps}
    return {name: value for name, value in chosen.items() if value != getattr(plain, name)}


def _flags(order: Order, called: Mapping[str, str]) -> Iterator[str]:
    for name, value in (_timing(order) | _changed(order, called)).items():
        flag = "--" + name.replace("_", "-")
        if name == "packs":
            for pack in value:
                yield from ("--pack", pack)
        elif value is True:
            yield flag
        elif isinstance(value, tuple):
            yield from (flag, "x".join(map(str, value)))
        else:
            yield from (flag, plain(value))


def plain(value: object) -> str:
    """The value as a person writes it: 4.0 is 4, and nothing is rounded."""
    return repr(value).removesuffix(".0") if isinstance(value, float) else str(value)


def _quoted(word: str) -> str:
    """The word for a shell; in double quotes where those suffice, since Windows knows no other."""
    if word and _SAFE.issuperset(word):
        return f'"{word}"' if {" ", "#"}.intersection(word) else word
    return shlex.quote(word)


def _text(value: object) -> str:
    """The value as Python writes it, texts in double quotes."""
    return json.dumps(value, ensure_ascii=False) if isinstance(value, str) else repr(value)


def _named(order: Order, called: Mapping[str, str]) -> list[str]:
    """Keyword arguments: `view="iso"`."""
    changed = _changed(order, called)
    if "packs" in changed:
        changed["packs"] = _Listed(changed["packs"])
    return [f"{name}={_text(value)}" for name, value in changed.items()]


class _Listed(list[str]):
    """A list whose texts are shown in double quotes."""

    def __repr__(self) -> str:
        return f"[{', '.join(map(_text, self))}]"


def _imports(names: list[str]) -> list[str]:
    """Import lines of full names, those of a module in one line."""
    homes: dict[str, list[str]] = {}
    for name in sorted(names):
        home, _, short = name.rpartition(".")
        homes.setdefault(home, []).append(short)
    return [f"from {home} import {', '.join(homes[home])}" for home in homes]


_Code = tuple[list[str], list[str]]
"""Full names to be imported, and the lines that use them."""


def _still(order: Order, banner: list[str], named: list[str], out: str) -> _Code:
    return ["drapery.draw"], [f"{_call('draw', banner, named)}.save({out})"]


def _loop(order: Order, banner: list[str], named: list[str], out: str) -> _Code:
    return ["drapery.animate"], [f"{_call('animate', banner, _times(order) + named)}.save({out})"]


def _face(order: Order, banner: list[str], named: list[str], out: str) -> _Code:
    drawn = _call("draw_face", banner, _times(order) + named)
    return ["drapery.draw_face"], [f"{drawn}.save({out})"]


def _design(order: Order, banner: list[str], named: list[str], out: str) -> _Code:
    names = ["drapery.banner.formats.write_banner", "pathlib.Path"]
    return names, [f'Path({out}).write_text(write_banner(banner) + "\\n")']


def _model(order: Order, banner: list[str], named: list[str], out: str) -> _Code:
    names = [
        "drapery.banner.packs.open_packs",
        "drapery.settings.frame_count",
        "drapery.render.export.save_model",
        "drapery.scenes.stager.loop",
        "drapery.settings.Settings",
    ]
    seconds, fps = repr(order.seconds), repr(order.fps)
    moved = [*(banner or ["None"]), "packs", "settings", f"frame_count({seconds}, {fps})", fps]
    return names, [
        f"settings = {_call('Settings', [], named)}",
        "packs = open_packs(settings.packs, format=settings.format)",
        f"scenes = {_call('loop', moved, [])}",
        f"save_model(scenes, {out}, fps={fps})",
    ]


def _times(order: Order) -> list[str]:
    return [f"{name}={_text(value)}" for name, value in _timing(order).items()]


def _call(function: str, arguments: list[str], named: list[str]) -> str:
    return f"{function}({', '.join([*arguments, *named])})"


_PYTHON = {"png": _still, "face": _face, "glb": _model, "json": _design}
