"""The fixture `golden` in small projects: names of files, reports, failed updates."""

from pathlib import Path

import pytest

pytest_plugins = ["pytester"]

HEAD = """
import numpy as np, pytest

def grey(level):
    return np.full((4, 4, 4), level, np.uint8)
"""


def test_every_id_has_a_separate_golden(pytester: pytest.Pytester) -> None:
    """Characters that no file name may have are left out of the name, and none is lost by it."""
    pytester.makepyfile(
        HEAD
        + """
IDS = ["a/b", "a:b", "a?b", "ab", "x" * 300 + "1", "x" * 300 + "2"]

@pytest.mark.parametrize("number, name", list(enumerate(IDS)), ids=IDS)
def test_one(golden, number, name):
    golden(grey(40 * number))
    golden(grey(40 * number + 1), name)
"""
    )
    pytester.runpytest_inprocess("--drapery-update").assert_outcomes(passed=6)
    assert len(list(pytester.path.glob("goldens/*/*.png"))) == 12
    pytester.runpytest_inprocess().assert_outcomes(passed=6)


def test_a_loop_is_a_golden_too(pytester: pytest.Pytester) -> None:
    test = pytester.makepyfile(
        HEAD
        + """
from drapery import Animation, Frame

def test_one(golden):
    loop = Animation(tuple(Frame(grey(level)) for level in (10, 20, 30)), 5)
    golden(loop, "a")
    golden(loop, "b", hashed=True)
"""
    )
    pytester.runpytest_inprocess("--drapery-update").assert_outcomes(passed=1)
    pytester.runpytest_inprocess().assert_outcomes(passed=1)
    code = Path(test).read_text(encoding="utf-8")
    Path(test).write_text(code.replace("20", "21"), encoding="utf-8")
    result = pytester.runpytest_inprocess()
    result.stdout.fnmatch_lines(
        ["golden 'a': 16 pixels differ, max 1, in frame 2, in columns 0 to 3 of rows 0 to 3; see *"]
    )
    page = (pytester.path / "drapery-report/index.html").read_text(encoding="utf-8")
    # Three pictures of the first golden; of the hashed one only the actual picture is known.
    assert page.count('data-frames="3"') == 4


def test_names_that_differ_by_case_alone_are_refused(pytester: pytest.Pytester) -> None:
    """A file system that ignores case would keep one file for both."""
    pytester.makepyfile(
        HEAD
        + """
def test_one(golden):
    golden(grey(10), "A")

def test_one_again(golden):
    golden(grey(10), "B")
    golden(grey(20), "b")
"""
    )
    result = pytester.runpytest_inprocess("--drapery-update")
    result.assert_outcomes(passed=1, failed=1)
    result.stdout.fnmatch_lines(
        ["golden 'b': *test_one_again?b?.png differs from *test_one_again?B?.png only in case;*"]
    )


def test_a_failed_update_says_why(pytester: pytest.Pytester) -> None:
    pytester.makepyfile(test_it=HEAD + "\ndef test_one(golden):\n    golden(grey(10), 'a')\n")
    folder = pytester.mkdir("goldens") / "test_it" / "test_one[a].png"
    folder.mkdir(parents=True)
    for words in (["--drapery-update"], []):
        result = pytester.runpytest_inprocess(*words)
        result.assert_outcomes(failed=1)
        result.stdout.fnmatch_lines(["golden 'a': *test_one?a?.png: *; *"])
        result.stdout.no_fnmatch_line("*accept it*")


def test_a_report_that_cannot_be_deleted_stops_no_test(pytester: pytest.Pytester) -> None:
    """Another user's report folder: tests run, and what went wrong is said once."""
    pytester.makepyfile(
        HEAD
        + """
def test_without_goldens():
    pass

def test_with_a_golden(golden):
    golden(grey(10), "a")
"""
    )
    pytester.runpytest_inprocess("--drapery-update").assert_outcomes(passed=2)
    # No user, not even the super-user, can unlink a folder.
    stuck = pytester.path / "drapery-report" / "old.failure.json"
    stuck.mkdir(parents=True)
    result = pytester.runpytest_inprocess()
    result.assert_outcomes(passed=2)
    result.stdout.fnmatch_lines(["*drapery-report*cannot be removed*--drapery-report*"])


def test_a_report_that_cannot_be_written_keeps_the_fault(pytester: pytest.Pytester) -> None:
    test = pytester.makepyfile(HEAD + "\ndef test_one(golden):\n    golden(grey(10), 'a')\n")
    pytester.runpytest_inprocess("--drapery-update").assert_outcomes(passed=1)
    code = Path(test).read_text(encoding="utf-8")
    Path(test).write_text(code.replace("grey(10)", "grey(11)"), encoding="utf-8")
    (pytester.path / "drapery-report").write_text("a file in the way of the folder")
    result = pytester.runpytest_inprocess()
    result.assert_outcomes(failed=1)
    result.stdout.fnmatch_lines(
        ["golden 'a': 16 pixels differ, max 1, in columns*; *drapery-report*"]
    )


def test_a_tolerance_out_of_range_is_refused_without_a_traceback(
    pytester: pytest.Pytester,
) -> None:
    pytester.makepyfile(HEAD + "\ndef test_one(golden):\n    golden(grey(0), tolerance=300)\n")
    result = pytester.runpytest_inprocess()
    result.stdout.fnmatch_lines(["*tolerance 300 is out of range; use 0 to 255*"])
    result.stdout.no_fnmatch_line("*golden.py*")
