"""Cloth that is gathered on a shorter edge, as curtains are hung, so that it falls in folds."""

import numpy as np

from drapery.cloth.cloth import Cloth
from drapery.cloth.state import State, rest_state
from drapery.elementary import sine_of_turns
from drapery.mesh import Array

FOLD_COLUMNS = 5
"""The fewest columns of cells in a fold: with fewer, a fold is a crease."""
LEAST_FOLDS, MOST_FOLDS = 2, 3
UNEVEN = (0.12, 0.2), (0.08, 0.7)
"""Folds differ in width: how far a wave over the whole edge, and one over half of it, shift them
[turns], and the phases of these waves [turns]."""
SAMPLES = 2048
"""Points of the curve along which the folds are measured."""
ROUNDING = 1e-9
HALVINGS = 40
"""Steps in the search for the depth of the folds."""


def fold_count(columns: int) -> int:
    """How many folds a grid with these columns of particles can show; 0 for a coarse one."""
    folds = min(MOST_FOLDS, (columns - 1) // FOLD_COLUMNS)
    return folds if folds >= LEAST_FOLDS else 0


def gathered_state(cloth: Cloth, width: float) -> State:
    """A grid whose top edge is gathered to a width [m], with velocity 0: a start for `simulate`.

    The cloth hangs straight down in `fold_count` vertical folds. They lie in front of its plane at
    rest, so nothing behind the cloth is touched. The edge has its full length along the folds. A
    grid that is not wider than the width, or too coarse for folds, starts at rest.
    """
    assert cloth.grid_shape is not None
    x = cloth.rest_positions[:, 0]
    length, folds = float(np.ptp(x)), fold_count(cloth.grid_shape[1])
    state = rest_state(cloth)
    if not folds or length <= width * (1 + ROUNDING):
        return state
    share = np.linspace(0.0, 1.0, SAMPLES)
    wave = (1 - sine_of_turns(0.25 + _turns(share, folds))) / 2
    depth = _depth(share * width, wave, length)
    along = _lengths(share * width, depth * wave)
    places = (x - x.min()) * (along[-1] / length)
    state.positions[0, :, 0] = np.interp(places, along, (share - 0.5) * width)
    state.positions[0, :, 2] = np.interp(places, along, depth * wave)
    return state


def _turns(share: Array, folds: int) -> Array:
    """Phase of the folds at a share 0..1 of the edge [turns]."""
    turns = folds * share
    for number, (shift, phase) in enumerate(UNEVEN, start=1):
        turns = turns + shift * sine_of_turns(number * share + phase)
    return turns


def _depth(across: Array, wave: Array, length: float) -> float:
    """The depth [m] at which a curve across an edge, depth times a wave 0..1, has a length [m]."""
    low, high = 0.0, length
    for _ in range(HALVINGS):
        middle = (low + high) / 2
        if _lengths(across, middle * wave)[-1] > length:
            high = middle
        else:
            low = middle
    return low


def _lengths(x: Array, z: Array) -> Array:
    """Length of a curve up to each of its points [m]."""
    dx, dz = x[1:] - x[:-1], z[1:] - z[:-1]
    lengths = np.zeros(len(x))
    np.add.accumulate(np.sqrt(dx * dx + dz * dz), out=lengths[1:])
    return lengths
