"""What the kernels of the first picture cost to compile: `python -m benchmarks.compiling`.

Each run is a process of its own with an empty cache; `numba` stands for the compiler as numba has
it, without `drapery.jit_compiling`. The ratio is that of the processor's times; the pictures must
be the same. On a slow core (x86-64, Python 3.13, numba 0.68.1): 120.6 s and 568 MB, and here 83.9 s
and 1045 MB, a ratio of 0.70.
"""

import argparse
import json
import os
import subprocess
import sys
import tempfile

from benchmarks.quick import add_quick

PLAIN = """
import sys
from types import ModuleType
sys.modules["drapery.jit_compiling"] = ModuleType("drapery.jit_compiling")
"""
RUN = """
import hashlib, json, resource, sys, time
start = time.process_time()
if sys.argv[1] == "face":
    from drapery import Banner, draw_face
    pixels = draw_face(Banner.parse("red")).pixels
else:
    from drapery import Banner, draw
    pixels = draw(Banner.parse("white creeper:lime border:black"), view="hero").pixels
seconds = time.process_time() - start
memory = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
print(json.dumps([seconds, memory, hashlib.sha256(pixels.tobytes()).hexdigest()]))
"""


def run(before: str, what: str) -> tuple[float, float, str]:
    """Seconds of the processor, the most memory [MB], and a hash of the first picture."""
    with tempfile.TemporaryDirectory() as cache:
        made = subprocess.run(
            [sys.executable, "-c", before + RUN, what],
            env=os.environ | {"NUMBA_CACHE_DIR": cache, "DRAPERY_AOT": "0"},
            stdout=subprocess.PIPE,
            check=True,
            text=True,
        )
    seconds, memory, pixels = json.loads(made.stdout)
    return seconds, memory, pixels


def main() -> None:
    """Run the command line."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    add_quick(parser)
    what = "face" if parser.parse_args().quick else "cloth"
    plain, here = run(PLAIN, what), run("", what)
    for name, (seconds, memory, _) in (("numba", plain), ("here", here)):
        print(f"{name:6} {seconds:6.1f} s of the processor, {memory:5.0f} MB")
    print(f"ratio  {here[0] / plain[0]:.2f}")
    if plain[2] != here[2]:
        sys.exit("the pictures differ")


if __name__ == "__main__":
    main()
