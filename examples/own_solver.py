"""A solver from nothing, on a banner in the wind and on a mesh that falls on a sphere.

`python examples/own_solver.py [FOLDER]`
"""

import sys
from itertools import islice
from math import ceil
from pathlib import Path

import numpy as np

from drapery import Banner, draw
from drapery.cloth import (
    Cloth,
    Collider,
    Collisions,
    Fabric,
    Sphere,
    State,
    accelerations,
    disc,
    simulate,
)
from drapery.render import draw_models, make_mesh, make_model

STIFF = Fabric(density=0.3, stretch=60, shear=10, flexion=1)


class SolverEuler:
    """Symplectic Euler steps of damped springs, of first order."""

    damping = 1e-3  # of the springs [s]

    def init(self, cloth: Cloth, dt: float) -> int:
        ends = cloth.spring_pairs.T
        pulls = [np.bincount(end, cloth.spring_stiffness, len(cloth.inv_mass)) for end in ends]
        fastest = np.sqrt((2 * sum(pulls) * cloth.inv_mass).max())  # [1/s]
        return ceil(dt * fastest)

    def step(self, cloth, state, substeps, forces, dt, *, steps=1, pins=None):
        first, second = cloth.spring_pairs.T
        held, h = cloth.inv_mass == 0, dt / substeps
        for _ in range(steps):
            x, v = state.positions.copy(), state.velocities.copy()
            loads = accelerations(forces, cloth, state)
            for part in range(1, substeps + 1):
                along, speed = x[:, second] - x[:, first], v[:, second] - v[:, first]
                length = np.sqrt((along**2).sum(-1, keepdims=True))
                along /= length
                slack = length - cloth.spring_length[:, None]
                slack += self.damping * (along * speed).sum(-1, keepdims=True)
                pull = cloth.spring_stiffness[:, None] * slack * along
                force = np.zeros_like(x)
                np.add.at(force, (slice(None), first), pull)
                np.add.at(force, (slice(None), second), -pull)
                v += h * (force * cloth.inv_mass[:, None] + loads)
                x += h * v
                if pins is not None:
                    x[:, held] = pins(state.time + part * h)
            state = State(x, v, state.time + dt)
        return state, substeps


def main(folder: Path) -> None:
    banner = Banner.parse("white creeper:lime border:black")
    options = {"grid": (9, 17), "time": 1.0, "size": (160, 200), "view": "hero"}
    draw(banner, solver=SolverEuler(), fabric=STIFF, **options).save(folder / "own_banner.png")
    ball = Collisions([Collider(Sphere(np.array([0, -0.35, 0]), 0.3), friction=0.5)])
    cover = disc(8, 0.5, fabric=STIFF)
    lying = next(islice(simulate(cover, SolverEuler(), collisions=ball, every=30), 1, None))
    model = make_model(make_mesh(lying.positions[0], cover.triangles), colour="#b02e26")
    draw_models([model], view="hero", size=(160, 200)).save(folder / "own_mesh.png")


if __name__ == "__main__":
    main(Path(sys.argv[1] if len(sys.argv) > 1 else "."))
