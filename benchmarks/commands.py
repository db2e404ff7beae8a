"""What a user waits for: `python -m benchmarks.commands [--against PYTHON] [--runs 5]`.

Whole commands are timed, with the start of Python: one picture, and 80 frames of 512 x 512 as a
GIF. With `--against`, the same commands of another environment's interpreter run in turn with
these, so both meet the same load of the machine. The ratio is that of the least times. `--jit`
leaves out the kernels that were compiled ahead of time, see `drapery.jit.library`. On two busy
cores the first picture after an installation took 0.8 s of the processor with them and 36 s
without.

Later pictures take 0.41 s of the processor (`--processor`, Python 3.13), on a slow machine 0.50 s.
There the imports of NumPy take 0.13, of typer 0.08, of Drapery's 190 modules 0.13 and of Pillow
0.03, the kernels 0.05, the cloth's plan 0.04 and the PNG file 0.02. They took 0.80 s while typer
read all options with pydantic (0.12), all forms of banners and NumPy's masked arrays were imported
(0.05), and Python looked for garbage before it ended (0.1).
"""

import argparse
import os
import subprocess
import sys
import tempfile
import time
from collections.abc import Sequence

from rich.console import Console
from rich.table import Table

from benchmarks.quick import add_quick

DESIGN = "white creeper:lime border:black"
COMMANDS = {
    "render": ("render", DESIGN, "-o", "banner.png"),
    "animate": ("animate", DESIGN, "-o", "banner.gif", "--seconds", "4", "--fps", "20"),
}

QUICK = {"render": (*COMMANDS["render"], "--size", "32x32")}


def seconds(python: str, command: Sequence[str], processor: bool) -> float:
    """How long a command takes with an interpreter [s], by the wall clock or of the processor."""
    with tempfile.TemporaryDirectory() as folder:
        begin, used = time.perf_counter(), processor_time()
        subprocess.run(
            [python, "-m", "drapery", *command], cwd=folder, check=True, capture_output=True
        )
        return processor_time() - used if processor else time.perf_counter() - begin


def processor_time() -> float:
    """What all processes that have ended took of the processor [s]."""
    times = os.times()
    return times.children_user + times.children_system


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--against", metavar="PYTHON", help="another interpreter, timed in turn")
    parser.add_argument("--runs", type=int, default=5)
    parser.add_argument("--processor", action="store_true", help="its time, not the wall clock's")
    parser.add_argument("--jit", action="store_true", help="no kernels compiled ahead of time")
    add_quick(parser)
    given = parser.parse_args()
    if given.jit:
        os.environ["DRAPERY_AOT"] = "0"
    pythons = [sys.executable, *([given.against] if given.against else [])]
    table = Table("command", *("this" if p == sys.executable else p for p in pythons), "ratio")
    for name, command in (QUICK if given.quick else COMMANDS).items():
        times: dict[str, list[float]] = {python: [] for python in pythons}
        for run in range(2 if given.quick else given.runs + 1):
            for python in pythons:
                taken = seconds(python, command, given.processor)
                if run:  # the first run compiles
                    times[python].append(taken)
        least = [min(times[python]) for python in pythons]
        table.add_row(name, *(f"{t:.2f} s" for t in least), f"{least[0] / least[-1]:.2f}")
    Console().print(table)


if __name__ == "__main__":
    main()
