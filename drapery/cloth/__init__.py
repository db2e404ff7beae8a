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

from drapery.lazy import import_lazily

if TYPE_CHECKING:
    from drapery.cloth.bending import Bending as Bending
    from drapery.cloth.builders import grid as grid, max_stretch as max_stretch, strip as strip
    from drapery.cloth.cloth import (
        FLEXION as FLEXION,
        SHEAR as SHEAR,
        STRUCTURAL as STRUCTURAL,
        Cloth as Cloth,
    )
    from drapery.cloth.colliders import (
        Box as Box,
        Capsule as Capsule,
        Collider as Collider,
        Plane as Plane,
        Pose as Pose,
        Shape as Shape,
        SignedDistance as SignedDistance,
        Sphere as Sphere,
        TriangleMesh as TriangleMesh,
        Voxels as Voxels,
        at_rest as at_rest,
        check_collider as check_collider,
        height_collider as height_collider,
        load_mesh as load_mesh,
        mesh_collider as mesh_collider,
        rotation_about as rotation_about,
        straight as straight,
        swinging as swinging,
    )
    from drapery.cloth.collisions import Collisions as Collisions
    from drapery.cloth.evaluated import accelerations as accelerations
    from drapery.cloth.fabric import FABRICS as FABRICS, Fabric as Fabric
    from drapery.cloth.forces import (
        Drag as Drag,
        Force as Force,
        ForceField as ForceField,
        Gravity as Gravity,
    )
    from drapery.cloth.meshes import (
        disc as disc,
        from_mesh as from_mesh,
        from_triangles as from_triangles,
    )
    from drapery.cloth.pins import (
        PinPath as PinPath,
        Pins as Pins,
        PosePath as PosePath,
        carried as carried,
    )
    from drapery.cloth.sewing import Seam as Seam, sew as sew
    from drapery.cloth.solvers.base import Solver as Solver
    from drapery.cloth.solvers.desbrun import SolverDesbrun as SolverDesbrun
    from drapery.cloth.solvers.driver import SolverState as SolverState
    from drapery.cloth.solvers.implicit import SolverImplicit as SolverImplicit
    from drapery.cloth.solvers.pbd import SolverPBD as SolverPBD
    from drapery.cloth.solvers.provot import SolverProvot as SolverProvot
    from drapery.cloth.solvers.registry import SOLVERS as SOLVERS, solver as solver
    from drapery.cloth.solvers.verlet import SolverVerlet as SolverVerlet
    from drapery.cloth.solvers.xpbd import SolverXPBD as SolverXPBD
    from drapery.cloth.state import (
        State as State,
        WorstStrain as WorstStrain,
        rest_state as rest_state,
    )
    from drapery.cloth.stepping import MovingCloth as MovingCloth, simulate as simulate
    from drapery.cloth.wind import Wind as Wind
    from drapery.cloth.world import Detail as Detail, World as World, WorldView as WorldView
else:
    import_lazily(__name__)
