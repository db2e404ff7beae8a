"""One sheet of live cloth, which the viewer's pointer can grab and pull."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Self

import numpy as np
from numpy.typing import NDArray

from drapery.cloth import Cloth, Force, MovingCloth, PinPath, State
from drapery.mesh import Array
from drapery.scenes import STEP
from drapery.style import ClothSpec, cloth_at_rest

EASE = 0.35
"""The share of the distance to its target that a held particle moves in a time step."""
MAX_SPEED = 0.2
"""The longest distance that a held particle moves in a time step [m]."""
NEAR = 1e-4
"""A held particle that is closer to its target than this moves onto it [m]."""
GRAB_RADIUS = 0.045
"""A grab holds all particles within this distance along the cloth [m]."""
MAX_STRETCH = 0.99
"""A grab stays nearer to each pin than this share of the cloth between them."""
PROJECTIONS = 48
"""The most projections of a target; see `reachable`."""


@dataclass(frozen=True, eq=False)
class Grab:
    """A pull at a particle and its neighbours.

    particle: the index of the pulled particle. around: the indices of all held particles, shape
    [K]. offsets: their positions relative to the pulled particle [m], shape [K, 3].
    target: where the particle is pulled to [m], in the cloth's frame, shape [3].
    """

    particle: int
    around: NDArray[np.intp]
    offsets: Array
    target: Array


@dataclass(frozen=True, eq=False, kw_only=True)
class LiveCloth(MovingCloth):
    """A panel's cloth that can be grabbed.

    spec: how to make it. whole: the ungrabbed cloth. hung: the positions in which it began [m],
    shape [N, 3]; its pins return to theirs.
    """

    spec: ClothSpec
    whole: Cloth
    hung: Array
    grab: Grab | None = None

    @property
    def positions(self) -> Array:
        """Positions in the panel's frame [m], shape [N, 3]."""
        positions: Array = self.state.positions[0]
        return positions

    @property
    def free(self) -> NDArray[np.intp]:
        """The indices of the particles that can be grabbed: those without a pin."""
        return np.flatnonzero(self.whole.inv_mass > 0)

    def advance(self, forces: Sequence[Force], steps: int = 1, pins: PinPath | None = None) -> Self:
        """The cloth some time steps later; held particles move towards their targets.

        Raises OptionError if the cloth has blown up.
        """
        moved, left = self, steps
        while left:
            path = moved._path() if pins is None else pins
            each = left if path is pins else 1  # a path of its own leads through one step
            moved = MovingCloth.advance(moved, forces, each, path)
            # A picture makes all its steps in one call, so its time is rounded only once.
            time = round(moved.state.time / STEP) * STEP
            moved, left = replace(moved, state=replace(moved.state, time=time)), left - each
        return moved

    def grabbed(self, particle: int) -> Self:
        """The cloth with a grab at a particle; the grab does not move the particle."""
        inv_mass, rest = self.whole.inv_mass.copy(), self.whole.rest_positions
        near = _lengths(rest - rest[particle]) <= GRAB_RADIUS
        around = np.flatnonzero(near & (inv_mass > 0))
        inv_mass[around] = 0.0
        place = self.positions[particle].astype(np.float64)
        grab = Grab(particle, around, self.positions[around] - place, place)
        return self._with_cloth(replace(self.whole, inv_mass=inv_mass), grab)

    def pulled(self, target: Array) -> Self:
        """The grab with another target [m], shape [3], or the nearest that the cloth allows."""
        if self.grab is None:
            return self
        return replace(self, grab=replace(self.grab, target=self.reachable(target)))

    def released(self) -> Self:
        """The cloth without a grab."""
        return self if self.grab is None else self._with_cloth(self.whole, None)

    def reachable(self, target: Array) -> Array:
        """A point near a target [m] that the grabbed particle can reach, shape [3].

        A pin can be no further away than the length of the flat cloth between pin and particle.
        The target is repeatedly projected onto the ball about the pin whose limit it exceeds most.
        """
        if self.grab is None:
            return target
        rest = self.whole.rest_positions
        pinned = self.whole.inv_mass == 0
        pins = self.hung[pinned].astype(np.float64)
        longest = MAX_STRETCH * _lengths(rest[pinned] - rest[self.grab.particle])
        place = np.asarray(target, np.float64)
        for _ in range(PROJECTIONS if len(pins) else 0):
            distances = _lengths(place - pins)
            worst = int(np.argmax(distances - longest))
            if distances[worst] <= longest[worst]:
                break
            place = pins[worst] + (place - pins[worst]) * (longest[worst] / distances[worst])
        return place

    def remade(self, spec: ClothSpec) -> "LiveCloth":
        """The cloth of another spec; it continues the motion if the size is the same.

        A cloth that has fallen further from the new pins than its own length hangs at rest again.
        Raises OptionError.
        """
        hung = new_live_cloth(spec)
        if self.spec.size != spec.size:
            return hung
        new = replace(new_live_cloth(_free(spec)), spec=spec)
        state, pinned = _resampled(self, new), new.whole.inv_mass == 0
        away = _lengths(state.positions[0][pinned] - new.hung[pinned])
        if (away > max(spec.size)).any():
            return hung
        return replace(new, state=state)

    def _with_cloth(self, cloth: Cloth, grab: Grab | None) -> Self:
        met = _free(self.spec).make_collisions()
        made = MovingCloth.begin(cloth, self.solver, STEP, collisions=met)
        changed = replace(self, cloth=cloth, solver_state=made.solver_state, grab=grab)
        return replace(changed, resolve=made.resolve, boxes=made.boxes)

    def _path(self) -> PinPath | None:
        """The path of the held particles during a time step; None if all are at their targets."""
        held = np.flatnonzero(self.cloth.inv_mass == 0)
        start, began = self.positions[held], self.state.time
        goal = self.hung[held].astype(start.dtype)
        if self.grab is not None:
            places = np.searchsorted(held, self.grab.around)
            goal[places] = self.grab.target + self.grab.offsets
        if (start == goal).all():
            return None
        end = _nearer(start, goal)
        return lambda time: start + (end - start) * min(max((time - began) / STEP, 0.0), 1.0)


def _free(spec: ClothSpec) -> ClothSpec:
    """The spec of cloth that passes through itself.

    A hand does not feel what is in its way, and cloth that it has pulled through itself, or that
    continues on another grid, could not come back.
    """
    return replace(spec, itself=False)


def new_live_cloth(spec: ClothSpec) -> LiveCloth:
    """A cloth at rest. Raises OptionError."""
    rest = cloth_at_rest(spec, STEP)
    return LiveCloth(**vars(rest), spec=spec, whole=rest.cloth, hung=rest.state.positions[0])


def _resampled(old: LiveCloth, new: LiveCloth) -> State:
    """The state on another grid, linearly interpolated between the particles of the old one."""
    if old.spec.shape == new.spec.shape:
        return old.state
    positions, velocities = (
        _bilinear(values[0], old.spec.shape, new.cloth.uvs)[None].astype(values.dtype)
        for values in (old.state.positions, old.state.velocities)
    )
    return State(positions, velocities, old.state.time)


def _bilinear(values: Array, shape: tuple[int, int], uvs: Array) -> Array:
    """Interpolate the values [N, 3] of a grid (columns, rows) at places [M, 2] in 0..1."""
    columns, rows = shape
    table = values.reshape(rows, columns, 3)
    across, down = uvs[:, 0] * (columns - 1), uvs[:, 1] * (rows - 1)
    left, top = (np.minimum(at.astype(int), n - 2) for at, n in ((across, columns), (down, rows)))
    x, y = (across - left)[:, None], (down - top)[:, None]
    upper = table[top, left] * (1 - x) + table[top, left + 1] * x
    lower = table[top + 1, left] * (1 - x) + table[top + 1, left + 1] * x
    mixed: Array = upper * (1 - y) + lower * y
    return mixed


def _nearer(start: Array, goal: Array) -> Array:
    """Positions of held particles after one time step from start towards goal [m], shape [K, 3]."""
    apart = goal - start
    length = np.sqrt((apart * apart).sum(axis=1, keepdims=True))
    share = np.minimum(EASE, MAX_SPEED / np.maximum(length, MAX_SPEED))
    return np.where(length < NEAR, goal, start + share * apart).astype(start.dtype)


def _lengths(vectors: Array) -> Array:
    lengths: Array = np.sqrt((vectors * vectors).sum(axis=-1))
    return lengths
