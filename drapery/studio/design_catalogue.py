"""The designs of the start page, which come with the package."""

from dataclasses import dataclass
from functools import cache
from importlib.resources import files

from drapery import Banner


@dataclass(frozen=True)
class OwnDesign:
    """A design to begin with. group: such as flags or symbols."""

    title: str
    group: str
    banner: Banner


EXAMPLES = ("Pirate", "Sunset", "Carpet")
"""The titles of the designs that a first visit shows."""


@cache
def own_designs() -> tuple[OwnDesign, ...]:
    """All designs, in the order of the file."""
    lines = files(__package__).joinpath("designs.txt").read_text("utf-8").splitlines()
    rows = (line.split(" | ") for line in lines if line and not line.startswith("#"))
    return tuple(OwnDesign(title, group, Banner.parse(text)) for title, group, text in rows)


def groups() -> tuple[str, ...]:
    """The groups, in the order of the file."""
    return tuple(dict.fromkeys(design.group for design in own_designs()))
