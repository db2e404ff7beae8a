"""The PositionBasedDynamics library (package `pyPBD`): XPBD distance constraints."""

import numpy as np

from benchmarks.peers import Load, Positions

EFFORTS = (1, 10)
"""Substeps of one iteration."""
MOST_PARTICLES = 70_000
THREADS = 2


class PBD:
    def __init__(self, load: Load) -> None:
        import pypbd

        self.load = load
        self.simulation = pypbd.Simulation.getCurrent()
        self.simulation.initDefault()
        self.model = self.simulation.getModel()
        for number in range(load.cloths):
            self._hang(pypbd, number)
        pypbd.TimeManager.getCurrent().setTimeStepSize(load.dt)
        stepper = self.simulation.getTimeStep()
        stepper.setValueUInt(pypbd.TimeStepController.NUM_SUB_STEPS, load.effort)
        stepper.setValueUInt(pypbd.TimeStepController.MAX_ITERATIONS, 1)
        self.stepper = stepper

    def _hang(self, pypbd: object, number: int) -> None:
        load = self.load
        mesh = self.model.addRegularTriangleModel(
            load.columns,
            load.rows,
            translation=[2.0 * number, -load.height, 0.0],
            scale=[load.width, load.height],
        )
        first = mesh.getIndexOffset()
        particles = self.model.getParticles()
        count = load.columns * load.rows
        for i in range(count):
            particles.setMass(first + i, 0.0 if i >= count - load.columns else load.mass)
        # Method 4 selects XPBD distance constraints; the next argument is their stiffness.
        self.model.addClothConstraints(mesh, 4, 1e8, 1e8, 1e8, 1e8, 0.3, 0.3, False, False)

    def step(self, count: int) -> None:
        for _ in range(count):
            self.stepper.step(self.model)

    def positions(self) -> Positions:
        particles = self.model.getParticles()
        flat = np.array(particles.getVertices())
        grid = flat.reshape(self.load.cloths, self.load.rows, self.load.columns, 3)
        return grid[:, ::-1]


def start(load: Load) -> PBD:
    return PBD(load)
