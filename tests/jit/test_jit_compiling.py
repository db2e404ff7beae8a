"""Functions that only kernels call are linked as text: no machine code of their own, the same
results."""

import gc
import operator
import sys
import threading
from typing import Any

import numpy as np
import pytest
from numba import njit
from numba.core import codegen, event, ir, utils
from numba.core.compiler import run_frontend
from numba.core.errors import TypingError

from drapery import jit
from drapery.jit import address_of, call_by_address, entry_point, kernel
from drapery.jit.arguments import pack
from drapery.jit.codegen import compile_kernel, types_of

ROW = np.arange(5.0)


@kernel
def last_times_five(row: Any) -> Any:
    return row[-1] * 5


@entry_point
def with_sum(row: Any) -> Any:
    return last_times_five(row) + np.sum(row)


@kernel
def one_more(row: Any) -> Any:
    return with_sum(row) + 1


@entry_point
def outermost(row: Any) -> Any:
    return one_more(row) + last_times_five(row)


@kernel
def checked(number: int) -> int:
    if number < 0:
        raise ValueError("the number is negative")
    return number


@entry_point
def checks(number: int) -> int:
    return checked(number)


@entry_point
def reshapes(row: Any, count: int) -> Any:
    return row.reshape((count, 1))[0, 0]


@kernel
def chosen(row: Any, at: Any, ends: Any, whole: Any) -> Any:
    return row[at] + row[ends[1]] if whole else row[at]


@entry_point
def chooses(row: Any) -> Any:
    last = len(row) - 1
    total = chosen(row, 1, (0, 2), True) + chosen(row, last, (0, last - 1), row[last] > 0)
    return total + chosen(row, np.int32(2), (np.int32(0), np.int32(1)), False)


@pytest.fixture(autouse=True)
def compiled_here(monkeypatch: pytest.MonkeyPatch) -> None:
    """Nothing is read from the cache of kernels, so that each test compiles."""
    monkeypatch.setattr("drapery.jit.kernel_cache.read_kernel", lambda kernel, types: None)
    for function in (
        last_times_five,
        with_sum,
        one_more,
        outermost,
        checked,
        checks,
        reshapes,
        chosen,
        chooses,
    ):
        function.forget()


def libraries(function: Any) -> list[Any]:
    return [made.library for made in function.dispatcher.overloads.values()]


def test_numba_has_what_is_changed() -> None:
    """It fails when numba's insides change: then kernels take longer to compile."""
    assert outermost(ROW) == 51
    assert "drapery.jit.compiling" in sys.modules
    assert [each.is_text for each in libraries(last_times_five)] == [True]
    assert [each.is_text for each in libraries(outermost)] == [False]


def test_an_entry_point_that_a_kernel_calls_first_has_code_of_its_own() -> None:
    assert outermost(ROW) == 51
    assert [each.is_text for each in libraries(with_sum)] == [False]
    assert with_sum(ROW) == 30


def test_an_entry_point_that_python_calls_first_is_called_by_others() -> None:
    assert with_sum(ROW) == 30
    assert outermost(ROW) == 51


def test_a_text_is_linked_once_where_it_is_used() -> None:
    assert outermost(ROW) == 51
    assert len(list(libraries(one_more)[0].get_defined_functions())) == 1


def test_a_kernel_is_compiled_once_for_literals_and_all_widths_of_integers() -> None:
    assert chooses(ROW) == 1 + 2 + 4 + 3 + 2
    assert [str(each) for each in chosen.dispatcher.overloads] == [
        "(Array(float64, 1, 'C', False, aligned=True), int64, UniTuple(int64, 2), bool)"
    ]


def test_only_kernels_of_ours_resolve_calls_of_the_same_types_once(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    resolved: list[Any] = []
    order = utils.order_by_target_specificity

    def listed(target: Any, templates: Any, fnkey: Any = "") -> Any:
        resolved.append(fnkey)
        return order(target, templates, fnkey=fnkey)

    def added(number):
        return number + number + number + number

    monkeypatch.setattr(utils, "order_by_target_specificity", listed)
    ours, again = entry_point(added), entry_point(added)
    assert ours(1.5) == 6
    assert resolved.count(operator.add) == 1
    assert again(1.5) == 6  # what is declared between two compilations counts
    assert resolved.count(operator.add) == 2
    assert njit(added)(1.5) == 6
    assert resolved.count(operator.add) > 4


def test_the_variables_of_an_instruction_are_those_that_numba_lists() -> None:
    def function(row, start, *rest):
        total = {"start": start}["start"]
        for at, (value, other) in enumerate(zip(row[1:-1], rest, strict=False)):
            if not value < other:
                row[at] = max(value, total, -other)
            total += value
        del start
        return total, rest

    def by_numba(part: Any) -> list[Any]:
        if isinstance(part, ir.Var):
            return [part]
        if isinstance(part, ir.Expr):
            return by_numba(part._kws)
        if isinstance(part, ir.Inst):
            return by_numba(vars(part))
        if isinstance(part, dict):
            part = list(part.values())
        parts = part if isinstance(part, (list, tuple)) else []
        return [found for each in parts for found in by_numba(each)]

    statements = [each for block in run_frontend(function).blocks.values() for each in block.body]
    assert len(statements) > 50
    for each in statements:
        assert each.list_vars() == by_numba(each)


def test_code_holds_no_path_of_the_machine_that_compiled_it() -> None:
    """Errors of our kernels and of numba's functions name no file, whoever compiled the latter."""
    assert njit(lambda row, count: row.reshape((count, 1))[0, 0])(ROW, 5) == 0
    for function, arguments in ((checks, (3,)), (reshapes, (ROW, 5))):
        parameters = types_of(arguments)
        made = compile_kernel(function, pack(arguments).types, parameters)
        for part in made.parts:
            assert b".py" not in part
    with pytest.raises(ValueError, match="total size"):
        reshapes(ROW, 4)


def test_an_error_of_an_inner_function_comes_out() -> None:
    assert checks(3) == 3
    with pytest.raises(ValueError, match="the number is negative"):
        checks(-1)


def test_a_function_of_others_that_a_kernel_calls_first_can_be_called() -> None:
    """As that of a collider that a user writes."""

    @njit
    def theirs(number):
        return np.sum(np.full(3, number))

    @njit
    def theirs_too(number):
        return theirs(number) + 1

    @kernel
    def between(number):
        return theirs(number) * 2

    @entry_point
    def ours(number):
        return between(number)

    assert ours(2.0) == 12
    assert theirs(2.0) == 6
    assert theirs_too(2.0) == 7


def test_code_is_called_by_address() -> None:
    example = (ROW,)
    call = call_by_address(int, example)

    @entry_point
    def length(row):
        return len(row)

    @entry_point
    def calls(address, row):
        return call(address, (row,))

    assert calls(address_of(length, example), np.arange(7.0)) == 7


def test_garbage_is_collected_again_afterwards() -> None:
    seen = []

    class Compilations(event.Listener):
        def on_start(self, event: event.Event) -> None:
            seen.append(gc.isenabled())

        def on_end(self, event: event.Event) -> None:
            pass

    jit.prepare_numba()  # what turns the collector off hears of each compilation first
    assert gc.isenabled()
    with event.install_listener("numba:compile", Compilations()):
        outermost(ROW)
    assert seen and not any(seen)
    assert gc.isenabled()
    with pytest.raises(TypingError):
        outermost(1)
    assert gc.isenabled()
    gc.disable()
    try:
        outermost(ROW.astype(np.float32))
        assert not gc.isenabled()
    finally:
        gc.enable()


def test_threads_compile_at_the_same_time() -> None:
    results: dict[int, Any] = {}
    kinds = (np.float32, np.float64, np.int32, np.int64)

    def run(number: int) -> None:
        results[number] = outermost(ROW.astype(kinds[number])), checks(number)

    threads = [threading.Thread(target=run, args=(number,)) for number in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert results == {number: (51, number) for number in range(4)}
    assert gc.isenabled()


def test_where_numba_differs_kernels_are_compiled_as_it_does(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    jit.prepare_numba()
    monkeypatch.delitem(sys.modules, "drapery.jit.compiling")
    monkeypatch.delattr(codegen.CPUCodeLibrary, "_optimize_functions")
    with pytest.warns(
        UserWarning, match="kernels take longer to compile, because drapery.jit.comp"
    ):
        jit.prepare_numba()
