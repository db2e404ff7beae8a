"""A slice of the fuzzing: a changed text gives banners or one line, soon."""

import fuzzing
import pytest

SAMPLES = fuzzing.text_samples()
READERS = fuzzing.text_readers()


@pytest.mark.parametrize("name", SAMPLES)
def test_the_samples_are_sound(name: str):
    for sample in SAMPLES[name]:
        assert READERS[name](sample)


@pytest.mark.parametrize("name", SAMPLES)
def test_changed_texts_are_read_or_refused(name: str):
    report = fuzzing.fuzz(READERS[name], SAMPLES[name], fuzzing.mutate_text, 300, seed=2)
    assert not report.failures, report.failures[0]
    assert report.count == 300 and len(report.outcomes) > 3
