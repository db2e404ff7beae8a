"""Fuzz every reader of input from outside: `python -m benchmarks.fuzz [--minutes 10] [READER ...]`.

Valid inputs of each reader are changed at random (seeded) and read. Each reading must give a result
or a DraperyError of one line, within a second and 200 MB. Anything else is a failure; then the exit
code is 1. `--save` writes the inputs that failed. The readers share the time, or each reads
`--count` inputs. With `--atheris READER`, atheris (if installed) chooses the changes by code
coverage.
"""

import argparse
import contextlib
import math
import sys
import tempfile
import time
from collections.abc import Sequence
from pathlib import Path
from typing import Any

sys.path.insert(0, str(Path(__file__).parents[1] / "tests"))

import fuzz_targets
import fuzzing
from fuzz_targets import Target

from benchmarks.quick import add_quick
from drapery.errors import DraperyError


def run(
    name: str, target: Target, count: float, seed: int, seconds: float, slowest: float
) -> fuzzing.FuzzReport:
    """Fuzz one reader and print the result."""
    for sample in target.samples:  # exclude what is loaded only once from the inputs' memory
        with contextlib.suppress(DraperyError):
            list(target.read(sample))
    start = time.perf_counter()
    report = fuzzing.fuzz(target.read, target.samples, target.mutate, count, seed, seconds, slowest)
    taken = time.perf_counter() - start
    print(
        f"{name}: {report.count} inputs in {taken:.0f} s, slowest {report.slowest:.3f} s,"
        f" heaviest {report.heaviest:.0f} MB, {len(report.failures)} failures",
        flush=True,
    )
    for outcome, number in report.outcomes.most_common(12):
        print(f"  {number:7d}  {outcome}")
    return report


def save(failures: Sequence[tuple[Any, str]], name: str, folder: Path) -> None:
    """Write each input that failed to a file."""
    folder.mkdir(parents=True, exist_ok=True)
    for number, (given, _) in enumerate(failures):
        data = given if isinstance(given, bytes) else str(given).encode("utf-8", "surrogatepass")
        (folder / f"{name.replace(' ', '-')}-{number}").write_bytes(data)


def drive_by_coverage(target: Target, arguments: list[str]) -> None:
    """Fuzz a reader with atheris, which runs until a failure or until it is stopped."""
    import atheris

    binary = isinstance(target.samples[0], bytes)

    def one_input(data: bytes) -> None:
        given = data if binary else data.decode("utf-8", "replace")
        report = fuzzing.FuzzReport()
        fuzzing.judge(target.read, given, report)
        if report.failures:
            raise AssertionError(report.failures[0][1])

    atheris.instrument_all()
    with tempfile.TemporaryDirectory() as corpus:
        for number, sample in enumerate(target.samples):
            data = fuzzing.unwrapped(sample) if binary else sample.encode()
            Path(corpus, str(number)).write_bytes(data)
        atheris.Setup([sys.argv[0], *arguments, corpus], one_input)
        atheris.Fuzz()


def main() -> int:
    """Run the command line; returns 1 if anything failed."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("readers", nargs="*", help="all of them by default")
    parser.add_argument("--minutes", type=float, default=10.0, help="of all readers together")
    parser.add_argument("--count", type=int, help="inputs of a reader, in place of minutes")
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument(
        "--slowest",
        type=float,
        default=1.0,
        help="processor time that one input may take [s]; other work on the machine adds to it",
    )
    parser.add_argument("--save", type=Path, help="folder for the inputs that failed")
    parser.add_argument("--atheris", action="store_true", help="drive one reader by coverage")
    add_quick(parser)
    options, rest = parser.parse_known_args()
    if options.quick:
        options.count, options.slowest = 5, 60.0
    known = fuzz_targets.targets()
    names = options.readers or list(known)
    if strange := [name for name in names if name not in known]:
        parser.error(f"{strange[0]} is not known; known are {', '.join(known)}")
    if options.atheris:
        drive_by_coverage(known[names[0]], rest)
        return 0
    seconds = math.inf if options.count else options.minutes * 60 / len(names)
    failed = False
    for name in names:
        count = options.count or math.inf
        report = run(name, known[name], count, options.seed, seconds, options.slowest)
        for _, reason in report.failures[:5]:
            print(f"  FAILURE {reason}")
        if options.save and report.failures:
            save(report.failures, name, options.save)
        failed = failed or bool(report.failures)
    return int(failed)


if __name__ == "__main__":
    sys.exit(main())
