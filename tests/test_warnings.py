"""The suite refuses warnings of Drapery and of tests, and lets those of other packages be."""

import tomllib
from pathlib import Path

import pytest

pytest_plugins = ["pytester"]
OPTIONS = tomllib.loads((Path(__file__).parents[1] / "pyproject.toml").read_text(encoding="utf-8"))
FILTERS = OPTIONS["tool"]["pytest"]["ini_options"]["filterwarnings"]

WARN = """
import warnings
def warn(category, module):
    warnings.warn_explicit("some words", category, f"{module}.py", 1, module)
"""
CASES = [
    *((category, "drapery.banner", False) for category in ("UserWarning", "DeprecationWarning")),
    *((category, "test_banner", False) for category in ("UserWarning", "DeprecationWarning")),
    *((category, "numpy.linalg", True) for category in ("UserWarning", "DeprecationWarning")),
    ("FutureWarning", "drapery.banner", True),
    ("ResourceWarning", "numpy.linalg", True),
]


def outcome(pytester: pytest.Pytester, test: str) -> dict[str, int]:
    """What becomes of a test of another project with the filters of this one."""
    lines = "\n".join(f"  {line}" for line in FILTERS)
    pytester.makeini(f"[pytest]\nfilterwarnings =\n{lines}\n")
    pytester.makepyfile(test_it=test)
    return pytester.runpytest("-p", "no:cacheprovider", "-p", "no:drapery").parseoutcomes()


@pytest.mark.parametrize(("category", "module", "passes"), CASES)
def test_warnings_that_come_from_here_are_errors(
    pytester: pytest.Pytester, category: str, module: str, passes: bool
) -> None:
    found = outcome(pytester, f"{WARN}\ndef test_it():\n    warn({category}, {module!r})\n")
    assert ("failed" in found) != passes, found


LEFT_OPEN = """
import gc, sqlite3
def test_it():
    sqlite3.connect(":memory:")
    gc.collect()
"""


def test_a_database_that_is_left_open_is_an_error(pytester: pytest.Pytester) -> None:
    assert "failed" in outcome(pytester, LEFT_OPEN)
