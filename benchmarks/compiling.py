"""What the kernels of the first picture cost to compile: `python -m benchmarks.compiling`.

Each run is a process of its own with an empty cache; `numba` stands for the compiler as numba has
it, without `drapery.jit.compiling`. The ratio is that of the processor's times; the pictures must
be the same. Alone on a machine (x86-64, Python 3.13, numba 0.68.1) numba took 93.6 s for 348
compilations of 289 functions, and 38.0 s were left for 291 of 288: a ratio of 0.41.
`--checkout FOLDER` compares with the sources of another checkout instead, such as the last
release, in turns; the least time of each counts. Other work on the machine, also on the other half
of a core, makes each time longer by up to a sixth.
"""

import argparse
import json
import os
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import NamedTuple

from benchmarks.quick import add_quick

PLAIN = """
import sys
from types import ModuleType
sys.modules["drapery.jit.compiling"] = ModuleType("drapery.jit.compiling")
"""
RUN = """
import hashlib, json, resource, sys, time
start = time.process_time()
from numba.core import event
class Counted(event.Listener):
    seen = []
    def on_start(self, event):
        self.seen.append(event.data["dispatcher"].py_func)
    def on_end(self, event):
        pass
event.register("numba:compile", Counted())
if sys.argv[1] == "face":
    from drapery import Banner, draw_face
    pixels = draw_face(Banner.parse("red")).pixels
else:
    from drapery import Banner, draw
    pixels = draw(Banner.parse("white creeper:lime border:black"), view="hero").pixels
seconds = time.process_time() - start
memory = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
counts = len(Counted.seen), len(set(Counted.seen))
print(json.dumps([seconds, memory, *counts, hashlib.sha256(pixels.tobytes()).hexdigest()]))
"""


ROOT = str(Path(__file__).parents[1])
TURNS = 3


class Cost(NamedTuple):
    """Seconds of the processor, the most memory [MB], how many compilations of how many functions,
    and a hash of the first picture."""

    seconds: float
    memory: float
    compilations: int
    functions: int
    pixels: str


def run(before: str, what: str, checkout: str = ROOT) -> Cost:
    """What the first picture costs in a process of its own, by the sources of a checkout."""
    with tempfile.TemporaryDirectory() as cache:
        made = subprocess.run(
            [sys.executable, "-c", before + RUN, what],
            cwd=checkout,  # the first place in which `python -c` looks for modules
            env=os.environ | {"NUMBA_CACHE_DIR": cache, "DRAPERY_AOT": "0"},
            stdout=subprocess.PIPE,
            check=True,
            text=True,
        )
    return Cost(*json.loads(made.stdout))


def main() -> None:
    """Run the command line."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    add_quick(parser)
    parser.add_argument("--checkout", help="a folder with the sources of another version")
    given = parser.parse_args()
    what = "face" if given.quick else "cloth"
    if given.checkout:
        turns = [(run("", what, given.checkout), run("", what)) for _ in range(TURNS)]
        name, (other, here) = "there", map(min, zip(*turns, strict=True))
    else:
        name, other, here = "numba", run(PLAIN, what), run("", what)
    for each, cost in ((name, other), ("here", here)):
        print(f"{each:6} {cost.seconds:6.1f} s of the processor, {cost.memory:5.0f} MB,", end=" ")
        print(f"{cost.compilations} compilations of {cost.functions} functions")
    print(f"ratio  {here.seconds / other.seconds:.2f}")
    if other.pixels != here.pixels:
        sys.exit("the pictures differ")


if __name__ == "__main__":
    main()
