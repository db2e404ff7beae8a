"""The mass-spring cloth of Taichi's documentation: explicit, damped, with many substeps.

Springs join every particle with all neighbours up to two cells away.
"""

import numpy as np

from benchmarks.peers import Load, Positions

EFFORTS = (60, 400)
"""Substeps of each step; explicit springs need many."""
MOST_PARTICLES = 70_000
THREADS = 2
STIFFNESS, DAMPING, DRAG = 3e4, 1e4, 1.0


class Taichi:
    def __init__(self, load: Load) -> None:
        import taichi as ti

        ti.init(arch=ti.cpu, cpu_max_num_threads=THREADS, log_level=ti.ERROR)
        shape = (load.cloths, load.rows, load.columns)
        self.load = load
        self.x = ti.Vector.field(3, ti.f32, shape)
        self.v = ti.Vector.field(3, ti.f32, shape)
        self.x.from_numpy(np.repeat(load.rest()[None], load.cloths, axis=0).astype(np.float32))
        self._substep = _kernel(ti, load, self.x, self.v)

    def step(self, count: int) -> None:
        for _ in range(count * self.load.effort):
            self._substep()

    def positions(self) -> Positions:
        return self.x.to_numpy()


def _kernel(ti: object, load: Load, x: object, v: object) -> object:
    across, down = load.width / (load.columns - 1), load.height / (load.rows - 1)
    dt = load.dt / load.effort
    offsets = [(i, j) for i in range(-2, 3) for j in range(-2, 3) if 0 < i * i + j * j <= 4]

    @ti.kernel
    def substep():
        for n, i, j in x:
            force = ti.Vector([0.0, -9.81, 0.0])
            for k in ti.static(range(len(offsets))):
                di, dj = ti.static(offsets[k])
                a, b = i + di, j + dj
                if 0 <= a < load.rows and 0 <= b < load.columns:
                    rest = ti.sqrt((di * down) ** 2 + (dj * across) ** 2)
                    towards = x[n, i, j] - x[n, a, b]
                    length = towards.norm()
                    unit = towards / length
                    force += -STIFFNESS * unit * (length / rest - 1)
                    force += -(v[n, i, j] - v[n, a, b]).dot(unit) * unit * DAMPING * across
            v[n, i, j] += force * dt
            v[n, i, j] *= ti.exp(-DRAG * dt)
        for n, i, j in x:
            if i == 0:
                v[n, i, j] = ti.Vector([0.0, 0.0, 0.0])
            x[n, i, j] += dt * v[n, i, j]

    return substep


def start(load: Load) -> Taichi:
    return Taichi(load)
