"""No kernel of the cloth reads or writes outside of its arrays."""

import os
import subprocess
import sys
from pathlib import Path
from typing import get_args

import pytest

from drapery.settings import SolverName

HERE = Path(__file__).parents[1]


@pytest.mark.parametrize("name", get_args(SolverName))
def test_no_index_lies_outside_of_an_array(name: str, untraced_processes: None) -> None:
    """Every layout and kind of contact, with one substep and with two, where kernels are Python."""
    run = subprocess.run(
        [sys.executable, "-W", "ignore", HERE / "bounds_sweep.py", name],
        env=os.environ | {"NUMBA_DISABLE_JIT": "1"},
        capture_output=True,
        text=True,
    )
    assert run.returncode == 0, run.stdout + run.stderr
