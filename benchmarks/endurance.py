"""A million steps of every solver in random gusts: `python -m benchmarks.cloth --endurance`."""

from collections.abc import Iterator
from dataclasses import dataclass
from time import perf_counter

import numpy as np
from rich.progress import Progress

from drapery.cloth import Gravity, State, Wind, grid, max_stretch, rest_state
from drapery.cloth.solvers.registry import SOLVERS, solver

STEPS_A_CALL = 2000
CLOTHS = 8
"""As many cloths as a register holds in double precision; each has different gusts."""


@dataclass(frozen=True)
class Endured:
    """steps: the number until the end, or until a state is not finite. fastest: the speed [m/s]."""

    solver: str
    steps: int
    finite: bool
    max_stretch: float
    fastest: float
    seconds: float


def endure(name: str, steps: int, progress: Progress) -> Endured:
    """Simulate small banners in strong gusts, with a new wind seed every `STEPS_A_CALL` steps."""
    cloth, method = grid(5, 9, 0.8333, 1.6667), solver(name, threads=1)
    solver_state, state = method.init(cloth, 1 / 60), rest_state(cloth, CLOTHS, np.float32)
    places = np.arange(CLOTHS)[:, None] * np.array([7.3, 0.0, 3.1])
    bar, start = progress.add_task(name, total=steps), perf_counter()
    stretch = fastest = 0.0
    for done, wind in _gusts(steps, places):
        state, solver_state = method.step(
            cloth,
            state,
            solver_state,
            (Gravity(), wind),
            1 / 60,
            steps=min(STEPS_A_CALL, steps - done),
        )
        finite = _finite(state)
        progress.update(bar, completed=min(done + STEPS_A_CALL, steps))
        stretch = max(stretch, max_stretch(state.positions, cloth))
        fastest = max(fastest, float(np.abs(state.velocities).max()))
        if not finite:
            return Endured(
                name, done + STEPS_A_CALL, False, stretch, fastest, perf_counter() - start
            )
    return Endured(name, steps, True, stretch, fastest, perf_counter() - start)


def _gusts(steps: int, places: np.ndarray) -> Iterator[tuple[int, Wind]]:
    random = np.random.default_rng(0)
    for done in range(0, steps, STEPS_A_CALL):
        velocity = random.normal(scale=(4.0, 1.5, 4.0))
        seed = int(random.integers(1 << 31))
        yield done, Wind(tuple(velocity), gusts=0.8, gust_size=1.0, seed=seed, origins=places)


def _finite(state: State) -> bool:
    return bool(np.isfinite(state.positions).all() and np.isfinite(state.velocities).all())


def endure_all(steps: int) -> list[Endured]:
    """Test every solver, one after another; shows progress."""
    with Progress() as progress:
        return [endure(name, steps, progress) for name in SOLVERS]


def show(found: Endured) -> str:
    end = "all finite" if found.finite else "NOT FINITE"
    return (
        f"{found.solver:9} {found.steps:9,} steps of {CLOTHS} cloths: {end}, stretched at most "
        f"{100 * found.max_stretch:.1f} %, {found.fastest:.1f} m/s, {found.seconds:.0f} s"
    )
