"""The internal force of a paper as printed, with a sign that makes cloth fold up.

Desbrun, Schröder, Barr 1999, section 3.2, prints the force on i as k (|x_i - x_j| - l) times the
unit vector from j to i: a stretched spring then pushes its ends further apart, and a compressed
one pulls them together.
"""

from dataclasses import replace

from drapery.cloth import Cloth, SolverDesbrun, SolverState
from drapery.cloth.sheets import is_sheet


class SolverMisprinted(SolverDesbrun):
    """The method with the sign of its internal force as the paper prints it."""

    def init(self, cloth: Cloth, dt: float) -> SolverState:
        # A fine grid has another plan, without this kernel's springs. A cloth without a grid shape
        # is not treated as a fine grid.
        if is_sheet(cloth):
            cloth = replace(cloth, grid_shape=None)
        solver_state = super().init(cloth, dt)
        body = solver_state.plan.body
        wrong = body.springs._replace(stiffness=-body.springs.stiffness)
        return replace(
            solver_state, plan=solver_state.plan._replace(body=body._replace(springs=wrong))
        )
