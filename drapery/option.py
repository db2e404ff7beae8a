"""The description of an option: its type and bounds, its help, and its values as texts."""

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, fields
from numbers import Integral, Real
from pathlib import Path
from types import MappingProxyType
from typing import Any, Literal, NamedTuple, TypeAlias

from drapery.errors import OptionError, shown

Audience: TypeAlias = Literal["anyone", "local", "python"]
"""Who may set an option: anyone over HTTP, the user of this machine, or only a Python program."""
OptionType: TypeAlias = type[bool] | type[int] | type[float] | type[str] | type[Path] | None
Effect: TypeAlias = Literal[
    "motion", "wind", "shape", "surface", "animation", "camera", "light", "file"
]
"""What an option changes: how the cloth moves, the wind, what stands where, textures and materials,
the moment of animated textures, the camera, the light, or the pixels and frames of a file."""
Output: TypeAlias = Literal["still", "loop", "model", "page", "face", "link"]
"""What is made: a picture, an animation, a 3-D file, a page of live cloth, a face without cloth, or
the address of a design in the studio."""


class Subject(NamedTuple):
    """What is drawn.

    kind: banner, shield, cape, elytra, garment or player.
    placement, pose: as in `Settings`; None is any of them.
    """

    kind: str = "banner"
    placement: str | None = None
    pose: str | None = None


_HIDDEN: Mapping[str, frozenset[Effect]] = {
    "shield": frozenset(("motion", "wind")),
    "cape": frozenset(("animation",)),
    "elytra": frozenset(("motion", "wind", "animation")),
    "item": frozenset(("motion", "wind", "camera")),
    "vanilla": frozenset(("motion", "wind")),
    "model": frozenset(("light", "file")),
    "face": frozenset(("motion", "wind", "shape", "animation", "camera", "light", "file")),
}
"""What does not show of a kind, placement or pose, or in an output: shields and elytra are stiff,
and an item has its own camera."""
_CALLED = {
    "cape": "a cape",
    "elytra": "elytra",
    "vanilla": "pose vanilla",
    "loop": "an animation",
    "standing": "placement standing",
    "wall": "placement wall",
    "item": "placement item",
    "banner": "a banner",
    "shield": "a shield",
    "garment": "a garment",
    "player": "a player",
    "still": "a still picture",
    "model": "a 3-D file",
    "page": "a page of live cloth",
}
"""How messages name the words of subjects, and outputs."""
_REMEDIES = dict.fromkeys(("garment", "player"), "set it in the garment's file")

_TRUE = frozenset({"1", "true", "yes", "on"})
_FALSE = frozenset({"0", "false", "no", "off"})


@dataclass(frozen=True)
class Option:
    """One option of a picture.

    help: its meaning, without a full stop at the end; `describe` adds the limits.
    type: of one value in Python; None where only the objects of `takes` are allowed.
    default: its value if nobody sets it. An option whose default is None may be set to None.
    default_text: the meaning of a default None.
    bounds: the lowest and the highest number that are allowed, both included.
    unit: of the number.
    choices: the values that are allowed, where they are few.
    parts: the names of the two whole numbers of a pair such as `512x512`.
    several: whether the value is a tuple of any number of values.
    takes: whether an object may be given, by a program, in place of a name or a number.
    audience: who may set it.
    ending: texts that end with it are paths of files; only for options of type str.
    flag: its name on the command line.
    metavar: what help shows in place of the value.
    affects: what it changes.
    not_for: words of subjects, and outputs, for which it does nothing all the same.
    remedy: what its refusal there advises.
    resolve: its value where nobody sets it, of all settings; for a default that depends on them.
    """

    name: str
    help: str
    type: OptionType
    default: Any = None
    default_text: str = ""
    bounds: tuple[float, float] | None = None
    unit: str = ""
    choices: tuple[str | int, ...] = ()
    parts: tuple[str, ...] = ()
    several: bool = False
    takes: Callable[[object], bool] | None = None
    audience: Audience = "local"
    ending: str = ""
    flag: str = ""
    metavar: str | None = None
    affects: tuple[Effect, ...] = ()
    not_for: tuple[str, ...] = ()
    remedy: str = ""
    resolve: Callable[[Any], Any] | None = None

    def applies(self, subject: Subject | None = None, output: Output | None = None) -> bool:
        """Whether it changes a subject in an output; None is any of them."""
        return self._hidden_by(subject, output) is None

    def refusal(self, subject: Subject | None = None, output: Output | None = None) -> str | None:
        """Why it is refused for a subject in an output, one line; None where it applies."""
        word = self._hidden_by(subject, output)
        if word is None:
            return None
        remedy = self.remedy or _REMEDIES.get(word, "leave it out")
        return f"{self.name} does nothing for {_CALLED.get(word, word)}; {remedy}"

    def _hidden_by(self, subject: Subject | None, output: Output | None) -> str | None:
        """The word of the subject, or the output, for which it does nothing."""
        seen = set(self.affects)
        words: tuple[str | None, ...] = (*(subject or ()), output)
        for word in words:
            if word is not None:
                seen -= _HIDDEN.get(word, frozenset())
                if not seen or word in self.not_for:
                    return word
        return None

    @property
    def public(self) -> bool:
        """Whether anyone may set it over HTTP."""
        return self.audience == "anyone"

    @property
    def command_flag(self) -> str:
        """Its name on the command line, such as `--block-light`."""
        return self.flag or "--" + self.name.replace("_", "-")

    @property
    def limits(self) -> str:
        """The values that are allowed, such as `0 to 40 m/s`; empty if any text will do."""
        if self.choices:
            *first, last = map(str, self.choices)
            return f"{', '.join(first)} or {last}"
        return "" if self.bounds is None else limits(*self.bounds, self.unit)

    def describe(self) -> str:
        """Its help with its limits, as one sentence."""
        return f"{self.help} ({self.limits})." if self.limits else f"{self.help}."

    def check(self, value: object) -> Any:
        """The value in its own type. Raises OptionError that names the option and its limits."""
        if value is None and self.default is None:
            return None
        if self.several:
            values = (value,) if self._taken(value) else _sequence(self.name, value)
            return tuple(self._check_one(self.name, each) for each in values)
        if self.parts:
            return self._check_pair(pair(self.name, value) if isinstance(value, str) else value)
        return self._check_one(self.name, value)

    def parse(self, value: object, folder: Path | None = None) -> Any:
        """A text, or a value of JSON, TOML or YAML, as `check` returns it.

        folder: relative paths start here; None leaves them as they are.
        Raises OptionError.
        """
        if self.several and isinstance(value, str):
            value = [part.strip() for part in value.split(";") if part.strip()]
        if self.several and isinstance(value, list | tuple):
            return self.check([self._parse_one(each, folder) for each in value])
        return self.check(self._parse_one(value, folder))

    def is_path(self, value: object) -> bool:
        """Whether a value of this option is the path of a file."""
        return self.type is Path or bool(self.ending and str(value).endswith(self.ending))

    def to_text(self, value: object) -> str:
        """A value as `parse` reads it; an empty text for None."""
        if value is None:
            return ""
        if isinstance(value, bool):
            return "yes" if value else "no"
        if isinstance(value, tuple | list):
            return ("x" if self.parts else ";").join(map(str, value))
        return str(value)

    def _check_pair(self, value: object) -> tuple[int, int]:
        if not isinstance(value, tuple | list) or len(value) != len(self.parts):
            example = self.to_text(self.default)
            raise OptionError(
                f"{self.name} {shown(value)} is not two whole numbers; write it like {example}"
            )
        first, second = (
            self._check_one(f"{self.name} ({part})", each)
            for part, each in zip(self.parts, value, strict=True)
        )
        return first, second

    def _taken(self, value: object) -> bool:
        return self.takes is not None and self.takes(value)

    def _check_one(self, name: str, value: Any) -> Any:
        if self._taken(value):
            return value
        if self.type is None:
            raise OptionError(f"{name} {shown(value)} cannot be used; give {self.help}")
        if self.type is bool:
            if not isinstance(value, bool):
                raise OptionError(f"{name} {shown(value)} is not yes or no; use one of them")
            return value
        if self.type is Path:
            if not isinstance(value, str | Path) or "\0" in str(value):
                raise OptionError(f"{name} {shown(value)} is not a path; give the path of a file")
            return value
        if self.choices:
            one_of(name, value, self.choices)
        elif self.type is str:
            if not isinstance(value, str):
                raise OptionError(f"{name} {shown(value)} is not a text; put it in quotes")
        elif self.bounds is not None:
            (whole if self.type is int else within)(name, value, *self.bounds, self.unit)
        return self.type(value)

    def _parse_one(self, value: object, folder: Path | None) -> object:
        if isinstance(value, str):
            value = _from_text(value.strip(), self.type)
        elif self.type is int and isinstance(value, float) and value.is_integer():
            value = int(value)
        if folder is not None and isinstance(value, str | Path) and self.is_path(value):
            value = folder / value if self.type is Path else str(folder / value)
        return value


def option_field(default: Any, kind: Any, help: str, **more: Any) -> Any:
    """A field of a dataclass of options, with its line of their table.

    default, kind, help, more: the default, type, help and other attributes of its `Option`.
    """
    return field(default=default, metadata={"help": help, "type": kind, **more})


def option_table(settings: type) -> Mapping[str, Option]:
    """The options of a dataclass by name, in the order in which help and its docstring list them.

    settings: the class, whose docstring gets a line of each option.
    """
    described = [each for each in fields(settings) if each.metadata]
    table = {
        each.name: Option(each.name, default=each.default, **each.metadata) for each in described
    }
    lines = [f"    {name}: {each.describe()}" for name, each in table.items()]
    settings.__doc__ = "\n".join([f"{settings.__doc__}\n", *lines])
    return MappingProxyType(table)


def _from_text(text: str, kind: OptionType) -> object:
    """The text as a value of the type, or the text itself if it is none of that type."""
    if kind is bool:
        word = text.lower()
        return word in _TRUE if word in _TRUE | _FALSE else text
    if kind not in (int, float) or "_" in text:
        return text
    try:
        number = float(text)
        if kind is int and number.is_integer():
            # A float holds whole numbers exactly only up to 2^53.
            return int(number) if "." in text or "e" in text.lower() else int(text)
    except (ValueError, OverflowError):
        return text
    return number


def limits(least: float, most: float, unit: str = "") -> str:
    """Two bounds as help and messages write them, such as `0 to 40 m/s`."""
    return f"{_plain(least)} to {_plain(most)} {unit}".strip()


def _plain(number: float) -> str:
    return str(int(number)) if float(number).is_integer() else f"{number:g}"


def one_of(option: str, value: object, allowed: Sequence[object]) -> None:
    """Raise OptionError unless the value is one of those allowed."""
    # True equals 1, and an array equals nothing as a whole.
    if isinstance(value, bool) or not isinstance(value, str | Integral) or value not in allowed:
        names = ", ".join(map(str, allowed))
        raise OptionError(f"{option} {shown(value)} is not known; use one of: {names}")


def within(option: str, value: Any, least: float, most: float, unit: str = "") -> None:
    """Raise OptionError unless the value is a finite number between two bounds, both included."""
    # int and float come first: asking an abstract class takes many times as long.
    if isinstance(value, bool) or not isinstance(value, int | float | Real):
        allowed = limits(least, most, unit)
        raise OptionError(f"{option} {shown(value)} is not a number; use {allowed}")
    # A whole number may be too large for a float, and NaN fails each comparison.
    is_whole = isinstance(value, int | Integral)
    if not value <= most or value < least or (not is_whole and math.isinf(value)):
        allowed = limits(least, most, unit)
        raise OptionError(f"{option} {shown(value)} is out of range; use {allowed}")


def whole(option: str, value: object, least: float, most: float, unit: str = "") -> None:
    """Raise OptionError unless the value is a whole number between two bounds, both included."""
    within(option, value, least, most, unit)
    if not isinstance(value, int | Integral):
        raise OptionError(f"{option} {shown(value)} is not a whole number; round it")


def pair(option: str, text: str) -> tuple[int, int]:
    """Two whole numbers written `512x512`. Raises OptionError."""
    sides = text.strip().lower().split("x")
    if len(sides) != 2 or len(text) > 16 or not all(s.isascii() and s.isdigit() for s in sides):
        raise OptionError(f"{option} {shown(text)} is not two whole numbers; write it like 512x512")
    return int(sides[0]), int(sides[1])


def _sequence(option: str, value: object) -> Sequence[object]:
    if isinstance(value, str | Path):
        return (value,)
    if not isinstance(value, tuple | list):
        raise OptionError(f"{option} {shown(value)} is not a list; put it in brackets: [...]")
    return value
