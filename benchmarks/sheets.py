"""What the layout for fine grids is worth: `python -m benchmarks.sheets`.

Each grid is stepped alone, on one thread, in gusts of wind: laid out as a plane of lanes (see
`drapery.cloth.sheets`) and on the general path, where one cloth fills one lane of a register.
Prints steps of 1/60 s a second, the best of five stretches of time taken by turns, and the ratio.
"""

import argparse
from time import perf_counter
from typing import Any
from unittest.mock import patch

from benchmarks.quick import add_quick
from drapery.cloth import Cloth, Gravity, SolverXPBD, Wind, grid, rest_state, solver
from drapery.cloth.solvers import xpbd
from drapery.cloth.solvers.xpbd import enough_substeps

GRIDS = (16, 31), (21, 41), (41, 81)
FORCES = (Gravity(), Wind((1.0, 0.0, 5.0)))
DT = 1 / 60
ROUNDS = 5


class Path:
    """One solver on one grid."""

    def __init__(self, name: str, cloth: Cloth, sheet: bool) -> None:
        self.solver: Any = solver(name, threads=1)
        if name == "xpbd":
            self.solver = SolverXPBD(threads=1, substeps=enough_substeps(cloth))
        self.cloth, self.best = cloth, 0.0
        xpbd._remembered.cache_clear()  # it would give the other path's plan
        with patch(f"drapery.cloth.solvers.{name}.is_sheet", lambda cloth: sheet):
            self.solver_state = self.solver.init(cloth, DT)
        self.state = rest_state(cloth)
        self.run(60)

    def run(self, steps: int) -> float:
        """The time for this number of steps [s]."""
        begin = perf_counter()
        self.state, self.solver_state = self.solver.step(
            self.cloth, self.state, self.solver_state, FORCES, DT, steps=steps
        )
        return perf_counter() - begin

    def time(self, seconds: float) -> None:
        """Step for about this time [s]; updates the best rate [steps/s]."""
        steps = max(1, int(30 * seconds / self.run(30)))
        self.best = max(self.best, steps / self.run(steps))


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--seconds", type=float, default=0.5, help="of each stretch")
    add_quick(parser)
    given = parser.parse_args()
    seconds, rounds, grids = given.seconds, ROUNDS, GRIDS
    if given.quick:
        seconds, rounds, grids = 0.01, 1, GRIDS[:1]
    print("| solver | grid | general path [steps/s] | plane of lanes [steps/s] | ratio |")
    print("|---|---|---|---|---|")
    for name in ("desbrun", "xpbd", "verlet", "provot"):
        for shape in grids:
            cloth = grid(*shape, 0.8333, 1.6667)
            paths = [Path(name, cloth, sheet) for sheet in (False, True)]
            for _ in range(rounds):
                for path in paths:
                    path.time(seconds)
            general, plane = (path.best for path in paths)
            size = f"{shape[0]} x {shape[1]}"
            print(f"| `{name}` | {size} | {general:.0f} | {plane:.0f} | {plane / general:.1f} |")


if __name__ == "__main__":
    main()
