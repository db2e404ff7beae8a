"""The key of a kernel has all that it is compiled from, and nothing else."""

import json
import os
import shutil
import subprocess
import sys
from collections.abc import Callable, Iterator
from functools import cache
from importlib import import_module
from itertools import chain
from pathlib import Path

import kernel_reach
import pytest
from kernel_reach import WHOLE, Place, functions, kernels, last_line, reached
from source_modules import FOLDERS, modules

from drapery.jit import EntryPoint, Kernel, sources as kernel_sources

KEYS = """
import json, sys
from importlib import import_module
from drapery.jit.sources import source_key
found = {name: source_key(getattr(import_module(name[0]), name[1])) for name in NAMES}
unwanted = sorted({"numba", "scipy"} & set(sys.modules))
print(json.dumps([[[name, key] for name, key in found.items()], unwanted]))
"""


@cache
def all_kernels() -> list[Place]:
    """All functions that are compiled: reading every module takes seconds."""
    return sorted(chain.from_iterable(map(kernels, modules())))


@cache
def entry_points() -> dict[Place, EntryPoint]:
    """The kernels that Python calls."""
    found = {place: getattr(import_module(place.module), place.name) for place in all_kernels()}
    return {place: made for place, made in found.items() if isinstance(made, EntryPoint)}


@cache
def compiled_by(place: Place) -> list[Place]:
    """The functions that a kernel is compiled from, as its text names them."""
    return [*functions(reached(place), of_kernels())]


@cache
def of_kernels() -> frozenset[Place]:
    """The functions that kernels are made of."""
    loaded = (vars(import_module(name)) for name in {place.module for place in all_kernels()})
    made = (each for values in loaded for each in values.values() if isinstance(each, Kernel))
    return frozenset(Place(k.py_func.__module__, k.py_func.__qualname__) for k in made)


def test_a_key_has_all_that_the_text_of_a_kernel_names() -> None:
    """What reading the modules finds is what following their objects does."""
    for place, made in entry_points().items():
        texts = "\n".join(node.text for node in kernel_sources.reached(made))
        for each in compiled_by(place):
            found = f"function {each.module}.{each.name} " in texts
            assert found or f"module {each.module} " in texts, (place, each)
        assert kernel_sources.source_key(made)


def test_an_edit_of_any_function_that_a_kernel_is_compiled_from_changes_its_key(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    by_function: dict[Place, Place] = {}
    for place in entry_points():
        by_function |= dict.fromkeys(compiled_by(place), place)
    assert len(by_function) > 300
    read = kernel_sources.source_lines
    before = {place: kernel_sources.source_key(made) for place, made in entry_points().items()}
    for function, place in by_function.items():

        def edited(path: str, function: Place = function) -> list[str]:
            lines = list(read(path))
            if Path(path) == modules()[function.module]:
                lines[last_line(function) - 1] += "  # edited"
            return lines

        monkeypatch.setattr(kernel_sources, "source_lines", cache(edited))
        kernel_sources.forget()
        assert kernel_sources.source_key(entry_points()[place]) != before[place], function
    monkeypatch.undo()
    kernel_sources.forget()


def test_every_kernel_is_found() -> None:
    """What reading the modules finds is what they hold when they are imported."""
    found = {f"{place.module}.{place.name}" for place in all_kernels()}
    for name in {place.module for place in all_kernels()}:
        for key, value in vars(import_module(name)).items():
            if isinstance(value, Kernel) and value.__module__ == name:
                assert f"{name}.{key}" in found
    assert len(found) > 350


@pytest.fixture
def scratch(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Path]:
    """A folder whose modules are known by their names in `drapery.scratch`."""

    def found() -> dict[str, Path]:
        return modules() | {f"drapery.scratch.{path.stem}": path for path in tmp_path.glob("*.py")}

    monkeypatch.setattr(kernel_reach, "modules", found)
    kernel_reach.forget()
    yield tmp_path
    kernel_reach.forget()


FOREIGN = Place("drapery.elementary", "sine_of_turns")
IMPORT = "from drapery.elementary import sine_of_turns\n"
WAYS = {
    "a name": IMPORT + "@kernel\ndef k(x):\n    return sine_of_turns(x)",
    "another name": "from drapery.elementary import sine_of_turns as s\n"
    "@kernel\ndef k(x):\n    return s(x)",
    "an alias": IMPORT + "s = sine_of_turns\n@kernel\ndef k(x):\n    return s(x)",
    "a module": "from drapery import elementary as e\n"
    "@kernel\ndef k(x):\n    return e.sine_of_turns(x)",
    "a whole path": "import drapery.elementary\n"
    "@kernel\ndef k(x):\n    return drapery.elementary.sine_of_turns(x)",
    "a kernel made of it": "from drapery import elementary as e\nk = kernel(e.sine_of_turns)",
    "one that borrows": IMPORT + "@borrowing_kernel\ndef k(x):\n    return sine_of_turns(x)",
    "an entry point": IMPORT + "@entry_point\ndef k(x):\n    return sine_of_turns(x)",
    "a renamed decorator": "from drapery.jit import kernel as c\nd: object = c\n"
    + IMPORT
    + "@d\ndef k(x):\n    return sine_of_turns(x)",
    "numba's own": "from numba.extending import overload\n"
    + IMPORT
    + "@overload(len)\ndef k(x):\n    return lambda: sine_of_turns(x)",
    "another kernel": IMPORT + "@kernel\ndef h(x):\n    return sine_of_turns(x)\n"
    "@kernel\ndef k(x):\n    return h(x)",
    "a table": IMPORT + "TABLE = (sine_of_turns,)\n@kernel\ndef k(x):\n    return TABLE[0](x)",
    "another module": "from drapery.scratch.other import s\n@kernel\ndef k(x):\n    return s(x)",
}


@pytest.mark.parametrize("way", WAYS)
def test_what_a_kernel_refers_to_is_found_however_it_is_named(way: str, scratch: Path) -> None:
    head = "from drapery.jit import borrowing_kernel, entry_point, kernel\n"
    (scratch / "other.py").write_text("from drapery.elementary import sine_of_turns as s\n")
    (scratch / "whole.py").write_text(head + WAYS[way] + "\n")
    (kernel,) = (one for one in kernels("drapery.scratch.whole") if one.name == "k")
    assert FOREIGN in reached(kernel)


@pytest.fixture
def copied(tmp_path: Path, untraced_processes: None) -> "Copied":
    """A function that reads the keys of all kernels in a copy of the project."""
    for name, folder in FOLDERS.items():
        target = tmp_path / name.replace(".", "/")
        # With the bytecode, which is read where a source has its time and size, and is not written.
        shutil.copytree(folder, target, ignore=shutil.ignore_patterns("*.png"))
    program = f"NAMES = {[tuple(place) for place in entry_points()]}\n{KEYS}"

    def keys() -> dict[tuple[str, ...], str]:
        env = os.environ | {"PYTHONPATH": str(tmp_path), "PYTHONDONTWRITEBYTECODE": "1"}
        done = subprocess.run(
            [sys.executable, "-c", program],
            env=env,
            capture_output=True,
            text=True,
            check=True,
            cwd=tmp_path,
        )
        keys, unwanted = json.loads(done.stdout)
        assert not unwanted, "making keys imports what takes long to import"
        return {tuple(name): key for name, key in keys}

    return keys


Copied = Callable[[], dict[tuple[str, ...], str]]


def copy_of(root: Path, path: Path) -> Path:
    """Where the copy of a file of the project is."""
    for name, folder in FOLDERS.items():
        if name != "drapery" and path.is_relative_to(folder):
            return root / name.replace(".", "/") / path.relative_to(folder)
    return root / "drapery" / path.relative_to(FOLDERS["drapery"])


def test_an_edit_of_files_without_kernels_changes_no_key(tmp_path: Path, copied: Copied) -> None:
    before = copied()
    used = {place.module for kernel in entry_points() for place in compiled_by(kernel)}
    used |= {
        place.module for kernel in all_kernels() for place in reached(kernel) if place.name == WHOLE
    }
    used.add("drapery.jit.calls")
    others = {name: path for name, path in modules().items() if name not in used}
    assert {"drapery.cloth.fabric", "drapery.render.camera"} <= set(others)
    for path in others.values():
        with copy_of(tmp_path, path).open("a", encoding="utf-8") as file:
            file.write("\nAN_EDIT = 1\n")
    assert copied() == before


EDITS = {
    "a constant of another module": (
        *("drapery/cloth/kernels.py", "MIN_SPEED = 1e-9", "MIN_SPEED = 2e-9"),
        Place("drapery.cloth.solvers.xpbd", "_advance_sheet"),
    ),
    "a constant from which another is made": (
        *("drapery/jit/__init__.py", "REGISTER = 64", "REGISTER = 32"),
        Place("drapery.cloth.solvers.xpbd", "_advance"),
    ),
    "the fields of a named tuple": (
        *("drapery/cloth/contact/smoothness.py", "    tangents: Array\n", ""),
        Place("drapery.cloth.contact.lanes_contact", "resolve"),
    ),
    "the options of the compiler": (
        *("drapery/jit/__init__.py", '"no_cfunc_wrapper": True', '"no_cfunc_wrapper": False'),
        Place("drapery.styles.kernels", "blur"),
    ),
    "what numba imports by name": (
        *("drapery/cloth/live_choices.py", "batch, 1, substeps)", "batch, 2, substeps)"),
        Place("drapery.cloth.live", "play"),
    ),
    "a choice that numba makes": (
        *("drapery/cloth/live.py", "desbrun.DesbrunPlan: desbrun._advance,", ""),
        Place("drapery.cloth.live", "play"),
    ),
}


def test_an_edit_of_what_a_kernel_holds_changes_its_key(tmp_path: Path, copied: Copied) -> None:
    before = copied()
    for name, (path, old, new, place) in EDITS.items():
        file = tmp_path / path
        text = file.read_text()
        assert old in text, name
        file.write_text(text.replace(old, new))
        assert copied()[place] != before[place], name
        file.write_text(text)
    assert copied() == before


def test_a_kernel_that_uses_what_has_no_text_has_no_key() -> None:
    unknown = object()
    assert kernel_sources.source_key(lambda: unknown) is None
    made: dict[str, Callable[[], int]] = {}
    exec("def written(): return 1", made)
    assert kernel_sources.source_key(made["written"]) is None
