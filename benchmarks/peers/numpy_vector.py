"""The same Verlet cloth with whole-array numpy; edges of one of four groups share no particle."""

import numpy as np

from benchmarks.peers import Load, Positions

EFFORTS = (6, 20)
MOST_PARTICLES = 300_000
THREADS = 1


class Vectorised:
    def __init__(self, load: Load) -> None:
        self.load = load
        self.now = np.repeat(load.rest()[None], load.cloths, axis=0)
        self.before = self.now.copy()
        self.free = np.ones((1, load.rows, load.columns, 1))
        self.free[:, 0] = 0

    def step(self, count: int) -> None:
        drop = np.array([0.0, -9.81, 0.0]) * self.load.dt**2
        for _ in range(count):
            fallen = self.now + self.free * (self.now - self.before + drop)
            self.before, self.now = self.now, fallen
            for _ in range(self.load.effort):
                self._relax()

    def positions(self) -> Positions:
        return self.now

    def _relax(self) -> None:
        across = self.load.width / (self.load.columns - 1)
        down = self.load.height / (self.load.rows - 1)
        for axis, rest in ((1, down), (2, across)):
            for first in (0, 1):
                self._edges(axis, first, rest)

    def _edges(self, axis: int, first: int, rest: float) -> None:
        count = (self.now.shape[axis] - first) // 2
        near = [slice(None)] * 4
        far = list(near)
        near[axis] = slice(first, first + 2 * count, 2)
        far[axis] = slice(first + 1, first + 2 * count, 2)
        a, b = self.now[tuple(near)], self.now[tuple(far)]
        width = [slice(None), *near[1:3], slice(None)]
        near_free = np.broadcast_to(self.free, (1, *self.now.shape[1:3], 1))[tuple(width)]
        d = b - a
        length = np.linalg.norm(d, axis=-1, keepdims=True)
        move = 0.5 * (length - rest) / length * d
        a += near_free * move
        far_free = np.broadcast_to(self.free, (1, *self.now.shape[1:3], 1))
        b -= far_free[(slice(None), *far[1:3], slice(None))] * move


def start(load: Load) -> Vectorised:
    return Vectorised(load)
