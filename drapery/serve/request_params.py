"""What an address asks for, checked: a request within the service's limits, or its faults."""

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any, get_args

from drapery.batch.manifest import PictureRequest
from drapery.errors import DraperyError, OptionError
from drapery.options import check_options, unknown
from drapery.settings import MAX_WIND, Pins, Settings, within

PUBLIC_OPTIONS = (
    *("size", "pose", "placement", "rotation", "facing", "view", "grid"),
    *("pins", "wind", "direction", "gusts", "time"),
    *("seed", "layers", "thickness", "background", "kind"),
)
"""Options that anyone may set. Those that name files, packs or backends are the service's own."""

PAIR = {"type": "string", "pattern": "^[1-9][0-9]{0,3}x[1-9][0-9]{0,3}$"}


@dataclass(frozen=True)
class PictureLimits:
    """JobLimits of one picture. side [pixels], pixels of all frames, seconds and fps of a loop,
    particles along a side of the cloth, hang: time that cloth hangs [s], max_length of a design."""

    side: int = 1024
    pixels: int = 32 << 20
    seconds: float = 10.0
    fps: float = 30.0
    particles: int = 33
    hang: float = 60.0
    max_length: int = 8000


@dataclass(frozen=True)
class ServiceConfig:
    """What the service draws with. base: its packs and the format it reads them as."""

    base: Settings = field(default_factory=lambda: Settings(size=(256, 320)))
    limits: PictureLimits = field(default_factory=PictureLimits)


def parameters(animated: bool, limits: PictureLimits) -> list[dict[str, Any]]:
    """The query's parameters, for OpenAPI."""
    schemas: dict[str, dict[str, Any]] = {
        "design": {"type": "string", "minLength": 1, "maxLength": limits.max_length},
        "size": PAIR,
        "pose": {"enum": ["cloth", "vanilla"]},
        "placement": {"enum": ["standing", "wall", "item"]},
        "rotation": {"type": "integer", "minimum": 0, "maximum": 15},
        "facing": {"enum": ["south", "west", "north", "east"]},
        "view": {"enum": ["front", "back", "iso", "gui", "hero"]},
        "grid": PAIR,
        "pins": {"enum": list(get_args(Pins))},
        "wind": {"type": "number", "minimum": 0, "maximum": MAX_WIND},
        "direction": {"type": "number", "minimum": -360, "maximum": 360},
        "gusts": {"type": "number", "minimum": 0, "maximum": 2},
        "time": {"type": "number", "minimum": 0, "maximum": limits.hang},
        "seed": {"type": "integer", "minimum": 0, "maximum": 2**32 - 1},
        "layers": {"enum": ["stacked", "flat"]},
        "thickness": {"type": "number", "minimum": 0, "maximum": 8},
        "background": {"type": "string", "pattern": "^(transparent|#?[0-9a-fA-F]{6})$"},
        "kind": {"enum": ["auto", "banner", "shield"]},
    }
    if animated:
        schemas["seconds"] = {"type": "number", "exclusiveMinimum": 0, "maximum": limits.seconds}
        schemas["fps"] = {"type": "number", "minimum": 1, "maximum": limits.fps}
    return [
        {"name": name, "in": "query", "required": name == "design", "schema": schema}
        for name, schema in schemas.items()
    ]


def read_request(
    query: Sequence[tuple[str, str]], ending: str, config: ServiceConfig
) -> PictureRequest | list[str]:
    """The request of a query, or why it is none, one line for each fault.

    query: names and values as they stand in the address. ending: `.png` or `.gif`.
    """
    words = dict(query)
    known = frozenset(
        {"design", *PUBLIC_OPTIONS, *(("seconds", "fps") if ending == ".gif" else ())}
    )
    faults = [unknown(name, known) for name in words if name not in known]
    faults += [f"{name} is given twice; give it once" for name in _twice(query, known)]
    if faults:
        return faults
    settings = check_options({n: words[n] for n in PUBLIC_OPTIONS if n in words}, Path())
    if isinstance(settings, list):
        return settings
    chosen = {n: getattr(settings, n) for n in PUBLIC_OPTIONS if n in words}
    try:
        settings = replace(config.base, **chosen)
        return _request(words, settings, ending, config.limits)
    except (DraperyError, ValueError) as error:
        return [str(error)]


def _request(
    words: dict[str, str], settings: Settings, ending: str, limits: PictureLimits
) -> PictureRequest:
    from drapery.banner.formats import parse_banner
    from drapery.render.views import VIEWS
    from drapery.settings import one_of
    from drapery.style.kinds import check_kind

    text = words.get("design", "")
    if not text:
        raise OptionError("design is missing; write ?design=white+creeper:lime")
    if len(text) > limits.max_length:
        raise OptionError(f"design has over {limits.max_length} max_length; write it shorter")
    one_of("view", settings.view, tuple(VIEWS))
    # Never `read_design`: a stranger's text must not name a file.
    banner = parse_banner(text)
    if settings.kind in ("cape", "elytra"):
        raise OptionError(f"kind {settings.kind} wears a file, which is not for an address")
    check_kind(banner, settings)
    seconds, fps = _times(words, limits) if ending == ".gif" else (None, None)
    _within(settings, 1 if seconds is None else round(seconds * (fps or 1)), limits)
    return PictureRequest("address", "picture" + ending, banner, settings, seconds, fps)


def _times(words: dict[str, str], limits: PictureLimits) -> tuple[float, float]:
    from drapery.settings import frame_count

    seconds, fps = _number("seconds", words, 4.0), _number("fps", words, 20.0)
    within("fps", fps, 1, limits.fps, "frames/s")
    within("seconds", seconds, 1 / fps, limits.seconds, "s")
    frame_count(seconds, fps)
    return seconds, fps


def _number(name: str, words: dict[str, str], default: float) -> float:
    try:
        return float(words.get(name, default))
    except ValueError:
        raise OptionError(f"{name} {words[name][:20]!r} is no number; write 4 or 2.5") from None


def _within(settings: Settings, frames: int, limits: PictureLimits) -> None:
    width, height = settings.size
    within("size", max(width, height), 1, limits.side, "pixels")
    within("grid", max(settings.grid), 2, limits.particles, "particles")
    within("time", settings.time, 0, limits.hang, "s")
    within("pixels of all frames", width * height * frames, 1, limits.pixels)


def _twice(query: Sequence[tuple[str, str]], known: frozenset[str]) -> list[str]:
    names = [name for name, _ in query]
    return sorted({name for name in names if name in known and names.count(name) > 1})
