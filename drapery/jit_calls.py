"""The parts of `drapery.jit` that need numba: calls by address, and notes of compilations."""

from collections.abc import Callable
from typing import Any

import numba
from llvmlite import ir
from numba import types
from numba.core import event
from numba.core.cgutils import if_unlikely
from numba.extending import intrinsic

_numba: Any = numba
_types: Any = types
_intrinsic: Any = intrinsic
_if_unlikely: Any = if_unlikely
_event: Any = event
_RESULTS: dict[type, Any] = {int: _types.int64}


def address_caller(result: type, example: tuple[Any, ...]) -> Any:
    """The intrinsic behind `call_by_address`."""
    returned = _RESULTS[result]
    wanted = _types.Tuple(tuple(map(_numba.typeof, example)))
    parameters = tuple(wanted)

    @_intrinsic
    def call(typing: Any, address: Any, arguments: Any) -> Any:
        def generate(context: Any, builder: Any, signature: Any, values: Any) -> Any:
            given = [builder.extract_value(values[1], i) for i in range(len(parameters))]
            shape = context.call_conv.get_function_type(returned, parameters)
            function = builder.inttoptr(values[0], ir.PointerType(shape))
            status, value = context.call_conv.call_function(
                builder, function, returned, parameters, given
            )
            with _if_unlikely(builder, status.is_error):
                context.call_conv.return_status_propagate(builder, status)
            return value

        if arguments != wanted:
            raise TypeError(f"called with {arguments}, not with {wanted}")
        return returned(_types.int64, wanted), generate

    return call


def call_at_first_compile(begin: Callable[[Any], None]) -> Callable[[], None]:
    """Call `begin` with the first function that is compiled. The result ends this."""

    class FirstCompile(event.Listener):
        called = False

        def on_start(self, event: Any) -> None:
            if not self.called:
                self.called = True
                begin(event.data["dispatcher"].py_func)

        def on_end(self, event: Any) -> None:
            pass

    listener = FirstCompile()
    _event.register("numba:compile", listener)
    return lambda: _event.unregister("numba:compile", listener)
