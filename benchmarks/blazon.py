"""How many blazons are read, and how many banners come back from their words.

`python -m benchmarks.blazon` reads `tests/blazons.txt`, every banner of one layer and 10,000 random
banners of up to 16 layers, and prints the shares and the time of one.
"""

import argparse
import random
import time
from collections.abc import Iterator
from pathlib import Path

from benchmarks.quick import add_quick
from drapery import Banner, Layer
from drapery.banner import DYE_NAMES, PATTERN_NAMES
from drapery.banner.blazon import parse_blazon, write_blazon
from drapery.errors import DesignError

BLAZONS = Path(__file__).parents[1] / "tests" / "blazons.txt"
COUNT = 10_000


def single_layers() -> Iterator[Banner]:
    """Every pattern in every dye, on one base for each dye."""
    for pattern in PATTERN_NAMES:
        for number, dye in enumerate(DYE_NAMES):
            yield Banner(DYE_NAMES[number * 7 % 16], (Layer(pattern, dye),))


def random_banners(count: int, seed: int = 19) -> Iterator[Banner]:
    """Banners and shields of up to 16 layers, the same ones for the same seed."""
    pick = random.Random(seed)
    for _ in range(count):
        layers = [
            Layer(pick.choice(PATTERN_NAMES), pick.choice(DYE_NAMES))
            for _ in range(pick.randint(0, 16))
        ]
        base = pick.choice(DYE_NAMES)
        yield Banner(base, tuple(layers), "shield" if pick.random() < 0.5 else "banner")


def returned(banners: Iterator[Banner]) -> str:
    """How many banners are the same after they were written as a blazon and read."""
    begin, same, count = time.perf_counter(), 0, 0
    for banner in banners:
        count += 1
        same += parse_blazon(write_blazon(banner)) == banner
    each = (time.perf_counter() - begin) / count
    return f"{same} of {count} are the same ({same / count:.2%}), {each * 1e3:.2f} ms each"


def is_read(text: str) -> bool:
    """Whether a blazon can be read."""
    try:
        parse_blazon(text)
    except DesignError:
        return False
    return True


def main() -> None:
    """Print the shares."""
    parser = argparse.ArgumentParser(description=__doc__)
    add_quick(parser)
    count = 100 if parser.parse_args().quick else COUNT
    lines = [x for x in BLAZONS.read_text("utf-8").splitlines() if not x.startswith("#")]
    read = sum(map(is_read, lines))
    print(f"blazons: {read} of {len(lines)} are read ({read / len(lines):.1%})")
    print(f"banners of one layer: {returned(single_layers())}")
    print(f"random banners: {returned(random_banners(count))}")


if __name__ == "__main__":
    main()
