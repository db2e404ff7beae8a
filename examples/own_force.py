"""A force of your own beside a wind, and what both do to each particle of a cloth."""

from itertools import islice

import numpy as np

from drapery.cloth import Gravity, Wind, accelerations, grid, simulate


class Whirl:
    def acceleration(self, cloth, state):  # [m/s²], [B, N, 3]
        x, z = state.positions[..., 0], state.positions[..., 2]
        return 2.0 * np.stack((-z, np.zeros_like(x), x), axis=-1)


cloth, forces = grid(9, 17, 0.8, 1.6), (Gravity(), Wind((0.0, 0.0, 4.0)), Whirl())
last = next(islice(simulate(cloth, forces=forces, every=60), 1, None))
np.savez("forces.npz", positions=last.positions, accelerations=accelerations(forces, cloth, last))
