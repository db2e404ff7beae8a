"""The positions of four sheets at four places of a gusty wind, as arrays in one file."""

from itertools import islice

import numpy as np

from drapery.cloth import Gravity, Wind, grid, simulate

sheet = grid(9, 17, width=0.8, height=1.6, pins=[0, 8])
places = np.array([[3.0, 0.0, 0.0]]) * np.arange(4)[:, None]  # [m]
forces = Gravity(), Wind((0, 0, 4), gusts=0.8, origins=places)
states = list(islice(simulate(sheet, forces=forces, count=4, every=6), 20))
times, positions = [s.time for s in states], np.stack([s.positions for s in states])
np.savez("positions.npz", times=times, positions=positions, triangles=sheet.triangles)
