"""Registers of lanes, and what stands in for them, calculate what numpy does, to the bit."""

from importlib import import_module
from pathlib import Path
from typing import get_args, get_type_hints

import llvmlite.ir
import numba.core.cgutils
import numba.core.codegen
import numba.core.datamodel
import numba.core.dispatcher
import numba.core.event
import numba.core.options
import numba.core.registry
import numba.extending
import numpy as np
import pytest
from numba import njit, typeof

from drapery import jit
from drapery.cloth import simd, simd_plain
from drapery.jit.sources import SIMD

SETTINGS = {"error_model": "numpy"}


def calculation(module):
    """A function that does of two rows, in a third, all that a register of a module can."""
    count, load, store = module.lane_count, module.load, module.store
    fill, sqrt, flush = module.fill, module.sqrt, module.flush_denormals
    maximum, minimum = module.maximum, module.minimum

    @njit(**SETTINGS)
    def calculated(x, part):
        y = simd.empty_lanes(3, x.shape[1], x)
        y[:2] = x
        for lane in range(0, y.shape[1], count(y)):
            a, b = load(y, 0, lane), load(y, 1, lane)
            d = sqrt(a * a + b * b) / maximum(a, b) - part * minimum(b, a)
            store(y, 2, lane, flush(d + fill(part) * -a, part))
        return y

    return calculated


calculated = {"registers": calculation(simd), "plain": calculation(simd_plain)}


@njit(**SETTINGS)
def first_byte(like):
    return simd.empty_lanes(5, 48, like).ctypes.data


@pytest.mark.parametrize("kind", calculated)
@pytest.mark.parametrize("dtype", [np.float32, np.float64])
def test_each_lane_is_what_numpy_makes_of_it(dtype, kind):
    a, b = np.random.default_rng(3).uniform(-2, 2, (2, 48)).astype(dtype)
    part = dtype(0.3)
    expected = (np.sqrt(a * a + b * b) / np.maximum(a, b) - part * np.minimum(b, a)) + part * -a
    expected[np.abs(expected) < part] = 0
    found = calculated[kind](np.stack([a, b]), part)
    np.testing.assert_array_equal(found, np.stack([a, b, expected]))


@pytest.mark.parametrize("dtype", [np.float32, np.float64])
def test_empty_lanes_begin_with_a_cache_line(dtype):
    assert all(first_byte(np.zeros((1, 1), dtype)) % simd.BYTES == 0 for _ in range(5))


@pytest.mark.parametrize("count, lanes", [(0, 0), (1, 16), (16, 16), (17, 32)])
def test_lanes_are_filled_up_to_whole_registers(count, lanes):
    assert simd.padded_count(count, np.float32) == lanes


def test_the_plain_module_has_the_names_of_the_other():
    names = {name for name, value in vars(simd).items() if isinstance(value, jit.NumbaName)}
    assert len(names) == 8
    assert all(isinstance(getattr(simd_plain, name), jit.Kernel) for name in names)


@pytest.fixture
def plain_name(monkeypatch):
    """A name of a module that does not fit, or of `simd_plain`."""
    jit.fits_numba.cache_clear()
    monkeypatch.setattr(jit, "declarations", [])
    yield lambda module: jit.numba_name(module, "fill", "drapery.cloth.simd_plain").make()
    jit.fits_numba.cache_clear()


def test_where_numba_lacks_something_the_plain_module_is_used(plain_name):
    with pytest.warns(UserWarning, match="kernels are slow, because drapery.missing does not fit"):
        assert plain_name("drapery.missing") is simd_plain.fill
    assert plain_name("drapery.cloth.simd_instructions") is not simd_plain.fill


def test_a_variable_chooses_the_plain_module(plain_name, monkeypatch):
    monkeypatch.setenv(SIMD, "0")
    assert plain_name("drapery.cloth.simd_instructions") is simd_plain.fill


INTERNALS = {
    numba.extending: "intrinsic overload lower_builtin models register_model type_callable",
    numba.core.cgutils: "get_or_insert_function if_unlikely",
    numba.core.dispatcher: "Dispatcher",
    numba.core.event: "Listener register unregister",
    numba.core.datamodel: "default_manager",
    numba.core.options.DefaultOptions: "_nrt",
    numba.core.registry.cpu_target.typing_context: "refresh resolve_value_type",
    numba.core.registry.cpu_target.target_context: "refresh call_conv make_array get_value_type",
    numba.core.registry.cpu_target.target_context.codegen(): "set_env _library_class",
    numba.core.codegen.JITCodeLibrary: (
        "_optimize_functions _optimize_final_module _finalize_final_module"
        " _finalize_dynamic_globals _verify_declare_only_symbols serialize_using_object_code"
        " has_dynamic_globals"
    ),
    llvmlite.ir: "Constant DoubleType FloatType FunctionType PointerType Undefined VectorType",
}
"""Names of numba and llvmlite that are not promised to stay, and that kernels are made with."""


@pytest.mark.parametrize("owner", INTERNALS, ids=lambda o: getattr(o, "__name__", type(o).__name__))
def test_numba_and_llvmlite_have_what_kernels_are_made_with(owner):
    """If this fails with new versions: adapt `simd_instructions`, `user_calls` and `drapery.jit`
    with its `calls`, `codegen`, `compiling` and `runtime`, or lower the highest versions in
    pyproject.toml."""
    missing = [name for name in INTERNALS[owner].split() if not hasattr(owner, name)]
    assert not missing


def borrowing_kernels():
    top = Path(jit.__file__).parents[1]
    for path in sorted(top.rglob("*.py")):
        if "@borrowing_kernel" in path.read_text():
            inside = path.relative_to(top.parent).with_suffix("").parts
            functions = vars(import_module(".".join(inside))).values()
            yield from (each for each in functions if isinstance(each, jit.Borrower))


def parts_of(kind):
    """The types in a type of tuples."""
    return set().union(*map(parts_of, get_args(kind))) if get_args(kind) else {kind}


def test_borrowing_kernels_return_no_arrays():
    """Their callers would drop a reference that was never taken."""
    returned = {each: get_type_hints(each.py_func)["return"] for each in borrowing_kernels()}
    assert len(returned) > 50
    for kind in returned.values():
        assert parts_of(kind) <= {float, int, bool, type(None)}


@jit.borrowing_kernel
def number_in(rows, i):
    row = rows[i % 2]
    return row[i]


@pytest.mark.parametrize(
    ("decorator", "counted"), [(jit.kernel, True), (jit.borrowing_kernel, False)]
)
def test_borrowing_kernels_count_no_references(decorator, counted):
    @decorator
    def total(rows, count):
        total = 0.0
        for i in range(count):
            total += number_in(rows, i)
        return total

    types = typeof((np.zeros(2), np.zeros(2))), typeof(1)
    total.dispatcher.compile(types)
    assert ("NRT_incref" in total.dispatcher.inspect_llvm(types)) == counted
