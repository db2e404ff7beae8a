"""Converts the parameters of an address to a checked request, or to a list of their errors."""

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal, TypeAlias
from urllib.parse import parse_qsl

from drapery.batch.manifest import PictureRequest
from drapery.errors import DraperyError, OptionError, shown
from drapery.file_formats import FileFormat, format_of
from drapery.option import Option, Output, Subject, within
from drapery.option_checks import check_options, one_line, unknown
from drapery.player_settings import PLAYER_OPTIONS, PlayerSettings
from drapery.settings import (
    LOOP_OPTIONS,
    OPTIONS,
    TEXTURED,
    LoopSettings,
    Settings,
    settled,
    settled_for,
)
from drapery.styles import combined_style

if TYPE_CHECKING:
    from drapery import Banner
    from drapery.garments import Garment

Resource: TypeAlias = Literal["banner", "garment", "player"]
"""What an address shows."""
SUBJECTS: dict[Resource, dict[str, bool]] = {
    "banner": {"design": True},
    "garment": {"name": True, "design": False},
    "player": {},
}
"""The texts that the address of each subject takes, and whether it needs them."""
PUBLIC_OPTIONS = tuple(name for name, option in OPTIONS.items() if option.public)
"""Options that anyone may set. Only the service sets those that name files, packs or backends."""
MAX_QUERY = 32 << 10
"""The most bytes of a query; enough for a design of 8000 characters with three bytes each."""
MAX_PARAMETERS = 64
MAX_WORN = 4
"""The most garments of a player."""
MAX_REASONS = 8
"""The most errors that one response lists."""

_PAIR = {"type": "string", "pattern": "^[1-9][0-9]{0,3}x[1-9][0-9]{0,3}$"}
_COLOUR = {"type": "string", "pattern": "^(transparent|#?[0-9a-fA-F]{6})$"}


@dataclass(frozen=True)
class PictureLimits:
    """Limits of one picture.

    side [pixels], pixels of all frames, seconds and fps of a loop, particles along a side of the
    cloth, simulated time before the picture [s], max_length of a design [characters],
    garments that a player wears.
    """

    side: int = 1024
    pixels: int = 32 << 20
    seconds: float = 10.0
    fps: float = 30.0
    particles: int = 33
    time: float = 60.0
    max_length: int = 8000
    garments: int = MAX_WORN


@dataclass(frozen=True)
class ServiceConfig:
    """What the service draws with.

    base: its packs and the pack format for reading them. skins, capes: PNG files by the names that
    addresses give them.
    """

    base: Settings = field(default_factory=lambda: Settings(size=(256, 320)))
    limits: PictureLimits = field(default_factory=PictureLimits)
    skins: Mapping[str, Path] = field(default_factory=dict)
    capes: Mapping[str, Path] = field(default_factory=dict)


def pictures_in(folder: Path) -> dict[str, Path]:
    """The PNG files of a folder by name, without their ending.

    Raises OptionError for a folder that cannot be read, and for a name that no address can give.
    """
    try:
        found = {path.stem: path for path in sorted(folder.iterdir()) if path.suffix == ".png"}
    except OSError as error:
        raise OptionError(f"{folder} cannot be read: {error.strerror}; check the path") from None
    for name, path in found.items():
        if not re.fullmatch(r"[A-Za-z0-9_-]{1,64}", name):
            raise OptionError(f"{path}: use letters, digits, - and _ in its name, 64 at most")
    return found


def options_of(subject: Resource, output: Output | None = None) -> tuple[str, ...]:
    """The options that the address of a subject takes."""
    return tuple(name for name in PUBLIC_OPTIONS if OPTIONS[name].applies(Subject(subject), output))


def _player_options(subject: Resource) -> tuple[str, ...]:
    """The options of a player that the address of a subject takes."""
    public = (name for name, option in PLAYER_OPTIONS.items() if option.public)
    return tuple(public) if subject == "player" else ()


def parameters(
    animated: bool, limits: PictureLimits, subject: Resource = "banner"
) -> list[dict[str, Any]]:
    """The query's parameters in OpenAPI form."""
    from drapery.garments import garment_names

    output: Output = "loop" if animated else "still"
    length = {"minLength": 1, "maxLength": limits.max_length}
    texts: dict[str, dict[str, Any]] = {
        "design": {"type": "string", **length},
        "name": {"enum": [*garment_names()]},
    }
    schemas: dict[str, dict[str, Any]] = {name: texts[name] for name in SUBJECTS[subject]}
    schemas |= {name: _schema(PLAYER_OPTIONS[name]) for name in _player_options(subject)}
    schemas |= {name: _schema(OPTIONS[name]) for name in options_of(subject, output)}
    if "time" in schemas:
        schemas["time"]["maximum"] = limits.time
    if animated:
        schemas |= {name: _schema(option) for name, option in LOOP_OPTIONS.items()}
        schemas["seconds"]["maximum"] = limits.seconds
        schemas["fps"]["maximum"] = limits.fps
    return [
        {
            "name": name,
            "in": "query",
            "required": SUBJECTS[subject].get(name, False),
            "schema": schema,
        }
        for name, schema in schemas.items()
    ]


def _schema(option: Option) -> dict[str, Any]:
    """The JSON schema of an option's values, which are texts."""
    if option.parts:
        return dict(_PAIR)
    if option.name == "background":
        return dict(_COLOUR)
    if option.choices:
        return {"enum": [choice for choice in option.choices if choice not in TEXTURED]}
    names: dict[object, str] = {bool: "boolean", int: "integer", float: "number"}
    schema: dict[str, Any] = {"type": names.get(option.type, "string")}
    if option.bounds is not None:
        schema["minimum"], schema["maximum"] = option.bounds
    return schema


def parse_query(query: bytes) -> list[tuple[str, str]]:
    """Names and values of a query. Raises OptionError if it is too long."""
    if len(query) > MAX_QUERY:
        raise OptionError(f"the query has over {MAX_QUERY} bytes; make it shorter")
    text = query.decode("latin-1")
    try:
        return parse_qsl(text, keep_blank_values=True, max_num_fields=MAX_PARAMETERS)
    except ValueError:
        raise OptionError(f"over {MAX_PARAMETERS} parameters; leave out some") from None


def read_request(
    query: Sequence[tuple[str, str]],
    ending: str,
    config: ServiceConfig,
    subject: Resource = "banner",
    skin: Path | None = None,
) -> PictureRequest | list[str]:
    """The request of a query, or the errors in the query, one line each.

    query: names and values from the address. ending: of a format that is served.
    subject: what it shows. skin: a file that the client sent, for a player.
    """
    faults = _faults(query, ending, subject)
    values = dict(query)
    if faults:
        return faults[:MAX_REASONS]
    output = _output(values, ending)
    option = OPTIONS["style"]
    if any(option.is_path(each) for each in option.parse(values.get("style", ""))):
        return [f"style {shown(values['style'])} names a file, which an address cannot; use a name"]
    settings = check_options({n: values[n] for n in PUBLIC_OPTIONS if n in values}, Path())
    if isinstance(settings, list):
        return settings[:MAX_REASONS]
    chosen = {n: getattr(settings, n) for n in PUBLIC_OPTIONS if n in values}
    try:
        combined_style(settings.style)
        if subject != "banner":
            is_player = subject == "player"
            garment = (
                _player(values, config, skin) if is_player else _garment(values, config.limits)
            )
            own = {**config.base.given_values, **garment.picture}
            settings = settled(Settings(**chosen), Subject(subject), output, own)
            return _request(values, garment, settings, ending, config.limits)
        settings, banner = Settings(**chosen), _banner(values, config.limits)
        settings = settled_for(banner, settings, output, config.base.given_values)
        _check_kind(banner, settings)
        return _request(values, banner, settings, ending, config.limits)
    except DraperyError as error:
        return [one_line(str(error))]
    except ValueError:
        return ["a value of the query cannot be used; correct it"]


def _format(ending: str) -> FileFormat:
    return format_of("picture" + ending, "still", "loop")


def _output(values: dict[str, str], ending: str) -> Output:
    """What a query asks for: a format that holds both is a loop where a length is asked for."""
    timed = any(name in values for name in LOOP_OPTIONS)
    return "loop" if _format(ending).kind(timed=timed) == "loop" else "still"


def _faults(query: Sequence[tuple[str, str]], ending: str, subject: Resource) -> list[str]:
    """The errors in the names of a query."""
    loop = tuple(LOOP_OPTIONS) if _format(ending).kind() == "loop" else ()
    known = frozenset({*SUBJECTS[subject], *_player_options(subject), *options_of(subject), *loop})
    names = [name for name, _ in query]
    strange = [name for name in dict.fromkeys(names) if name not in known]
    twice = sorted({name for name in names if name in known and names.count(name) > 1})
    # Limit the number: comparing a name with all known names takes time.
    faults = [unknown(name, known) for name in strange[:MAX_REASONS]]
    return faults + [f"{name} is given twice; give it once" for name in twice]


def _banner(values: dict[str, str], limits: PictureLimits) -> "Banner":
    from drapery import Banner

    text = values.get("design", "")
    if not text:
        raise OptionError("design is missing; write ?design=white+creeper:lime")
    if len(text) > limits.max_length:
        raise OptionError(f"design has over {limits.max_length} characters; write it shorter")
    # A client's text must not name a file, so only parse it and never open it.
    return Banner.parse(text)


def _check_kind(banner: "Banner", settings: Settings) -> None:
    from drapery.style import check_kind

    if settings.kind in TEXTURED:
        raise OptionError(f"kind {settings.kind} shows a file, which an address cannot name")
    check_kind(banner, settings)


def _garment(values: dict[str, str], limits: PictureLimits) -> "Garment":
    from drapery.garments import find_garment, garment_names

    name = values.get("name", "")
    # A client's text must not name a file, which `find_garment` would open.
    if name not in garment_names():
        what = f"name {shown(name)} is not a garment" if name else "name is missing"
        raise OptionError(f"{what}; use one of: {', '.join(garment_names())}")
    found = find_garment(name)
    return found.with_design(_banner(values, limits)) if "design" in values else found


def _player(values: dict[str, str], config: ServiceConfig, skin: Path | None) -> "Garment":
    """The player of an address. skin: a file that the client sent."""
    from drapery.garments import garment_names, is_profile_text, player_of, skin_names

    given = {name: values[name] for name in PLAYER_OPTIONS if name in values}
    for name in ("head", "worn_design", "shield"):
        if len(given.get(name, "")) > config.limits.max_length:
            raise OptionError(f"{name} has over {config.limits.max_length} characters")
    chosen = {name: PLAYER_OPTIONS[name].parse(value) for name, value in given.items()}
    # A client's text must not name a file, which `player_of` would open.
    if ".json" in chosen.get("motion", "").lower():
        raise OptionError("motion names a file, which an address cannot; use the name of a motion")
    worn = chosen.get("wear", ())
    within("wear", len(worn), 0, config.limits.garments, "garments")
    for name in worn:
        _known("wear", name, garment_names())
    if skin is not None and "skin" in chosen:
        raise OptionError("skin is in the address and in the body; leave one out")
    if skin is not None:
        chosen["skin"] = str(skin)
    elif is_profile_text(chosen.get("skin", "")):
        # It names textures of the service's packs alone.
        if len(chosen["skin"]) > config.limits.max_length:
            raise OptionError(f"skin has over {config.limits.max_length} characters")
    elif "skin" in chosen and chosen["skin"] not in skin_names():
        _known("skin", chosen["skin"], (*skin_names(), *config.skins))
        chosen["skin"] = str(config.skins[chosen["skin"]])
    if "cape" in chosen:
        _known("cape", chosen["cape"], tuple(config.capes))
        chosen["cape"] = str(config.capes[chosen["cape"]])
    return player_of(PlayerSettings(**chosen))


def _known(option: str, name: str, names: Sequence[str]) -> None:
    if name not in names:
        listed = ", ".join([*names[:MAX_REASONS], *["..."] * (len(names) > MAX_REASONS)])
        remedy = f"use one of: {listed}" if names else "the service has none; leave it out"
        raise OptionError(f"{option} {shown(name)} is not known; {remedy}")


def _request(
    values: dict[str, str],
    banner: "Banner | Garment",
    settings: Settings,
    ending: str,
    limits: PictureLimits,
) -> PictureRequest:
    timing = _timing(values, limits) if _output(values, ending) == "loop" else None
    _check_size(settings, 1 if timing is None else timing.count, limits)
    return PictureRequest("address", "picture" + ending, banner, settings, timing)


def _timing(values: dict[str, str], limits: PictureLimits) -> LoopSettings:
    given = {name: o.parse(values[name]) for name, o in LOOP_OPTIONS.items() if name in values}
    timing = LoopSettings(**given)
    within("fps", timing.fps, 1, limits.fps, "frames/s")
    within("seconds", timing.seconds, 1 / timing.fps, limits.seconds, "s")
    return timing


def _check_size(settings: Settings, frames: int, limits: PictureLimits) -> None:
    width, height = settings.size
    within("size", max(width, height), 1, limits.side, "pixels")
    within("grid", max(settings.grid), 2, limits.particles, "particles")
    within("time", settings.time, 0, limits.time, "s")
    within("pixels of all frames", width * height * frames, 1, limits.pixels)
