"""Cloth that a page plays without Python: the loop over time steps, its wind and pulls, as kernels.

`play` is compiled to WebAssembly by `drapery.web.wasm`, from this source and from that of the
solvers. On a processor it gives the bits of `MovingCloth.advance`, as long as nothing is pulled:
the loop calls the solvers' own kernels. Everything that a host may change between two calls is in
arrays, so that it only writes numbers.
"""

from collections.abc import Sequence
from dataclasses import replace
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from drapery.cloth import kernels
from drapery.cloth.cloth import Cloth
from drapery.cloth.contact.lanes_contact import contact_work
from drapery.cloth.forces import Drag, Force, Gravity, lower_forces
from drapery.cloth.ripples import (
    PADDING,
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
from drapery.cloth.solvers import desbrun, xpbd
from drapery.cloth.solvers.driver import Batch, batch_of
from drapery.cloth.stepping import MovingCloth
from drapery.cloth.wind import Wind
from drapery.errors import OptionError
from drapery.jit import entry_point, kernel, uses_numba
from drapery.mesh import Array

__all__ = ["LiveCall", "LiveControls", "LiveWind", "aim", "live_call", "play"]

EASE = 0.35
"""The share of the distance to its target that a pulled particle moves in a time step."""
MAX_MOTION = 0.2
"""The longest distance that a pull moves a particle in a time step [m]."""
PULL_RADIUS = 0.045
"""A pull moves all particles within this distance along the cloth [m]."""
MAX_STRETCH = 0.99
"""A pull stays nearer to each pin than this share of the cloth between them."""
LATE = 100.0
"""A turned wind has at least this time [s], so that its swell keeps its frequency within 2 %."""
PROJECTIONS = 48
"""The most projections of the target of a pull on what the cloth can reach."""

PLAYERS = {
    desbrun.DesbrunPlan: desbrun._advance,
    desbrun.DesbrunSheetPlan: desbrun._advance_sheet,
    xpbd.XPBDPlan: xpbd._advance,
    xpbd.XPBDSheetPlan: xpbd._advance_sheet,
}
"""The plans that can be played, and the kernels that step them."""
BY_LANES = desbrun.DesbrunPlan, xpbd.XPBDPlan
"""Plans of cloths that are stepped side by side in lanes."""

rate_of, place_of = kernel(ripple_rate), kernel(ripple_place)
strength_of = kernel(ripple_strength)
vortex_rate_of, vortex_place_of = kernel(vortex_rate), kernel(vortex_place)
vortex_strength_of = kernel(vortex_strength)


class LiveControls(NamedTuple):
    """What moves with a played cloth, and what its host writes.

    clock: [2]: steps since the start, and steps to make in a call of `play`.
    dt: one step [s], [1].
    grab: [2]: the particle that the host wants to pull, or -1; the one that is pulled, or -1.
    target: where it is pulled to [m], [3]. offsets: of all particles from it [m], [N, 3].
    around: the particles that are pulled, 1 or 0, [N].
    rest, hung: all particles at rest and at the start [m], [N, 3]. pins: the pinned ones, [P].
    push: accelerations by the pull [m/s²], [3N, L].
    positions, velocities: of the first cloth [m], [m/s], [N, 3]: what the host reads.
    """

    clock: NDArray[np.int64]
    dt: Array
    grab: NDArray[np.int64]
    target: Array
    offsets: Array
    around: NDArray[np.int64]
    rest: Array
    hung: Array
    pins: NDArray[np.int64]
    push: Array
    positions: Array
    velocities: Array


class LiveWind(NamedTuple):
    """What `aim` needs to turn a wind.

    velocity: the free mean wind that the host wants [m/s], [3]. lee: factors of it at the cloth,
    [3]. swell: frequency of the swell [1/s], [1]. strengths: over the mean speed that of gusts, of
    ripples and of vortices, then the size of the gusts [m], [4]. ripples: none without them.
    vortices: the phase of the vortices, [1], or none. rest, normal, down: see `resting_frame`.
    """

    velocity: Array
    lee: Array
    swell: Array
    strengths: Array
    ripples: RippleTables
    vortices: Array
    rest: Array
    normal: Array
    down: Array


class LiveCall(NamedTuple):
    """The arguments of `play` and, with the batch's winds, of `aim`."""

    live: LiveControls
    wind: LiveWind
    plan: Any
    batch: Batch
    substeps: int


def live_call(
    moving: MovingCloth,
    forces: Sequence[Force],
    free: Wind,
    lee: tuple[float, float, float] = (1.0, 1.0, 1.0),
    lanes: int | None = None,
) -> LiveCall:
    """One cloth at the start of its motion, ready to be played.

    forces: gravity, drag and one wind, whose period is ignored. free: this wind before it is
    multiplied by lee, the factors of a wind at the cloth. lanes: that the arrays have room for; by
    default a register of this processor.
    Raises OptionError for solvers, contacts and forces that cannot be played.
    """
    state, solver_state = moving.state, moving.solver_state
    plan = solver_state.of(state.positions.dtype)
    if type(plan) not in PLAYERS:
        name = type(moving.solver).__name__
        raise OptionError(f"solver {name} cannot be played without Python; use xpbd or desbrun")
    if moving.resolve is not None:
        raise OptionError(
            "contact of the cloth with itself cannot be played without Python; use contact world"
        )
    winds = [force for force in forces if isinstance(force, Wind)]
    if len(winds) != 1 or not all(isinstance(force, Gravity | Drag | Wind) for force in forces):
        raise OptionError("only gravity, drag and one wind can be played without Python")
    wind = replace(winds[0], period=None)
    others = [force for force in forces if not isinstance(force, Wind)]
    loads = lower_forces([*others, wind], moving.cloth, 1)
    made = batch_of(moving.cloth, state, solver_state, loads, 1, None, 1, moving.boxes)
    blown = _live_wind(moving.cloth, free, lee)
    batch = _narrowed(made, lanes or made.x.shape[1], blown)
    return LiveCall(_controls(moving, batch), blown, plan, batch, solver_state.substeps)


def _live_wind(cloth: Cloth, wind: Wind, lee: tuple[float, float, float]) -> LiveWind:
    ripples = ripple_tables(wind)
    return LiveWind(
        np.array(wind.velocity, float),
        np.array(lee, float),
        np.array([1.0 / wind.sine_period]),
        np.array([wind.gusts, wind.ripples, wind.vortices, wind.gust_size], float),
        ripples if wind.ripples else RippleTables(*(part[:0] for part in ripples)),
        vortex_turns(wind) if wind.vortices else np.zeros(0),
        *resting_frame(cloth),
    )


def _narrowed(batch: Batch, lanes: int, wind: LiveWind) -> Batch:
    """The batch with so many lanes, with room for all waves, and for the contact of one cloth."""

    def cut(values: Array) -> Array:
        return np.ascontiguousarray(values[..., :lanes])

    waves = len(wind.ripples.turns) + len(wind.vortices)
    shape = 1, waves, len(wind.rest) + PADDING
    gusts = batch.gusts._replace(
        phases=cut(batch.gusts.phases),
        origins=cut(batch.gusts.origins),
        rates=np.zeros((1, waves)),
        turns=np.concatenate([wind.ripples.turns, wind.vortices])[None],
        sines=np.zeros(shape, batch.x.dtype),
        cosines=np.zeros(shape, batch.x.dtype),
    )
    return batch._replace(
        x=cut(batch.x),
        v=cut(batch.v),
        new_x=np.zeros_like(cut(batch.x)),
        new_v=np.zeros_like(cut(batch.v)),
        gusts=gusts,
        width=lanes,
        residuals=cut(batch.residuals),
        work=_zeros(contact_work(batch.contact)),
    )


def _zeros(scratch: Any) -> Any:
    """Zeros like the arrays of a named tuple, so that the same cloth has the same bytes."""
    parts = (_zeros(p) if isinstance(p, tuple) else np.zeros_like(p) for p in scratch)
    return type(scratch)(*parts)


def _controls(moving: MovingCloth, batch: Batch) -> LiveControls:
    cloth, positions = moving.cloth, np.array(moving.state.positions[0], order="C")
    count = len(positions)
    return LiveControls(
        clock=np.zeros(2, np.int64),
        dt=np.array([moving.dt]),
        grab=np.array([-1, -1]),
        target=np.zeros(3),
        offsets=np.zeros((count, 3)),
        around=np.zeros(count, np.int64),
        rest=np.array(cloth.rest_positions, float),
        hung=positions.astype(float),
        pins=np.flatnonzero(cloth.inv_mass == 0),
        push=np.zeros_like(batch.x),
        positions=positions,
        velocities=np.zeros_like(positions),
    )


def step_plan(plan: Any, batch: Any, substeps: Any) -> None:
    """One time step of the solver that the plan belongs to."""


uses_numba("drapery.cloth.live_choices")


@entry_point
def play(live: Any, plan: Any, batch: Any, substeps: Any) -> Any:
    """Make live.clock[1] time steps of one cloth; returns 1 if it has blown up, otherwise 0."""
    for _ in range(live.clock[1]):
        rows = pull(live, batch)
        # The time as a call of the solver for all steps since the start would have it.
        batch.numbers[2] = live.clock[0] * substeps * batch.numbers[0]
        here = Batch(
            batch.x,
            batch.v,
            batch.new_x,
            batch.new_v,
            batch.gusts,
            batch.numbers,
            batch.targets,
            live.push[:rows],
            batch.width,
            batch.residuals,
            batch.contact,
            batch.poses,
            batch.resolve,
            batch.work,
            batch.often,
            batch.cloths,
        )
        step_plan(plan, here, substeps)
        for row in range(batch.x.shape[0]):
            for lane in range(batch.x.shape[1]):
                batch.x[row, lane] = batch.new_x[row, lane]
                batch.v[row, lane] = batch.new_v[row, lane]
        live.clock[0] += 1
    return read_out(live, batch)


@kernel
def read_out(live: Any, batch: Any) -> Any:
    """Copy the first cloth to where the host reads it; returns 1 if it has blown up."""
    torn = 0
    for i in range(live.positions.shape[0]):
        for axis in range(3):
            live.positions[i, axis] = batch.x[3 * i + axis, 0]
            live.velocities[i, axis] = batch.v[3 * i + axis, 0]
            if not np.isfinite(live.positions[i, axis]):
                torn = 1
    return torn


@kernel
def pull(live: Any, batch: Any) -> Any:
    """Accelerations that move the pulled particles towards the target, into live.push; returns how
    many of its rows hold any.

    A pulled particle gets the velocity that takes it a share of the way in this step. What the
    cloth cannot follow, the solver takes back.
    """
    if live.grab[0] < 0:
        live.grab[1] = -1
        return 0
    if live.grab[1] != live.grab[0]:
        grab_around(live, batch)
    x, y, z = reachable(live)
    dt = live.dt[0]
    for i in range(live.around.size):
        px = x + live.offsets[i, 0] - batch.x[3 * i, 0]
        py = y + live.offsets[i, 1] - batch.x[3 * i + 1, 0]
        pz = z + live.offsets[i, 2] - batch.x[3 * i + 2, 0]
        length = np.sqrt(px * px + py * py + pz * pz)
        share = live.around[i] * min(EASE, MAX_MOTION / max(length, MAX_MOTION)) / dt
        change = px, py, pz
        for axis in range(3):
            for lane in range(live.push.shape[1]):
                gain = (share * change[axis] - live.around[i] * batch.v[3 * i + axis, 0]) / dt
                live.push[3 * i + axis, lane] = live.push.dtype.type(gain)
    return live.push.shape[0]


@kernel
def grab_around(live: Any, batch: Any) -> None:
    """Begin a pull at the particle that the host wants."""
    held = live.grab[1] = live.grab[0]
    for i in range(live.around.size):
        dx = live.rest[i, 0] - live.rest[held, 0]
        dy = live.rest[i, 1] - live.rest[held, 1]
        dz = live.rest[i, 2] - live.rest[held, 2]
        near = np.sqrt(dx * dx + dy * dy + dz * dz) <= PULL_RADIUS
        live.around[i] = 1 if near else 0
        for axis in range(3):
            place = np.float64(batch.x[3 * i + axis, 0])
            live.offsets[i, axis] = place - np.float64(batch.x[3 * held + axis, 0])
    for p in range(live.pins.size):
        live.around[live.pins[p]] = 0


@kernel
def reachable(live: Any) -> Any:
    """The target, or a point near it that is in reach of all pins.

    A pin can be no further away than the length of the flat cloth between pin and particle.
    The target is repeatedly projected onto the ball about the pin whose limit it exceeds most.
    """
    x, y, z = live.target[0], live.target[1], live.target[2]
    held = live.grab[1]
    for _ in range(PROJECTIONS):
        worst, excess, part = -1, 0.0, 1.0
        for p in range(live.pins.size):
            pin = live.pins[p]
            dx = live.rest[pin, 0] - live.rest[held, 0]
            dy = live.rest[pin, 1] - live.rest[held, 1]
            dz = live.rest[pin, 2] - live.rest[held, 2]
            longest = MAX_STRETCH * np.sqrt(dx * dx + dy * dy + dz * dz)
            px, py, pz = x - live.hung[pin, 0], y - live.hung[pin, 1], z - live.hung[pin, 2]
            distance = np.sqrt(px * px + py * py + pz * pz)
            if distance - longest > excess:
                worst, excess, part = pin, distance - longest, longest / distance
        if worst < 0:
            break
        x = live.hung[worst, 0] + (x - live.hung[worst, 0]) * part
        y = live.hung[worst, 1] + (y - live.hung[worst, 1]) * part
        z = live.hung[worst, 2] + (z - live.hung[worst, 2]) * part
    return x, y, z


@entry_point
def aim(live: Any, wind: Any, gusts: Any) -> Any:
    """Turn the winds of a batch to wind.velocity: what `lower_forces` writes for it.

    Gusts, swell and waves continue where they are: the time of the wind is shifted. Returns 0.
    """
    x = wind.lee[0] * wind.velocity[0]
    y = wind.lee[1] * wind.velocity[1]
    z = wind.lee[2] * wind.velocity[2]
    speed = np.sqrt(x * x + y * y + z * z)
    numbers, frequency = gusts.numbers[0], speed / wind.strengths[3]
    now = later = 0.0
    if live.clock[0] > 0:
        time = live.clock[0] * live.dt[0]
        now = time + gusts.phases[0, 0]
        later = same_gust(now, numbers, frequency)
        numbers[11] = swell_frequency(now * numbers[11], later, wind.swell[0])
        for lane in range(gusts.phases.shape[1]):
            gusts.phases[0, lane] = later - time
    turn_axes(numbers, x, y, z, speed)
    numbers[9], numbers[12], numbers[14] = speed, wind.strengths[0] * speed, frequency
    turn_waves(wind, gusts, x, y, z, speed, now, later)
    return 0


@kernel
def same_gust(now: Any, numbers: Any, frequency: Any) -> Any:
    """A time [s] at which gusts of a frequency are where those of another one are now.

    It is late enough for `swell_frequency`: the gusts repeat.
    """
    if not (numbers[14] > 0 and frequency > 0):
        return now
    later = now * numbers[14] / frequency
    repeated = numbers[15] / frequency
    if later < LATE:
        later += np.ceil((LATE - later) / repeated) * repeated
    return later


@kernel
def swell_frequency(turns: Any, later: Any, frequency: Any) -> Any:
    """The frequency nearest to one [1/s] with which a swell has these turns at a time [s]."""
    turns -= np.floor(turns)
    return (turns + np.floor(later * frequency - turns + 0.5)) / later if later > 0 else frequency


@kernel
def turn_axes(numbers: Any, x: Any, y: Any, z: Any, speed: Any) -> None:
    """Orthonormal rows: along a wind, level across it, and the third; see `wind`."""
    ex, ey, ez = (x / speed, y / speed, z / speed) if speed > 0 else (1.0, 0.0, 0.0)
    length = np.sqrt(ez * ez + ex * ex)
    ax, az = (ez / length, -ex / length) if length > 1e-9 else (1.0, 0.0)
    if speed == 0:
        ax, az = 0.0, 1.0
    numbers[0], numbers[1], numbers[2] = ex, ey, ez
    numbers[3], numbers[4], numbers[5] = ax, 0.0, az
    numbers[6] = ey * az
    numbers[7] = ez * ax - ex * az
    numbers[8] = 0.0 - ey * ax
    if speed == 0:
        numbers[7] = 1.0


@kernel
def turn_waves(
    wind: Any, gusts: Any, x: Any, y: Any, z: Any, speed: Any, now: Any, later: Any
) -> None:
    """The rates of the waves, and their parts at each particle; see `ripples`.

    A wave has the same phase at the time `later` [s] as the old one now.
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
    count = wind.ripples.turns.size
    for k in range(count):
        table = wind.ripples
        rate = rate_of(speed, table.carried[k], table.forward[k], table.lengths[k])
        put_rate(gusts, k, rate, now, later)
    if wind.vortices.size > 0:
        rate = vortex_rate_of(speed, high - low) if high > low else 0.0
        put_rate(gusts, count, rate, now, later)
    for i in range(wind.rest.shape[0]):
        along = wind.rest[i, 0] * ax + wind.rest[i, 1] * ay + wind.rest[i, 2] * az
        across = wind.rest[i, 0] * bx + wind.rest[i, 1] * by + wind.rest[i, 2] * bz
        for k in range(count):
            table = wind.ripples
            strength = strength_of(table.roots[k], wind.strengths[1], speed, table.norm[0])
            place = place_of(table.forward[k], table.sideways[k], along, across, table.lengths[k])
            put_wave(gusts, k, i, strength, place)
        if wind.vortices.size > 0:
            strength = place = 0.0
            if speed > 0 and high > low:
                strength = vortex_strength_of(wind.strengths[2], speed, across, low, high)
                place = vortex_place_of(along, gusts.rates[0, count], speed)
            put_wave(gusts, count, i, strength, place)


@kernel
def put_rate(gusts: Any, k: Any, rate: Any, now: Any, later: Any) -> None:
    """The rate of wave k, and the turns with which its phase continues."""
    turns = gusts.turns[0, k] + now * gusts.rates[0, k] - later * rate
    gusts.turns[0, k] = turns - np.floor(turns)
    gusts.rates[0, k] = rate


@kernel
def put_wave(gusts: Any, k: Any, i: Any, strength: Any, place: Any) -> None:
    """The parts of wave k at particle i."""
    F = gusts.sines.dtype.type
    gusts.sines[0, k, i] = F(strength * kernels.sine_of_turns(0.25 - place))
    gusts.cosines[0, k, i] = F(strength * kernels.sine_of_turns(-place))
