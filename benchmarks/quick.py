"""`--quick`, which every benchmark takes: the least of each of its parts, in seconds.

Its figures mean nothing; it shows that the benchmark still runs. `python -m benchmarks.all` runs
them all.
"""

import sys
from argparse import ArgumentParser
from importlib.util import find_spec


def add_quick(parser: ArgumentParser) -> None:
    """The option, which is `quick` of what the parser returns."""
    parser.add_argument("--quick", action="store_true", help="the least that runs all of it")


def is_installed(module: str) -> bool:
    """Whether a module of another package is there; if not, a line says what is left out."""
    found = find_spec(module) is not None
    if not found:
        print(f'{module} is not installed (`pip install ".[bench]"`): left out')
    return found


def needs(found: object, what: str) -> None:
    """End with a line, and without a fault, where this machine does not have what is measured."""
    if not found:
        print(f"{what} is not here: nothing is measured")
        sys.exit(0)
