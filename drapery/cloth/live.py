"""Cloth that a page plays without Python: the loop over time steps as a kernel.

`play` is compiled to WebAssembly by `drapery.web.wasm`, from this source and the source of the
solvers. On a processor it gives the bits of `MovingCloth.advance`, as long as nothing is pulled:
the loop calls the solvers' own kernels. Everything that a host may change between two calls is in
arrays, so that it only writes numbers.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from drapery.cloth.contact.lanes_contact import contact_work
from drapery.cloth.forces import Drag, Force, Gravity, lower_forces
from drapery.cloth.live_pull import pull
from drapery.cloth.live_wind import LiveWind, make_live_wind
from drapery.cloth.pins import PinPath
from drapery.cloth.ripples import PADDING
from drapery.cloth.solvers import desbrun, xpbd
from drapery.cloth.solvers.driver import Batch, batch_of, with_addresses
from drapery.cloth.stepping import MovingCloth
from drapery.cloth.wind import Wind
from drapery.errors import OptionError
from drapery.jit import entry_point, kernel, numba_name
from drapery.mesh import Array

__all__ = ["LiveCall", "LiveControls", "LiveMotion", "live_call", "play"]

PLAYERS = {
    desbrun.DesbrunPlan: desbrun._advance,
    desbrun.DesbrunSheetPlan: desbrun._advance_sheet,
    xpbd.XPBDPlan: xpbd._advance,
    xpbd.XPBDSheetPlan: xpbd._advance_sheet,
}
"""The plans that can be played, and the kernels that step them."""
BY_LANES = desbrun.DesbrunPlan, xpbd.XPBDPlan
"""Plans of cloths that are stepped side by side in lanes."""
step_plan = numba_name("drapery.cloth.live_choices", "step_plan")


@dataclass(frozen=True, eq=False)
class LiveMotion:
    """How the body that holds a played cloth moves, and repeats its motion.

    pins: the path of the pins; None for pins that do not move. first, period: steps before the
    motion repeats, and steps after which it does; pins and boxes follow it.
    airflow: added to the free wind, of a body that moves through the air [m/s].
    carried: part of the wind's velocity that pulls the cloth along as an acceleration [1/s].
    """

    pins: PinPath | None = None
    first: int = 0
    period: int = 1
    airflow: tuple[float, float, float] = (0.0, 0.0, 0.0)
    carried: float = 0.0


STILL = LiveMotion()
"""A body that does not move."""


class LiveControls(NamedTuple):
    """What moves with a played cloth, and what its host writes.

    clock: [2]: steps since the start, and steps to make in a call of `play`.
    cycle: [2]: steps before the motion of pins and boxes repeats, and steps after which it does.
    row: of the present step in tables of that motion, [1].
    dt: one step [s], [1].
    grab: [2]: the particle that the host wants to pull, or -1; the one that is pulled, or -1.
    target: where it is pulled to [m], [3]. offsets: of all particles from it [m], [N, 3].
    around: the particles that are pulled, 1 or 0, [N].
    rest: all particles at rest [m], [N, 3]. pins: the pinned ones, [P].
    push: accelerations by the pull [m/s²], [3N, L].
    positions, velocities: of the first cloth [m], [m/s], [N, 3]: what the host reads.
    """

    clock: NDArray[np.int64]
    cycle: NDArray[np.int64]
    row: NDArray[np.int64]
    dt: Array
    grab: NDArray[np.int64]
    target: Array
    offsets: Array
    around: NDArray[np.int64]
    rest: Array
    pins: NDArray[np.int64]
    push: Array
    positions: Array
    velocities: Array


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
    motion: LiveMotion = STILL,
) -> LiveCall:
    """One cloth at the start of its motion, ready to be played.

    forces: gravity, drag and one wind, whose period is ignored. free: this wind before it is
    multiplied by lee, the factors of a wind at the cloth, and before `motion` changes it. lanes:
    that the arrays have room for; by default a register of this processor. motion: of the body
    that holds the cloth. The host calls `aim` before the first step.
    Raises OptionError for solvers, contacts and forces that cannot be played.
    """
    state, solver_state = moving.state, moving.solver_state
    plan = solver_state.of(state.positions.dtype)
    if type(plan) not in PLAYERS:
        name = type(moving.solver).__name__
        raise OptionError(f"solver {name} cannot be played without Python; use xpbd or desbrun")
    if moving.resolve is not None:
        raise OptionError("contact with shapes other than boxes cannot be played without Python")
    winds = [force for force in forces if isinstance(force, Wind)]
    if len(winds) != 1 or not all(isinstance(force, Gravity | Drag | Wind) for force in forces):
        raise OptionError("only gravity, drag and one wind can be played without Python")
    wind = replace(winds[0], period=None)
    others = [force for force in forces if not isinstance(force, Wind)]
    loads = lower_forces([*others, wind], moving.cloth, 1)
    steps = motion.first + motion.period
    given = moving.cloth, state, solver_state, loads, steps, motion.pins, 1, moving.boxes
    made = with_addresses(batch_of(*given), solver_state)
    blown = make_live_wind(moving.cloth, free, lee, motion.airflow, loads.gravity, motion.carried)
    batch = _narrowed(made, lanes or made.x.shape[1], blown)
    return LiveCall(_controls(moving, batch, motion), blown, plan, batch, solver_state.substeps)


def _narrowed(batch: Batch, lanes: int, wind: LiveWind) -> Batch:
    """The batch with other lanes, with room for all waves, and for the contact of one cloth."""

    def cut(values: Array) -> Array:
        return np.ascontiguousarray(values[..., :lanes])

    waves = len(wind.ripple_tables.turns) + len(wind.vortex_turns)
    shape = 1, waves, len(wind.rest) + PADDING
    gusts = batch.gusts._replace(
        phases=cut(batch.gusts.phases),
        origins=cut(batch.gusts.origins),
        rates=np.zeros((1, waves)),
        turns=np.concatenate([wind.ripple_tables.turns, wind.vortex_turns])[None],
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
        work=_zeros(contact_work(batch.contact, len(batch.x) // 3, batch.itself)),
        strains=cut(batch.strains),
    )


def _zeros(scratch: Any) -> Any:
    """Zeros like the arrays of a named tuple, so that the same cloth has the same bytes."""
    parts = (_zeros(p) if isinstance(p, tuple) else np.zeros_like(p) for p in scratch)
    return type(scratch)(*parts)


def _controls(moving: MovingCloth, batch: Batch, motion: LiveMotion) -> LiveControls:
    cloth, positions = moving.cloth, np.array(moving.state.positions[0], order="C")
    count = len(positions)
    return LiveControls(
        clock=np.zeros(2, np.int64),
        cycle=np.array([motion.first, motion.period]),
        row=np.zeros(1, np.int64),
        dt=np.array([moving.dt]),
        grab=np.array([-1, -1]),
        target=np.zeros(3),
        offsets=np.zeros((count, 3)),
        around=np.zeros(count, np.int64),
        rest=np.array(cloth.rest_positions, float),
        pins=np.flatnonzero(cloth.inv_mass == 0),
        push=np.zeros_like(batch.x),
        positions=positions,
        velocities=np.zeros_like(positions),
    )


@entry_point
def play(live: Any, plan: Any, batch: Any, substeps: Any) -> Any:
    """Make live.clock[1] time steps of one cloth; returns 1 if it has blown up, otherwise 0."""
    for _ in range(live.clock[1]):
        rows = pull(live, batch)
        row = live.row[0]
        # Boxes that do not move have only one pose.
        begin = min(row, batch.poses.shape[0] - 1)
        # The time as a call of the solver for all steps since the start would have it.
        batch.numbers[2] = live.clock[0] * substeps * batch.numbers[0]
        here = Batch(
            batch.x,
            batch.v,
            batch.new_x,
            batch.new_v,
            batch.gusts,
            batch.numbers,
            batch.targets[row * substeps : (row + 1) * substeps],
            live.push[:rows],
            batch.width,
            batch.residuals,
            batch.contact,
            batch.itself,
            batch.poses[begin : begin + 2],
            batch.resolve,
            batch.work,
            batch.often,
            batch.cloths,
            batch.limit,
            batch.squares,
            batch.strains,
            batch.limit_strain,
            batch.blow,
            batch.add_winds,
            batch.meet_lanes,
        )
        step_plan(plan, here, substeps)
        for row in range(batch.x.shape[0]):
            for lane in range(batch.x.shape[1]):
                batch.x[row, lane] = batch.new_x[row, lane]
                batch.v[row, lane] = batch.new_v[row, lane]
        live.clock[0] += 1
        live.row[0] += 1
        if live.row[0] == live.cycle[0] + live.cycle[1]:
            live.row[0] = live.cycle[0]
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
