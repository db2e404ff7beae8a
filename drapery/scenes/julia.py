"""A curtain of 500 dots in the plane: a tutorial's Verlet cloth, step by step as published.

The cloth has 25 x 20 particles at distances of 0.2 m; its top row is pinned. Each step of 0.02 s
applies gravity and a sine wind, then makes six passes over the distances between neighbours, in
which each free end moves half of the correction. There is one step a frame, at 30 frames a second.
"""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from drapery.cloth import Gravity, SolverPBD, State, rest_state, simulate
from drapery.render import Frame
from drapery.scenes.catalogue import Clip
from drapery.scenes.curtain import SineWind, plane_curtain
from drapery.scenes.dot_plot import DotPlot
from drapery.scenes.parameters import SceneParameters, grid_parameter, parameter

CLIP = Clip(count=300, fps=30.0)
STEPS_PER_SECOND = 30
"""Steps per second of the film; the simulated time of a step is `dt`."""
X_RANGE, Y_RANGE = (0, 6), (-5, 6)
"""Of the plot [m]."""


@dataclass(frozen=True)
class JuliaParameters(SceneParameters):
    """What can be set of the scene `julia`."""

    grid: tuple[int, int] = grid_parameter((25, 20), "Particles across and down the curtain")
    spacing: float = parameter(0.2, "Distance of neighbouring particles", (0.01, 1), "m")
    dt: float = parameter(0.02, "Time step", (0.001, 0.1), "s")
    passes: int = parameter(6, "Passes over all distances in a step", (1, 64))
    gravity: float = parameter(9.8, "Acceleration downwards", (-100, 100), "m/s²")
    wind: float = parameter(2.0, "Amplitude of the wind's acceleration", (-100, 100), "m/s²")
    turn: float = parameter(0.05, "Phase of the wind's sine in a step", (-4, 4), "radians")


def play(parameters: JuliaParameters, clip: Clip) -> Iterator[Frame]:
    """The dots after each step, as a plot."""
    plot = DotPlot(clip.size, X_RANGE, Y_RANGE)
    wanted = [1 + round(k * STEPS_PER_SECOND / clip.fps) for k in range(clip.count)]
    states = enumerate(steps(parameters))
    number, state = next(states)
    for step in wanted:
        while number < step:
            number, state = next(states)
        yield plot.frame(state.positions[0])


def steps(parameters: JuliaParameters) -> Iterator[State]:
    """The start, then the state after each step."""
    p = parameters
    cloth = plane_curtain(p.grid, p.spacing)
    forces = (Gravity((0.0, -p.gravity, 0.0)), SineWind(p.wind, p.turn, p.dt))
    start = rest_state(cloth, dtype=np.float64)
    return simulate(cloth, SolverPBD.plain(p.passes), forces, p.dt, start=start)
