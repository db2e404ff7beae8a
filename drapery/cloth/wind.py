"""Wind: a steady flow, a sine, and gusts of gradient noise that travel with the flow.

`drapery.cloth.ripples` adds what runs along the cloth.

Ken Perlin, "An image synthesizer" (SIGGRAPH 1985), for the noise and its use; "Improving noise"
(SIGGRAPH 2002) for the quintic fade. Moving frozen turbulence with the mean flow is Taylor's
hypothesis (Proc. R. Soc. A 164, 1938).
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from drapery.arrays import Floats, Vectors
from drapery.cloth.checks import check_count, check_number, vector3
from drapery.errors import OptionError, counted, shown
from drapery.mesh import Array

CROSSWIND = (1.0, 0.75, 0.5)
"""Rms of gusts along, across and up, over that along: Panofsky, Dutton, "Atmospheric
Turbulence" (1984), near neutral air over flat ground."""
MAX_SPEED, MAX_PLACE = 1e6, 1e9
"""Bounds of a wind's velocity [m/s], and of its origins [m] and phases [s]."""
UNBOUND_CELLS = 4096.0
"""Gusts of a wind without a period repeat after this many gust sizes."""


@dataclass(frozen=True, eq=False)
class Wind:
    """A wind that presses on faces: force = pressure · area · ((wind - velocity) · n) n.

    The force is 0 on a cloth that is edge-on to the wind and on a cloth that moves with it.

    velocity: mean wind [m/s], each component from -1e6 to 1e6.
    gusts: turbulence intensity, the rms of the gusts along the wind over its mean speed, 0 to 1000.
    gust_size: the size of a gust [m], 0.001 to 1e6; gusts travel with the mean wind.
    sine: amplitude of a regular swell over the mean speed, 0 to 1000.
    sine_period: period of the swell [s], 0.001 to 1e9.
    seed: chooses the gusts; a whole number.
    period: time [s] after which the wind repeats exactly, 0.001 to 1e9; the period of the swell and
        the speed of the gusts are rounded to fit. None: it does not repeat for hours.
    pressure: force per area and speed [N s/m³], 0 to 1e6.
    ripples: rms of the waves that eddies drive along the cloth, over the mean speed, 0 to 1000.
    ripple_size: middle length of these waves [m], 0.001 to 1e6; four or five times the width of the
        pole or bar that sheds the eddies.
    vortices: amplitude of the vortices that leave the two sides of the cloth alternately, over the
        mean speed, 0 to 1000.
    phases: time offset of each cloth of a batch [s], shape [B] or one number.
    origins: position of each cloth in the wind [m], shape [B, 3] or [3].
    Raises OptionError.
    """

    velocity: tuple[float, float, float]
    gusts: float = 0.4
    gust_size: float = 1.5
    sine: float = 0.2
    sine_period: float = 3.1
    seed: int = 0
    period: float | None = None
    pressure: float = 0.25
    ripples: float = 0.0
    ripple_size: float = 0.5
    vortices: float = 0.0
    phases: Floats | float = 0.0
    origins: Vectors | tuple[float, float, float] = (0.0, 0.0, 0.0)

    def __post_init__(self) -> None:
        vector3("wind velocity", self.velocity, MAX_SPEED, "m/s")
        check_number("wind gusts", self.gusts, 0, 1e3)
        check_number("wind gust_size", self.gust_size, 1e-3, 1e6, "m")
        check_number("wind sine", self.sine, 0, 1e3)
        check_number("wind sine_period", self.sine_period, 1e-3, 1e9, "s")
        check_number("wind pressure", self.pressure, 0, 1e6, "N s/m³")
        check_number("wind ripples", self.ripples, 0, 1e3)
        check_number("wind ripple_size", self.ripple_size, 1e-3, 1e6, "m")
        check_number("wind vortices", self.vortices, 0, 1e3)
        check_count("wind seed", self.seed, -(2**63), 2**64 - 1)
        if self.period is not None:
            check_number("wind period", self.period, 1e-3, 1e9, "s")
        for name in ("phases", "origins"):
            _check_finite(f"wind {name}", getattr(self, name))


def _check_finite(name: str, values: object) -> None:
    try:
        wrong = not (np.abs(np.asarray(values, float)) <= MAX_PLACE).all()
    except (TypeError, ValueError, OverflowError):
        wrong = True
    if wrong:
        raise OptionError(f"{name} {shown(values)} must be numbers up to {MAX_PLACE:g} in size")


class WindNumbers(NamedTuple):
    """The numbers of a wind that kernels read: a row of `Gusts.numbers`, in this order.

    speed: of the mean wind [m/s].
    sine: amplitude of the swell over the mean speed.
    sine_rate: frequency of the swell [1/s].
    gusts: amplitude of the gusts [m/s].
    gust_scale: 1 over the size of a gust [1/m].
    gust_rate: frequency of the gusts [cells/s].
    gust_start: place of the gusts at time 0 [cells]; a page that turns the wind moves it.
    gust_cells: cells before the gusts repeat.
    pressure: force per area and speed [N s/m³].
    axes: unit vectors along the wind, level across it, and the third; nine columns, the last.
    """

    speed: float
    sine: float
    sine_rate: float
    gusts: float
    gust_scale: float
    gust_rate: float
    gust_start: float
    gust_cells: float
    pressure: float
    axes: Sequence[float]


COLUMN: Any = WindNumbers._make(range(len(WindNumbers._fields)))
"""Where each number is in its row: kernels read `numbers[COLUMN.speed]`; `axes` is the first of
nine columns."""
COLUMNS: int = COLUMN.axes + 9
"""How many columns a row has."""


class Gusts(NamedTuple):
    """W winds on B cloths, as the kernels read them.

    numbers: see `WindNumbers`, [W, COLUMNS]. seeds: [W]. phases: [W, B]. origins: [W, 3, B].
    rates, turns: of K waves, [W, K]. sines, cosines: [W, K, N + padding]; see `ripples.Waves`.
    """

    numbers: Array
    seeds: NDArray[np.uint32]
    phases: Array
    origins: Array
    rates: Array
    turns: Array
    sines: Array
    cosines: Array


def lower_winds(winds: Sequence[Wind], count: int) -> Gusts:
    """All winds on `count` cloths as arrays, without waves. Raises OptionError."""
    phases = np.zeros((len(winds), count))
    origins = np.zeros((len(winds), 3, count))
    for number, wind in enumerate(winds):
        try:
            phases[number] = wind.phases
            origins[number] = np.asarray(wind.origins, float).T.reshape(3, -1)
        except ValueError:
            raise OptionError(
                f"wind phases and origins must fit {counted(count, 'cloth')}"
            ) from None
    rows = [[*row[: COLUMN.axes], *row.axes] for row in map(_numbers, winds)]
    numbers = np.array(rows, float).reshape(len(winds), COLUMNS)
    seeds = np.array([wind.seed & 0xFFFFFFFF for wind in winds], np.uint32)
    none = np.zeros((len(winds), 0))
    return Gusts(numbers, seeds, phases, origins, none, none, none[..., None], none[..., None])


def _numbers(wind: Wind) -> WindNumbers:
    velocity = np.asarray(wind.velocity, float)
    speed = float(np.sqrt((velocity * velocity).sum()))
    sine_frequency = 1.0 / wind.sine_period
    frequency, cells = speed / wind.gust_size, UNBOUND_CELLS
    if wind.period is not None:
        sine_frequency = max(1, round(wind.period * sine_frequency)) / wind.period
        cells = max(1, round(wind.period * frequency))
        frequency = cells / wind.period
    return WindNumbers(
        speed=speed,
        sine=wind.sine,
        sine_rate=sine_frequency,
        gusts=wind.gusts * speed,
        gust_scale=1.0 / wind.gust_size,
        gust_rate=frequency,
        gust_start=0.0,
        gust_cells=cells,
        pressure=wind.pressure,
        axes=_axes(velocity, speed),
    )


def _axes(velocity: Array, speed: float) -> list[float]:
    """Orthonormal rows: along the wind, level across it, and the third."""
    if speed == 0:
        return [1, 0, 0, 0, 0, 1, 0, 1, 0]
    along = velocity / speed
    level = np.array([along[2], 0.0, -along[0]])
    length = float(np.sqrt((level * level).sum()))
    across = level / length if length > 1e-9 else np.array([1.0, 0.0, 0.0])
    return [*along, *across, *np.cross(along, across)]
