"""The simulation core. Knows nothing of Minecraft, textures or pixels."""

from drapery.cloth.builders import grid, max_stretch, strip
from drapery.cloth.cloth import FLEXION, SHEAR, STRUCTURAL, Cloth
from drapery.cloth.fabric import Fabric
from drapery.cloth.forces import Drag, Force, Gravity
from drapery.cloth.meshes import disc, from_mesh, from_triangles
from drapery.cloth.pins import PinPath, carried
from drapery.cloth.sewing import Seam, sew
from drapery.cloth.solvers.base import Solver
from drapery.cloth.solvers.desbrun import SolverDesbrun
from drapery.cloth.solvers.registry import SOLVERS, solver
from drapery.cloth.solvers.xpbd import SolverXPBD
from drapery.cloth.state import State, rest_state
from drapery.cloth.stepping import simulate
from drapery.cloth.wind import Wind
from drapery.cloth.world import Detail, World

__all__ = [
    "FLEXION",
    "SHEAR",
    "SOLVERS",
    "STRUCTURAL",
    "Cloth",
    "Detail",
    "Drag",
    "Fabric",
    "Force",
    "Gravity",
    "PinPath",
    "Seam",
    "Solver",
    "SolverDesbrun",
    "SolverXPBD",
    "State",
    "Wind",
    "World",
    "carried",
    "disc",
    "from_mesh",
    "from_triangles",
    "grid",
    "max_stretch",
    "rest_state",
    "sew",
    "simulate",
    "solver",
    "strip",
]
