"""The solver's kernel that numba chooses for a played cloth, by the type of its plan."""

from typing import Any

from numba.extending import overload

from drapery.cloth.live import BY_LANES, PLAYERS


def step_plan(plan: Any, batch: Any, substeps: Any) -> None:
    """One time step of the solver that the plan belongs to."""


@overload(step_plan)
def _step_plan(plan: Any, batch: Any, substeps: Any) -> Any:
    advance = PLAYERS[plan.instance_class]

    def implementation(plan: Any, batch: Any, substeps: Any) -> None:
        advance(0, batch.cloths, plan, batch, 1, substeps)

    def of_lanes(plan: Any, batch: Any, substeps: Any) -> None:
        advance(0, batch.width, plan, batch, 1, substeps)

    return of_lanes if plan.instance_class in BY_LANES else implementation
