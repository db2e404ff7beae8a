"""A picture with settings of a solver, a wind, a fabric and a force that no name stands for."""

from drapery import Banner, draw
from drapery.cloth import Drag, Fabric, SolverXPBD, Wind

draw(
    Banner.parse("green gradient:lime creeper:white"),
    solver=SolverXPBD(substeps=8),
    wind=Wind((3.0, 0.0, 5.0), gusts=0.8, seed=3),
    fabric=Fabric(density=0.15, flexion=0.05),
    forces=[Drag(0.3)],
).save("own_physics.png")
