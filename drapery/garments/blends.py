"""The text of a player's motion: one, several layers, or a mean by weight."""

from dataclasses import dataclass
from pathlib import Path

from drapery.errors import OptionError, shown
from drapery.player_settings import MOTIONS

MAX_BLENDED = 8
"""The most motions of a blend."""
POSE_ENDING = ".json"
"""How the names of files of poses end."""


@dataclass(frozen=True)
class MotionBlend:
    """Motions by name or file, each with its weight, and whether they are a mean or layers."""

    parts: tuple[tuple[str, float], ...]
    is_mean: bool = False

    @property
    def files(self) -> tuple[str, ...]:
        """Those that are files of poses."""
        return tuple(name for name, _ in self.parts if name.lower().endswith(POSE_ENDING))


def read_blend(text: str, folder: Path = Path()) -> MotionBlend:
    """The motions of a text: `wave`, `walk+wave`, `walk:0.7,wave:0.3` or `pose.json`.

    folder: of files of poses, whose names may hold + and commas. Raises OptionError, also for names
    that no motion has.
    """
    if text.lower().endswith(POSE_ENDING) and _is_file(folder / text):
        return MotionBlend(((text, 1.0),))
    is_mean = "+" not in text and "," in text
    names = [name.strip() for name in text.split("," if is_mean else "+")]
    if len(names) > MAX_BLENDED:
        raise OptionError(f"motion {shown(text)} blends over {MAX_BLENDED} motions; use fewer")
    parts = tuple(_weighted(name) if is_mean else (name, 1.0) for name in names)
    for name, _ in parts:
        if name not in MOTIONS and not name.lower().endswith(POSE_ENDING):
            raise unknown_motion(name)
    if not sum(weight for _, weight in parts):
        raise OptionError(f"motion {shown(text)} has only weights of 0; write walk:0.7,wave:0.3")
    return MotionBlend(parts, is_mean)


def _is_file(path: Path) -> bool:
    try:
        return path.is_file()
    except (OSError, ValueError):  # a name that no file can have
        return False


def unknown_motion(name: str) -> OptionError:
    """The error for a name that no motion has."""
    first, *others = MOTIONS
    return OptionError(
        f"motion {shown(name)} is not known; use {first}, a pose in a JSON file, or one of:"
        f" {', '.join(others)}"
    )


def _weighted(text: str) -> tuple[str, float]:
    name, colon, number = text.rpartition(":")
    if not colon:
        return text, 1.0
    try:
        weight = float(number)
    except ValueError:
        weight = -1.0
    if not 0 <= weight <= 1:
        raise OptionError(
            f"motion {shown(text)}: its weight is not 0 to 1; write walk:0.7,wave:0.3"
        )
    return name, weight
