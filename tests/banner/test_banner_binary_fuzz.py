"""A slice of the fuzzing: a changed file gives banners or one line, soon."""

import fuzzing
import pytest

SAMPLES = fuzzing.binary_samples()
READERS = fuzzing.binary_readers()
COUNT = 40
"""Changes of each form's samples; `python -m benchmarks.fuzz` in `.ci/run` makes 300 others."""


def test_every_form_of_bytes_is_fuzzed():
    assert SAMPLES.keys() == READERS.keys()


@pytest.mark.parametrize("name", SAMPLES)
def test_the_samples_are_sound(name: str):
    for sample in SAMPLES[name]:
        assert list(READERS[name](sample))


@pytest.mark.parametrize("name", SAMPLES)
def test_changed_files_are_read_or_refused(name: str):
    report = fuzzing.fuzz(READERS[name], SAMPLES[name], fuzzing.mutate_bytes, COUNT, seed=1)
    assert not report.failures, report.failures[0][1]
    assert report.count == COUNT and len(report.outcomes) > 3
