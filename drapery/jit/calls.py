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
_RESULTS: dict[type | None, Any] = {int: _types.int64, None: _types.none}


def address_caller(result: type | None, example: tuple[Any, ...] | None) -> Any:
    """The intrinsic behind `call_by_address`."""
    returned = _RESULTS[result]
    wanted = None if example is None else _types.Tuple(tuple(map(_numba.typeof, example)))

    @_intrinsic
    def call(typing: Any, address: Any, arguments: Any) -> Any:
        parameters = tuple(map(_as_in_python, arguments))

        def generate(context: Any, builder: Any, signature: Any, values: Any) -> Any:
            given = [
                context.cast(builder, builder.extract_value(values[1], i), *kinds)
                for i, kinds in enumerate(zip(signature.args[1], parameters, strict=True))
            ]
            shape = context.call_conv.get_function_type(returned, parameters)
            function = builder.inttoptr(values[0], ir.PointerType(shape))
            status, value = context.call_conv.call_function(
                builder, function, returned, parameters, given
            )
            with _if_unlikely(builder, status.is_error):
                context.call_conv.return_status_propagate(builder, status)
            return value

        if wanted is not None and arguments != wanted:
            raise TypeError(f"called with {arguments}, not with {wanted}")
        return returned(_types.int64, arguments), generate

    return call


def _as_in_python(kind: Any) -> Any:
    """The type that a value has if Python gives it: no literal, and whole numbers of 64 bits."""
    kind = _types.unliteral(kind)
    return _types.int64 if isinstance(kind, _types.Integer) and kind.signed else kind


def call_at_first_compile(begin: Callable[[Any], None]) -> Callable[[], None]:
    """Call `begin` with the first function that is compiled. The result ends this."""

    class FirstCompile(event.Listener):  # type: ignore[misc]
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
