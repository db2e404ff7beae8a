"""The limit on strain: no structural spring of a cloth ends a step longer than its limit.

Solvers limit stretch in their own ways, and contact may undo them: it holds particles while the
solver moves their neighbours by several cells. So all solvers share this last pass. A cloth whose
springs are within the limit keeps its bits. In another one

1. each spring that is too long is shortened in turn, in sweeps from the pins outwards and back
   (Provot, "Deformation constraints in a mass-spring model", Graphics Interface 1995; Goldenthal et
   al., "Efficient simulation of inextensible cloth", SIGGRAPH 2007, filter velocities so after the
   step), and contact, if there is any, is resolved again from the start of the step. Ends share a
   correction by inverse mass; later the end that is farther from the pins takes all of it in each
   second sweep, which shortens long chains at once;
2. if springs are still too long after some rounds of that, boxes are met anew without friction,
   which holds particles where their springs have to slide them along a box;
3. if springs are still too long, and boxes move or the cloth begins in one, springs are shortened
   from there without contact with boxes: the cloth enters them as far as its springs need, and no
   farther;
4. else all particles go back by the same part of their way in the step, at whose start no spring
   was too long. Lengths are convex in the places of particles, so each spring is held on the whole
   way there.

The last cannot help where pins move the cloth apart; then `State.worst` and a warning say how far,
where and when.
"""

import math
import warnings
from collections.abc import Iterable
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from drapery.cloth.cloth import STRUCTURAL, Cloth
from drapery.cloth.colliders.vectors import add_scaled, dot, norm, row, scale, subtract
from drapery.cloth.contact.geometry import put
from drapery.cloth.order import across_then_outwards, pin_distances
from drapery.cloth.sheets import SheetLayout
from drapery.cloth.simd import fill, lane_count, load, maximum, store
from drapery.cloth.state import WorstStrain
from drapery.jit import call_by_address, entry_point, kernel
from drapery.mesh import Array

MOST_STRETCH = 1.15
"""The longest structural spring over its length at rest, unless the limit of a solver is higher:
Provot's 1.1, and room for what his sweeps leave over."""
SHORTENED = 0.98
"""A spring that is too long becomes this part of its longest length: else the next step would find
it too long again."""
HELD_TO = 1e-3
"""A spring is held if it is over its limit by at most this part."""
SWEEPS = 24
"""The most sweeps over the springs before contact is resolved again."""
SHARED_SWEEPS = 12
"""Sweeps in which ends share corrections, before far ends follow near ones in each second one."""
TOLD = 0.02
"""A strain over its limit by more than this part is warned of: it can be seen."""
NOTES = 6
"""What is noted of the worst moment of each cloth: the length of a spring over its longest one, the
number of the step, the number of the spring, and the place of its middle (3)."""
LEEWAY = 0.01
"""A spring that is over its limit at the start of a step by at most this part gets no longer."""


class StrainLimit(NamedTuple):
    """The longest structural springs of a cloth, in the order of sweeps.

    pairs: their ends, [S, 2]. longest: [m], [S]. squares: of these, [S].
    shares: the parts of a correction that the ends take, by inverse mass; pinned ones take none,
        [S, 2].
    follow: the same where the end that is farther from the pins takes all, [S, 2].
    inv_mass: of the particles [1/kg], [N].
    """

    pairs: NDArray[np.int32]
    longest: Array
    squares: Array
    shares: Array
    follow: Array
    inv_mass: Array


NEVER = StrainLimit(
    np.zeros((0, 2), np.int32),
    np.zeros(0),
    np.zeros(0),
    np.zeros((0, 2)),
    np.zeros((0, 2)),
    np.zeros(0),
)
"""The limit of cloth that may stretch at will."""


def strain_limit(cloth: Cloth, stretch: float) -> StrainLimit:
    """The structural springs, each at most `stretch` times as long as at rest; none if that is
    infinite."""
    if math.isinf(stretch):
        return NEVER
    springs = across_then_outwards(cloth, np.flatnonzero(cloth.spring_kind == STRUCTURAL))
    pairs = cloth.spring_pairs[springs].astype(np.int32)
    inv_mass = np.array(cloth.inv_mass, float)
    weights = inv_mass[pairs]
    shares = weights / np.maximum(weights.sum(axis=1, keepdims=True), 1e-300)
    longest, follow = stretch * cloth.spring_length[springs], _followed(cloth, pairs, shares)
    return StrainLimit(pairs, longest, longest**2, shares, follow, inv_mass)


def _followed(cloth: Cloth, pairs: NDArray[np.int32], shares: Array) -> Array:
    """The `follow` of a `StrainLimit`; ends that are equally far from the pins share."""
    far = pin_distances(cloth)[pairs]
    other, alike = far[:, ::-1], 1.0 + 1e-9
    follows: Array = np.where(far > alike * other, 1.0, shares)
    return np.where(other > alike * far, 0.0, follows)


def allowed_stretch(limit: float, sweeps: int) -> float:
    """The longest structural spring over its length at rest for a solver with this limit; infinite
    if it makes no sweeps to hold it."""
    return max(MOST_STRETCH, limit) if sweeps else math.inf


def plane_squares(sheet: SheetLayout, limit: StrainLimit) -> Array:
    """The squares of the longest lengths in a plane of lanes, of springs to the next column and to
    the next row [m²], [2, plane]; infinite where there is none."""
    squares = np.full((2, sheet.plane if len(limit.longest) else 0), np.inf)
    first, second = limit.pairs.T
    lanes = first // sheet.columns * sheet.width + first % sheet.columns
    down = second - first == sheet.columns
    squares[down.astype(int), lanes] = limit.squares
    return squares


@kernel
def excess_of_lanes(out: Any, y: Any, pairs: Any, squares: Any, lane: Any) -> None:
    """For each lane of a register of y [3N, L], the largest square of a spring's length less the
    square of its limit [m²], if it is above 0, into out [1, lanes].

    squares: of the limits [m²], [1, S].
    """
    most = fill(y.dtype.type(0))
    for s in range(pairs.shape[0]):
        i, j = 3 * np.intp(pairs[s, 0]), 3 * np.intp(pairs[s, 1])
        square = fill(squares[0, s])
        dx = load(y, j, lane) - load(y, i, lane)
        dy = load(y, j + 1, lane) - load(y, i + 1, lane)
        dz = load(y, j + 2, lane) - load(y, i + 2, lane)
        most = maximum(dx * dx + dy * dy + dz * dz - square, most)
    store(out, 0, 0, most)


@kernel
def plane_is_long(y: Any, squares: Any, sheet: Any) -> bool:
    """Whether a spring of a plane y [3, lanes] is too long; squares: see `plane_squares`."""
    if squares.shape[1] == 0:
        return False
    most, width = fill(y.dtype.type(0)), sheet.width
    for n in range(0, sheet.size, lane_count(y)):
        x0, y0, z0 = load(y, 0, n), load(y, 1, n), load(y, 2, n)
        dx, dy, dz = load(y, 0, n + 1) - x0, load(y, 1, n + 1) - y0, load(y, 2, n + 1) - z0
        # The number that may be NaN, in lanes without cloth, comes first: see `maximum`.
        most = maximum(dx * dx + dy * dy + dz * dz - load(squares, 0, n), most)
        dx, dy = load(y, 0, n + width) - x0, load(y, 1, n + width) - y0
        dz = load(y, 2, n + width) - z0
        most = maximum(dx * dx + dy * dy + dz * dz - load(squares, 1, n), most)
    out = np.empty((1, lane_count(y)), y.dtype)
    store(out, 0, 0, most)
    found = False
    for lane in range(lane_count(y)):
        found = found or out[0, lane] > 0
    return found


@kernel
def is_long(x: Array, limit: StrainLimit) -> bool:
    """Whether a spring of a cloth [N, 3] is too long."""
    for s in range(limit.squares.size):
        offset = subtract(row(x, limit.pairs[s, 1]), row(x, limit.pairs[s, 0]))
        if dot(offset, offset) > limit.squares[s]:
            return True
    return False


@kernel
def longest_square(x: Array, limit: StrainLimit) -> float:
    """The largest square of a spring's length in a cloth [N, 3] over the square of its limit."""
    most = 0.0
    for s in range(limit.squares.size):
        offset = subtract(row(x, limit.pairs[s, 1]), row(x, limit.pairs[s, 0]))
        most = max(most, dot(offset, offset) / limit.squares[s])
    return most


@kernel
def note_longest(noted: Array, x: Array, limit: StrainLimit, step: int) -> None:
    """Note the spring of a cloth [N, 3] that is longest over its limit, if it is longer than the
    one of an earlier step. noted: see NOTES, [6]."""
    most, longest = noted[0] * noted[0], -1
    for s in range(limit.squares.size):
        offset = subtract(row(x, limit.pairs[s, 1]), row(x, limit.pairs[s, 0]))
        square = dot(offset, offset) / limit.squares[s]
        if square > most:
            most, longest = square, s
    if longest >= 0:
        i, j = limit.pairs[longest, 0], limit.pairs[longest, 1]
        noted[0], noted[1], noted[2] = np.sqrt(most), step, longest
        for axis in range(3):
            noted[3 + axis] = 0.5 * (x[i, axis] + x[j, axis])


@kernel
def shorten_long(x: Array, limit: StrainLimit) -> bool:
    """Sweep over the springs of a cloth [N, 3] that are too long; returns whether there was one."""
    found, count = False, limit.longest.size
    for sweep in range(SWEEPS):
        again, back = False, sweep % 2 == 1
        follows = sweep >= SHARED_SWEEPS and not back
        for n in range(count):
            s = count - 1 - n if back else n
            i, j = limit.pairs[s, 0], limit.pairs[s, 1]
            offset = subtract(row(x, j), row(x, i))
            if dot(offset, offset) <= limit.squares[s] or is_pinned(limit, s):
                continue
            again = True
            first = limit.follow[s, 0] if follows else limit.shares[s, 0]
            second = limit.follow[s, 1] if follows else limit.shares[s, 1]
            part = 1.0 - SHORTENED * limit.longest[s] / norm(offset)
            for axis in range(3):
                x[i, axis] += first * part * offset[axis]
                x[j, axis] -= second * part * offset[axis]
        if not again:
            break
        found = True
    return found


@kernel
def is_pinned(limit: StrainLimit, s: int) -> bool:
    """Whether both ends of a spring are pinned."""
    return bool(limit.shares[s, 0] + limit.shares[s, 1] == 0.0)


@kernel
def go_back(x0: Array, x: Array, limit: StrainLimit) -> bool:
    """Take the free particles of a cloth [N, 3] back to the part of their way from x0 to x at which
    no spring is too long; springs that are too long at the start of the step do not count. Returns
    whether pins moved: then x0 is carried along by their mean motion."""
    shift, pins, part = (0.0, 0.0, 0.0), 0, 1.0
    for i in range(len(limit.inv_mass)):
        if limit.inv_mass[i] == 0.0:
            shift, pins = add_scaled(shift, 1.0, subtract(row(x, i), row(x0, i))), pins + 1
    shift = scale(1.0 / max(pins, 1), shift)
    for s in range(limit.longest.size):
        i, j = limit.pairs[s, 0], limit.pairs[s, 1]
        offset = subtract(row(x, j), row(x, i))
        square = limit.squares[s]
        if dot(offset, offset) <= square or is_pinned(limit, s):
            continue
        # Pinned particles are at their places already.
        first = row(x, i) if limit.inv_mass[i] == 0.0 else add_scaled(row(x0, i), 1.0, shift)
        second = row(x, j) if limit.inv_mass[j] == 0.0 else add_scaled(row(x0, j), 1.0, shift)
        begin = subtract(second, first)
        way = subtract(offset, begin)
        a, b, c = dot(way, way), dot(begin, way), dot(begin, begin) - square
        if c < 0.0:
            part = min(part, SHORTENED * (np.sqrt(b * b - a * c) - b) / a)
        elif c < 2.0 * LEEWAY * square:
            part = 0.0
    if part < 1.0:
        for i in range(len(x)):
            if limit.inv_mass[i] > 0.0:
                begin = add_scaled(row(x0, i), 1.0, shift)
                put(x, i, 0, add_scaled(begin, part, subtract(row(x, i), begin)))
    return norm(shift) > 0.0


def worst_now(x: Array, limit: StrainLimit, time: float) -> WorstStrain | None:
    """The spring of cloths [B, N, 3] that is longest over its limit at a time [s]; None where all
    springs are held."""
    offsets = x[:, limit.pairs[:, 1]] - x[:, limit.pairs[:, 0]]
    ratios = np.sqrt((offsets * offsets).sum(axis=-1)) / limit.longest
    if not float(ratios.max(initial=0.0)) - 1.0 > HELD_TO:
        return None
    cloth, spring = (int(each) for each in np.unravel_index(ratios.argmax(), ratios.shape))
    middle = x[cloth, limit.pairs[spring]].mean(axis=0)
    return _worst(float(ratios[cloth, spring]), time, cloth, limit.pairs[spring], middle)


def worst_noted(noted: Array, limit: StrainLimit, begin: float, dt: float) -> WorstStrain | None:
    """The spring that was longest over its limit in some steps of dt [s] from a time [s] on; None
    where all springs were held. noted: see NOTES, [6, B]."""
    cloth = int(noted[0].argmax())
    ratio, step, spring, *place = noted[:, cloth].tolist()
    if not ratio - 1.0 > HELD_TO:
        return None
    return _worst(ratio, begin + (step + 1) * dt, cloth, limit.pairs[int(spring)], place)


def _worst(
    ratio: float, time: float, cloth: int, pair: NDArray[np.int32], middle: Iterable[float]
) -> WorstStrain:
    (i, j), (x, y, z) = (int(end) for end in pair), (float(axis) for axis in middle)
    return WorstStrain(ratio - 1.0, time, cloth, (i, j), (x, y, z))


def worse(first: WorstStrain | None, second: WorstStrain | None) -> WorstStrain | None:
    """The one that is farther over its limit; the first if both are as far."""
    if first is None or second is None:
        return second if first is None else first
    return second if second.over > first.over else first


def warn_of_strain(worst: WorstStrain | None) -> None:
    """Warn of cloth whose strain was over its limit by more than `TOLD`."""
    if worst is None or worst.over <= TOLD:
        return
    (i, j), place = worst.particles, ", ".join(f"{each:.3g}" for each in worst.place)
    warnings.warn(
        f"pins or colliders pull cloth {worst.cloth} apart: at {worst.time:.4g} s the edge between "
        f"particles {i} and {j} at ({place}) m was {100 * worst.over:.3g} % longer than its limit; "
        "move pins and colliders less far, pin fewer particles, or make the cloth thinner",
        stacklevel=4,
    )


@entry_point
def limit_strain(x0: Array, x: Array, limit: StrainLimit) -> int:
    """Shorten the springs of a cloth that touches nothing, or go back towards x0, [N, 3]; returns
    whether one was long."""
    found = shorten_long(x, limit)
    if found and is_long(x, limit):
        go_back(x0, x, limit)
    return int(found)


EXAMPLE = (np.zeros((0, 3)), np.zeros((0, 3)), NEVER)
call_limit = call_by_address(int, EXAMPLE)
