"""Imports run downhill, nothing hides, and what is installed is what is here."""

import ast
import tomllib
from pathlib import Path

import pytest

ROOT = Path(__file__).parent.parent
ROOMS = {
    "drapery": ROOT / "drapery",
    "drapery.render": ROOT / "render",
    "drapery.assets": ROOT / "assets",
}

# Each room and the rooms it may import. Longest prefix decides; a room may import itself.
LAW: dict[str, set[str]] = {
    "drapery.errors": set(),
    "drapery.mesh": {"errors"},
    "drapery.option": {"errors"},
    "drapery.settings": {"errors", "option"},
    "drapery.jit_cache": set(),
    "drapery.jit": {"jit_cache"},
    "drapery.options": {"errors", "settings"},
    "drapery.yaml_text": {"errors"},
    "drapery.cloth": {"errors", "jit", "mesh"},
    "drapery.banner": {"errors", "assets"},
    "drapery.packs": {"banner"},
    "drapery.assets": set(),
    "drapery.render": {"errors", "jit", "mesh"},
    "drapery.style": {"errors", "jit", "mesh", "settings", "banner", "render"},
    "drapery.scenes": {"errors", "mesh", "settings", "cloth", "banner", "style", "render"},
    "drapery.pictures": {"errors", "mesh", "settings", "banner", "render", "scenes"},
    "drapery.comparison": {"errors", "mesh", "settings", "banner", "render", "pictures", "scenes"},
    "drapery.sheets": {
        *("errors", "settings", "banner", "render", "pictures", "comparison", "scenes"),
    },
    "drapery.beet": {"errors", "settings", "banner", "testing"},
    "drapery.testing": {
        *(
            "errors",
            "options",
            "settings",
            "yaml_text",
            "banner",
            "render",
            "pictures",
            "comparison",
        ),
    },
    "drapery.batch": {
        *("drapery", "errors", "option", "options", "settings", "yaml_text"),
        *("banner", "packs", "style", "render"),
    },
    "drapery.serve": {
        *("drapery", "errors", "option", "options", "settings", "style", "batch"),
    },
    "drapery.studio": {
        *("drapery", "errors", "mesh", "option", "options", "settings"),
        *("cloth", "banner", "packs", "render", "style", "scenes", "pictures"),
    },
}
NOT_INSTALLED = ROOT / "assets" / "drawing"
TOP_FLOOR = {"drapery.cli", "drapery.commands", "drapery.__main__", "drapery"}


def modules() -> dict[str, Path]:
    found = {}
    for package, folder in ROOMS.items():
        for path in sorted(folder.rglob("*.py")):
            if NOT_INSTALLED in path.parents:
                continue
            parts = path.relative_to(folder).with_suffix("").parts
            name = ".".join((package, *parts)).removesuffix(".__init__")
            found[name] = path
    return found


def room_of(name: str) -> str:
    return ".".join(name.split(".")[:2])


def imports_of(path: Path) -> set[str]:
    names: set[str] = set()
    for node in ast.walk(ast.parse(path.read_text())):
        if isinstance(node, ast.Import):
            names |= {alias.name for alias in node.names}
        elif isinstance(node, ast.ImportFrom):
            assert node.level == 0, f"{path}: write imports from the top"
            names.add(node.module or "")
    return {name for name in names if name.split(".")[0] == "drapery"}


@pytest.mark.parametrize("name", sorted(modules()))
def test_imports_run_downhill(name: str) -> None:
    room = room_of(name)
    if room in TOP_FLOOR:
        return
    allowed = LAW.get(room)
    assert allowed is not None, f"{room} has no place in the law of imports"
    for target in imports_of(modules()[name]):
        other = room_of(target)
        assert other == room or other.removeprefix("drapery.") in allowed, f"{name} -> {target}"


def test_every_package_is_installed() -> None:
    config = tomllib.loads((ROOT / "pyproject.toml").read_text())
    listed = set(config["tool"]["setuptools"]["packages"])
    here = {
        ".".join((package, *path.parent.relative_to(folder).parts))
        for package, folder in ROOMS.items()
        for path in folder.rglob("*.py")
        if NOT_INSTALLED not in path.parents
    }
    assert listed == here


def test_no_module_bears_the_name_of_its_function() -> None:
    for name, path in modules().items():
        own = name.rsplit(".", 1)[-1]
        functions = {
            node.name
            for node in ast.parse(path.read_text()).body
            if isinstance(node, ast.FunctionDef)
        }
        assert own not in functions, f"{name} holds a function of its own name"
