"""What the fixture `golden` accepts, deletes and reports in the runs of a small project."""

import json
from collections.abc import Callable

import pytest
from conftest import Run
from plain_runs import PLAIN

pytest_plugins = ["pytester"]

HEAD = """
import os, pytest, numpy as np

def grey(level):
    return np.full((4, 4, 4), level, np.uint8)

LEVEL = int(os.environ.get("LEVEL", 10))
"""

Project = Callable[..., pytest.RunResult]


@pytest.fixture
def project(pytester: pytest.Pytester, monkeypatch: pytest.MonkeyPatch) -> Project:
    """Writes test_it.py, if there is code, and runs pytest: `project("-k x", code, LEVEL=20)`."""

    def run(words: str = "", code: str | None = None, **variables: int) -> pytest.RunResult:
        if code is not None:
            pytester.makepyfile(test_it=HEAD + code)
        monkeypatch.setenv("LEVEL", str(variables.get("LEVEL", 10)))
        return pytester.runpytest_inprocess(*PLAIN, *words.split())

    return run


def goldens(pytester: pytest.Pytester) -> set[str]:
    return {path.name for path in pytester.path.glob("goldens/*/*")}


def entries(pytester: pytest.Pytester) -> list[str]:
    """The names of the pictures in the report."""
    found = pytester.path.glob("drapery-report/*.failure.json")
    return sorted(json.loads(path.read_text(encoding="utf-8"))["name"] for path in found)


MANY = """
IDS = ["a/b", "é", "x" * 300, "plain"]

@pytest.mark.parametrize("level", range(4), ids=IDS)
def test_many(golden, level):
    golden(grey(level))
    golden(grey(level), "hash", hashed=True)

def test_other(golden):
    golden(grey(LEVEL), "a")
"""


def test_goldens_that_no_test_names_are_listed_then_deleted(
    pytester: pytest.Pytester, project: Project
) -> None:
    assert project("--drapery-update", MANY).ret == 0
    before = goldens(pytester)
    assert len(before) == 9
    result = project("", MANY.replace('"plain"', '"new"').partition("def test_other")[0])
    result.assert_outcomes(passed=3, failed=1)
    result.stdout.no_fnmatch_line("*named by no test*")
    shorter = MANY.replace(', "plain"', "").replace("range(4)", "range(3)")
    shorter = shorter.partition("def test_other")[0]
    result = project("", shorter)
    result.assert_outcomes(passed=3)
    result.stdout.fnmatch_lines(["drapery: 3 goldens are named by no test; *--drapery-prune:"])
    assert goldens(pytester) == before
    result = project("--drapery-prune")
    result.stdout.fnmatch_lines(["drapery: 3 goldens deleted"])
    gone = {
        "test_many[plain][1].png",
        "test_many[plain][hash].sha256",
        "test_other[a].png",
    }
    assert before - goldens(pytester) == gone
    project("--drapery-prune").stdout.fnmatch_lines(["drapery: 0 goldens deleted"])


@pytest.mark.parametrize(
    ("words", "code", "reason"),
    [
        ("-k other", MANY, "not all tests of the files ran"),
        ("--deselect test_it.py::test_other", MANY, "not all tests of the files ran"),
        ("test_it.py::test_other", MANY, "not all tests of the files ran"),
        ("--collect-only", MANY, "not all tests of the files ran"),
        ("-x", "def test_first(): assert False\n" + MANY, "not all tests passed"),
        ("", "def test_first(): pytest.exit('as by Ctrl-C')\n" + MANY, "not all tests passed"),
        ("", MANY + "\ndef test_error(missing): pass", "not all tests passed"),
        ("", MANY.replace("golden(grey(LEVEL)", "1 / 0; golden(grey(1)"), "not all tests passed"),
        ("", "import no_such_module\n" + MANY, "not all tests passed"),
    ],
)
def test_only_a_complete_run_deletes(
    pytester: pytest.Pytester, project: Project, words: str, code: str, reason: str
) -> None:
    project("--drapery-update", MANY + "\ndef test_gone(golden): golden(grey(1))")
    before = goldens(pytester)
    result = project(f"--drapery-prune {words}", code)
    result.stdout.fnmatch_lines([f"drapery: no golden is deleted, because {reason}"])
    assert goldens(pytester) == before


@pytest.mark.parametrize("mark", ["skip", "xfail", "xfail(run=False)"])
def test_skipped_and_expected_failures_keep_their_goldens(
    pytester: pytest.Pytester, project: Project, mark: str
) -> None:
    code = MANY + "\ndef test_gone(golden): golden(grey(1))"
    project("--drapery-update", code)
    before = goldens(pytester)
    marked = MANY.replace("@pytest", f"@pytest.mark.{mark}\n@pytest").replace(
        "golden(grey(level))", "1 / 0"
    )
    assert project("--drapery-prune", marked).ret == 0
    assert before - goldens(pytester) == {"test_gone[1].png"}


def test_files_of_others_and_of_tests_that_did_not_run_are_kept(
    pytester: pytest.Pytester, project: Project
) -> None:
    pytester.makepyfile(test_two=HEAD + "def test_two(golden): golden(grey(1))")
    project("--drapery-update", "def test_one(golden): golden(grey(1))")
    pytester.makepyfile(test_two="import pytest\npytest.skip('no', allow_module_level=True)")
    for name in ("goldens/minecraft/creeper.png", "goldens/test_it/readme.png", "goldens/a[1].png"):
        path = pytester.path / name
        path.parent.mkdir(exist_ok=True)
        path.write_bytes(b"")
    gone = pytester.path / "goldens/test_gone/test_gone[1].png"
    gone.parent.mkdir()
    gone.write_bytes(b"")
    project("--drapery-prune").stdout.fnmatch_lines(["drapery: 1 golden deleted"])
    assert not gone.exists()
    kept = sorted(path.name for path in pytester.path.rglob("goldens/**/*.png"))
    assert kept == ["a[1].png", "creeper.png", "readme.png", "test_one[1].png", "test_two[1].png"]


@pytest.mark.slow
def test_workers_send_what_they_named(pytester: pytest.Pytester, project: Project) -> None:
    project("--drapery-update", MANY)
    before = goldens(pytester)
    result = project("--drapery-prune -n 2", MANY.replace(', "a")', ', "b")'))
    result.stdout.fnmatch_lines(["drapery: no golden is deleted, because not all tests passed"])
    project("--drapery-update -n 2").stdout.fnmatch_lines(["drapery: 1 golden written"])
    result = project("--drapery-prune -n 2")
    result.stdout.fnmatch_lines(["drapery: 1 golden deleted", "  *test_other?a?.png"])
    assert goldens(pytester) == before - {"test_other[a].png"} | {"test_other[b].png"}


def test_a_prune_never_accepts(pytester: pytest.Pytester, project: Project) -> None:
    project("--drapery-update", MANY)
    both = project("--drapery-prune --drapery-update", LEVEL=20)
    assert both.ret == pytest.ExitCode.USAGE_ERROR
    both.stderr.fnmatch_lines(["*run pytest twice*"])
    assert project("--drapery-prune", LEVEL=20).ret == 1
    assert project("", LEVEL=10).ret == 0


def test_the_flag_of_another_plugin_says_what_to_use(project: Project) -> None:
    # Where syrupy is installed, the flag is for its own snapshots.
    result = project("-p no:syrupy --snapshot-update", MANY)
    assert result.ret == pytest.ExitCode.USAGE_ERROR
    result.stderr.fnmatch_lines(["*--drapery-update*--drapery-prune*"])


def test_all_goldens_of_a_test_are_checked(pytester: pytest.Pytester, project: Project) -> None:
    code = """
def test_three(golden):
    for name in "abc":
        golden(grey(LEVEL if name != "b" else 7), name)
"""
    project("--drapery-update", code)
    result = project("", LEVEL=20)
    result.assert_outcomes(failed=1)
    result.stdout.fnmatch_lines(["golden 'a': 16 pixels*", "golden 'c': 16 pixels*"])
    assert entries(pytester) == [f"test_it.py::test_three [{name}]" for name in "ac"]


def test_a_difference_is_not_lost_behind_another_end(project: Project) -> None:
    code = """
def test_skip(golden):
    golden(grey(LEVEL))
    pytest.skip("after it")

def test_error(golden):
    golden(grey(LEVEL))
    1 / (LEVEL - 20)

@pytest.fixture
def late(golden):
    yield
    golden(grey(LEVEL))

def test_late(late):
    pass
"""
    project("--drapery-update", code, LEVEL=11)
    result = project("", LEVEL=20)
    result.assert_outcomes(failed=2, passed=1, errors=1)
    assert result.stdout.str().count("golden '1': 16 pixels differ") >= 3


def test_each_try_of_a_test_begins_anew(pytester: pytest.Pytester, project: Project) -> None:
    pytester.makeconftest(
        """
import pytest
from _pytest.runner import runtestprotocol

@pytest.hookimpl(tryfirst=True)
def pytest_runtest_protocol(item, nextitem):
    '''As plugins do that run a failed test once more.'''
    reports = runtestprotocol(item, nextitem=nextitem, log=False)
    if any(report.failed for report in reports):
        item._initrequest()
        reports = runtestprotocol(item, nextitem=nextitem, log=False)
    for report in reports:
        item.ihook.pytest_runtest_logreport(report=report)
    return True
"""
    )
    code = """
tries = []

def test_flaky(golden):
    tries.append(1)
    golden(grey(1))
    golden(grey(LEVEL if len(tries) > 1 else FIRST))
    golden(grey(2), tolerance=3)
"""
    project("--drapery-update", "FIRST = LEVEL" + code)
    assert goldens(pytester) == {f"test_flaky[{number}].png" for number in (1, 2, 3)}
    project("", "FIRST = 99" + code).assert_outcomes(passed=1)
    assert entries(pytester) == []
    assert not (pytester.path / "drapery-report/index.html").exists()
    project("", LEVEL=50).assert_outcomes(failed=1)
    assert entries(pytester) == ["test_it.py::test_flaky [2]"]


def test_an_expected_failure_has_no_entry(pytester: pytest.Pytester, project: Project) -> None:
    code = "@pytest.mark.xfail\ndef test_x(golden): golden(grey(LEVEL))"
    project("--drapery-update", code)
    project("", LEVEL=20).assert_outcomes(xfailed=1)
    assert entries(pytester) == []


def test_a_name_is_used_once_in_a_test(pytester: pytest.Pytester, project: Project) -> None:
    code = """
def test_it(golden):
    golden(grey(1), "2")
    golden(grey(2))
    golden(grey(3), "2", tolerance=5)
    golden(grey(4), "2", hashed=True)
"""
    result = project("--drapery-update", code)
    result.assert_outcomes(failed=1)
    faults = [line for line in result.stdout.lines if line.startswith("golden '2' is named twice")]
    # In CI pytest repeats them in its summary.
    assert len(faults) >= 3
    assert set(faults) == {"golden '2' is named twice in this test; use another name"}
    assert goldens(pytester) == {"test_it[2].png"}


def test_runs_that_leave_tests_out_keep_the_report(
    pytester: pytest.Pytester, project: Project
) -> None:
    code = "\n".join(f"def test_{name}(golden): golden(grey(LEVEL))" for name in "abc")
    project("--drapery-update", code)
    project("", LEVEL=20)
    all_three = [f"test_it.py::test_{name} [1]" for name in "abc"]
    assert entries(pytester) == all_three
    project("--collect-only")
    assert entries(pytester) == all_three
    project("-k test_a")
    assert entries(pytester) == all_three[1:]
    page = (pytester.path / "drapery-report/index.html").read_text(encoding="utf-8")
    assert "test_b [1]" in page and "test_a [1]" not in page
    project("-k test_b -n 1")
    assert entries(pytester) == all_three[2:]
    project("", code.replace("test_c", "test_d"))
    assert entries(pytester) == ["test_it.py::test_d [1]"]
    project("--drapery-update")
    assert entries(pytester) == []
    assert not (pytester.path / "drapery-report/index.html").exists()


def test_a_report_accepts_what_it_compared_with(
    pytester: pytest.Pytester, project: Project, drapery: Run, monkeypatch: pytest.MonkeyPatch
) -> None:
    code = "def test_a(golden, tmp_path):\n    os.chdir(tmp_path)\n    golden(grey(LEVEL))"
    project("--drapery-update", code)
    project("", LEVEL=20).assert_outcomes(failed=1)
    golden = pytester.path / "goldens/test_it/test_a[1].png"
    first = golden.read_bytes()
    golden.write_bytes(b"newer")
    monkeypatch.chdir(pytester.path)  # the test has left it
    exit_code, _, message = drapery("golden", "accept")
    assert exit_code == 2 and "is not the one that the report compared with" in message
    assert golden.read_bytes() == b"newer"
    golden.write_bytes(first)
    exit_code, output, _ = drapery("golden", "accept")
    assert (exit_code, output.splitlines()[0]) == (0, "wrote goldens/test_it/test_a[1].png")
    project("", LEVEL=20).assert_outcomes(passed=1)


def test_a_golden_has_several_approved_pictures(
    pytester: pytest.Pytester, project: Project
) -> None:
    code = """
def test_a(golden):
    golden(grey(LEVEL))
    golden(grey(LEVEL), "hash", hashed=True)
"""
    project("--drapery-update", code)
    project("--drapery-update --drapery-variant arm64", LEVEL=20)
    assert goldens(pytester) == {
        f"test_a[{name}]{variant}.{ending}"
        for name, ending in (("1", "png"), ("hash", "sha256"))
        for variant in ("", "~arm64")
    }
    for level in (10, 20):
        result = project("--drapery-prune", LEVEL=level)
        result.assert_outcomes(passed=1)
        result.stdout.fnmatch_lines(["drapery: 0 goldens deleted"])
    result = project("", LEVEL=21)
    result.assert_outcomes(failed=1)
    assert project("--drapery-variant arm64").ret == pytest.ExitCode.USAGE_ERROR
    assert project("--drapery-update --drapery-variant ../x").ret == pytest.ExitCode.USAGE_ERROR


def test_a_project_has_its_own_defaults(pytester: pytest.Pytester, project: Project) -> None:
    project("--drapery-update", "def test_a(golden): golden(grey(LEVEL))")
    pytester.makeini("[pytest]\ndrapery_tolerance = 10")
    project("", LEVEL=20).assert_outcomes(passed=1)
    project("", LEVEL=21).assert_outcomes(failed=1)
    pytester.makeini("[pytest]\ndrapery_pixels = 16")
    project("", LEVEL=99).assert_outcomes(passed=1)
    pytester.makeini("[pytest]\ndrapery_tolerance = much")
    result = project()
    result.assert_outcomes(failed=1)
    result.stdout.fnmatch_lines(
        ["drapery_... in pytest's configuration: tolerance 'much' *is not a number; use 0 to 255"]
    )


def test_odd_names_raise_no_warning(pytester: pytest.Pytester) -> None:
    pytester.makepyfile(test_it=HEAD + MANY)
    words = "-q", "-W", "error", *PLAIN
    assert pytester.runpytest_subprocess(*words, "--drapery-update").ret == 0
    assert pytester.runpytest_subprocess(*words).ret == 0


def test_hidden_colours_count_in_no_form(project: Project) -> None:
    code = """
def test_hidden(golden):
    picture = grey(0)
    picture[0, 0, :3] = LEVEL
    golden(picture)
    golden(picture, hashed=True)
"""
    project("--drapery-update", code)
    project("", LEVEL=20).assert_outcomes(passed=1)
