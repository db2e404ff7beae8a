"""The paper's spring force as printed folds a banner up; with the right sign it hangs straight."""

from collections.abc import Iterator
from dataclasses import dataclass

from drapery.cloth import Cloth, Gravity, Solver, SolverDesbrun, State, Wind
from drapery.render import View
from drapery.scenes.backdrop import framing
from drapery.scenes.banners import FLAG_STEP, flag_cloth
from drapery.scenes.catalogue import Clip
from drapery.scenes.misprint import SolverMisprinted
from drapery.scenes.moving import motion
from drapery.scenes.parameters import (
    SceneParameters,
    grid_parameter,
    seed_parameter,
    wind_parameter,
)
from drapery.scenes.picture_grid import PictureGrid, panel_size
from drapery.scenes.wires import on_paper, paper, wired
from drapery.style import FLAG_SIZE

SIDE_ON = View(azimuth=30, elevation=6, fov=26)
WIDE, HIGH = 0.75 * FLAG_SIZE[0], FLAG_SIZE[1]
FRAMED = [(x, y, z) for x in (-WIDE, WIDE) for y in (0.1, -HIGH) for z in (-0.2, 0.5)]
"""The flag, folded or in the wind [m]."""
VARIANTS = (
    (SolverMisprinted(), paper((246, 222, 216))),
    (SolverDesbrun(), paper((222, 234, 220))),
)
"""The solver and the colour of each picture."""


@dataclass(frozen=True)
class FoldParameters(SceneParameters):
    """What can be set of the scene `fold`."""

    grid: tuple[int, int] = grid_parameter((5, 9), "Particles across and down the flag")
    wind: float = wind_parameter(3.0)
    seed: int = seed_parameter()


def play(parameters: FoldParameters, clip: Clip) -> Iterator[PictureGrid]:
    """The printed sign on the left."""
    size, cloth = panel_size(clip.size, 2), flag_cloth(parameters.grid)
    backdrop = on_paper(framing(SIDE_ON, FRAMED, size, margin=0.06))
    motions = [flag_states(parameters, cloth, solver, clip) for solver, _ in VARIANTS]
    for states in zip(*motions, strict=True):
        pictures = tuple(
            backdrop.scene(wired(cloth, state.positions[0], backdrop, material))
            for state, (_, material) in zip(states, VARIANTS, strict=True)
        )
        yield PictureGrid(pictures, ("as printed", "right sign"))


def flag_states(
    parameters: FoldParameters, cloth: Cloth, solver: Solver, clip: Clip
) -> Iterator[State]:
    """A flag from rest in a light wind."""
    velocity = (0.35 * parameters.wind, 0.0, 0.94 * parameters.wind)
    forces = (Gravity(), Wind(velocity, seed=parameters.seed))
    return motion(cloth, clip, solver=solver, forces=forces, step=FLAG_STEP)
