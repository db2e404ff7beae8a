"""The paper's spring force as printed folds a banner up; with the right sign it hangs straight.

Desbrun, Schröder, Barr 1999, section 3.2, prints the force on i as k (|x_i - x_j| - l) times the
unit vector from j to i: a stretched spring then pushes its ends further apart, and a compressed
one pulls them together.
"""

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from drapery.cloth import Cloth, Gravity, Solver, SolverDesbrun, SolverState, State, Wind
from drapery.cloth.sheets import is_sheet
from drapery.render import Scene, View, frame_points
from drapery.scenes.banners import flag_cloth
from drapery.scenes.catalogue import Clip
from drapery.scenes.moving import motion
from drapery.scenes.parameters import (
    SceneParameters,
    grid_parameter,
    seed_parameter,
    wind_parameter,
)
from drapery.scenes.picture_grid import PictureGrid, panel_size
from drapery.scenes.wires import DAYLIGHT, PAPER, paper, wired
from drapery.style import FLAG_SIZE

SIDE_ON = View(azimuth=30, elevation=6, fov=26)
RIGHT, WRONG = paper((222, 234, 220)), paper((246, 222, 216))


class SolverMisprinted(SolverDesbrun):
    """The method with the sign of its internal force as the paper prints it."""

    def init(self, cloth: Cloth, dt: float) -> SolverState:
        # A fine grid has another plan, without this kernel's springs. A cloth without a grid shape
        # is not treated as a fine grid.
        if is_sheet(cloth):
            cloth = replace(cloth, grid_shape=None)
        solver_state = super().init(cloth, dt)
        body = solver_state.plan.body
        wrong = body.springs._replace(stiffness=-body.springs.stiffness)
        return replace(
            solver_state, plan=solver_state.plan._replace(body=body._replace(springs=wrong))
        )


@dataclass(frozen=True)
class FoldParameters(SceneParameters):
    """What can be set of the scene `fold`."""

    grid: tuple[int, int] = grid_parameter((5, 9), "Particles across and down the flag")
    wind: float = wind_parameter(3.0)
    seed: int = seed_parameter()


def play(parameters: FoldParameters, clip: Clip) -> Iterator[PictureGrid]:
    """The printed sign on the left."""
    size, cloth = panel_size(clip.size, 2), flag_cloth(parameters.grid)
    high, wide = FLAG_SIZE[1], 0.75 * FLAG_SIZE[0]
    room = np.array([[x, y, z] for x in (-wide, wide) for y in (0.1, -high) for z in (-0.2, 0.5)])
    camera = frame_points(SIDE_ON, room, size[0] / size[1], margin=0.06)
    variants = ((SolverMisprinted(), WRONG), (SolverDesbrun(), RIGHT))
    motions = [flag_states(parameters, cloth, solver, clip) for solver, _ in variants]
    for states in zip(*motions, strict=True):
        pictures = tuple(
            Scene(
                wired(cloth, state.positions[0], camera, size[1], material),
                camera,
                size,
                DAYLIGHT,
                PAPER,
                samples=4,
            )
            for state, (_, material) in zip(states, variants, strict=True)
        )
        yield PictureGrid(pictures, ("as printed", "right sign"))


def flag_states(
    parameters: FoldParameters, cloth: Cloth, solver: Solver, clip: Clip
) -> Iterator[State]:
    """A flag from rest in a light wind."""
    velocity = (0.35 * parameters.wind, 0.0, 0.94 * parameters.wind)
    forces = (Gravity(), Wind(velocity, seed=parameters.seed))
    return motion(cloth, clip, solver=solver, forces=forces, step=1 / 60)
