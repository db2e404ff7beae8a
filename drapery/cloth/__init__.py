"""The simulation core. Knows nothing of Minecraft, textures or pixels."""

from drapery.cloth.builders import grid, max_stretch
from drapery.cloth.cloth import FLEXION, SHEAR, STRUCTURAL, Cloth
from drapery.cloth.forces import Drag, Force, Gravity
from drapery.cloth.pins import PinPath
from drapery.cloth.solvers.base import Solver
from drapery.cloth.solvers.desbrun import SolverDesbrun
from drapery.cloth.solvers.xpbd import SolverXPBD
from drapery.cloth.state import State, rest_state
from drapery.cloth.stepping import simulate
from drapery.cloth.wind import Wind

__all__ = [
    "FLEXION",
    "SHEAR",
    "STRUCTURAL",
    "Cloth",
    "Drag",
    "Force",
    "Gravity",
    "PinPath",
    "Solver",
    "SolverDesbrun",
    "SolverXPBD",
    "State",
    "Wind",
    "grid",
    "max_stretch",
    "rest_state",
    "simulate",
]
