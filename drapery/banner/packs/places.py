"""Where textures lie that moved between versions of the game."""

from collections.abc import Sequence
from dataclasses import dataclass
from math import inf

from drapery.banner.packs.texture_ids import texture_file
from drapery.banner.packs.versions import last_before


@dataclass(frozen=True)
class Place:
    """A place of a texture. texture: its id. first, last: the formats whose game looks there."""

    texture: str
    first: float = 0
    last: float = inf

    @property
    def file(self) -> str:
        """The file of the texture inside a pack."""
        return texture_file(self.texture)

    def is_for(self, format: int | None) -> bool:
        """Whether the game of a format looks there; None is an unknown format."""
        return format is None or self.first <= format <= self.last


def in_order(places: Sequence[Place], format: int | None) -> list[Place]:
    """The places in the order to try them in a pack of a format: the game's own first."""
    return sorted(places, key=lambda place: not place.is_for(format))


def moved(new: str, old: str, game: str) -> tuple[Place, ...]:
    """The place of a texture since a version of the game, and the one before. new, old: ids."""
    last = last_before(game)
    return Place(new, first=last + 1), Place(old, last=last)


def base_places(base: str) -> tuple[Place, ...]:
    """Those of banner_base, shield_base or shield_base_nopattern."""
    folder = base.split("_", 1)[0]
    return moved(f"minecraft:entity/{folder}/{base}", f"minecraft:entity/{base}", "26.1")


def wings_places() -> tuple[Place, ...]:
    """Those of the texture of elytra."""
    return moved("minecraft:entity/equipment/wings/elytra", "minecraft:entity/elytra", "1.21.2")
