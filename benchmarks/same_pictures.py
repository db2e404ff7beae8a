"""Whether a change keeps all pictures: `python -m benchmarks.same_pictures FILE [--count 500]`.

It draws seeded random requests over everything: banners, shields, capes, walls, grids, styles,
packs, garments, players, loops, models, live cloth. If FILE is not there, their hashes are written
to it; if it is, they are compared with it, each request that differs is printed, and the exit code
is 1. Make the file before a change of what no picture may notice, and compare after each step.
"""

import argparse
import sys
import tempfile
import time
import warnings
from collections import Counter
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[1] / "tests"))

from picture_requests import Request, added, digest, requests

from benchmarks.quick import add_quick


def drawn(asked: list[Request]) -> list[str]:
    """The line of each request: its hash, a space, the request; and how long each subject took."""
    lines, seconds = [], Counter[str]()
    for request in asked:
        start = time.perf_counter()
        lines.append(f"{digest(request)} {request.text}")
        seconds[request.subject] += time.perf_counter() - start
    for subject, taken in seconds.most_common():
        print(f"{subject:8} {taken:6.1f} s", file=sys.stderr)
    return lines


def main() -> int:
    """Run the command line; returns 1 if a picture differs."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("file", type=Path, nargs="?", help="of the hashes")
    parser.add_argument("--count", type=int, default=500, help="of requests")
    parser.add_argument("--seed", type=int, default=1, help="of other requests")
    add_quick(parser)
    given = parser.parse_args()
    count = 10 if given.quick else given.count
    warnings.simplefilter("ignore")
    with tempfile.TemporaryDirectory() as folder:
        path = given.file or Path(folder, "hashes.txt")
        lines = drawn([*requests(count, given.seed), *added()])
        if not path.exists():
            path.write_text("\n".join(lines) + "\n", encoding="utf-8")
            print(f"{len(lines)} hashes are in {path}")
            return 0
        before = path.read_text(encoding="utf-8").splitlines()
    compared, differing = compare(before, lines)
    print(f"{len(differing)} of {compared} pictures differ", *differing, sep="\n")
    return min(len(differing), 1)


def compare(before: list[str], now: list[str]) -> tuple[int, list[str]]:
    """How many requests are in both files, and their lines of now with another hash."""
    hashes = {text: hashed for hashed, _, text in (line.partition(" [") for line in before)}
    compared, differing = 0, []
    for line in now:
        hashed, _, text = line.partition(" [")
        compared += text in hashes
        if hashes.get(text, hashed) != hashed:
            differing.append(line)
    return compared, differing


if __name__ == "__main__":
    sys.exit(main())
