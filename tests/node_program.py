"""JavaScript that node runs."""

import shutil
import subprocess
from pathlib import Path

NODE = shutil.which("node")


def run_node(*words: str | Path, stdin: str = "") -> str:
    """What node prints; AssertionError with all its output if it fails."""
    command = [str(NODE), *map(str, words)]
    done = subprocess.run(
        command,
        input=stdin,
        cwd=Path(__file__).parent / "js",
        capture_output=True,
        text=True,
        timeout=120,
    )
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout
