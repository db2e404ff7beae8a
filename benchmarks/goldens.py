"""How long a check of many golden pictures takes: `python -m benchmarks.goldens`."""

import argparse
import random
from pathlib import Path
from tempfile import TemporaryDirectory
from time import perf_counter

from drapery.banner.dyes import DYE_NAMES
from drapery.banner.patterns import PATTERN_NAMES
from drapery.testing.case_check import check_cases, update_cases
from drapery.testing.cases import Case, CaseFile


def cases(count: int, size: int) -> CaseFile:
    """Different banners with six layers, each drawn at size x size."""
    chance = random.Random(0)
    made = []
    for number in range(count):
        layers = [f"{chance.choice(PATTERN_NAMES)}:{chance.choice(DYE_NAMES)}" for _ in range(6)]
        design = " ".join([chance.choice(DYE_NAMES), *layers])
        made.append(Case(name=f"case-{number}", design=design, size=(size, size), seed=number))
    return CaseFile(case=tuple(made))


def main() -> None:
    words = argparse.ArgumentParser(description=__doc__)
    words.add_argument("--count", type=int, default=200)
    words.add_argument("--size", type=int, default=256)
    asked = words.parse_args()
    file = cases(asked.count, asked.size)
    with TemporaryDirectory() as kept:
        folder = Path(kept)
        list(update_cases(file, folder))
        start = perf_counter()
        faults = [o for o in check_cases(file, folder, folder / "report") if o.fault is not None]
        took = perf_counter() - start
    print(
        f"{asked.count} goldens of {asked.size} x {asked.size}: {took:.2f} s,"
        f" {1000 * took / asked.count:.1f} ms each, {len(faults)} faults"
    )


if __name__ == "__main__":
    main()
