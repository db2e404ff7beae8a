"""The stretch of a sheet over time by two solvers, as a table that any program plots."""

from itertools import islice

import numpy as np

from drapery.cloth import Gravity, SolverVerlet, SolverXPBD, Wind, grid, max_stretch, simulate

sheet, forces = grid(9, 17, width=0.8, height=1.6), (Gravity(), Wind((0.0, 0.0, 4.0)))
columns = []
for solver in (SolverXPBD(), SolverVerlet()):
    states = list(islice(simulate(sheet, solver, forces, every=6), 40))
    columns.append([float(max_stretch(state.positions, sheet)) for state in states])
table = np.column_stack([[state.time for state in states], *columns])
np.savetxt(
    "stretch.csv", table, fmt="%.4f", delimiter=",", header="seconds,XPBD,Verlet", comments=""
)
