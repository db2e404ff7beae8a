"""A walking figure in cloth that garments describe: in place, over ground that passes below."""

from collections.abc import Iterator, Sequence
from functools import lru_cache

import numpy as np

from drapery.cloth import Collisions, State, Wind
from drapery.garments import SewnCloth, tailor
from drapery.packs import Packs, open_packs
from drapery.render import Camera, Material, Model, Scene, View, frame_points
from drapery.scenes.backdrop import Backdrop
from drapery.scenes.catalogue import Clip
from drapery.scenes.moving import LOOP, motion
from drapery.scenes.variants import varied
from drapery.stage.forces import in_wind
from drapery.stage.gait import Gait
from drapery.style.figure import PARTS, figure_material, figure_mesh
from drapery.style.scenery import moved, path_ground, shadow

BEHIND = View(azimuth=214, elevation=14, fov=26)
BEFORE = View(azimuth=32, elevation=12, fov=26)
PERIOD = 10
"""The ground repeats after this number of blocks, the distance walked in a loop."""

Worn = tuple[SewnCloth, Iterator[State]]
"""A cloth and its state at each frame."""


@lru_cache(maxsize=8)
def cloths_of(
    name: str, thickness: float, points: tuple[int, int] | None = None, resolution: int = 16
) -> tuple[SewnCloth, ...]:
    """The cloths of a garment of the package.

    thickness: [texels]. points: of its pieces. resolution: texels to a block.
    """
    piece = None if points is None else {"points": points}
    made = varied(name, piece=piece, thickness=thickness, resolution=resolution)
    return tailor(made, open_packs(()))


def worn_states(
    sewn: SewnCloth, gait: Gait, clip: Clip, wind: Wind, *, order: int = 2, settle: float = LOOP
) -> Iterator[State]:
    """A cloth at each frame, in the figure's own frame. settle: time before the first [s]."""
    met = gait.colliders(sewn.solid or tuple(PARTS))
    return motion(
        sewn.cloth,
        clip,
        forces=in_wind(sewn.cloth, wind),
        collisions=Collisions(met, sewn.distance, order=order),
        pins=sewn.pin_path(gait.poses),
        settle=settle,
    )


def walk_scenes(
    skin: str,
    gait: Gait,
    clip: Clip,
    worn: Sequence[Worn],
    *,
    view: View = BEHIND,
    tail: float = 0.9,
    lifted: tuple[Model, ...] = (),
) -> Iterator[Scene]:
    """The figure at each frame. tail: how far its cloth streams behind it [m].
    lifted: models that move with its body."""
    packs = open_packs(())
    material, causeway = figure_material(skin, packs), ground(packs)
    backdrop = Backdrop(camera(clip.size, view, tail), clip.size)
    for states in zip(*(states for _, states in worn), strict=True):
        time = states[0].time
        models = [*walker(gait, time, material, causeway)]
        models += moved(lifted, gait.raised(time))
        for (sewn, _), state in zip(worn, states, strict=True):
            models += sewn.models(state.positions[0])
        yield backdrop.scene(models)


def walker(
    gait: Gait, time: float, skin: Material, causeway: tuple[Model, ...]
) -> tuple[Model, ...]:
    """The figure, its shadow and the ground at a time of its walk [s]."""
    passed = np.array([0.0, 0.0, -(gait.speed * time % PERIOD)])
    figure = Model(figure_mesh(gait.poses(time)), (skin,), name="player")
    return (*moved(causeway, passed), shadow((0, 0), 0.5), figure)


def ground(packs: Packs) -> tuple[Model, ...]:
    """The path that it walks on."""
    return path_ground(24, PERIOD, packs)


def camera(size: tuple[int, int], view: View = BEHIND, tail: float = 0.9) -> Camera:
    """A view of the figure. tail: how far its cloth streams behind it [m]."""
    framed = np.array([[-0.5, 0, -tail], [0.5, 0, 0.5], [0.5, 2, 0.4], [-0.5, 2, -0.4]])
    return frame_points(view, framed, size[0] / size[1], margin=0.1)
