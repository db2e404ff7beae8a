"""Kernels compile in less of the processor's time: what only they call gets no code of its own.

numba makes optimised machine code for each function that it compiles, also for those that are
only called by other kernels. Such a function is linked as text into its caller, which LLVM
optimises as a whole, so its own code is never run. Here a function that an entry point of Drapery
reaches keeps its text alone, if it is one of Drapery's kernels or a part of numba. Everything else
is compiled as numba does it: entry points, since Python or an address may call them too, and
functions of others.
numba also compiles a function again for each literal, and for each width of an integer, that a
kernel calls it with. Here a kernel has one compilation for all of them.
numba finds the types of an operator or of a function of NumPy anew at each of its calls, and each
time that a type near the call becomes known; it tries some twenty implementations for it. Here
the same types are looked up once in a compilation, which takes a sixth of the time.
An error names no place in the sources: its path would be in the code of wheels and pages.
No garbage is collected meanwhile: a compilation makes millions of objects that live to its end.

Importing this module changes the code generator of this process. The import raises AttributeError
where numba lacks what the module changes. A compilation holds numba's global lock, so the list of
those that are open belongs to one thread at a time.
"""

import gc
from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import Any

from numba.core import callconv, codegen, dispatcher, event, ir, types
from numba.core.registry import cpu_target

_Dispatcher: Any = dispatcher.Dispatcher
_Convention: Any = callconv.CPUCallConv
_Function: Any = types.BaseFunction
_Instruction: Any = ir.Inst
_Variable: Any = ir.Var
_types: Any = types
_codegen: Any = codegen
_event: Any = event
_generator: Any = cpu_target.target_context.codegen()
_set_environment = _generator.set_env
_call_template = _Dispatcher.get_call_template
_call_type = _Function.get_call_type
_describe_error = _Convention.build_excinfo_struct
_FOLDER = str(Path(callconv.__file__).parents[1])

_open: list[Any] = []
"""numba's objects of the functions that are being compiled, the outermost first."""
_environments: dict[str, Any] = {}
"""numba's environments of functions without code, by the name of the variable for their address."""
_signatures: dict[tuple[Any, ...], Any] = {}
"""Of numba's own functions, by the function and the types of arguments, in this compilation."""


def _is_ours() -> bool:
    """Whether one of Drapery's functions is being compiled."""
    return bool(_open) and hasattr(_open[0], "is_inner")


def _is_text() -> Any:
    """Whether what is compiled now is only linked into its callers."""
    if len(_open) < 2 or not _is_ours():
        return False
    function = _open[-1]
    ours = getattr(function, "is_inner", None)
    return ours if ours is not None else f"{function.__module__}".startswith("numba.")


class KernelLibrary(_codegen.JITCodeLibrary):  # type: ignore[misc]
    """The code of one function, or its text.

    numba links all that a function reaches into each function on the way there. A text stays alone
    here: what has code links all texts that it reaches, each once.
    """

    def __init__(self, generator: Any, name: str) -> None:
        super().__init__(generator, name)
        self.is_text = _is_text()

    def finalize(self) -> None:
        if self.is_text:
            self._finalized = True
            return
        self._linking_libraries = list(_reached(self, set()))
        super().finalize()

    def _optimize_functions(self, module: Any) -> None:
        if not self.is_text:
            super()._optimize_functions(module)

    def _finalize_final_module(self) -> None:
        super()._finalize_final_module()
        for variable in self._final_module.global_variables:
            if variable.name in _environments:
                _set_environment(variable.name, _environments[variable.name])


def _reached(library: Any, seen: set[Any]) -> Iterator[Any]:
    """The libraries that a library links, and those that texts among them link, each once."""
    for each in library._linking_libraries:
        if each not in seen:
            seen.add(each)
            yield each
            if getattr(each, "is_text", False):
                yield from _reached(each, seen)


def _set_environment_later(name: str, environment: Any) -> None:
    """Set the address of an environment; for a text, when the code of a caller exists."""
    if _is_text():
        _environments[name] = environment
    else:
        _set_environment(name, environment)


def _plain(kind: Any) -> Any:
    """The type of a value for whatever value it is: bool or a 64-bit integer, also in a tuple."""
    if isinstance(kind, _types.BaseAnonymousTuple):
        return _types.Tuple.from_types([_plain(each) for each in kind])
    if isinstance(kind, _types.Boolean):
        return _types.boolean
    return _types.int64 if isinstance(kind, _types.Integer) and kind.signed else kind


def _plain_call_template(function: Any, arguments: Any, named: Any) -> Any:
    """numba's, but kernels are called with plain types."""
    if hasattr(function, "is_inner"):
        arguments = tuple(map(_plain, arguments))
        named = {name: _plain(kind) for name, kind in named.items()}
    return _call_template(function, arguments, named)


def _kept_call_type(function: Any, context: Any, arguments: Any, named: Any) -> Any:
    """numba's signature of a call of one of its functions, kept while Drapery's are compiled."""
    if not _is_ours():
        return _call_type(function, context, arguments, named)
    call = function, arguments, tuple(named.items())
    if call not in _signatures:
        _signatures[call] = _call_type(function, context, arguments, named)
    return _signatures[call]


def _variables(_: Any, part: Any) -> list[Any]:
    """The variables of a part of an instruction, as numba lists them; it asks half a million times
    for a picture."""
    found: list[Any] = []
    _add_variables((part,), found)
    return found


def _add_variables(parts: Iterable[Any], found: list[Any]) -> None:
    for part in parts:
        kind = type(part)
        if kind is _Variable:
            found.append(part)
        elif kind is list or kind is tuple:
            _add_variables(part, found)
        elif kind is dict:
            _add_variables(part.values(), found)
        elif isinstance(part, _Instruction):
            found += part.list_vars()


def _describe_without_place(convention: Any, kind: Any, words: Any, place: Any, name: Any) -> Any:
    """numba's description of an error, without its place in kernels and in numba's functions."""
    ours = _is_ours() or f"{place}".startswith(_FOLDER)
    return _describe_error(convention, kind, words, None if ours else place, name)


class _Compilations(_event.Listener):  # type: ignore[misc]
    """Follows which functions are compiled; collects no garbage until the outermost one is."""

    collected = False

    def on_start(self, event: Any) -> None:
        function = event.data["dispatcher"]
        if not _open and hasattr(function, "is_inner"):
            self.collected = gc.isenabled()
            gc.disable()
        _open.append(function)

    def on_end(self, event: Any) -> None:
        if _open:  # a user's function may have begun before this listener did
            _open.pop()
        if not _open:
            _signatures.clear()
        if not _open and self.collected:
            self.collected = False
            gc.enable()


def _check_numba() -> None:
    """Raises AttributeError if numba's code generator is not made of the parts that change here."""
    parts = ["finalize", "_optimize_functions", "_finalize_final_module", "_get_module_for_linking"]
    for part in parts:
        getattr(_codegen.JITCodeLibrary, part)
    getattr(_Instruction, "_rec_list_vars")  # noqa: B009
    if _generator._library_class is not _codegen.JITCodeLibrary:
        raise AttributeError("the class of libraries is another one")


_check_numba()
_generator._library_class = KernelLibrary
_generator.set_env = _set_environment_later
_Dispatcher.get_call_template = _plain_call_template
_Function.get_call_type = _kept_call_type
_Instruction._rec_list_vars = _variables
_Convention.build_excinfo_struct = _describe_without_place
_event.register("numba:compile", _Compilations())
