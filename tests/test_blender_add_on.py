"""The add-on for Blender, without it: the command that it runs, and what it says.

`python -m release.blender.check` runs it in Blender.
"""

import importlib
import shlex
import sys
import tomllib
from collections.abc import Iterator
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest
from docs_blocks import check_command

ROOT = Path(__file__).parent.parent
NAME = "release.blender.drapery_banners"


@pytest.fixture
def add_on(monkeypatch: pytest.MonkeyPatch) -> Iterator[Any]:
    """The module of the add-on; `bpy` has only the names that it needs to be read."""
    types = SimpleNamespace(AddonPreferences=object, Operator=object)
    names = ("StringProperty", "EnumProperty", "FloatProperty")
    props = SimpleNamespace(**dict.fromkeys(names, lambda **_: None))
    monkeypatch.setitem(sys.modules, "bpy", SimpleNamespace(types=types, props=props))
    yield importlib.import_module(NAME)
    del sys.modules[NAME]


def test_it_has_the_version_of_the_package(add_on: Any) -> None:
    project = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))["project"]
    assert ".".join(map(str, add_on.bl_info["version"])) == project["version"]


@pytest.mark.parametrize(
    ("subject", "values", "last"),
    [
        ("model", ["white creeper:lime"], ["--", "white creeper:lime"]),
        ("model", ["-x"], ["--", "-x"]),
        ("garment", ["cape"], ["--", "cape"]),
        ("player", ["dancer", "run", "scarf"], ["--skin=dancer", "--motion=run", "--wear=scarf"]),
        ("player", ["traveller", "walk", ""], ["--skin=traveller", "--motion=walk"]),
    ],
)
def test_its_command_is_one_of_the_program(
    add_on: Any, subject: str, values: list[str], last: list[str]
) -> None:
    fields = dict(zip(add_on.FIELDS[subject], values, strict=True))
    words = add_on.words_of(subject, fields, 1.5, 24, Path("cloth.glb"))
    assert words[-len(last) - 2 :] == ["-o", "cloth.glb", *last]
    check_command(shlex.join(["drapery", *words]))


def test_a_fault_is_the_line_of_the_command(add_on: Any) -> None:
    program = "import sys; sys.exit('noise\\ndrapery: layer 1 is unknown')"
    with pytest.raises(add_on.DraperyError, match=r"^drapery: layer 1 is unknown$"):
        add_on.run_command(sys.executable, ["-c", program])
    with pytest.raises(add_on.DraperyError, match="there is no command 'no-such'; name that"):
        add_on.run_command("no-such", [])
    add_on.run_command(sys.executable, ["-c", ""])
