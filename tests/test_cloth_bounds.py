"""No kernel of the cloth reads or writes outside of its arrays."""

import os
import subprocess
import sys
from pathlib import Path

HERE = Path(__file__).parent
CHECKED = {"NUMBA_BOUNDSCHECK": "1", "NUMBA_OPT": "0", "DRAPERY_AOT": "0"}


def test_no_index_lies_outside_of_an_array(untraced_processes: None) -> None:
    """Every solver, layout, kind of contact and some numbers of substeps."""
    run = subprocess.run(
        [sys.executable, "-W", "ignore", HERE / "bounds_sweep.py"],
        env=os.environ | CHECKED,
        capture_output=True,
        text=True,
    )
    assert run.returncode == 0, run.stdout + run.stderr
