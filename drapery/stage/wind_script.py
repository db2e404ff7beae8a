"""Scripts of a wind that changes: commands at times, one on each line.

A command is a time [s], a word and its number. `#` begins a comment.

    0.0  strength 6      m/s
    1.5  direction 40    degrees: where the wind blows to; 0 is +z, 90 is +x
    2.5  off
    3.0  on
"""

import math
from bisect import bisect_right
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np

from drapery.cloth import Wind
from drapery.elementary import sine_of_turns
from drapery.errors import OptionError
from drapery.user_files import read_user_file

MAX_BYTES = 1 << 16
SAMPLE = """
0.0 strength 7
1.3 direction 55
2.2 off
2.8 direction -35
2.8 strength 9
2.8 on
"""
"""The script of a scene unless another is given."""
LIMITS = {"strength": (0.0, 40.0), "direction": (-3600.0, 3600.0)}


@dataclass(frozen=True)
class WindSetting:
    """The wind from a time on [s]. direction: [degrees]. strength: [m/s]. on: whether it blows."""

    time: float = 0.0
    direction: float = 0.0
    strength: float = 5.0
    on: bool = True

    @property
    def speed(self) -> float:
        """The speed of the wind [m/s]; 0 while it is off."""
        return self.strength if self.on else 0.0

    def wind(self, gusts: float, seed: int) -> Wind:
        """The wind from this time on; gusts, seed: as in `Wind`."""
        turns = self.direction / 360
        along = np.array([sine_of_turns(turns), 0.0, sine_of_turns(turns + 0.25)]) * self.speed
        return Wind((along[0], 0.0, along[2]), gusts=gusts, seed=seed)


def read_script(path: str) -> tuple[WindSetting, ...]:
    """The settings of a file, in order; of SAMPLE if the path is empty.

    Raises OptionError that names the line.
    """
    if not path:
        return tuple(parse_script(SAMPLE))
    name, remedy = f"script {path}", "give a file of commands"
    data = read_user_file(path, MAX_BYTES, name=name, remedy=remedy)
    try:
        return tuple(parse_script(data.decode("utf-8-sig"), path))
    except UnicodeDecodeError:
        raise OptionError(f"{name} is not text in UTF-8; save it as UTF-8") from None


def parse_script(text: str, name: str = "script") -> Iterator[WindSetting]:
    """The settings of a script, the first at time 0. name: of the script in messages.

    Raises OptionError that names the line.
    """
    now = WindSetting()
    yield now
    for number, line in enumerate(text.splitlines(), 1):
        words = line.partition("#")[0].split()
        if words:
            now = _after(now, words, f"{name}, line {number}")
            yield now


def setting_at(settings: Sequence[WindSetting], time: float) -> WindSetting:
    """The last setting at a time [s]. settings: in order, the first at time 0."""
    return settings[bisect_right([setting.time - 1e-9 for setting in settings], time) - 1]


def _after(now: WindSetting, words: list[str], place: str) -> WindSetting:
    """The setting after one command, given as words. place: its line, for messages."""
    match words:
        case [time, ("on" | "off") as switch]:
            return replace(now, time=_time(time, now, place), on=switch == "on")
        case [time, ("direction" | "strength") as word, value]:
            number = _number(value, *LIMITS[word], place)
            changed = replace(now, time=_time(time, now, place))
            return (
                replace(changed, direction=number)
                if word == "direction"
                else replace(changed, strength=number)
            )
    command = " ".join(words)[:40]
    raise OptionError(
        f"{place}: {command!r} is not a command; write TIME on|off|direction N|strength N"
    )


def _time(text: str, now: WindSetting, place: str) -> float:
    time = _number(text, 0.0, 3600.0, place)
    if time < now.time:
        raise OptionError(f"{place}: {time:g} s is before {now.time:g} s; sort the commands")
    return time


def _number(text: str, least: float, most: float, place: str) -> float:
    try:
        value = float(text)
    except ValueError:
        value = math.nan
    if not least <= value <= most:
        raise OptionError(f"{place}: {text[:20]!r} is not a number from {least:g} to {most:g}")
    return value
