"""Fuzz every form of a banner: `python -m benchmarks.fuzz_formats [--count N] [FORM…]`.

Each form's sound samples are changed at random (seeded) and read. Every outcome must be banners
or a DraperyError of one line, within a second and 200 MB; anything else is a failure, whose
input `--save` keeps. By default 100,000 inputs for a form of text, 20,000 for one of bytes.
With `--atheris FORM`, atheris (if installed) drives the changes by coverage instead.
"""

import argparse
import sys
import tempfile
import time
from collections.abc import Callable, Iterable, Sequence
from pathlib import Path
from typing import Any, NamedTuple

sys.path.insert(0, str(Path(__file__).parents[1] / "tests"))

import fuzzing

TEXT_COUNT, BINARY_COUNT = 100_000, 20_000


class Target(NamedTuple):
    """A form to fuzz: its reader, sound samples, how to change them, how often."""

    read: Callable[[Any], Iterable[Any]]
    samples: Sequence[Any]
    mutate: Callable[..., Any]
    count: int


def targets() -> dict[str, Target]:
    """All forms by name; those of bytes first."""
    readers, samples = fuzzing.binary_readers(), fuzzing.binary_samples()
    found = {
        name: Target(readers[name], samples[name], fuzzing.mutate_bytes, BINARY_COUNT)
        for name in readers
    }
    readers, texts = fuzzing.text_readers(), fuzzing.text_samples()
    return found | {
        name: Target(readers[name], texts[name], fuzzing.mutate_text, TEXT_COUNT)
        for name in readers
    }


def run(name: str, target: Target, count: int, seed: int) -> fuzzing.FuzzReport:
    """Fuzz one form and print what came of it."""
    for sample in target.samples:  # whatever is loaded once is not the inputs' memory
        list(target.read(sample))
    start = time.perf_counter()
    report = fuzzing.fuzz(target.read, target.samples, target.mutate, count, seed)
    seconds = time.perf_counter() - start
    print(
        f"{name}: {report.count} inputs in {seconds:.0f} s, slowest {report.slowest:.3f} s,"
        f" heaviest {report.heaviest:.0f} MB, {len(report.failures)} failures",
        flush=True,
    )
    for outcome, number in report.outcomes.most_common(12):
        print(f"  {number:7d}  {outcome}")
    return report


def save(failures: Sequence[tuple[Any, str]], name: str, folder: Path) -> None:
    """Keep the inputs that failed, each in a file."""
    folder.mkdir(parents=True, exist_ok=True)
    for number, (given, _) in enumerate(failures):
        data = given if isinstance(given, bytes) else str(given).encode("utf-8", "surrogatepass")
        (folder / f"{name}-{number}").write_bytes(data)


def drive_by_coverage(target: Target, arguments: list[str]) -> None:
    """Hand the form to atheris, which runs until it fails or is stopped."""
    import atheris

    binary = target.mutate is fuzzing.mutate_bytes

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
    """The command line. 1 if anything failed."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("forms", nargs="*", help="all of them by default")
    parser.add_argument("--count", type=int, help="inputs a form")
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--save", type=Path, help="folder for the inputs that failed")
    parser.add_argument("--atheris", action="store_true", help="drive the one form by coverage")
    options, rest = parser.parse_known_args()
    known = targets()
    if options.atheris:
        drive_by_coverage(known[options.forms[0]], rest)
        return 0
    failed = False
    for name in options.forms or known:
        target = known[name]
        report = run(name, target, options.count or target.count, options.seed)
        for _, reason in report.failures[:5]:
            print(f"  FAILURE {reason}")
        if options.save and report.failures:
            save(report.failures, name, options.save)
        failed = failed or bool(report.failures)
    return int(failed)


if __name__ == "__main__":
    sys.exit(main())
