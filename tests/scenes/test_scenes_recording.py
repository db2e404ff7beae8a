"""Schedules and the one recorder of cloth."""

import math

import numpy as np
import pytest

from drapery.cloth import Gravity, MovingCloth, SolverXPBD, State, grid, simulate
from drapery.stage.recording import Drape, Meeting, Schedule, record

STEP = 1 / 60


def drape(push: float = 0.0) -> Drape:
    cloth = grid(4, 5, 0.8, 1.0, pins="top")
    solver, forces = SolverXPBD(), (Gravity((push, -9.81, 0.0)),)
    return Drape(lambda dt: MovingCloth.begin(cloth, solver, dt), lambda period: forces)


@pytest.mark.parametrize("time", [0.0, 0.2, 2.05, 3.0, 8.3, 16.1])
@pytest.mark.parametrize("tolerance", [0.0, 1e-9])
def test_a_still_is_exactly_at_its_time(time: float, tolerance: float) -> None:
    at = Schedule.still(time, STEP, tolerance)
    assert at.times == (time,)
    assert at.moments == ((1,) if time else (0,))
    assert math.isclose(at.dt * at.every * at.moments[0], time)
    assert at.dt <= STEP * (1 + 1e-9)


def test_a_tolerance_saves_the_step_that_rounding_adds() -> None:
    assert Schedule.still(8.3, STEP).every == 499
    assert Schedule.still(8.3, STEP, 1e-9).every == 498


def test_a_loop_is_recorded_when_the_cloth_has_settled() -> None:
    at = Schedule.loop(40, 20.0, STEP)
    assert at.period == 2.0
    assert at.times == pytest.approx([8 + frame / 20 for frame in range(40)])
    assert [*at.moments] == [*range(160 - at.fade, 200)]
    assert at.dt * at.every == pytest.approx(1 / 20)


def test_moments_are_those_of_the_solver_in_any_order() -> None:
    hung = drape()
    begun = hung.begin(STEP)
    states = simulate(begun.cloth, begun.solver, hung.forces(None), STEP)
    expected = [next(states).positions[0] for _ in range(7)]
    (found,) = record([hung], Schedule.at([0.1, 0.0, 0.05, 0.1], STEP))
    assert np.array_equal(found, [expected[number] for number in (6, 0, 3, 6)])


def test_cloths_that_do_not_meet_move_as_each_alone() -> None:
    at = Schedule.at([0.1, 0.2], STEP)
    both = record([drape(), drape(2.0)], at)
    for found, push in zip(both, (0.0, 2.0), strict=True):
        assert np.array_equal(found, record([drape(push)], at)[0])


def test_cloths_that_meet_are_resolved_after_each_step() -> None:
    seen: list[tuple[float, float]] = []

    def resolve(before: list[State], after: list[State]) -> list[State]:
        seen.append((before[0].time, after[0].time))
        return before[:1] + after[1:]

    at = Schedule(STEP, 3, (2,), (0.1,))
    meeting = Meeting([1, 2], resolve)  # type: ignore[arg-type]
    alone, held, free = record([drape(), drape(), drape()], at, meeting)
    assert len(seen) == 6
    assert np.array_equal(held[0], drape().begin(STEP).state.positions[0])
    assert np.array_equal(free, alone)


def test_each_moment_is_told_and_may_end_the_work() -> None:
    seen: list[tuple[int, int]] = []

    def told(number: int, last: int) -> None:
        seen.append((number, last))

    record([drape(), drape()], Schedule.at([0.1], STEP), on_moment=told)
    assert seen == [(number, 6) for number in range(7)]

    def stop(number: int, last: int) -> None:
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        record([drape()], Schedule.at([0.1], STEP), on_moment=stop)


def test_nothing_is_recorded_of_a_subject_without_cloth() -> None:
    assert record([], Schedule.still(3.0, STEP)) == []
