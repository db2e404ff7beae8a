"""How long a check of many golden pictures takes: `python -m benchmarks.goldens [--cold]`.

The goldens are written first, and then checked by a new process, as in CI. With `--cold` that
process finds no kernels in numba's cache. Times of the processor do not depend on what else runs.
"""

import argparse
import os
import random
import subprocess
import sys
from pathlib import Path
from tempfile import TemporaryDirectory
from time import perf_counter

from benchmarks.quick import add_quick
from drapery.banner.dyes import DYE_NAMES
from drapery.banner.patterns import PATTERN_NAMES


def cases(count: int, size: int) -> str:
    """A file of cases: different banners with six layers, each drawn at size x size."""
    chance = random.Random(0)
    lines = ["[defaults]", f'size = "{size}x{size}"']
    for number in range(count):
        layers = [f"{chance.choice(PATTERN_NAMES)}:{chance.choice(DYE_NAMES)}" for _ in range(6)]
        design = " ".join([chance.choice(DYE_NAMES), *layers])
        lines += ["[[case]]", f'name = "case-{number}"', f'design = "{design}"', f"seed = {number}"]
    return "\n".join([*lines, ""])


def run(command: str, folder: Path, env: dict[str, str]) -> tuple[float, float, str]:
    """The time on the clock and of the processor [s], and what `drapery golden` printed last."""
    words = [sys.executable, "-m", "drapery", "golden", command, "cases.toml"]
    start, before = perf_counter(), os.times()
    done = subprocess.run(words, cwd=folder, env=env, capture_output=True, text=True)
    after = os.times()
    used = after.children_user + after.children_system
    used -= before.children_user + before.children_system
    return perf_counter() - start, used, (done.stdout or done.stderr).splitlines()[-1]


def main() -> None:
    words = argparse.ArgumentParser(description=__doc__)
    words.add_argument("--count", type=int, default=500)
    words.add_argument("--size", type=int, default=256)
    words.add_argument("--cold", action="store_true", help="without kernels in numba's cache")
    words.add_argument("--repeats", type=int, default=1, help="checks of the same goldens")
    add_quick(words)
    asked = words.parse_args()
    if asked.quick:
        asked.count, asked.size = 3, 32
    with TemporaryDirectory() as kept:
        folder = Path(kept)
        (folder / "cases.toml").write_text(cases(asked.count, asked.size), encoding="utf-8")
        run("update", folder, dict(os.environ))
        for number in range(asked.repeats):
            cache = {"NUMBA_CACHE_DIR": str(folder / f"kernels-{number}")} if asked.cold else {}
            wall, used, said = run("check", folder, os.environ | cache)
            each = f"{1000 * used / asked.count:.1f} ms each"
            print(f"{wall:.1f} s, of the processor {used:.1f} s, {each}: {said}", flush=True)


if __name__ == "__main__":
    main()
