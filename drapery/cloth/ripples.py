"""Ripples of a wind: pressure waves that run along a cloth, and vortices shed at its sides.

Eddies that a pole, a bar or an edge sheds are carried along the cloth by the flow and press on it
as they pass. The pressure under them is a sum of waves of several lengths, each carried at about
0.6 of the speed of the flow: Corcos, "The structure of the turbulent pressure field in
boundary-layer flows" (J. Fluid Mech. 18, 1964). They run in the direction of the wind along the
cloth; a wind that meets the cloth head-on is turned by it towards the free edge. A plate also sheds
vortices alternately at its two sides with f b / U = 0.145: Fage, Johansen, "On the flow of air
behind an inclined flat plate of infinite span" (Proc. R. Soc. A 116, 1927).

A wave at a particle is sin(2π (f t + turn - s)), so it is stored as two parts a particle, and a
step needs only the sine and the cosine of its phase. All frequencies are multiples of 1 / period
for a wind that repeats.
"""

from collections.abc import Sequence
from typing import Any, NamedTuple
from weakref import WeakKeyDictionary

import numpy as np

from drapery.cloth.cloth import Cloth
from drapery.cloth.wind import Gusts, Wind
from drapery.elementary import cbrt, power, sine_of_turns
from drapery.mesh import Array, face_normals

WAVES = 16
"""Waves of a wind, without the vortices."""
OCTAVES = 2.0
"""The octaves around the size of the ripples over which their lengths are spread."""
CARRIED = 0.45, 0.75
"""Speeds of waves over the wind's: Corcos's range."""
MEAN_CARRIED = sum(CARRIED) / 2
SPREAD = 0.2
"""Waves run up to this part of a turn to either side of the flow."""
STROUHAL = 0.145
"""Frequency of the vortices behind a flat plate times its width over the speed."""
PADDING = 64
"""Numbers after those of the last particle, so that kernels may read whole registers."""


class Waves(NamedTuple):
    """K waves on N particles: sin(2π (rates t + turns)) sines + cos(…) cosines [m/s].

    rates: [1/s], [K]. turns: [K]. sines, cosines: [m/s], [K, N + PADDING].
    """

    rates: Array
    turns: Array
    sines: Array
    cosines: Array


_known: WeakKeyDictionary[Cloth, WeakKeyDictionary[Wind, Waves]] = WeakKeyDictionary()
"""Waves that are made, as long as both cloth and wind exist. A limit on their number would make
all of them anew in each step wherever more cloths are stepped in turn."""


def waves_of(wind: Wind, cloth: Cloth) -> Waves:
    """The waves of a wind on a cloth in its rest shape; none if it has no ripples or vortices."""
    known = _known.setdefault(cloth, WeakKeyDictionary())
    waves = known.get(wind)
    if waves is None:
        waves = known[wind] = _made_waves(wind, cloth)
    return waves


def _made_waves(wind: Wind, cloth: Cloth) -> Waves:
    velocity = np.asarray(wind.velocity, float)
    speed = float(np.sqrt((velocity * velocity).sum()))
    along, across = _places(velocity, cloth)
    waves = [_no_waves(len(along))]
    if wind.ripples and speed:
        waves.append(_ripples(wind, speed, along, across))
    if wind.vortices and speed and np.ptp(across) > 0:
        waves.append(_vortices(wind, speed, along, across))
    rates, turns, sines, cosines = (np.concatenate(parts) for parts in zip(*waves, strict=True))
    if wind.period is not None:
        rates = np.maximum(1, np.round(rates * wind.period)) / wind.period
    padding = ((0, 0), (0, PADDING))
    return Waves(rates, turns, np.pad(sines, padding), np.pad(cosines, padding))


def with_waves(gusts: Gusts, winds: Sequence[Wind], cloth: Cloth) -> Gusts:
    """The winds with their waves on a cloth; those with fewer are filled with waves of 0 m/s."""
    if not any(wind.ripples or wind.vortices for wind in winds):
        return gusts
    waves = [waves_of(wind, cloth) for wind in winds]
    most = max(len(wave.rates) for wave in waves)
    filled = ([_filled(part, most) for part in parts] for parts in zip(*waves, strict=True))
    rates, turns, sines, cosines = map(np.stack, filled)
    return gusts._replace(rates=rates, turns=turns, sines=sines, cosines=cosines)


def _filled(values: Array, count: int) -> Array:
    """The rows, with zeros behind them up to a number of rows."""
    more = np.zeros((count - len(values), *values.shape[1:]))
    return np.concatenate([values, more]) if len(more) else values


def _no_waves(particles: int) -> Waves:
    return Waves(np.zeros(0), np.zeros(0), *np.zeros((2, 0, particles)))


def _ripples(wind: Wind, speed: float, along: Array, across: Array) -> Waves:
    made = ripple_tables(wind)
    rates = ripple_rate(speed, made.carried, made.forward, made.lengths)
    headings = made.forward[:, None], made.sideways[:, None]
    places = ripple_place(*headings, along, across, made.lengths[:, None])
    strength = ripple_strength(made.roots, wind.ripples, speed, made.norm[0])
    return _at_places(rates, made.turns, places, strength[:, None])


def _vortices(wind: Wind, speed: float, along: Array, across: Array) -> Waves:
    low, high = across.min(), across.max()
    rate = vortex_rate(speed, high - low)
    place = vortex_place(along, rate, speed)
    strength = vortex_strength(wind.vortices, speed, across, low, high)
    return _at_places(np.array([rate]), vortex_turns(wind), place[None], strength[None])


def _at_places(rates: Array, turns: Array, places: Array, strength: Array) -> Waves:
    sines, cosines = strength * sine_of_turns(0.25 - places), strength * sine_of_turns(-places)
    return Waves(rates, turns, sines, cosines)


class RippleTables(NamedTuple):
    """What does not depend on the velocity of a wind, of K ripples.

    lengths: [m], [K]. carried: their speed over the wind's, [K]. forward, sideways: of the
    direction in which they run, to the flow along the cloth, [K]. roots: cube roots of the lengths,
    [K]: longer waves are stronger so (Kolmogorov 1941). turns: their phases, [K]. norm: 1 over the
    rms of all roots together, [1].
    """

    lengths: Array
    carried: Array
    forward: Array
    sideways: Array
    roots: Array
    turns: Array
    norm: Array


def ripple_tables(wind: Wind) -> RippleTables:
    """The tables of a wind's ripples."""
    jitter, angle, pace, turns = _random(wind.seed, 4, WAVES)
    octaves = OCTAVES * ((np.arange(WAVES) + jitter) / WAVES - 0.5)
    lengths = wind.ripple_size * power(2.0, octaves)
    heading = SPREAD * (2 * angle - 1)
    roots = cbrt(lengths)
    return RippleTables(
        lengths,
        CARRIED[0] + (CARRIED[1] - CARRIED[0]) * pace,
        sine_of_turns(heading + 0.25),
        sine_of_turns(heading),
        roots,
        turns,
        np.sqrt(2 / (roots * roots).sum(keepdims=True)),
    )


def vortex_turns(wind: Wind) -> Array:
    """The phase of a wind's vortices, [1]."""
    turns: Array = _random(wind.seed, 5, 1)[4]
    return turns


# Of numbers or of arrays: the kernel that turns a wind uses the same formulas, see `live`.


def ripple_rate(speed: Any, carried: Any, forward: Any, length: Any) -> Any:
    """The frequency of a ripple [1/s]."""
    return speed * carried * forward / length


def ripple_place(forward: Any, sideways: Any, along: Any, across: Any, length: Any) -> Any:
    """The phase of a ripple at a place [m] along and across the flow [turns]."""
    return (forward * along + sideways * across) / length


def ripple_strength(root: Any, ripples: Any, speed: Any, norm: Any) -> Any:
    """The amplitude of a ripple [m/s]."""
    return root * (ripples * speed * norm)


def vortex_rate(speed: Any, width: Any) -> Any:
    """The frequency of vortices behind a cloth of a width across the flow [m]: [1/s]."""
    return STROUHAL * speed / width


def vortex_place(along: Any, rate: Any, speed: Any) -> Any:
    """The phase of the vortices at a place along the flow [m]: [turns]."""
    return along * rate / (speed * MEAN_CARRIED)


def vortex_strength(vortices: Any, speed: Any, across: Any, low: Any, high: Any) -> Any:
    """The amplitude of the vortices at a place across a flow from low to high [m]: [m/s]."""
    return vortices * speed * ((2 * across - low - high) / (high - low))


def _places(velocity: Array, cloth: Cloth) -> tuple[Array, Array]:
    """How far each particle lies along the flow over the cloth, and across it [m], [N] each."""
    rest, normal, down = resting_frame(cloth)
    head_on = float((velocity * normal).sum())
    along = _unit(velocity - head_on * normal + abs(head_on) * down, down)
    across = np.cross(normal, along)
    return (rest * along).sum(axis=1), (rest * across).sum(axis=1)


def resting_frame(cloth: Cloth) -> tuple[Array, Array, Array]:
    """Particles at rest about their middle [m], [N, 3]; the normal of the cloth, and from its pins
    down along it, [3] each."""
    rest = cloth.rest_positions - cloth.rest_positions.mean(axis=0)
    normal = _unit(face_normals(rest, cloth.triangles).sum(axis=0), np.array([0.0, 0.0, 1.0]))
    pinned = cloth.inv_mass == 0
    down = np.array([0.0, -1.0, 0.0])
    if pinned.any() and not pinned.all():
        down = rest[~pinned].mean(axis=0) - rest[pinned].mean(axis=0)
    return rest, normal, _unit(down - (down * normal).sum() * normal, np.array([0.0, -1.0, 0.0]))


def _unit(vector: Array, otherwise: Array) -> Array:
    length = np.sqrt((vector * vector).sum())
    chosen: Array = vector / length if length > 1e-9 else otherwise
    return chosen


def _random(seed: int, rows: int, count: int) -> Array:
    """Numbers from 0 to 1 that are the same on every machine, [rows, count]."""
    raw = np.random.PCG64(seed & 0xFFFFFFFFFFFFFFFF).random_raw(rows * count)
    return (raw >> np.uint64(11)).reshape(rows, count) * 2.0**-53
