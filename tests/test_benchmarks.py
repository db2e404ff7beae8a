"""Every benchmark takes `--quick`, by which `.ci/versions benchmarks` runs all of them."""

from pathlib import Path

import pytest

from benchmarks.all import PARTS, names

FOLDER = Path(__file__).parents[1] / "benchmarks"


@pytest.mark.parametrize("name", names())
def test_a_benchmark_runs_by_itself_and_has_a_quick_mode(name: str) -> None:
    text = (FOLDER / f"{name}.py").read_text("utf-8")
    assert 'if __name__ == "__main__":' in text
    assert "add_quick(" in text


def test_parts_are_no_benchmarks_of_their_own() -> None:
    for name in {*PARTS} - {"all"}:
        assert "__main__" not in (FOLDER / f"{name}.py").read_text("utf-8")


def test_the_part_of_the_versions_runs_all() -> None:
    script = (FOLDER.parent / ".ci" / "versions").read_text("utf-8")
    assert "benchmarks() { python -m benchmarks.all; }" in script
