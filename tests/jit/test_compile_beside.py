"""Kernels are compiled by other processes while a command compiles its first one."""

import os
import shutil
import subprocess
import sys
from collections.abc import Callable
from importlib import import_module
from pathlib import Path
from typing import Any, get_args
from uuid import uuid4

import numpy as np
import pytest

from drapery.cloth import Collider, Collisions, Gravity, MovingCloth, Plane, grid, solver
from drapery.cloth.solvers import driver
from drapery.commands import notices
from drapery.jit import called_next, compiled_beside, expected_call
from drapery.jit.kernel_cache import kernel_cache_status
from drapery.settings import SolverName

KERNEL = """
from drapery.jit import entry_point

@entry_point
def twice(x):
    return 2 * x
"""
FOREVER = """
import sys
import time

def main():
    while True:
        time.sleep(1)
"""

Start = Callable[..., "subprocess.Popen[bytes]"]


@pytest.fixture
def start(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, untraced_processes: None) -> Start:
    """Starts the process with kernels of a module of its own, and an empty cache."""
    (tmp_path / "beside_kernels.py").write_text(KERNEL)
    (tmp_path / "beside_forever").mkdir()
    (tmp_path / "beside_forever" / "__main__.py").write_text(FOREVER)
    monkeypatch.syspath_prepend(str(tmp_path))
    paths = os.pathsep.join([str(tmp_path), os.environ.get("PYTHONPATH", "")])

    def started(*words: str) -> "subprocess.Popen[bytes]":
        return subprocess.Popen(
            [sys.executable, "-m", "drapery.jit.beside", *words],
            stdin=subprocess.PIPE,
            env=os.environ | {"PYTHONPATH": paths, "NUMBA_CACHE_DIR": str(tmp_path / "cache")},
        )

    return started


def test_the_next_kernel_is_stored_for_the_types_of_its_call(start: Start, tmp_path: Path) -> None:
    with called_next(import_module("beside_kernels").twice, (1.5,)):
        expected = expected_call()
    assert expected is not None
    assert expected[0] == "beside_kernels.twice"
    process = start()
    assert process.stdin is not None
    process.stdin.write(expected[1])
    process.stdin.flush()
    assert process.wait() == 0  # it does not wait for the end of its input
    process.stdin.close()
    stored = list((tmp_path / "cache" / "drapery" / "beside_kernels.twice").rglob("*.kernel"))
    assert len(stored) == 1


def test_a_kernel_that_is_compiled_beside_is_awaited_and_not_compiled_again(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, untraced_processes: None
) -> None:
    name = f"beside_{uuid4().hex}"  # which is not stored yet
    (tmp_path / f"{name}.py").write_text(KERNEL)
    monkeypatch.syspath_prepend(str(tmp_path))
    twice = import_module(name).twice
    with called_next(twice, (2.5,)):
        expected = expected_call()
    assert expected is not None
    paths = os.pathsep.join([str(tmp_path), os.environ.get("PYTHONPATH", "")])
    process = subprocess.Popen(
        [sys.executable, "-m", "drapery.jit.beside"],
        stdin=subprocess.PIPE,
        env=os.environ | {"PYTHONPATH": paths},
    )
    assert process.stdin is not None
    process.stdin.write(expected[1])
    process.stdin.flush()
    compiled_beside(expected[0], process.wait)

    def compile_again(*_: Any) -> None:
        raise AssertionError("the kernel was compiled again")

    monkeypatch.setattr("drapery.jit.codegen.compile_kernel", compile_again)
    assert twice(2.5) == 5.0
    process.stdin.close()
    folder = kernel_cache_status().folder
    assert folder is not None
    shutil.rmtree(folder / expected[0])


def test_it_ends_when_the_process_that_started_it_does(start: Start) -> None:
    process = start("beside_forever")
    assert process.stdin is not None
    process.stdin.close()
    assert process.wait() == 0


def test_no_call_is_expected_of_what_is_no_kernel() -> None:
    assert expected_call() is None
    with called_next(len, ("text",)):
        assert expected_call() is None


def test_a_command_starts_them_when_it_compiles_a_kernel_of_cloth(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    cloth: Any = import_module("drapery.cloth.contact.lanes_contact").resolve
    renderer: Any = import_module("drapery.render.soft.bins").sort_into_tiles
    started: list[tuple[Any, ...]] = []
    monkeypatch.setattr(notices, "start_beside", lambda *given: started.append(given))
    with called_next(cloth, (1,)):
        notices.say_compiling(cloth.py_func)
    notices.say_compiling(renderer.py_func)
    names = ["drapery.render.soft", "drapery.cloth.contact.lanes_contact.resolve"]
    assert [name for name, *_ in started] == names
    assert b"resolve" in started[1][2]
    assert capsys.readouterr().err.count("happens once and takes up to a minute") == 2


@pytest.mark.parametrize("name", get_args(SolverName))
def test_whatever_a_step_compiles_first_the_kernel_of_its_solver_is_known(
    name: SolverName, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The longest of all; compiled after what it calls by address, it doubles the time."""
    known = []

    def address(*_: Any) -> int:
        known.append(expected_call())
        raise InterruptedError

    monkeypatch.setattr(driver, "address_of", address)
    ground = Collider(Plane(np.zeros(3), np.array([0.0, 1, 0])))
    met = Collisions([ground], 0.01)
    cloth = MovingCloth.begin(grid(4, 5, 1.0, 1.0), solver(name), collisions=met)
    with pytest.raises(InterruptedError):
        cloth.advance((Gravity(),))
    assert [each[0].rpartition(".")[0] for each in known] == [f"drapery.cloth.solvers.{name}"]
