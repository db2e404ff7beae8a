"""The wind of a played cloth: `aim` turns it to another velocity, and its gusts continue."""

from typing import Any, NamedTuple

import numpy as np

from drapery.cloth import kernels
from drapery.cloth.cloth import Cloth
from drapery.cloth.ripples import (
    RippleTables,
    resting_frame,
    ripple_place,
    ripple_rate,
    ripple_strength,
    ripple_tables,
    vortex_place,
    vortex_rate,
    vortex_strength,
    vortex_turns,
)
from drapery.cloth.wind import COLUMN, Wind
from drapery.jit import entry_point, kernel
from drapery.mesh import Array

__all__ = ["LiveWind", "aim", "make_live_wind"]

rate_of, place_of = kernel(ripple_rate), kernel(ripple_place)
strength_of = kernel(ripple_strength)
vortex_rate_of, vortex_place_of = kernel(vortex_rate), kernel(vortex_place)
vortex_strength_of = kernel(vortex_strength)


class LiveWind(NamedTuple):
    """What `aim` needs to turn a wind.

    velocity: the free mean wind that the host wants [m/s], [3]. lee: factors of it at the cloth,
    [3]. airflow: added to it at the cloth [m/s], [3]. gravity: without wind [m/s²], [3].
    carried: the part of the wind's velocity that acts beside it [1/s]. gusts, gust_size,
    ripples, vortices: as in `Wind`. ripple_tables: empty without ripples.
    vortex_turns: the phase of the vortices, [1], or none. rest, normal, down: see `resting_frame`.
    """

    velocity: Array
    lee: Array
    airflow: Array
    gravity: Array
    carried: float
    gusts: float
    gust_size: float
    ripples: float
    vortices: float
    ripple_tables: RippleTables
    vortex_turns: Array
    rest: Array
    normal: Array
    down: Array


def make_live_wind(
    cloth: Cloth,
    wind: Wind,
    lee: tuple[float, float, float],
    airflow: tuple[float, float, float],
    gravity: Array,
    carried: float,
) -> LiveWind:
    """A wind before it is multiplied by lee, ready to be turned by `aim`; see `LiveWind`."""
    tables = ripple_tables(wind)
    return LiveWind(
        np.array(wind.velocity, float),
        np.array(lee, float),
        np.array(airflow, float),
        np.array(gravity, float),
        float(carried),
        float(wind.gusts),
        float(wind.gust_size),
        float(wind.ripples),
        float(wind.vortices),
        tables if wind.ripples else RippleTables(*(part[:0] for part in tables)),
        vortex_turns(wind) if wind.vortices else np.zeros(0),
        *resting_frame(cloth),
    )


@entry_point
def aim(live: Any, wind: Any, gusts: Any, loads: Any) -> Any:
    """Turn the winds of a batch to wind.velocity: what `lower_forces` writes for it.

    loads: the numbers of the batch, whose gravity changes where a wind carries the cloth.

    Gusts and waves continue where they are, at other rates. Returns 0.
    """
    x = wind.lee[0] * wind.velocity[0] + wind.airflow[0]
    y = wind.lee[1] * wind.velocity[1] + wind.airflow[1]
    z = wind.lee[2] * wind.velocity[2] + wind.airflow[2]
    loads[3] = wind.gravity[0] + wind.carried * x
    loads[4] = wind.gravity[1] + wind.carried * y
    loads[5] = wind.gravity[2] + wind.carried * z
    speed = np.sqrt(x * x + y * y + z * z)
    numbers, frequency = gusts.numbers[0], speed / wind.gust_size
    now = 0.0
    if live.clock[0] > 0:
        now = live.clock[0] * live.dt[0] + gusts.phases[0, 0]
        start = numbers[COLUMN.gust_start] + now * numbers[COLUMN.gust_rate] - now * frequency
        cells = numbers[COLUMN.gust_cells]
        numbers[COLUMN.gust_start] = start - cells * np.floor(start / cells)
    turn_axes(numbers, x, y, z, speed)
    numbers[COLUMN.speed], numbers[COLUMN.gusts] = speed, wind.gusts * speed
    numbers[COLUMN.gust_rate] = frequency
    turn_waves(wind, gusts, x, y, z, speed, now)
    return 0


@kernel
def turn_axes(numbers: Any, x: Any, y: Any, z: Any, speed: Any) -> None:
    """Orthonormal rows: along a wind, level across it, and the third; see `wind`."""
    ex, ey, ez = (x / speed, y / speed, z / speed) if speed > 0 else (1.0, 0.0, 0.0)
    length = np.sqrt(ez * ez + ex * ex)
    ax, az = (ez / length, -ex / length) if length > 1e-9 else (1.0, 0.0)
    if speed == 0:
        ax, az = 0.0, 1.0
    third = ey * az, 1.0 if speed == 0 else ez * ax - ex * az, 0.0 - ey * ax
    rows = (ex, ey, ez), (ax, 0.0, az), third
    for row in range(3):
        for axis in range(3):
            numbers[COLUMN.axes + 3 * row + axis] = rows[row][axis]


@kernel
def turn_waves(wind: Any, gusts: Any, x: Any, y: Any, z: Any, speed: Any, now: Any) -> None:
    """The rates of the waves, and their parts at each particle; see `ripples`.

    A wave has the same phase now [s] as the old one.
    """
    nx, ny, nz = wind.normal[0], wind.normal[1], wind.normal[2]
    head_on = x * nx + y * ny + z * nz
    ax = x - head_on * nx + abs(head_on) * wind.down[0]
    ay = y - head_on * ny + abs(head_on) * wind.down[1]
    az = z - head_on * nz + abs(head_on) * wind.down[2]
    length = np.sqrt(ax * ax + ay * ay + az * az)
    if length > 1e-9:
        ax, ay, az = ax / length, ay / length, az / length
    else:
        ax, ay, az = wind.down[0], wind.down[1], wind.down[2]
    bx, by, bz = ny * az - nz * ay, nz * ax - nx * az, nx * ay - ny * ax
    low, high = np.inf, -np.inf
    for i in range(wind.rest.shape[0]):
        across = wind.rest[i, 0] * bx + wind.rest[i, 1] * by + wind.rest[i, 2] * bz
        low, high = min(low, across), max(high, across)
    count = wind.ripple_tables.turns.size
    for k in range(count):
        table = wind.ripple_tables
        rate = rate_of(speed, table.carried[k], table.forward[k], table.lengths[k])
        put_rate(gusts, k, rate, now)
    if wind.vortex_turns.size > 0:
        rate = vortex_rate_of(speed, high - low) if high > low else 0.0
        put_rate(gusts, count, rate, now)
    for i in range(wind.rest.shape[0]):
        along = wind.rest[i, 0] * ax + wind.rest[i, 1] * ay + wind.rest[i, 2] * az
        across = wind.rest[i, 0] * bx + wind.rest[i, 1] * by + wind.rest[i, 2] * bz
        for k in range(count):
            table = wind.ripple_tables
            strength = strength_of(table.roots[k], wind.ripples, speed, table.norm[0])
            place = place_of(table.forward[k], table.sideways[k], along, across, table.lengths[k])
            put_wave(gusts, k, i, strength, place)
        if wind.vortex_turns.size > 0:
            strength = place = 0.0
            if speed > 0 and high > low:
                strength = vortex_strength_of(wind.vortices, speed, across, low, high)
                place = vortex_place_of(along, gusts.rates[0, count], speed)
            put_wave(gusts, count, i, strength, place)


@kernel
def put_rate(gusts: Any, k: Any, rate: Any, now: Any) -> None:
    """The rate of wave k, and the turns with which its phase continues."""
    turns = gusts.turns[0, k] + now * gusts.rates[0, k] - now * rate
    gusts.turns[0, k] = turns - np.floor(turns)
    gusts.rates[0, k] = rate


@kernel
def put_wave(gusts: Any, k: Any, i: Any, strength: Any, place: Any) -> None:
    """The parts of wave k at particle i."""
    F = gusts.sines.dtype.type
    gusts.sines[0, k, i] = F(strength * kernels.sine_of_turns(0.25 - place))
    gusts.cosines[0, k, i] = F(strength * kernels.sine_of_turns(-place))
