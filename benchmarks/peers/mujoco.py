"""MuJoCo's flex cloth (package `mujoco`): a grid whose edges are equality constraints."""

import numpy as np

from benchmarks.peers import Load, Positions

EFFORTS = (1, 4)
MOST_PARTICLES = 2_000
THREADS = 1


def _model(load: Load) -> str:
    spacing = f"{load.width / (load.columns - 1)} {load.height / (load.rows - 1)} 1"
    mass = load.mass * load.columns * load.rows
    flexes = "".join(
        f"""<flexcomp name="cloth{n}" type="grid" dim="2" count="{load.columns} {load.rows} 1"
        spacing="{spacing}" mass="{mass}" pos="{2 * n} 0 0" radius="0.001">
        <edge equality="true"/><contact contype="0" conaffinity="0"/>
        <pin gridrange="0 {load.rows - 1} {load.columns - 1} {load.rows - 1}"/></flexcomp>"""
        for n in range(load.cloths)
    )
    return f"""<mujoco><option gravity="0 -9.81 0" timestep="{load.dt / load.effort}"
        solver="CG" tolerance="1e-6"/><size memory="1G"/>
        <worldbody>{flexes}</worldbody></mujoco>"""


class Mujoco:
    def __init__(self, load: Load) -> None:
        import mujoco

        self.load = load
        self.mujoco = mujoco
        self.model = mujoco.MjModel.from_xml_string(_model(load))
        self.data = mujoco.MjData(self.model)
        mujoco.mj_forward(self.model, self.data)

    def step(self, count: int) -> None:
        for _ in range(count * self.load.effort):
            self.mujoco.mj_step(self.model, self.data)

    def positions(self) -> Positions:
        flat = self.data.flexvert_xpos.reshape(
            self.load.cloths, self.load.columns, self.load.rows, 3
        )
        return np.asarray(flat.transpose(0, 2, 1, 3)[:, ::-1])


def start(load: Load) -> Mujoco:
    return Mujoco(load)
