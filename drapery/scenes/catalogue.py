"""The ready-made scenes, found by name: one module each, which offers `Parameters` and `play`.

`Parameters` is a frozen dataclass whose defaults are the scene's own values; `play(parameters,
shot)` yields one picture for each frame of the shot. The module's first line says what is seen;
its SHOT, where it has one, is its own length and frame rate.
"""

import math
import pkgutil
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, fields
from importlib import import_module
from types import ModuleType
from typing import Any

import drapery.scenes
from drapery.errors import OptionError
from drapery.scenes.panels import Picture


@dataclass(frozen=True)
class Shot:
    """What is asked of any scene.

    size: width and height [pixels]. count: frames. fps: frames per second.
    """

    size: tuple[int, int] = (480, 480)
    count: int = 80
    fps: float = 20.0


@dataclass(frozen=True)
class Entry:
    """One scene of the catalogue."""

    name: str
    summary: str
    module: ModuleType

    @property
    def shot(self) -> Shot:
        """The scene's own length and frame rate."""
        own: Shot = getattr(self.module, "SHOT", Shot())
        return own

    def parameters(self, words: Mapping[str, str] | None = None) -> Any:
        """The scene's parameters, some of them given as text. Raises OptionError."""
        return _read(self.module.Parameters, words or {}, self.name)

    def play(self, parameters: Any, shot: Shot) -> Iterator[Picture]:
        """One picture for each frame of the shot."""
        pictures: Iterable[Picture] = self.module.play(parameters, shot)
        return iter(pictures)


def names() -> list[str]:
    """All scenes, by the names that people type."""
    found = (info.name for info in pkgutil.iter_modules(drapery.scenes.__path__))
    return sorted(name.replace("_", "-") for name in found if _is_scene(name))


def find(name: str) -> Entry:
    """The scene of this name. Raises OptionError if there is none."""
    known = names()
    if name not in known:
        raise OptionError(f"scene {name!r} is not known; use one of: {', '.join(known)}")
    module = import_module(f"drapery.scenes.{name.replace('-', '_')}")
    summary = (module.__doc__ or "").strip().splitlines()[0]
    return Entry(name, summary, module)


def _is_scene(name: str) -> bool:
    return hasattr(import_module(f"drapery.scenes.{name}"), "play")


def _read(kind: type[Any], words: Mapping[str, str], scene: str) -> Any:
    known = {field.name: field for field in fields(kind)}
    given = {}
    for word, text in words.items():
        field = known.get(word.replace("-", "_"))
        if field is None:
            raise OptionError(
                f"scene {scene} has no parameter {word!r}; it has: {', '.join(known)}"
            )
        given[field.name] = _value(word, text, field.default)
    return kind(**given)


def _value(word: str, text: str, default: Any) -> Any:
    """A parameter's text as the type of its default. Raises OptionError."""
    try:
        if isinstance(default, bool):
            return {"yes": True, "true": True, "no": False, "false": False}[text.lower()]
        if isinstance(default, tuple):
            parts = text.replace("x", ",").split(",")
            return tuple(_number(p, type(d)) for d, p in zip(default, parts, strict=True))
        return text if isinstance(default, str) else _number(text, type(default))
    except (KeyError, ValueError):
        pass
    example = ",".join(map(str, default)) if isinstance(default, tuple) else default
    example = {True: "yes", False: "no"}[default] if isinstance(default, bool) else example
    raise OptionError(f"parameter {word} = {text!r} does not fit; write it like {example}")


def _number(text: str, kind: type[Any]) -> Any:
    """A finite number. Raises ValueError."""
    value = kind(text)
    if not math.isfinite(value):
        raise ValueError(text)
    return value
