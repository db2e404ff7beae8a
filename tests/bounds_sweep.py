"""All solvers on all layouts of lanes against all kinds of contact, for a few steps each.

Each case that reads or writes outside of an array is printed. `test_cloth_bounds.py` runs this with
kernels as Python: `NUMBA_DISABLE_JIT=1 python tests/bounds_sweep.py`, see `interpreted.py`.
`.ci/versions` runs it with compiled kernels that check every index, those of registers too:
`NUMBA_BOUNDSCHECK=1 NUMBA_OPT=1 DRAPERY_AOT=0 python tests/bounds_sweep.py`. Types of arguments are
the same in all cases of a solver and layout, so each kernel is compiled once.
"""

import os
import sys
from collections.abc import Iterator
from itertools import product
from typing import Any, get_args

import numpy as np

if os.environ.get("NUMBA_DISABLE_JIT"):
    import interpreted  # noqa: F401 - before kernels are declared

from drapery.cloth import (
    Box,
    Capsule,
    Cloth,
    Collider,
    Collisions,
    Fabric,
    Gravity,
    MovingCloth,
    Plane,
    Pose,
    Sphere,
    State,
    Voxels,
    Wind,
    disc,
    from_triangles,
    grid,
    rest_state,
)
from drapery.cloth.colliders import mesh_collider, straight
from drapery.cloth.contact import lanes_contact
from drapery.cloth.simd import BYTES, load, store
from drapery.cloth.solvers.registry import solver
from drapery.jit import entry_point
from drapery.mesh import Array
from drapery.settings import SolverName

if os.environ.get("NUMBA_DISABLE_JIT"):  # all rounds use the same indices
    lanes_contact.LOOSE_ROUNDS = lanes_contact.STRAIN_ROUNDS = 2
BEHIND = np.array([0.0, -0.5, 0.02])
"""A place so near to the cloth that the wind presses the cloth on it in the first step [m]."""
THICK = 0.02
FABRIC = Fabric(0.3, bending=1e-3, damping=0.05)
TETRAHEDRON = np.array([[0.0, 0.3, 0.0], [0.3, -0.2, 0.0], [-0.3, -0.2, 0.0], [0.0, 0.0, -0.3]])
FACES = np.array([[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]])
CELLS = np.array([[-1, -3, 0], [0, -3, 0]], np.int32)
BESIDE = Pose(np.array([0.0, 0.0, 0.02]))
"""Where a block is that has a face in the plane of its origin."""
STEPS = {1: 2, 2: 1}
"""How many steps are made, by the number of substeps: each case goes from one to the next once."""
OF_OTHER_PINS = "grid without pins", "plane of lanes on two pins", "loose plane of lanes"
"""Layouts that differ from others by their pins."""
OF_POINTS = "sphere", "capsule", "voxels", "mesh", "itself and a sphere"
"""Contact whose kernels see one point after another, and no pin: not with these layouts."""
OWN_LOOPS = "desbrun", "xpbd"
"""Solvers whose loop has another form with one substep."""
PLANES = "desbrun", "provot", "verlet", "xpbd"
"""Solvers with planes of lanes."""


def near(x: float = 0.0, z: float = 0.0) -> Array:
    """A place some way from BEHIND [m]."""
    return BEHIND + np.array([x, 0.0, z])


def layouts(name: str) -> dict[str, tuple[Cloth, int]]:
    """Cloths, and how many of each, one for each layout that a solver has kernels for."""
    found = {
        "small grid": (square(4, 5), 1),
        "crowd": (square(3, 2), 17),
        "mesh": (upright_disc(), 1),
        "grid without pins": (square(4, 5, "none"), 1),
    }
    if name in PLANES:
        found["plane of lanes"] = square(18, 3), 2
        found["plane of lanes on two pins"] = square(17, 3, "corners"), 1
    if name in PLANES and name != "xpbd":
        found["loose plane of lanes"] = square(16, 3, "none"), 1
    return found


def square(columns: int, rows: int, pins: Any = "top") -> Cloth:
    """A grid of 1 m that resists bending."""
    return grid(columns, rows, 1.0, 1.0, pins=pins, fabric=FABRIC)


def upright_disc() -> Cloth:
    """A round cloth that faces +z, held at one point of its rim."""
    flat = disc(1, 0.5)
    upright = flat.rest_positions[:, [0, 2, 1]] - (0.0, 0.5, 0.0)
    held = (int(upright[:, 1].argmax()),)
    return from_triangles(upright, flat.triangles, pins=held, fabric=FABRIC)


def contacts() -> dict[str, Collisions | None]:
    """Each shape alone, and boxes with the cloth itself."""
    box = Box(near(z=0.1), np.array([0.5, 0.4, 0.2]))
    shapes: dict[str, Any] = {
        "box": Collider(box),
        "plane": Collider(Plane(BEHIND, np.array([0.0, 0.0, -1.0]))),
        "moving box": Collider(box, straight((0.0, 0.0, -3.0))),
        "sphere": Collider(Sphere(near(z=0.2), 0.2)),
        "capsule": Collider(Capsule(near(x=-0.3), near(x=0.3), 0.1)),
        "voxels": Collider(Voxels(CELLS, 0.2), lambda time: BESIDE),
        "mesh": Collider(mesh_collider(TETRAHEDRON + BEHIND, FACES)),
    }
    found: dict[str, Collisions | None] = {"nothing": None}
    found |= {name: Collisions([shape], THICK) for name, shape in shapes.items()}
    found["itself"] = Collisions((), THICK, apart=THICK)
    found["itself and a moving box"] = Collisions([shapes["moving box"]], THICK, apart=THICK)
    found["itself and a sphere"] = Collisions([shapes["sphere"]], THICK, apart=THICK)
    return found


def folded(cloth: Cloth, count: int) -> State:
    """Cloths at rest whose lower halves move towards their upper halves, so that they meet."""
    state = rest_state(cloth, count)
    velocities = np.zeros_like(state.positions)
    velocities[..., 1] = np.where(state.positions[..., 1] < -0.5, 12.0, 0.0)
    velocities[..., 2] = 4.0
    velocities[:, cloth.inv_mass == 0] = 0
    return State(state.positions, velocities, 0.0)


@entry_point
def first_of_register(x: Any, row: Any, lane: Any) -> None:
    """Set x[0, 0 : ...] to x[row, lane : ...]."""
    store(x, 0, 0, load(x, row, lane))


def unchecked() -> Iterator[str]:
    """Indices outside of an array of two registers in each row that no check finds."""
    x = np.zeros((3, 2 * BYTES // 4), np.float32)
    for row, lane in ((3, 0), (-1, 0), (0, -1), (2, BYTES // 4 + 1)):
        try:
            first_of_register(x, row, lane)
        except IndexError:
            continue
        yield f"a register at [{row}, {lane}] of {x.shape} is not checked"


def wrong_indices(*names: str) -> Iterator[str]:
    """The cases of some solvers in which a kernel used an index outside of an array."""
    wind = (0.0, 0.0, 20.0)
    met = contacts()
    for name in names:
        numbers = STEPS if name in OWN_LOOPS else [2]
        for (layout, (cloth, count)), substeps in product(layouts(name).items(), numbers):
            options: dict[str, Any] = {"threads": 1, "substeps": substeps}
            if name == "desbrun" and layout.startswith("loose"):
                options["angular"] = "none"
            for contact, collisions in met.items():
                if layout in OF_OTHER_PINS and contact in OF_POINTS:
                    continue
                # The wind is blown before anything is met, and its noise takes long in Python.
                forces = Gravity(), Wind(wind, gusts=0.0 if collisions else 0.5)
                try:
                    moving = MovingCloth.begin(
                        cloth,
                        solver(name, **options),
                        start=folded(cloth, count),
                        collisions=collisions,
                    )
                    moving.advance(forces, steps=STEPS[substeps])
                except IndexError as fault:
                    yield f"{name}, {layout}, {contact}, substeps={substeps}: {fault}"


if __name__ == "__main__":
    found = [*unchecked(), *wrong_indices(*(sys.argv[1:] or get_args(SolverName)))]
    print(*found, sep="\n")
    sys.exit(bool(found))
