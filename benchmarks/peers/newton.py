"""NVIDIA Newton's XPBD on the processor (package `newton`)."""

import numpy as np

from benchmarks.peers import Load, Positions

EFFORTS = (8, 16, 32)
"""Substeps; its iterations do not help springs, see `_stiffness`."""
MOST_PARTICLES = 45_000
THREADS = 1


def _stiffness(load: Load) -> float:
    """The stiffest springs that stay stable [N/m].

    Newton adds the corrections of all springs at a particle and does not average them. With eight
    springs, their compliance must therefore exceed the masses' part: 1 / (k dt²) >= 8 * 2 / m.
    """
    return load.mass / (16 * (load.dt / load.effort) ** 2)


class Newton:
    def __init__(self, load: Load) -> None:
        import warp

        warp.config.quiet = True  # must be set before newton initialises warp
        import newton

        builder = newton.ModelBuilder(up_axis=newton.Axis.Y)
        for number in range(load.cloths):
            builder.add_cloth_grid(
                pos=warp.vec3(2.0 * number, 0.0, 0.0),
                rot=warp.quat_identity(),
                vel=warp.vec3(0.0, 0.0, 0.0),
                dim_x=load.columns - 1,
                dim_y=load.rows - 1,
                cell_x=load.width / (load.columns - 1),
                cell_y=load.height / (load.rows - 1),
                mass=load.mass,
                fix_top=True,
                tri_ke=0.0,
                tri_ka=0.0,
                tri_kd=0.0,
                edge_ke=0.0,
                edge_kd=0.0,
                add_springs=True,
                spring_ke=_stiffness(load),
                spring_kd=0.0,
                # Less than half a cell; otherwise the particles collide with each other at rest.
                particle_radius=1e-3,
            )
        self.load = load
        self.model = builder.finalize(device="cpu")
        self.solver = newton.solvers.SolverXPBD(self.model, iterations=1)
        self.states = self.model.state(), self.model.state()

    def step(self, count: int) -> None:
        near, far = self.states
        for _ in range(count * self.load.effort):
            near.clear_forces()
            self.solver.step(near, far, None, None, self.load.dt / self.load.effort)
            near, far = far, near
        self.states = near, far

    def positions(self) -> Positions:
        flat = self.states[0].particle_q.numpy()
        grid = flat.reshape(self.load.cloths, self.load.rows, self.load.columns, 3)
        return np.asarray(grid[:, ::-1])


def start(load: Load) -> Newton:
    return Newton(load)
