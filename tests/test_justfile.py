"""The ten commands of the justfile: each can be run here, and CONTRIBUTING.md names it."""

import os
import re
import shlex
import tomllib
from importlib.util import find_spec
from pathlib import Path

import pytest
from packaging.requirements import Requirement

ROOT = Path(__file__).parent.parent
RECIPE = re.compile(r"(?m)^# (.+)\n(\w+)[^:\n]*:\n((?:    .+\n)+)")
RECIPES = {
    name: lines.split("\n")[:-1]
    for _, name, lines in RECIPE.findall((ROOT / "justfile").read_text("utf-8"))
}
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))["project"]


def test_the_guide_names_each_command() -> None:
    text = (ROOT / "CONTRIBUTING.md").read_text("utf-8")
    assert re.findall(r"(?m)^\| `just (\w+)` \|", text) == [*RECIPES]
    assert len(RECIPES) == 10


@pytest.mark.parametrize("name", RECIPES)
def test_a_command_runs_what_is_here(name: str) -> None:
    """A module, a script of the checkout, or a program that an extra installs."""
    extras = PROJECT["optional-dependencies"]
    tools = {Requirement(each).name for kind in ("dev", "docs") for each in extras[kind]}
    for line in RECIPES[name]:
        program, *words = shlex.split(line)
        if program == "python":
            is_module = words[0] == "-m"
            assert find_spec(words[1]) if is_module else (ROOT / words[0]).is_file(), line
        elif "/" in program:
            assert os.access(ROOT / program, os.X_OK), line
        else:
            assert program == "pip" or program in tools, line
