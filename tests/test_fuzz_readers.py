"""A slice of the fuzzing of all readers of files, of queries, of command lines and of pages."""

import fuzz_targets
import fuzzing
import pytest

TARGETS = fuzz_targets.other_targets()
COUNTS = dict.fromkeys(TARGETS, 40) | {"data pack": 150}
"""Changes of each reader's samples, more where few ways to end are common;
`python -m benchmarks.fuzz` in `.ci/run` makes 300 others of each reader."""


@pytest.mark.parametrize("name", TARGETS)
def test_the_samples_are_valid(name: str) -> None:
    for sample in TARGETS[name].samples:
        assert list(TARGETS[name].read(sample))


@pytest.mark.parametrize("name", TARGETS)
def test_changed_inputs_are_read_or_refused(name: str) -> None:
    target = TARGETS[name]
    report = fuzzing.fuzz(target.read, target.samples, target.mutate, COUNTS[name], seed=3)
    assert not report.failures, report.failures[0]
    assert report.count == COUNTS[name] and len(report.outcomes) > 3
