"""What the kernels of the first picture cost to compile: `python -m benchmarks.compiling`.

Each run is a process of its own with an empty cache; `numba` stands for the compiler as numba has
it, without `drapery.jit.compiling`. The ratio is that of the processor's times; the pictures must
be the same. On a slow and busy core (x86-64, Python 3.13, numba 0.68.1) 357 compilations of 222
functions that were linked into each caller took 88.3 s and 1074 MB; linked once, in the same
minutes, 306 took 70.7 s and 554 MB. Later 263 of 200 took 61.3 s and 506 MB. Compiled twice are
`nearest` and `gap_of`, for int64 and uint8, and `texels_of`, for both precisions; the other 60 are
numba's own.
"""

import argparse
import json
import os
import subprocess
import sys
import tempfile
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


class Cost(NamedTuple):
    """Seconds of the processor, the most memory [MB], how many compilations of how many functions,
    and a hash of the first picture."""

    seconds: float
    memory: float
    compilations: int
    functions: int
    pixels: str


def run(before: str, what: str) -> Cost:
    """What the first picture costs in a process of its own."""
    with tempfile.TemporaryDirectory() as cache:
        made = subprocess.run(
            [sys.executable, "-c", before + RUN, what],
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
    what = "face" if parser.parse_args().quick else "cloth"
    plain, here = run(PLAIN, what), run("", what)
    for name, cost in (("numba", plain), ("here", here)):
        print(f"{name:6} {cost.seconds:6.1f} s of the processor, {cost.memory:5.0f} MB,", end=" ")
        print(f"{cost.compilations} compilations of {cost.functions} functions")
    print(f"ratio  {here.seconds / plain.seconds:.2f}")
    if plain.pixels != here.pixels:
        sys.exit("the pictures differ")


if __name__ == "__main__":
    main()
