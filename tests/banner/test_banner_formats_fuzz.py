"""A slice of the fuzzing: a changed text gives banners or one line, soon."""

import re

import fuzzing
import pytest

SAMPLES = fuzzing.text_samples()
READERS = fuzzing.text_readers()
KEY = re.compile(r"""(?<![\w"'.:/])("[\w.:]+"|'[\w.:]+'|[\w.]+)(?=\s*[:=])""")
STRANGE_KEYS = (
    *('""', "''", "null", "~", "true", "3", "-0.5", "2026-01-01", "?", "[]", "<<", "[a]"),
    *("9" * 5000, f"'{'9' * 5000}'", f"? {'9' * 5000}\n"),
)


COUNTS = dict.fromkeys(SAMPLES, 40) | dict.fromkeys(["planet-minecraft", "bannermaker"], 200)
"""Changes of each form's samples, more where most of them are refused alike;
`python -m benchmarks.fuzz` in `.ci/run` makes 300 others of each form."""
STRIDE = 37
"""Each text's own reader gets all of its changes; the one that asks them all gets so few: a number
that shares no factor with the number of strange keys, so that it meets each of them."""


@pytest.mark.parametrize("name", SAMPLES)
def test_the_samples_are_sound(name: str):
    for sample in SAMPLES[name]:
        assert READERS[name](sample)


@pytest.mark.parametrize("name", SAMPLES)
def test_changed_texts_are_read_or_refused(name: str):
    report = fuzzing.fuzz(READERS[name], SAMPLES[name], fuzzing.mutate_text, COUNTS[name], seed=2)
    assert not report.failures, report.failures[0]
    assert report.count == COUNTS[name] and len(report.outcomes) > 3


@pytest.mark.parametrize("name", SAMPLES)
def test_strange_keys_are_read_or_refused(name: str):
    """Each key of a tree in turn gives way to an empty one, a null, a number, a date, a merge."""
    report = fuzzing.FuzzReport()
    changes = [
        sample[: found.start()] + key + sample[found.end() :]
        for sample in SAMPLES[name]
        for found in KEY.finditer(sample)
        for key in STRANGE_KEYS
    ]
    for changed in changes[:: STRIDE if name == "any text" else 1]:
        fuzzing.judge(READERS[name], changed, report)
    assert not report.failures, report.failures[0]


@pytest.mark.parametrize("name", SAMPLES)
def test_long_numbers_are_read_or_refused(name: str):
    """Python makes no number of over 4,300 digits."""
    report = fuzzing.FuzzReport()
    changes = [
        sample[: found.start()] + "9" * 5000 + sample[found.end() :]
        for sample in SAMPLES[name]
        for found in re.finditer(r"\w+", sample)
    ]
    for changed in changes[:: STRIDE if name == "any text" else 1]:
        fuzzing.judge(READERS[name], changed, report)
    assert not report.failures, report.failures[0][1]
