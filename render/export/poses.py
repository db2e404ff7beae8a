"""Which frames of a loop a 3-D file holds: between those poses, positions move along lines."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from drapery.errors import OptionError
from drapery.render.drawlist import Float32
from drapery.render.export.parts import MeshParts

MAX_POSES = 256
"""A first pose and 255 morph targets, which viewers keep in the layers of a texture: WebGL 2
promises 256 of them."""
TOLERANCES = (0.001, 0.002, 0.004)
"""How far poses between key poses may be from the frames [m]; a coarser one is tried where a finer
one takes too many."""


def key_poses(parts: MeshParts, fps: float) -> tuple[list[int], float]:
    """The frames that are kept, the first one among them, and the largest error of the others [m].

    After the last frame comes the first one. Raises OptionError where they are too many.
    """
    moving = [part.positions for part in parts.parts if part.skin is None]
    moving = [positions for positions in moving if len(positions) > 1]
    kept: list[int] = []
    for tolerance in TOLERANCES:
        kept = _kept(moving, parts.frames, tolerance)
        if len(kept) <= MAX_POSES:
            return kept, max((_error(p, kept) for p in moving), default=0.0)
    raise OptionError(
        f"a loop of {parts.frames / fps:g} s takes {len(kept)} poses, and a GLB has at most"
        f" {MAX_POSES}; use seconds {MAX_POSES / fps:g}, or fewer fps"
    )


def _kept(moving: Sequence[Float32], frames: int, tolerance: float) -> list[int]:
    """Each pose is the last one up to which the frames since the pose before are near enough."""
    kept, end = [0], 1
    while end < frames:
        longer = end + 1
        if all(_between(each, kept[-1], longer) <= tolerance for each in moving):
            end = longer
        else:
            kept.append(end)
            end = longer
    return kept


def _error(positions: Float32, kept: list[int]) -> float:
    ends = [*kept[1:], len(positions)]
    return max(_between(positions, start, end) for start, end in zip(kept, ends, strict=True))


def _between(positions: Float32, start: int, end: int) -> float:
    """How far the frames between two are from the line between those [m]."""
    first, last = positions[start], positions[end % len(positions)]
    share = (np.arange(start + 1, end) - start)[:, None, None] / (end - start)
    away: NDArray[np.floating] = first + (last - first) * share - positions[start + 1 : end]
    return float(np.sqrt((away * away).sum(axis=-1)).max(initial=0.0))
