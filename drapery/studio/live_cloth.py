"""One sheet of cloth that moves on tick by tick, held at its pins and by a hand."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from drapery.cloth import Cloth, Force, PinPath, Solver, State, grid, rest_state, solver
from drapery.cloth.pins import PinName
from drapery.mesh import Array
from drapery.scenes.staging import STEP

EASE = 0.35
"""Part of the way to its goal that what is held goes in a tick."""
FASTEST = 0.2
"""The most that it goes in a tick [m]."""
NEAR = 1e-4
"""Closer than this it is there [m]."""
FINGER = 0.045
"""How far from it along the cloth a hand takes hold [m]."""
REACH = 0.99
"""A hand pulls no further from a pin than this part of the cloth between them."""
ROUNDS = 48


@dataclass(frozen=True)
class ClothSpec:
    """What a cloth is made of: particles across and down, size [m], pins, solver."""

    shape: tuple[int, int]
    size: tuple[float, float]
    pins: PinName
    solver: str


@dataclass(frozen=True, eq=False)
class Grab:
    """What pulls at a particle, and at those so near that a finger would take them too.

    around: all that are taken, shape [K]; offsets: where they are from the particle [m], [K, 3].
    target: where to it pulls the particle [m], in the cloth's frame, shape [3].
    """

    particle: int
    around: NDArray[np.intp]
    offsets: Array
    target: Array


@dataclass(frozen=True, eq=False)
class LiveCloth:
    """A cloth as it hangs.

    whole: the cloth without a hand; cloth: with the held particle pinned. memory: the solver's.
    """

    weave: ClothSpec
    whole: Cloth
    cloth: Cloth
    method: Solver
    memory: Any
    state: State
    hand: Grab | None = None

    @property
    def positions(self) -> Array:
        """[m], shape [N, 3]."""
        found: Array = self.state.positions[0]
        return found


def hang(weave: ClothSpec) -> LiveCloth:
    """A cloth at rest. Raises OptionError."""
    whole = grid(*weave.shape, *weave.size, pins=weave.pins)
    method = solver(weave.solver)
    return LiveCloth(weave, whole, whole, method, method.init(whole, STEP), rest_state(whole))


def rewoven(old: LiveCloth, weave: ClothSpec) -> LiveCloth:
    """The cloth made otherwise, as it hangs: its motion goes on. Raises OptionError."""
    new = hang(weave)
    if old.weave.size != weave.size:
        return new
    return replace(new, state=_resampled(old, new))


def _resampled(old: LiveCloth, new: LiveCloth) -> State:
    """The state on another grid, between its particles in a straight line."""
    if old.weave.shape == new.weave.shape:
        return old.state
    found = [
        _bilinear(values[0], old.weave.shape, new.whole.uvs)[None].astype(values.dtype)
        for values in (old.state.positions, old.state.velocities)
    ]
    return State(found[0], found[1], old.state.time)


def _bilinear(values: Array, shape: tuple[int, int], uvs: Array) -> Array:
    """Values [N, 3] of a grid of columns and rows at places [M, 2] of 0..1."""
    columns, rows = shape
    table = values.reshape(rows, columns, 3)
    across, down = uvs[:, 0] * (columns - 1), uvs[:, 1] * (rows - 1)
    left, top = (np.minimum(at.astype(int), n - 2) for at, n in ((across, columns), (down, rows)))
    x, y = (across - left)[:, None], (down - top)[:, None]
    upper = table[top, left] * (1 - x) + table[top, left + 1] * x
    lower = table[top + 1, left] * (1 - x) + table[top + 1, left + 1] * x
    mixed: Array = upper * (1 - y) + lower * y
    return mixed


def moved(hanging: LiveCloth, forces: Sequence[Force]) -> LiveCloth:
    """The cloth one tick later. Raises OptionError where it has blown up."""
    state, memory = hanging.method.step(
        hanging.cloth, hanging.state, hanging.memory, forces, STEP, pins=_path(hanging)
    )
    # Rounded as in a picture, whose steps are made in one call.
    ticks = round(state.time / STEP)
    return replace(hanging, state=replace(state, time=ticks * STEP), memory=memory)


def _path(hanging: LiveCloth) -> PinPath | None:
    """Where what is held goes during a tick; None where all is at home."""
    held = np.flatnonzero(hanging.cloth.inv_mass == 0)
    start, began = hanging.positions[held], hanging.state.time
    goal = hanging.cloth.rest_positions[held].astype(start.dtype)
    if hanging.hand is not None:
        places = np.searchsorted(held, hanging.hand.around)
        goal[places] = hanging.hand.target + hanging.hand.offsets
    if (start == goal).all():
        return None
    end = _nearer(start, goal)
    return lambda time: start + (end - start) * min(max((time - began) / STEP, 0.0), 1.0)


def _nearer(start: Array, goal: Array) -> Array:
    way = goal - start
    length = np.sqrt((way * way).sum(axis=1, keepdims=True))
    share = np.minimum(EASE, FASTEST / np.maximum(length, FASTEST))
    return np.where(length < NEAR, goal, start + share * way).astype(start.dtype)


def grabbed(hanging: LiveCloth, particle: int) -> LiveCloth:
    """The cloth with a hand at a particle, which stays where it is."""
    inv_mass, rest = hanging.whole.inv_mass.copy(), hanging.whole.rest_positions
    around = np.flatnonzero((_lengths(rest - rest[particle]) <= FINGER) & (inv_mass > 0))
    inv_mass[around] = 0.0
    cloth = replace(hanging.whole, inv_mass=inv_mass)
    memory = hanging.method.init(cloth, STEP)
    place = hanging.positions[particle].astype(np.float64)
    hand = Grab(particle, around, hanging.positions[around] - place, place)
    return replace(hanging, cloth=cloth, memory=memory, hand=hand)


def pulled(hanging: LiveCloth, target: Array) -> LiveCloth:
    """The hand pulls to a place [m], shape [3], or as near as the cloth lets it."""
    if hanging.hand is None:
        return hanging
    return replace(hanging, hand=replace(hanging.hand, target=within_reach(hanging, target)))


def released(hanging: LiveCloth) -> LiveCloth:
    """The cloth without a hand."""
    if hanging.hand is None:
        return hanging
    memory = hanging.method.init(hanging.whole, STEP)
    return replace(hanging, cloth=hanging.whole, memory=memory, hand=None)


def free(hanging: LiveCloth) -> NDArray[np.intp]:
    """The particles that a hand can take."""
    return np.flatnonzero(hanging.whole.inv_mass > 0)


def within_reach(hanging: LiveCloth, target: Array) -> Array:
    """The place near a target to which the hand's particle can go without tearing the cloth.

    From each pin it is no further than the flat cloth between them: the target is put back onto
    the most distant pin's ball, again and again.
    """
    if hanging.hand is None:
        return target
    rest = hanging.whole.rest_positions
    pins = rest[hanging.whole.inv_mass == 0]
    reach = REACH * _lengths(pins - rest[hanging.hand.particle])
    place = np.asarray(target, np.float64)
    for _ in range(ROUNDS if len(pins) else 0):
        away = _lengths(place - pins)
        worst = int(np.argmax(away - reach))
        if away[worst] <= reach[worst]:
            break
        place = pins[worst] + (place - pins[worst]) * (reach[worst] / away[worst])
    return place


def _lengths(vectors: Array) -> Array:
    lengths: Array = np.sqrt((vectors * vectors).sum(axis=-1))
    return lengths
