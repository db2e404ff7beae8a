"""Compiled kernels follow their sources, survive damage, and need no folder to write to."""

import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np
import pytest

from drapery.jit import entry_point, kernel_cache as jit_cache
from drapery.jit.kernel_cache import KernelCacheStatus

CALLEE = "from drapery.jit import kernel\n\n@kernel\ndef part(x):\n    return x + {number}\n"
CALLER = """
from drapery.jit import entry_point
from .parts import part

@entry_point
def total(x):
    return 2 * part(x)
"""
USE = """
import sys
import drapery
drapery.__path__.append({root!r})
from drapery.{name}.whole import total
print(total(1.0), "numba" not in sys.modules)
"""
NO_FOLDER = """
import warnings
from pathlib import Path
warnings.simplefilter("always")
from drapery.jit import kernel_cache as jit_cache
jit_cache.try_folder = lambda folder, private: Path("/dev/null/kernels").mkdir()
from drapery.jit import entry_point, kernel

@entry_point
def first(x):
    return x + 1.0

@entry_point
def second(x):
    return x + 2.0

print(first(1.0) + second(1.0), jit_cache.kernel_cache_status().folder)
"""


def make_package(folder, number=1):
    """A package of two modules with kernels."""
    folder.mkdir()
    (folder / "__init__.py").write_text("")
    (folder / "parts.py").write_text(CALLEE.format(number=number))
    (folder / "whole.py").write_text(CALLER)


@pytest.fixture
def package(tmp_path, untraced_processes):
    """A function that runs a package with kernels in a new process."""
    folder = tmp_path / "scratch_kernels"
    make_package(folder)

    def run():
        program = USE.format(root=str(tmp_path), name=folder.name)
        return run_program(program, tmp_path / "cache").stdout.split()

    run.callee, run.cache = folder / "parts.py", tmp_path / "cache"
    return run


def run_program(program, cache):
    env = os.environ | {"NUMBA_CACHE_DIR": str(cache), "PYTHONDONTWRITEBYTECODE": "1"}
    command = [sys.executable, "-c", program]
    return subprocess.run(command, env=env, capture_output=True, text=True, check=True, timeout=120)


def test_an_edited_callee_in_another_file_is_compiled_again(package):
    assert package() == ["4.0", "False"]
    package.callee.write_text(CALLEE.format(number=5))
    assert package() == ["12.0", "False"]
    assert package() == ["12.0", "True"]


def test_equal_sources_in_two_folders_share_their_kernels(package, tmp_path):
    assert package() == ["4.0", "False"]
    copied = tmp_path / "other" / "scratch_kernels"
    shutil.copytree(package.callee.parent, copied, ignore=shutil.ignore_patterns("__pycache__"))
    program = USE.format(root=str(copied.parent), name=copied.name)
    assert run_program(program, package.cache).stdout.split() == ["4.0", "True"]


def test_kernels_of_a_few_states_of_the_sources_are_kept(tmp_path, monkeypatch):
    status = jit_cache.KernelCacheStatus(tmp_path)
    monkeypatch.setattr(jit_cache, "kernel_cache_status", lambda: status)
    monkeypatch.setattr(jit_cache, "MAX_SOURCES", 3)
    for number in range(5):
        folder = jit_cache.folder_for("kernel", f"sources {number}")
        os.utime(folder, (number, number))
    kept = [jit_cache.folder_for("kernel", f"sources {number}") for number in (2, 3, 4)]
    assert sorted((tmp_path / "kernel").iterdir()) == sorted(kept)


def with_a_wrong_byte(content):
    middle = len(content) // 2
    return content[:middle] + bytes([content[middle] ^ 0xFF]) + content[middle + 1 :]


DAMAGES = (lambda content: b"", lambda content: content[: len(content) // 2], with_a_wrong_byte)


@pytest.mark.slow
def test_damaged_cache_files_are_rebuilt(tmp_path, untraced_processes):
    """A package for each damage; one process uses all packages."""
    program, numbers = "", range(len(DAMAGES))
    for number in numbers:
        make_package(tmp_path / f"scratch{number}", number)
        program += USE.format(root=str(tmp_path), name=f"scratch{number}")

    def run():
        words = run_program(program, tmp_path / "cache").stdout.split()
        return [float(word) for word in words[::2]], words[1::2]

    totals = [2.0 * (1 + number) for number in numbers]
    assert run() == (totals, ["False"] * len(DAMAGES))
    for number, damage in enumerate(DAMAGES):
        folder = tmp_path / "cache" / "drapery" / f"drapery.scratch{number}.whole.total"
        (path,) = folder.rglob("*.kernel")
        path.write_bytes(damage(path.read_bytes()))
    assert run()[0] == totals
    assert run() == (totals, ["True"] * len(DAMAGES))


def test_without_a_folder_kernels_are_compiled_and_one_warning_says_so(tmp_path):
    run = run_program(NO_FOLDER, tmp_path)
    assert run.stdout.split() == ["5.0", "None"]
    assert run.stderr.count("UserWarning: kernels are compiled in every process") == 1
    assert "NUMBA_CACHE_DIR" in run.stderr


def test_kernels_are_stored_with_temporary_files_if_no_other_folder_is_writable():
    program = "from drapery.jit.kernel_cache import *; print(kernel_cache_status().folder)"
    run = run_program(program, Path("/dev/null/kernels"))
    assert Path(run.stdout.strip()).parent == Path(tempfile.gettempdir())
    assert not run.stderr


def test_a_shared_folder_of_temporary_files_is_not_trusted(tmp_path, monkeypatch):
    open_to_all = tmp_path / "kernels"
    open_to_all.mkdir()
    open_to_all.chmod(0o777)
    if hasattr(os, "getuid"):
        with pytest.raises(PermissionError):
            jit_cache.try_folder(open_to_all, private=True)
    jit_cache.try_folder(tmp_path / "own", private=True)


def test_kernels_whose_arguments_have_other_fields_are_compiled_again(package, tmp_path):
    tuples = (
        "from typing import NamedTuple\n\nclass Two(NamedTuple):\n    {}: float\n    {}: float\n"
    )
    folder = package.callee.parent
    (folder / "two.py").write_text(tuples.format("low", "high"))
    (folder / "gap.py").write_text(
        "from drapery.jit import entry_point\n\n@entry_point\ndef gap(two):\n"
        "    return two.high - two.low\n"
    )
    use = USE.replace("whole import total", "gap import gap").replace(
        "total(1.0)", "gap(Two(1.0, 3.0))"
    )
    use = use.replace("\nprint", "\nfrom drapery.{name}.two import Two\nprint")
    program = use.format(root=str(tmp_path), name=folder.name)
    assert run_program(program, package.cache).stdout.split() == ["2.0", "False"]
    assert run_program(program, package.cache).stdout.split() == ["2.0", "True"]
    (folder / "two.py").write_text(tuples.format("high", "low"))
    assert run_program(program, package.cache).stdout.split() == ["-2.0", "False"]


def test_an_edit_elsewhere_in_the_files_of_a_kernel_compiles_nothing(package):
    assert package() == ["4.0", "False"]
    package.callee.write_text(
        "NEW = 1\n" + CALLEE.format(number=1) + "\n\ndef other():\n    pass\n"
    )
    assert package() == ["4.0", "True"]


def test_a_later_picture_needs_no_numba(untraced_processes):
    program = "import sys; from drapery import Banner, draw\n"
    program += "draw(Banner.parse('white creeper:lime'), size=(32, 32))\n"
    program += "print({'numba', 'scipy'} & set(sys.modules))"
    command = [sys.executable, "-c", program]
    runs = [subprocess.run(command, capture_output=True, check=True) for _ in range(2)]
    assert runs[1].stdout.split() == [b"set()"]


@entry_point
def results(number, fraction):
    return number, (fraction, -number), 0


@entry_point
def half_of(fraction):
    return fraction / 2


@entry_point
def as_it_is(row):
    return row


def test_results_are_numbers_and_tuples_of_them():
    assert results(3, 0.5) == (3, (0.5, -3), 0)
    assert half_of(0.5) == 0.25


def test_an_array_as_a_result_is_refused():
    with pytest.raises(TypeError, match="cannot return array"):
        as_it_is(np.zeros(3))


def test_code_that_needs_numba_is_not_stored(tmp_path, monkeypatch):
    """It calls what numba alone brings into a process: a symbol of LAPACK."""
    monkeypatch.setattr(jit_cache, "kernel_cache_status", lambda: KernelCacheStatus(tmp_path))

    @entry_point
    def determinant(matrix):
        return np.linalg.det(matrix)

    assert determinant(np.eye(3)) == 1
    assert not list(tmp_path.rglob("*.kernel"))
    assert half_of(1) == 0.5
    assert list(tmp_path.rglob("*.kernel"))
