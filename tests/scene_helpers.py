"""Helpers for the tests of scenes: a scene's last picture, a banner's cloth, and its clearance."""

from collections.abc import Sequence

import numpy as np

from drapery import Banner, Settings
from drapery.cloth import Cloth, Force, MovingCloth, State
from drapery.cloth.colliders import Collider
from drapery.cloth.colliders.check import sample_distances
from drapery.cloth.colliders.sampling import sample_points
from drapery.packs import open_packs
from drapery.render.frame import Frame
from drapery.scenes import STEP, StagedBody
from drapery.scenes.catalogue import Clip, find_scene
from drapery.scenes.drawing import scene_frames
from drapery.style import body_of


def still(name: str, frames: int = 1, fps: float = 20.0, **words: str) -> Frame:
    """The last picture of a short, small clip."""
    scene = find_scene(name)
    clip = Clip((160, 160), frames, fps)
    return next(scene_frames(scene, scene.parameters(words), clip, "soft", last=True))


def flag_of(settings: Settings) -> tuple[MovingCloth, tuple[Force, ...]]:
    """The cloth of a white banner before its first time step, and the forces on it."""
    body = body_of(Banner.parse("white"), open_packs(()), settings)
    (drape,) = StagedBody(body, settings).drapes
    return drape.begin(STEP), drape.forces(None)


def clearance(cloth: Cloth, state: State, colliders: Sequence[Collider], order: int = 2) -> float:
    """The least distance [m] of the thin sheet from any collider; negative inside."""
    points = sample_points(cloth, order)
    least = np.inf
    for sheet in state.positions:
        places = np.einsum("mc,mci->mi", points.weights, sheet[points.particles].astype(float))
        for collider in colliders:
            pose = collider.path(state.time)
            own = np.einsum("ij,mi->mj", pose.rotation, places - pose.position)
            distances = sample_distances(collider.packed, np.ascontiguousarray(own))
            least = min(least, distances.min())
    return float(least)
