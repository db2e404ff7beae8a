"""Kernels that were compiled ahead of time: their arguments, their library, and their bits."""

import os
import re
import subprocess
import sys
import weakref
from pathlib import Path
from typing import NamedTuple

import llvmlite.ir
import numpy as np
import pytest
from numba import typeof

from drapery.jit import arguments as arguments_of, entry_point, library
from drapery.jit.arguments import pack
from drapery.jit.runtime import add_runtime

RELEASE = Path(__file__).parents[2] / "release"


class Pair(NamedTuple):
    first: object
    second: object


class OtherPair(NamedTuple):
    first: object
    second: object


def read_only(array):
    array.flags.writeable = False
    return array


VALUES = (
    *(1, 2**40, True, 0.5, np.float32(0.5), np.uint8(3), np.bool_(True), ()),
    *(np.zeros(3), np.zeros(3, np.float32), np.zeros(6)[::2], read_only(np.zeros(3))),
    *(np.zeros((2, 3)), np.zeros((2, 3)).T, np.zeros((4, 6))[::2, ::2], np.zeros((0, 3))),
    *(np.zeros(2, [("x", "i4"), ("y", "f4")]), np.zeros(2, [("x", "i4"), ("z", "f4")])),
    *((1, 2), (1, 2.0), ((1,), 2), (1, (2,)), Pair(1, 2), OtherPair(1, 2), Pair(1, 2.0)),
)


def test_arguments_with_the_same_types_have_the_same_types_for_numba():
    for one in VALUES:
        for other in VALUES:
            if pack((one,)).types == pack((other,)).types:
                assert typeof(one) == typeof(other), (one, other)


@pytest.mark.parametrize("value", [None, "text", 1 + 2j, [1], np.datetime64(0, "s")])
def test_other_arguments_are_refused(value):
    with pytest.raises(TypeError, match="a kernel takes no "):
        pack((1, (value,)))


@pytest.mark.parametrize("value", [2**63, -(2**63) - 1])
def test_integers_beyond_64_bits_are_refused(value):
    with pytest.raises(OverflowError, match="64 bits"):
        pack((value,))


def test_an_array_is_its_size_place_shape_and_strides():
    array = np.zeros((4, 6), np.float32)[:, ::2]
    words = pack((array, 7)).words
    assert words == [0, 0, 12, 4, array.ctypes.data, 4, 3, 24, 8, 7]


def test_numbers_keep_their_bits():
    words = pack((0.1, np.float32(0.1), -1, True)).words
    assert np.array(words[:1]).view(float) == [0.1]
    assert np.array(words[1:2]).view(np.float32)[0] == np.float32(0.1)
    assert words[2:] == [-1, 1]


@entry_point
def scaled_sum(numbers, pair, factor, negative):
    """A sum of a copy, to use memory of numba's; called by tests only."""
    copied = np.zeros(numbers.size, numbers.dtype)
    for i in range(numbers.size):
        copied[i] = factor * numbers[i] + pair.second[i]
    for i in range(numbers.size):
        numbers[i] = copied[numbers.size - 1 - i]
    return not negative


def arguments():
    return np.linspace(0, 1, 7, dtype=np.float32), Pair(1, np.arange(7.0)), 0.3, False


BUILD = """
import os, sys
os.environ |= {"NUMBA_OPT": "0", "DRAPERY_AOT": "0"}
sys.path[:0] = [*TESTS, ROOT]
from pathlib import Path
import numba
import test_aot
from drapery.jit.arguments import pack
from drapery.jit.library import machine
from release import kernels
given = test_aot.arguments()
test_aot.scaled_sum(*given)
types = tuple(map(numba.typeof, given))
call = kernels.Call(test_aot.scaled_sum, pack(given).types, types)
kernels.build(Path(sys.argv[1]), (sys.platform, machine()), [call])
"""


@pytest.fixture(scope="module")
def built(tmp_path_factory):
    """A library with one kernel."""
    pytest.importorskip("ziglang")
    if not library.has_registers():
        pytest.skip("the processor has no AVX2, for which libraries are compiled")
    folder = tmp_path_factory.mktemp("aot")
    path = folder / library.library_path().name
    places = {"TESTS": [*map(str, Path(__file__).parents[:2])], "ROOT": str(RELEASE.parent)}
    lines = [f"{name} = {value!r}" for name, value in places.items()]
    env = os.environ | {"NUMBA_CACHE_DIR": str(folder / "cache")}
    command = [sys.executable, "-c", "\n".join([*lines, BUILD]), path]
    done = subprocess.run(command, env=env, capture_output=True, text=True, timeout=600)
    assert done.returncode == 0, done.stderr
    return path


@pytest.fixture
def use(monkeypatch):
    """A function that makes a library the one of this installation; it returns its kernels."""

    monkeypatch.delenv(library.OFF, raising=False)

    def use(path):
        monkeypatch.setattr(library, "library_path", lambda: path)
        library.installed_library.cache_clear()
        return library.kernels_of(scaled_sum)

    yield use
    library.installed_library.cache_clear()


def test_a_library_calculates_what_numba_does(built, use):
    (kernel,) = use(built).values()
    ours, theirs = arguments(), arguments()
    assert kernel(pack(ours).words) is scaled_sum(*theirs) is True
    assert ours[0].tobytes() == theirs[0].tobytes()
    assert kernel(pack((*arguments()[:3], True)).words) is False
    assert kernel.address  # other kernels call it there


def test_a_library_of_other_sources_is_not_used(built, use, monkeypatch):
    assert use(built)
    monkeypatch.setattr(library, "source_key", lambda function: "other")
    assert not library.kernels_of(scaled_sum)


@pytest.mark.parametrize("content", [b"", b"no library"])
def test_a_damaged_library_is_not_used(content, tmp_path, use):
    path = tmp_path / "damaged.so"
    path.write_bytes(content)
    assert not use(path)


def test_a_missing_library_is_not_used(tmp_path, use):
    assert not use(tmp_path / "missing.so")


def test_a_variable_turns_the_library_off(built, use, monkeypatch):
    monkeypatch.setenv(library.OFF, "0")
    assert not use(built)


def test_a_library_of_another_layout_is_not_used(built, use, monkeypatch):
    monkeypatch.setattr(library, "ABI", library.ABI + 1)
    assert not use(built)


def test_numba_is_imported_only_for_kernels():
    """Its import takes longer than all else that a command does before it draws."""
    program = "import sys; import drapery.cli, drapery.stage.bodies, drapery.render.soft\n"
    program += "from drapery.cloth import Fabric, Gravity, Wind, grid, rest_state\n"
    program += "from drapery.render import Camera\nfrom drapery.styles import STEPS\n"
    program += "print(sorted({'numba', 'llvmlite', 'scipy', 'trimesh'} & set(sys.modules)))"
    run = subprocess.run([sys.executable, "-c", program], capture_output=True, check=True)
    assert run.stdout.split() == [b"[]"]


def test_a_command_with_plain_options_imports_what_it_needs(tmp_path):
    """typer would import pydantic for every option, a sixth of the time of a picture."""
    program = "import sys; from drapery.commands.app import command_line\n"
    program += (
        "words = ['flat', 'white', '-o', 'flat.png', '--scale', '2', '--pack', sys.argv[1]]\n"
    )
    program += "command_line(words)(words, standalone_mode=False)\n"
    program += "others = {'pydantic', 'drapery.commands.animate'}\n"
    program += "print(sorted(others & set(sys.modules)))"
    (tmp_path / "pack.mcmeta").write_text('{"pack": {"pack_format": 46, "description": ""}}')
    command = [sys.executable, "-c", program, str(tmp_path)]
    run = subprocess.run(command, capture_output=True, check=True, cwd=tmp_path)
    assert run.stdout.split() == [b"[]"]


def test_cloth_of_a_picture_is_made_without_scipy():
    """Its import would take half the time of a later picture; numba imports it too."""
    program = "import sys; from drapery.style import ClothSpec, cloth_at_rest\n"
    program += (
        "spec = ClothSpec((5, 9), (1.0, 2.0), 'top', 'xpbd', itself=True, thickness=0.1)\n"
        "cloth_at_rest(spec, 1 / 60)\n"
    )
    program += "print('scipy' in sys.modules)"
    run = subprocess.run([sys.executable, "-c", program], capture_output=True, check=True)
    assert run.stdout.split() == [b"False"]


def test_kernels_have_the_memory_that_kernels_in_pages_have():
    """The module of pages is linked in every run of the tests; not all kernels are."""
    module = llvmlite.ir.Module()
    add_runtime(module)
    ours = {each.name for each in module.functions if each.blocks}
    text = (Path(library.__file__).parents[1] / "web/wasm/runtime.c").read_text()
    theirs = set(re.findall(r"\b(?:NRT|numba)_\w+(?=\()", text))
    assert theirs and theirs <= ours


def test_a_tuple_that_is_packed_again_has_its_present_words():
    pair = Pair(np.zeros(3), (np.arange(2), 7))
    before = pack((pair, 1))
    assert pack((pair, 1)) == before
    pair.first[:] = 1  # the words hold places, not values
    assert pack((pair, 1)) == before
    for number in range(100):  # tuples that are freed; others get their places in memory
        assert pack(((number, np.zeros(1)),)).words[0] == number
    assert pack((pair, 1)) == before


def test_few_tuples_are_kept_and_none_with_large_arrays():
    def packed(size):
        array = np.zeros(size)
        pack(((size, array),))
        return weakref.ref(array)

    small = [packed(size) for size in range(1, 101)]
    assert sum(array() is not None for array in small) == arguments_of.MOST_KEPT
    assert packed(arguments_of.MOST_BYTES)() is None
