"""How the motion of cloth is recorded for pictures: at which moments, and where it is at each."""

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import islice
from typing import Any

import numpy as np

from drapery.cloth import Force, MovingCloth, PinPath, State
from drapery.cloth.strain import warn_of_strain
from drapery.mesh import Array

SETTLING = 8.0
"""The cloth of a loop moves at least this long before it is recorded [s]."""
FADE = 1.5
"""The end of a loop fades so long into the motion that leads to its start [s]."""


@dataclass(frozen=True)
class Schedule:
    """The moments of a motion from rest that pictures show.

    dt: the time step [s].
    every: time steps from one moment to the next.
    moments: the numbers of those that are recorded; 0 is the start.
    times: when the pictures are [s], one a picture.
    fps: [frames/s] of a loop, after which the wind repeats; None for other pictures.
    fade: number of moments that are recorded before a loop, whose end fades into them.
    """

    dt: float
    every: int
    moments: Sequence[int]
    times: tuple[float, ...]
    fps: float | None = None
    fade: int = 0

    @property
    def period(self) -> float | None:
        """How long a loop is [s]; None for other pictures."""
        return None if self.fps is None else len(self.times) / self.fps

    @staticmethod
    def still(time: float, step: float, tolerance: float = 0.0) -> "Schedule":
        """One picture, exactly at a time.

        time: when the picture is [s].
        step: the longest time step [s].
        tolerance: the share of a step by which steps may be longer, so that no step is added where
            a time differs from whole steps only by rounding.
        """
        steps = math.ceil(time / step - tolerance)
        dt = time / steps if steps else step
        return Schedule(dt, max(steps, 1), (min(steps, 1),), (time,))

    @staticmethod
    def loop(count: int, fps: float, step: float, tolerance: float = 0.0) -> "Schedule":
        """The pictures of a loop, when the cloth has settled.

        The first is a whole number of periods after the start, so the wind is as it was there.

        count: number of pictures.
        fps: [frames/s].
        step: the longest time step [s].
        tolerance: see `still`.
        """
        period = count / fps
        steps = math.ceil(1 / (fps * step) - tolerance)
        fade = min(count, math.ceil(FADE * fps))
        first = math.ceil(SETTLING / period) * count
        times = tuple((first + frame) / fps for frame in range(count))
        moments = range(first - fade, first + count)
        return Schedule(1 / (fps * steps), steps, moments, times, fps, fade)

    @staticmethod
    def at(times: Sequence[float], step: float, every: int = 1) -> "Schedule":
        """Pictures at some times of one motion, its cloth at the nearest moments.

        times: when the pictures are [s].
        step: the time step [s].
        every: time steps from one moment to the next, which one call of a kernel makes.
        """
        moments = tuple(round(time / (every * step)) for time in times)
        return Schedule(step, every, moments, tuple(times))


@dataclass(frozen=True, eq=False)
class Drape:
    """A cloth that is to be recorded, and what acts on it.

    begin: makes it before its first time step [s]; raises OptionError.
    forces: those of a wind that repeats after a period [s], or does not.
    pins: the path of its pins; None if they rest.
    """

    begin: Callable[[float], MovingCloth]
    forces: Callable[[float | None], tuple[Force, ...]]
    pins: PinPath | None = None


@dataclass(frozen=True, eq=False)
class Meeting:
    """Cloths that meet each other. numbers: which ones.

    resolve: their contact after each time step, from their states before and after it.
    """

    numbers: Sequence[int]
    resolve: Callable[[Sequence[State], Sequence[State]], list[State]]


def record(
    drapes: Sequence[Drape],
    at: Schedule,
    meeting: Meeting | None = None,
    on_moment: Callable[[int, int], object] | None = None,
) -> list[Array]:
    """Where each cloth is at the moments of a schedule [m], each [F, N, 3].

    on_moment: called at each moment from the start on with its number and the number of the last
    one; it may raise to end the simulation.
    Raises OptionError.
    """
    if not drapes:
        return []
    wanted, places = frozenset(at.moments), {}
    motion = _motion(drapes, at, meeting)
    last = max(wanted)
    states: list[State] = []
    try:
        for number, states in enumerate(islice(motion, last + 1)):
            if on_moment is not None:
                on_moment(number, last)
            if number in wanted:
                places[number] = [state.positions[0] for state in states]
    finally:
        # The worst moment is known when the motion ends, also by an error.
        for state in states:
            warn_of_strain(state.worst)
    motions = zip(*(places[number] for number in at.moments), strict=True)
    found = [np.stack(motion) for motion in motions]
    return [close_loop(motion, at.fade) for motion in found] if at.fade else found


def _motion(
    drapes: Sequence[Drape], at: Schedule, meeting: Meeting | None
) -> Iterator[list[State]]:
    """The states of all cloths at each moment, those that meet each other step by step."""
    together = [] if meeting is None else [*meeting.numbers]
    alone = [number for number in range(len(drapes)) if number not in together]
    forces = [each.forces(at.period) for each in drapes]
    moving = [each.begin(at.dt) for each in drapes]

    def given(number: int, steps: int) -> tuple[Any, ...]:
        return forces[number], steps, drapes[number].pins

    while True:
        yield [each.state for each in moving]
        for number in alone:
            moving[number] = moving[number].unmet(*given(number, at.every))
        if meeting is None:
            continue
        for _ in range(at.every):
            before = [moving[number].state for number in together]
            moved = [moving[number].unmet(*given(number, 1)) for number in together]
            met = meeting.resolve(before, [each.state for each in moved])
            for number, each, state in zip(together, moved, met, strict=True):
                moving[number] = replace(each, state=state)


def close_loop(motion: Array, before: int) -> Array:
    """Make the last F moments of a recorded motion [before + F, ...] a seamless loop.

    The wind repeats, so the moments before the loop resemble those at its end, and they lead to its
    first one: the end of the loop fades into them.
    """
    looped = motion[before:].copy()
    share = np.arange(1, before + 1).reshape(-1, *[1] * (motion.ndim - 1)) / (before + 1)
    share = share * share * (3 - 2 * share)
    end = looped[len(looped) - before :]
    end += share * (motion[:before] - end)
    return looped
