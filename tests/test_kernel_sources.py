"""Every source that a kernel is compiled from is in the hash under which it is stored."""

import os
import shutil
import subprocess
import sys
from collections.abc import Iterator
from importlib import import_module
from itertools import chain
from pathlib import Path

import kernel_reach
import pytest
from kernel_reach import Place, kernels, reached
from test_import_contract import FOLDERS, modules

from drapery import kernel_sources
from drapery.jit import Kernel

ALL = sorted(chain.from_iterable(map(kernels, modules())))
HASH = """
from drapery.cloth.solvers.xpbd import _advance
from drapery.kernel_sources import source_hash
from drapery.web.wasm.module import sources_hash
print(source_hash(_advance.py_func), sources_hash())
"""


def hashed_files(package: str) -> set[Path]:
    import_module(package)
    return {path.resolve() for path in kernel_sources._sources_of(package)}


def test_all_that_a_kernel_refers_to_is_hashed() -> None:
    missing = {
        f"{kernel.module}.{kernel.name} uses {place.module}.{place.name}"
        for kernel in ALL
        for place in reached(kernel)
        if modules()[place.module].resolve()
        not in hashed_files(".".join(kernel.module.split(".")[:2]))
    }
    assert not missing, "\n".join(sorted(missing))


def test_every_kernel_is_found() -> None:
    """What reading the modules finds is what they hold when they are imported."""
    found = {f"{place.module}.{place.name}" for place in ALL}
    for name in {place.module for place in ALL}:
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


FOREIGN = Place("drapery.elementary", "sine_of_turn")
IMPORT = "from drapery.elementary import sine_of_turn\n"
WAYS = {
    "a name": IMPORT + "@kernel\ndef k(x):\n    return sine_of_turn(x)",
    "another name": "from drapery.elementary import sine_of_turn as s\n"
    "@kernel\ndef k(x):\n    return s(x)",
    "an alias": IMPORT + "s = sine_of_turn\n@kernel\ndef k(x):\n    return s(x)",
    "a module": "from drapery import elementary as e\n"
    "@kernel\ndef k(x):\n    return e.sine_of_turn(x)",
    "a whole path": "import drapery.elementary\n"
    "@kernel\ndef k(x):\n    return drapery.elementary.sine_of_turn(x)",
    "a kernel made of it": "from drapery import elementary as e\nk = kernel(e.sine_of_turn)",
    "one that borrows": IMPORT + "@borrowing_kernel\ndef k(x):\n    return sine_of_turn(x)",
    "an entry point": IMPORT + "@entry_point\ndef k(x):\n    return sine_of_turn(x)",
    "a renamed decorator": "from drapery.jit import kernel as c\nd: object = c\n"
    + IMPORT
    + "@d\ndef k(x):\n    return sine_of_turn(x)",
    "numba's own": "from numba.extending import overload\n"
    + IMPORT
    + "@overload(len)\ndef k(x):\n    return lambda: sine_of_turn(x)",
    "another kernel": IMPORT + "@kernel\ndef h(x):\n    return sine_of_turn(x)\n"
    "@kernel\ndef k(x):\n    return h(x)",
    "a table": IMPORT + "TABLE = (sine_of_turn,)\n@kernel\ndef k(x):\n    return TABLE[0](x)",
    "another module": "from drapery.scratch.other import s\n@kernel\ndef k(x):\n    return s(x)",
}


@pytest.mark.parametrize("way", WAYS)
def test_what_a_kernel_refers_to_is_found_however_it_is_named(way: str, scratch: Path) -> None:
    head = "from drapery.jit import borrowing_kernel, entry_point, kernel\n"
    (scratch / "other.py").write_text("from drapery.elementary import sine_of_turn as s\n")
    (scratch / "whole.py").write_text(head + WAYS[way] + "\n")
    (kernel,) = (one for one in kernels("drapery.scratch.whole") if one.name == "k")
    assert FOREIGN in reached(kernel)


def test_an_edit_of_a_shared_source_changes_the_keys(
    tmp_path: Path, untraced_processes: None
) -> None:
    """In a copy: of the kernels that numba and a wheel store, and of the module for pages."""
    for name, folder in FOLDERS.items():
        target = tmp_path / name.replace(".", "/")
        shutil.copytree(folder, target, ignore=shutil.ignore_patterns("__pycache__", "*.png"))

    def keys() -> list[str]:
        env = os.environ | {"PYTHONPATH": str(tmp_path), "PYTHONDONTWRITEBYTECODE": "1"}
        command = [sys.executable, "-c", HASH]
        return subprocess.run(
            command, env=env, capture_output=True, text=True, check=True, cwd=tmp_path
        ).stdout.split()

    before = keys()
    assert before == keys()
    with (tmp_path / "drapery" / "elementary.py").open("a") as file:
        file.write("\n# An edit.\n")
    after = keys()
    assert all(old != new for old, new in zip(before, after, strict=True))
