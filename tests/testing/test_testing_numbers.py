"""Goldens of numbers: arrays within a tolerance, and files by their hash."""

from pathlib import Path

import numpy as np
import pytest

from drapery.errors import OptionError
from drapery.testing.golden import GoldenError
from drapery.testing.numbers import as_numbers, changed, decode_numbers, encode_numbers

pytest_plugins = ["pytester"]

TEST = """
from pathlib import Path
import numpy as np

def test_one(golden_numbers):
    golden_numbers({"positions": np.zeros((4, 3)) + BY, "time": 1.5}, "sheet", within=1e-6)
    Path("model.glb").write_bytes(b"glTF" + bytes([int(BY * 1e8)]))
    golden_numbers("model.glb")
"""


def test_what_is_kept_comes_back_with_the_same_bytes() -> None:
    numbers = as_numbers({"positions": np.linspace(0, 1, 6).reshape(2, 3), "count": 3})
    data = encode_numbers(numbers)
    assert data == encode_numbers(numbers)
    back = decode_numbers(data)
    assert back.keys() == numbers.keys() and changed(back, numbers, 0.0) == ""
    assert back["positions"].dtype == np.float64 and back["count"].shape == ()
    with pytest.raises(GoldenError, match="not a readable NPZ"):
        decode_numbers(data[:50])


@pytest.mark.parametrize(
    ("was", "now", "within", "line"),
    [
        ([1.0, 2.0], [1.0, 2.5], 0.5, ""),
        ([np.nan, np.inf], [np.nan, np.inf], 0.0, ""),
        ([1.0, 2.0], [1.0, 2.5], 0.1, "numbers differ by more than 0.1 in 1 of 2,"
         " the most at [1]: 2.5, it was 2"),
        ([1.0, 2.0], [1.0, np.nan], 9.0, "numbers differ by more than 9 in 1 of 2,"
         " the most at [1]: nan, it was 2"),
        ([np.inf], [1.0], 9.0, "numbers differ by more than 9 in 1 of 1,"
         " the most at [0]: 1, it was inf"),
        (7, 8, 0.0, "numbers differ in 1 of 1, the most: 8, it was 7"),
        ([1.0], [1], 9.0, "numbers are int64 [1], they were float64 [1]"),
        ([[1.0]], [1.0, 2.0], 9.0, "numbers are float64 [2], they were float64 [1, 1]"),
        ({"a": 1}, {"b": 1}, 0.0, "the arrays are b, they were a"),
    ],
)  # fmt: skip
def test_a_difference_is_a_line(was: object, now: object, within: float, line: str) -> None:
    assert changed(as_numbers(was), as_numbers(now), within) == line


def test_what_holds_no_numbers_is_refused() -> None:
    for value in ("text", None, [[1], [2, 3]], {"a/b": 1}, {3: 1}):
        with pytest.raises(OptionError):
            as_numbers({"value": value} if not isinstance(value, dict) else value)


def test_numbers_have_goldens_a_report_and_an_update(pytester: pytest.Pytester) -> None:
    test = pytester.makepyfile(test_it=TEST.replace("BY", "0"))
    pytester.runpytest_inprocess().assert_outcomes(failed=1)
    run = pytester.runpytest_inprocess("--drapery-update")
    run.stdout.fnmatch_lines("drapery: 2 goldens written")
    found = {path.name for path in (pytester.path / "goldens/test_it").iterdir()}
    assert found == {"test_one[sheet].npz", "test_one[2].sha256"}
    pytester.runpytest_inprocess().assert_outcomes(passed=1)
    assert not (pytester.path / "drapery-report").exists() or not list(
        (pytester.path / "drapery-report").glob("*.failure.json")
    )

    test.write_text(TEST.replace("BY", "4e-7"))  # within the tolerance, but the file changes
    run = pytester.runpytest_inprocess()
    run.assert_outcomes(failed=1)
    run.stdout.fnmatch_lines("golden '2': the file changed from 5 bytes sha256:*--drapery-update")
    run.stdout.no_fnmatch_line("*golden 'sheet'*")

    test.write_text(TEST.replace("BY", "2e-6"))
    run = pytester.runpytest_inprocess()
    run.stdout.fnmatch_lines("golden 'sheet': positions differ by more than 1e-06 in 12 of 12*")
    page = (pytester.path / "drapery-report/index.html").read_text("utf-8")
    assert "2 goldens not as expected" in page and "in 12 of 12, the most" in page


def test_a_damaged_or_unused_golden_of_numbers_is_named(pytester: pytest.Pytester) -> None:
    test = pytester.makepyfile(test_it=TEST.replace("BY", "0"))
    pytester.runpytest_inprocess("--drapery-update")
    kept = pytester.path / "goldens/test_it/test_one[sheet].npz"
    kept.write_bytes(kept.read_bytes()[:40])
    pytester.runpytest_inprocess().stdout.fnmatch_lines("*not a readable NPZ; restore the file*")
    test.write_text("def test_one(): pass\n")
    run = pytester.runpytest_inprocess("--drapery-prune")
    run.stdout.fnmatch_lines("drapery: 2 goldens deleted")
    assert not kept.exists()


@pytest.mark.parametrize(
    ("call", "line"),
    [
        ("golden_numbers('text.txt', within=1)", "within does nothing for a file*"),
        ("golden_numbers([1.0], within=-1)", "within -1 is not a distance; use 0 or more"),
        ("golden_numbers('absent.glb')", "*absent.glb*"),
        ("golden_numbers(['a'])", "*has no numbers; give an array*"),
    ],
)
def test_a_wrong_call_is_a_line(pytester: pytest.Pytester, call: str, line: str) -> None:
    Path("text.txt").write_text("text", encoding="utf-8")
    pytester.makepyfile(f"def test_one(golden_numbers):\n    {call}\n")
    run = pytester.runpytest_inprocess()
    run.assert_outcomes(failed=1)
    run.stdout.fnmatch_lines(line)
    run.stdout.no_fnmatch_line("*Traceback*")
