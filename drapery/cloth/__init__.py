"""The simulation core: cloths, forces, solvers and colliders. It does not depend on Minecraft.

```python
from itertools import islice

from drapery.cloth import Gravity, SolverXPBD, Wind, grid, simulate

cloth = grid(11, 21, width=1.25, height=2.5)
forces = [Gravity(), Wind((0.0, 0.0, 4.0))]
for state in islice(simulate(cloth, SolverXPBD(), forces), 180):
    print(state.time, state.positions.shape)
```

Units are SI; y is up. Arrays have the vector as their last axis: a `State` of B cloths of N
particles has positions [B, N, 3]. The same input gives the same bits, for any number of threads.
Names are imported when they are first used, so importing the package is cheap.
"""

from typing import TYPE_CHECKING

from drapery.lazy import lazy_names

if TYPE_CHECKING:
    from drapery.cloth.bending import Bending
    from drapery.cloth.builders import grid, max_stretch, strip
    from drapery.cloth.cloth import FLEXION, SHEAR, STRUCTURAL, Cloth
    from drapery.cloth.colliders import (
        Box,
        Capsule,
        Collider,
        Plane,
        Pose,
        Shape,
        SignedDistance,
        Sphere,
        TriangleMesh,
        Voxels,
        check_collider,
        height_collider,
        load_mesh,
        mesh_collider,
        rotation_about,
        still,
        straight,
        swinging,
    )
    from drapery.cloth.collisions import Collisions
    from drapery.cloth.fabric import FABRICS, Fabric
    from drapery.cloth.forces import Drag, Force, ForceField, Gravity
    from drapery.cloth.meshes import disc, from_mesh, from_triangles
    from drapery.cloth.pins import PinPath, Pins, PosePath, carried
    from drapery.cloth.sewing import Seam, sew
    from drapery.cloth.solvers.base import Solver
    from drapery.cloth.solvers.desbrun import SolverDesbrun
    from drapery.cloth.solvers.driver import SolverState
    from drapery.cloth.solvers.implicit import SolverImplicit
    from drapery.cloth.solvers.pbd import SolverPBD
    from drapery.cloth.solvers.provot import SolverProvot
    from drapery.cloth.solvers.registry import SOLVERS, solver
    from drapery.cloth.solvers.verlet import SolverVerlet
    from drapery.cloth.solvers.xpbd import SolverXPBD
    from drapery.cloth.state import State, rest_state
    from drapery.cloth.stepping import MovingCloth, simulate
    from drapery.cloth.wind import Wind
    from drapery.cloth.world import Detail, World, WorldView

__all__ = [
    "FABRICS",
    "FLEXION",
    "SHEAR",
    "SOLVERS",
    "STRUCTURAL",
    "Bending",
    "Box",
    "Capsule",
    "Cloth",
    "Collider",
    "Collisions",
    "Detail",
    "Drag",
    "Fabric",
    "Force",
    "ForceField",
    "Gravity",
    "MovingCloth",
    "PinPath",
    "Pins",
    "Plane",
    "Pose",
    "PosePath",
    "Seam",
    "Shape",
    "SignedDistance",
    "Solver",
    "SolverDesbrun",
    "SolverImplicit",
    "SolverPBD",
    "SolverProvot",
    "SolverState",
    "SolverVerlet",
    "SolverXPBD",
    "Sphere",
    "State",
    "TriangleMesh",
    "Voxels",
    "Wind",
    "World",
    "WorldView",
    "carried",
    "check_collider",
    "disc",
    "from_mesh",
    "from_triangles",
    "grid",
    "height_collider",
    "load_mesh",
    "max_stretch",
    "mesh_collider",
    "rest_state",
    "rotation_about",
    "sew",
    "simulate",
    "solver",
    "still",
    "straight",
    "strip",
    "swinging",
]

__getattr__, __dir__ = lazy_names(
    __name__,
    {
        "cloth.bending": ("Bending",),
        "cloth.builders": ("grid", "max_stretch", "strip"),
        "cloth.cloth": ("Cloth", "FLEXION", "SHEAR", "STRUCTURAL"),
        "cloth.colliders": (
            "Box",
            "Capsule",
            "Collider",
            "Plane",
            "Pose",
            "Shape",
            "SignedDistance",
            "Sphere",
            "TriangleMesh",
            "Voxels",
            "check_collider",
            "height_collider",
            "load_mesh",
            "mesh_collider",
            "rotation_about",
            "still",
            "straight",
            "swinging",
        ),
        "cloth.collisions": ("Collisions",),
        "cloth.fabric": ("FABRICS", "Fabric"),
        "cloth.forces": ("Drag", "Force", "ForceField", "Gravity"),
        "cloth.meshes": ("disc", "from_mesh", "from_triangles"),
        "cloth.pins": ("PinPath", "Pins", "PosePath", "carried"),
        "cloth.sewing": ("Seam", "sew"),
        "cloth.solvers.base": ("Solver",),
        "cloth.solvers.desbrun": ("SolverDesbrun",),
        "cloth.solvers.driver": ("SolverState",),
        "cloth.solvers.implicit": ("SolverImplicit",),
        "cloth.solvers.pbd": ("SolverPBD",),
        "cloth.solvers.provot": ("SolverProvot",),
        "cloth.solvers.registry": ("SOLVERS", "solver"),
        "cloth.solvers.verlet": ("SolverVerlet",),
        "cloth.solvers.xpbd": ("SolverXPBD",),
        "cloth.state": ("State", "rest_state"),
        "cloth.stepping": ("MovingCloth", "simulate"),
        "cloth.wind": ("Wind",),
        "cloth.world": ("Detail", "World", "WorldView"),
    },
)
