"""Modules of this package in other processes of the same Python."""

import sys

_RUN = """\
import runpy, sys
sys.path[:] = {path!r}
runpy.run_module({name!r}, run_name="__main__", alter_sys=True)"""


def module_command(name: str, *words: str) -> list[str]:
    """The command that runs a module in another process, which imports what this one imports.

    `python -m` would search the working directory first: in a checkout it finds other sources than
    those that are installed, and anywhere a folder `drapery` of the user.
    """
    return [sys.executable, "-P", "-c", _RUN.format(path=sys.path, name=name), *words]
