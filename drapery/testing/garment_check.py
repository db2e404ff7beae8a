"""A check of garments for their authors."""

from collections.abc import Sequence
from functools import partial
from typing import Any

import numpy as np
from numpy.typing import NDArray

from drapery.cloth import Box, Collider, max_stretch
from drapery.errors import OptionError
from drapery.garments import Garment, SewnCloth
from drapery.packs import open_packs
from drapery.scenes import Dressed, Schedule

Points = NDArray[np.floating[Any]]

SECONDS, FPS = 1.5, 10
DEPTH = 1e-3
"""The middle of the cloth may be so deep in what it meets [m]."""
STRETCH = 0.25
"""A spring may be longer than at rest by this part of its length."""


def check_garment(garment: Garment, seconds: float = SECONDS) -> None:
    """Move a garment for some seconds. These are faults:

    - two motions of the same garment differ, or are not finite;
    - a spring becomes longer than at rest by over a quarter;
    - its cloth begins in its wearer, a pole or a block, or enters one, by over 1 mm.

    garment: the garment to check.
    seconds: of motion [s].

    Raises OptionError with the first fault found.
    """
    packs, settings = open_packs(()), garment.settings()
    times = [frame / FPS for frame in range(round(seconds * FPS) + 1)]
    dressed = Dressed(garment, packs, settings)
    at = partial(Schedule.at, step=dressed.step, every=round(1 / (FPS * dressed.step)))
    sheets = dressed.record(at(times))
    again = Dressed(garment, packs, settings).record(at(times[:3]))
    name = f"garment {garment.name}"
    for sewn, sheet, other in zip(dressed.cloths, sheets, again, strict=True):
        pieces = ", ".join(piece.name for piece in sewn.pieces)
        if not (np.isfinite(sheet).all() and np.array_equal(sheet[:3], other)):
            raise OptionError(f"{name}: two motions of {pieces} differ; report this as a fault")
        # Cloth that begins inside is thrown out, and stretched by it.
        _check_depths(f"{name}: {pieces} begins", dressed, sewn, sheet[:1], times[:1])
        stretch = max_stretch(sheet[1:], sewn.cloth)
        if stretch > STRETCH:
            raise OptionError(
                f"{name}: {pieces} stretches by {stretch:.0%}; use a stiffer fabric, less wind,"
                " or pins that are nearer to each other"
            )
        _check_depths(f"{name}: {pieces} is", dressed, sewn, sheet[1:], times[1:])


def _check_depths(
    what: str, dressed: Dressed, sewn: SewnCloth, sheet: Points, times: Sequence[float]
) -> None:
    """Raise OptionError for a cloth in what it meets. sheet: its positions at some times [s]."""
    if dressed.garment.collisions == "none":
        return
    colliders = dressed.colliders(sewn)
    depth = max(
        deepest(sewn, positions, colliders, time)
        for time, positions in zip(times, sheet, strict=True)
    )
    if depth > DEPTH:
        raise OptionError(
            f"{what} {depth * 1000:.1f} mm inside what it meets; pin it farther"
            " outside, or leave a part of the wearer out of `solid`"
        )


def deepest(
    sewn: SewnCloth, positions: Points, colliders: Sequence[Collider], time: float
) -> float:
    """How deep free particles, and middles of free faces, are inside boxes at a time [s]: in m."""
    free = sewn.cloth.inv_mass > 0
    faces = sewn.cloth.triangles[free[sewn.cloth.triangles].all(axis=1)]
    points = np.concatenate([positions[free], positions[faces].mean(axis=1)])
    if not len(points):
        return 0.0
    boxes = [each for each in colliders if isinstance(each.shape, Box)]
    return max((float(_depths(points, each, time).max()) for each in boxes), default=0.0)


def _depths(points: Points, collider: Collider, time: float) -> Points:
    """How deep points are in a box [m], shape [P]; 0 outside."""
    box, pose = collider.shape, collider.path(time)
    assert isinstance(box, Box)
    own = np.einsum("ij,ni->nj", pose.rotation, points - pose.position) - box.centre
    own = np.einsum("ij,ni->nj", box.rotation, own)
    outside = (np.abs(own) - np.asarray(box.size) / 2).max(axis=1)
    depths: Points = np.maximum(-outside, 0.0)
    return depths
