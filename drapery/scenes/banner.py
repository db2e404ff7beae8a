"""The banner block with its flag of cloth, or with the game's own stiff board."""

from collections.abc import Iterator
from dataclasses import dataclass, fields

from drapery.banner.design import Banner
from drapery.banner.packs import open_packs
from drapery.render.scene import Scene
from drapery.scenes.catalogue import Shot
from drapery.scenes.staging import loop
from drapery.settings import LayerMode, Placement, Pose, Settings


@dataclass(frozen=True)
class Parameters:
    """A design and what `drapery animate` can be asked of it; see `Settings`."""

    design: str = "white creeper:lime border:black"
    pose: Pose = "cloth"
    placement: Placement = "standing"
    view: str = "hero"
    grid: tuple[int, int] = (5, 9)
    wind: float = 4.0
    seed: int = 0
    layers: LayerMode = "stacked"
    thickness: float = 1.0


def play(parameters: Parameters, shot: Shot) -> Iterator[Scene]:
    """A seamless loop of the banner."""
    options = {f.name: getattr(parameters, f.name) for f in fields(parameters)}
    banner = Banner.parse(options.pop("design"))
    settings = Settings(**options, size=shot.size)
    return loop(banner, open_packs(()), settings, shot.count, shot.fps)
