"""Kernels compile in less of the processor's time: what only they call gets no code of its own.

numba makes optimised machine code for each function that it compiles, also for those that are
only called by other kernels. Such a function is linked as text into its caller, which LLVM
optimises as a whole, so its own code is never run. Here a function that an entry point of Drapery
reaches keeps its text alone, if it is one of Drapery's kernels or a part of numba. Everything else
is compiled as numba does it: entry points, since Python or an address may call them too, and
functions of others.
No garbage is collected meanwhile: a compilation makes millions of objects that live to its end.

Importing this module changes the code generator of this process. The import raises AttributeError
where numba lacks what the module changes. A compilation holds numba's global lock, so the list of
those that are open belongs to one thread at a time.
"""

import gc
from typing import Any

from numba.core import codegen, event
from numba.core.registry import cpu_target

_codegen: Any = codegen
_event: Any = event
_generator: Any = cpu_target.target_context.codegen()
_set_environment = _generator.set_env

_open: list[Any] = []
"""numba's objects of the functions that are being compiled, the outermost first."""
_environments: dict[str, Any] = {}
"""numba's environments of functions without code, by the name of the variable for their address."""


def _is_text() -> Any:
    """Whether what is compiled now is only linked into its callers."""
    if len(_open) < 2 or not hasattr(_open[0], "is_inner"):
        return False
    function = _open[-1]
    ours = getattr(function, "is_inner", None)
    return ours if ours is not None else f"{function.__module__}".startswith("numba.")


class KernelLibrary(_codegen.JITCodeLibrary):  # type: ignore[misc]
    """The code of one function, or its text."""

    def __init__(self, generator: Any, name: str) -> None:
        super().__init__(generator, name)
        self.is_text = _is_text()

    def _optimize_functions(self, module: Any) -> None:
        if not self.is_text:
            super()._optimize_functions(module)

    def _optimize_final_module(self) -> None:
        if not self.is_text:
            super()._optimize_final_module()

    def _finalize_final_module(self) -> None:
        # What comes from the cache of kernels has its code already.
        if self.is_text and not getattr(self, "_compiled_object", None):
            self._finalize_dynamic_globals()
            self._verify_declare_only_symbols()
            self._finalized = True
            return
        super()._finalize_final_module()
        for variable in self._final_module.global_variables:
            if variable.name in _environments:
                _set_environment(variable.name, _environments[variable.name])


def _set_environment_later(name: str, environment: Any) -> None:
    """Set the address of an environment; that of a text when the code of a caller exists."""
    if _is_text():
        _environments[name] = environment
    else:
        _set_environment(name, environment)


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
        _open.pop()
        if not _open and self.collected:
            self.collected = False
            gc.enable()


def _check_numba() -> None:
    """Raises AttributeError if numba's code generator is not made of the parts that change here."""
    parts = ["_optimize_functions", "_optimize_final_module", "_finalize_final_module"]
    parts += ["_finalize_dynamic_globals", "_verify_declare_only_symbols"]
    for part in parts:
        getattr(_codegen.JITCodeLibrary, part)
    if _generator._library_class is not _codegen.JITCodeLibrary:
        raise AttributeError("the class of libraries is another one")


_check_numba()
_generator._library_class = KernelLibrary
_generator.set_env = _set_environment_later
_event.register("numba:compile", _Compilations())
