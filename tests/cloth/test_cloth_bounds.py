"""No kernel of the cloth reads or writes outside of its arrays."""

import os
import subprocess
import sys
from pathlib import Path
from typing import get_args

import pytest

from drapery.settings import SolverName

HERE = Path(__file__).parents[1]
CHECKED = {"NUMBA_BOUNDSCHECK": "1", "NUMBA_OPT": "1", "DRAPERY_AOT": "0"}


@pytest.mark.parametrize("name", get_args(SolverName))
def test_no_index_lies_outside_of_an_array(name: str, untraced_processes: None) -> None:
    """Every layout, kind of contact and some numbers of substeps. What solvers share is compiled
    for the first of them alone."""
    run = subprocess.run(
        [sys.executable, "-W", "ignore", HERE / "bounds_sweep.py", name],
        env=os.environ | CHECKED,
        capture_output=True,
        text=True,
    )
    assert run.returncode == 0, run.stdout + run.stderr
