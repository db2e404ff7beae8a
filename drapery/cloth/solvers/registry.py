"""Solvers by name. Each is imported only when it is asked for."""

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
"""Names, which are those of the modules, and their classes; the default first."""


def solver(name: str, **options: Any) -> Solver:
    """A solver with some of its options. Raises OptionError for a name or an option that is not."""
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
