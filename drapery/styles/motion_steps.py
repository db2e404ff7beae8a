"""Steps that change how cloth moves: the positions of all moments of a picture or loop."""

from dataclasses import dataclass
from typing import Annotated

import numpy as np
from pydantic import Field

from drapery.elementary import arctan2, cos, sin
from drapery.mesh import Array
from drapery.style.piece import Piece

LOOSE = 0.7
"""A snapped angle stays until the angle of the cloth is this number of steps away, so it does not
flicker between two neighbours."""
ROUNDS = 3
"""How often `snap_angles` goes around a loop: after that the end leads to the start."""
UPRIGHT = 0.7
"""A held row whose unit vector has a larger upward part stands upright, as at a flag's pole."""
SEAM = 3.0
"""The end of a loop is at most this many distances between its frames away from its start."""


def hold(
    piece: Piece,
    positions: Array,
    *,
    every: Annotated[int, Field(ge=1, le=60, description="frames that show one pose")] = 2,
) -> Array:
    """Show each pose for several frames, as hand-drawn animation does. A still does not change.

    A loop has at least four poses, or one for each frame.
    """
    every = min(every, max(1, len(positions) // 4))
    return positions[np.arange(len(positions)) // every * every]


def calm(
    piece: Piece,
    positions: Array,
    *,
    frames: Annotated[int, Field(ge=2, le=60, description="from a pose until it fades out")] = 6,
) -> Array:
    """Slow folds: each pose is a mean of those around it, which count less the farther they are.

    Ripples, and shades on them, do not come and go. A loop of fewer than eight frames stays.
    """
    count = len(positions)
    reach = min(frames, 1 + count // 8)
    places, total = np.arange(count), reach * positions
    for away in range(1, reach):
        for beside in (places - away, places + away):
            at = beside % count if _is_loop(positions) else np.clip(beside, 0, count - 1)
            total = total + (reach - away) * positions[at]
    calmed: Array = total / reach**2
    return calmed


def snap_angles(
    piece: Piece,
    positions: Array,
    *,
    degrees: Annotated[float, Field(ge=1, le=90, description="between two angles")] = 15.0,
) -> Array:
    """Move in whole angles, as a jointed puppet in a stop-motion film does.

    The cloth is a chain of rows from its held edge on. Each row turns about that edge until its
    mean angle from below, or from the mean direction of a flag at an upright pole, is a multiple of
    `degrees`, and stays there until the simulated angle is 0.7 steps away. Lengths along the chain
    and the folds across it stay; the shape step `boards` makes the rows straight.
    """
    chain = _chain(piece, positions)
    pieces = np.diff(chain.rows, axis=1)
    ahead = np.cross(chain.hinge, -chain.rest)
    rest, middle = np.cross(chain.hinge, ahead), pieces.mean(axis=2)
    angles = arctan2(*(np.sum(middle * axis[:, None], axis=-1) for axis in (ahead, rest)))
    turns = _kept_angles(angles, np.radians(degrees)) - angles
    turned = _turned(pieces, -chain.hinge[:, None, None], turns[..., None])
    below = chain.rows[:, :1] + np.cumsum(turned, axis=1)
    return chain.positions(np.concatenate([chain.rows[:, :1], below], axis=1))


def squash(
    piece: Piece,
    positions: Array,
    *,
    strength: Annotated[float, Field(ge=0, le=1, description="stretch at the fastest")] = 0.3,
) -> Array:
    """Squash and stretch: the faster cloth moves, the longer it is that way, and the narrower.

    At the fastest moment of a loop it is 1 + strength times as long along its mean velocity, which
    counts from its held edge; across, it is narrower by the square root of that, so that the
    volume stays (Johnston and Thomas, "The illusion of life", 1981). The held edge stays.
    """
    chain = _chain(piece, positions)
    edge = chain.rows[:, :1]
    velocity = _velocity((chain.rows - edge.mean(axis=2, keepdims=True)).mean(axis=(1, 2)))
    squares = np.sum(velocity * velocity, axis=-1)[:, None, None]
    most = max(float(squares.max()), 1e-18)
    length = (1 + strength) ** (squares / most)
    outer = velocity[:, :, None] * velocity[:, None, :] / np.maximum(squares, 1e-18)
    change = (length**-0.5 - 1) * np.eye(3) + (length - length**-0.5) * outer
    # The far end changes as a whole; at the held edge each particle stays in its place.
    share = np.linspace(0, 1, chain.rows.shape[1])[:, None, None]
    offsets = chain.rows - edge + share * (edge - edge.mean(axis=2, keepdims=True))
    moved = sum(offsets[..., k, None] * change[:, None, None, :, k] for k in range(3))
    return chain.positions(chain.rows + moved)


@dataclass(frozen=True, eq=False)
class ClothChain:
    """The motion of a piece as rows that follow each other from its held edge on.

    rows: [m], shape [F, R, C, 3]; the first row is held. hinge: unit vector along that
    row at each moment, shape [F, 3]. rest: unit vector from which angles count: down, or where the
    chain goes to on average if the held row stands upright. sideways: whether the left edge is
    held, and not the top.
    """

    rows: Array
    hinge: Array
    rest: Array
    sideways: bool

    def positions(self, rows: Array) -> Array:
        """The positions of other rows [m], shape [F, N, 3]."""
        grid = rows.swapaxes(1, 2) if self.sideways else rows
        return grid.reshape(len(grid), -1, 3)


def _chain(piece: Piece, positions: Array) -> ClothChain:
    """The piece from its held edge on: the left one if it moves less than the top one."""
    grid = piece.rows(positions)
    top, left = (edge - edge[:1] for edge in (grid[:, 0], grid[:, :, 0]))
    sideways = float(np.abs(left).mean()) < float(np.abs(top).mean())
    rows = grid.swapaxes(1, 2) if sideways else grid
    hinge = _unit(rows[:, 0, -1] - rows[:, 0, 0])
    if abs(float(hinge[:, 1].mean())) < UPRIGHT:
        rest = np.array([0.0, -1.0, 0.0])
    else:
        rest = _unit((rows[:, -1] - rows[:, 0]).mean(axis=(0, 1)) * [1.0, 0.0, 1.0])
    return ClothChain(rows, hinge, rest, sideways)


def _unit(vectors: Array) -> Array:
    lengths = np.sqrt(np.sum(vectors * vectors, axis=-1, keepdims=True))
    unit: Array = vectors / np.maximum(lengths, 1e-12)
    return unit


def _kept_angles(angles: Array, step: float) -> Array:
    """Multiples of a step for each row over a loop, shape [F, R]; each stays while it is near."""
    snapped = np.round(angles / step) * step
    kept = snapped[0]
    for _ in range(ROUNDS):
        for frame, angle in enumerate(angles):
            away = np.abs((angle - kept + np.pi) % (2 * np.pi) - np.pi)
            kept = np.where(away > LOOSE * step, np.round(angle / step) * step, kept)
            snapped[frame] = kept
    return snapped


def _turned(vectors: Array, axes: Array, angles: Array) -> Array:
    """Vectors turned about unit axes, by Rodrigues' formula."""
    cosine, sine = cos(angles)[..., None], sin(angles)[..., None]
    along = np.sum(vectors * axes, axis=-1, keepdims=True) * axes
    turned: Array = along + cosine * (vectors - along) + sine * np.cross(axes, vectors)
    return turned


def _velocity(middles: Array) -> Array:
    """The velocity of a point over a loop [m a frame], shape [F, 3]."""
    steps = np.roll(middles, -1, axis=0) - middles
    if not _is_loop(middles):
        steps[-1] = 0.0
    velocity: Array = (steps + np.roll(steps, 1, axis=0)) / 2
    return velocity


def _is_loop(places: Array) -> bool:
    """Whether the end of a motion leads to its start. places: of its moments, shape [F, ..., 3]."""
    steps = np.roll(places, -1, axis=0) - places
    lengths = np.sqrt((steps * steps).reshape(len(steps), -1).sum(axis=1))
    return len(steps) < 3 or bool(lengths[-1] <= SEAM * lengths[:-1].max())
