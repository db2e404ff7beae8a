"""Registers of lanes calculate what numpy does, to the bit."""

import llvmlite.ir
import numba.core.caching
import numba.core.cgutils
import numba.core.datamodel
import numba.core.dispatcher
import numba.core.event
import numba.core.registry
import numba.extending
import numba.misc.appdirs
import numpy as np
import pytest
from numba import njit

from drapery.cloth import simd

SETTINGS = {"error_model": "numpy"}


@njit(**SETTINGS)
def calculated(x, part):
    """Of two rows, in a third: all that a register can."""
    y = simd.empty_lanes(3, x.shape[1], x)
    y[:2] = x
    for lane in range(0, y.shape[1], simd.lane_count(y)):
        a, b = simd.load(y, 0, lane), simd.load(y, 1, lane)
        d = simd.sqrt(a * a + b * b) / simd.maximum(a, b) - part * b
        simd.store(y, 2, lane, simd.flush_denormals(d + simd.fill(part) * -a, part))
    return y


@njit(**SETTINGS)
def first_byte(like):
    return simd.empty_lanes(5, 48, like).ctypes.data


@pytest.mark.parametrize("dtype", [np.float32, np.float64])
def test_each_lane_is_what_numpy_makes_of_it(dtype):
    a, b = np.random.default_rng(3).uniform(-2, 2, (2, 48)).astype(dtype)
    part = dtype(0.3)
    expected = (np.sqrt(a * a + b * b) / np.maximum(a, b) - part * b) + part * -a
    expected[np.abs(expected) < part] = 0
    found = calculated(np.stack([a, b]), part)
    np.testing.assert_array_equal(found, np.stack([a, b, expected]))


@pytest.mark.parametrize("dtype", [np.float32, np.float64])
def test_empty_lanes_begin_with_a_cache_line(dtype):
    assert all(first_byte(np.zeros((1, 1), dtype)) % simd.BYTES == 0 for _ in range(5))


@pytest.mark.parametrize("count, lanes", [(0, 0), (1, 16), (16, 16), (17, 32)])
def test_lanes_are_filled_up_to_whole_registers(count, lanes):
    assert simd.padded_count(count, np.float32) == lanes


INTERNALS = {
    numba.extending: "intrinsic overload lower_builtin models register_model type_callable",
    numba.core.cgutils: "get_or_insert_function if_unlikely",
    numba.core.caching: "_CacheLocator CompileResultCacheImpl FunctionCache IndexDataCacheFile",
    numba.core.dispatcher: "Dispatcher",
    numba.core.event: "Listener register unregister",
    numba.core.datamodel: "default_manager",
    numba.misc.appdirs: "AppDirs",
    numba.core.registry.cpu_target.typing_context: "refresh resolve_value_type",
    numba.core.registry.cpu_target.target_context: "refresh call_conv make_array get_value_type",
    llvmlite.ir: "Constant DoubleType FloatType FunctionType PointerType Undefined VectorType",
}
"""Names of numba and llvmlite that are not promised to stay, and that kernels are made with."""


@pytest.mark.parametrize("owner", INTERNALS, ids=lambda o: getattr(o, "__name__", type(o).__name__))
def test_numba_and_llvmlite_have_what_kernels_are_made_with(owner):
    """If this fails with new versions: adapt `simd_instructions`, `jit`, `jit_cache`, `jit_calls`
    and `user_calls`, or lower the highest versions in pyproject.toml."""
    missing = [name for name in INTERNALS[owner].split() if not hasattr(owner, name)]
    assert not missing
