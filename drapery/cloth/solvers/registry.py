"""Solvers by name. A solver's module is imported when it is first used."""

from dataclasses import fields
from importlib import import_module
from typing import Any

from drapery.cloth.solvers.base import Solver
from drapery.errors import OptionError

SOLVERS = {
    "desbrun": "SolverDesbrun",
    "xpbd": "SolverXPBD",
    "pbd": "SolverPBD",
    "verlet": "SolverVerlet",
    "provot": "SolverProvot",
    "implicit": "SolverImplicit",
}
"""Names of solvers (also of their modules) and their classes."""
DEFAULT_SOLVER = "xpbd"
"""The solver of whoever names none: it holds fine cloth and keeps its motion."""


def solver(name: str = DEFAULT_SOLVER, **options: Any) -> Solver:
    """A solver by its name: `solver("pbd", passes=8)`.

    `simulate`, `MovingCloth.begin`, `World` and `Settings` have the same default.

    name: one of SOLVERS.
    options: fields of its class by name.

    Raises OptionError for an unknown name or option.
    """
    if name not in SOLVERS:
        raise OptionError(f"solver {name!r} is not known; use one of: {', '.join(SOLVERS)}")
    method = getattr(import_module(f"drapery.cloth.solvers.{name}"), SOLVERS[name])
    known = [field.name for field in fields(method)]
    for option in options:
        if option not in known:
            raise OptionError(
                f"solver {name} has no option {option!r}; use one of: {', '.join(known)}"
            )
    made: Solver = method(**options)
    return made
