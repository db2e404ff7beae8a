"""The method of many tutorials: plain Python loops over particles and springs.

Verlet integration, then passes over all edges; a pass moves each free end by half of the error.
"""

from math import sqrt

import numpy as np

from benchmarks.peers import Load, Positions

EFFORTS = (6,)
MOST_PARTICLES = 4_000
THREADS = 1


class Tutorial:
    def __init__(self, load: Load) -> None:
        self.load = load
        self.now = [
            [list(map(float, p)) for p in load.rest().reshape(-1, 3)] for _ in range(load.cloths)
        ]
        self.before = [[list(p) for p in cloth] for cloth in self.now]
        self.edges = _edges(load)

    def step(self, count: int) -> None:
        for _ in range(count):
            for now, before in zip(self.now, self.before, strict=True):
                self._fall(now, before)
                for _ in range(self.load.effort):
                    self._relax(now)

    def positions(self) -> Positions:
        return np.array(self.now).reshape(self.load.cloths, self.load.rows, self.load.columns, 3)

    def _fall(self, now: list[list[float]], before: list[list[float]]) -> None:
        drop = -9.81 * self.load.dt**2
        for i in range(self.load.columns, len(now)):
            x, y, z = now[i]
            bx, by, bz = before[i]
            before[i] = [x, y, z]
            now[i] = [2 * x - bx, 2 * y - by + drop, 2 * z - bz]

    def _relax(self, now: list[list[float]]) -> None:
        pinned = self.load.columns
        for i, j, rest in self.edges:
            a, b = now[i], now[j]
            d = [b[0] - a[0], b[1] - a[1], b[2] - a[2]]
            length = sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2])
            share = 0.5 * (length - rest) / length
            for axis in range(3):
                if i >= pinned:
                    a[axis] += share * d[axis]
                if j >= pinned:
                    b[axis] -= share * d[axis]


def _edges(load: Load) -> list[tuple[int, int, float]]:
    across, down = load.width / (load.columns - 1), load.height / (load.rows - 1)
    edges = []
    for row in range(load.rows):
        for column in range(load.columns):
            i = row * load.columns + column
            if column + 1 < load.columns:
                edges.append((i, i + 1, across))
            if row + 1 < load.rows:
                edges.append((i, i + load.columns, down))
    return edges


def start(load: Load) -> Tutorial:
    return Tutorial(load)
