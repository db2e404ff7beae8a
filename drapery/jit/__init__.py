"""Decorators: `kernel` for functions that kernels call, `entry_point` for those Python calls.

numba is imported, which takes longer than to draw a picture, when a kernel has to be compiled.
Kernels that are stored, see `drapery.jit.kernel_cache`, or were compiled ahead of time (AOT), see
`drapery.jit.library`, run without it: `arguments` packs the arguments of a call, and `compiled`
calls a kernel with them.
"""

import os
import sys
import threading
import warnings
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from functools import cache, cached_property, update_wrapper
from importlib import import_module
from typing import TYPE_CHECKING, Any, TypeVar, cast

from drapery.errors import BackendError
from drapery.jit.arguments import pack
from drapery.jit.compiled import CompiledKernel
from drapery.jit.library import kernels_of
from drapery.jit.sources import SIMD, Compiled, ImportedByNumba

if TYPE_CHECKING:
    from drapery.jit.objects import KernelObject

Function = TypeVar("Function", bound=Callable[..., object])

OPTIONS = {"error_model": "numpy", "no_cpython_wrapper": True, "no_cfunc_wrapper": True}
REGISTER = 64
"""Bytes of the widest register for which kernels are written; see `drapery.cloth.simd`."""

DISABLE_JIT = "NUMBA_DISABLE_JIT"
"""The variable of the environment that turns numba's compiler off."""

declarations: list[Callable[[], Any]] = []
"""What tells numba of types and instructions, before the first kernel that uses them."""
_lock = threading.RLock()
_expected: ContextVar[tuple[Any, tuple[Any, ...]] | None] = ContextVar("_expected", default=None)
"""The function that is called next, and its arguments."""
_beside: list[tuple[str, Callable[[], object]]] = []
"""What other processes compile, as the beginnings of names; and the calls that wait for them."""


class Kernel(Compiled):
    """A function that numba compiles when it is first used; kernels call it as any other."""

    options: dict[str, Any] = OPTIONS
    is_inner = True
    """Whether only kernels call it; see `drapery.jit.compiling`."""

    def __init__(self, function: Callable[..., object]) -> None:
        update_wrapper(cast(Any, self), function)
        self.py_func = function
        self._made: Any = None

    @property
    def dispatcher(self) -> Any:
        """numba's object for the function."""
        if self._made is None:
            with _lock:
                if self._made is None:
                    prepare_numba()
                    made = self._make()
                    made.is_inner = self.is_inner
                    self._made = made
        return self._made

    @property
    def made_of(self) -> tuple[Any, ...]:
        return self.py_func, self.options, _compiled

    def _make(self) -> Any:
        return _compiled(self.py_func, self.options)

    def forget(self) -> None:
        """Drop what was compiled: the next call reads it from the cache, or compiles anew."""
        self._made = None
        vars(self).pop("_ready", None)

    @property
    def _numba_type_(self) -> Any:
        return self.dispatcher._numba_type_

    def __getattr__(self, name: str) -> Any:
        if name.startswith("__"):
            raise AttributeError(name)
        return getattr(self.dispatcher, name)


class Borrower(Kernel):
    """A kernel that does not count references to arrays."""

    options = OPTIONS | {"_nrt": False}


class EntryPoint(Kernel):
    """A kernel that Python calls, with numbers, arrays and tuples of them."""

    is_inner = False

    def __init__(self, function: Callable[..., object]) -> None:
        super().__init__(function)
        self._one_thread = threading.Lock()

    def __call__(self, *arguments: Any) -> Any:
        packed = pack(arguments)
        return self._compiled(packed.types, arguments)(packed.words)

    def compiled(self, arguments: tuple[Any, ...]) -> CompiledKernel:
        """The machine code for such arguments: made ahead of time, stored, or compiled now."""
        return self._compiled(pack(arguments).types, arguments)

    def _compiled(self, types: tuple[str, ...], arguments: tuple[Any, ...]) -> CompiledKernel:
        if types not in self._ready:
            with self._one_thread:
                if types not in self._ready:
                    self._ready[types] = self._loaded(types, arguments)
        return self._ready[types]

    def _loaded(self, types: tuple[str, ...], arguments: tuple[Any, ...]) -> CompiledKernel:
        from drapery.jit.kernel_cache import read_kernel
        from drapery.jit.objects import load

        made = read_kernel(self, types)
        if made is None and _await_others(f"{self.__module__}.{self.__qualname__}"):
            made = read_kernel(self, types)
        return load(made or self._new(types, arguments))

    def _new(self, types: tuple[str, ...], arguments: tuple[Any, ...]) -> "KernelObject":
        prepare_numba()
        from drapery.jit.codegen import compile_kernel, types_of

        return compile_kernel(self, types, types_of(arguments))

    @cached_property
    def _ready(self) -> dict[tuple[str, ...], CompiledKernel]:
        return kernels_of(self)


class NumbaName(Compiled):
    """A name that kernels use for something that is made when numba is imported."""

    def __init__(self, make: Callable[[], Any], *made_of: Any) -> None:
        self.make, self._made_of = make, made_of
        declarations.append(lambda: self._numba_type_)

    @property
    def made_of(self) -> tuple[Any, ...]:
        return self._made_of

    @cached_property
    def _numba_type_(self) -> Any:
        from numba.core.registry import cpu_target

        made = self.make()
        # Numba asks for this type also while it compiles a function.
        cpu_target.typing_context.refresh()
        cpu_target.target_context.refresh()
        return cpu_target.typing_context.resolve_value_type(made)


def _compiled(function: Callable[..., object], options: dict[str, Any]) -> Any:
    from numba import njit

    return cast(Any, njit)(**options)(function)


def kernel(function: Function) -> Function:
    """A function that only kernels call: strict IEEE arithmetic, cached as part of its callers."""
    return cast(Function, Kernel(function))


def borrowing_kernel(function: Function) -> Function:
    """The same for a function that neither makes nor returns arrays, in which references to its
    callers' arrays are not counted.

    Counting is atomic, and numba leaves much of it inside loops and around calls (its issues 2345
    and 2350): it took up to half the time of contact.
    """
    return cast(Function, Borrower(function))


def entry_point(function: Function) -> Function:
    """The same for a function that Python calls: cached on disk; it releases the GIL."""
    return cast(Function, EntryPoint(function))


def compiler_fault() -> str:
    """Why kernels cannot be compiled, and the remedy; empty if they can be."""
    from numba import config

    if cast(Any, config).DISABLE_JIT:
        return (
            f"{DISABLE_JIT} is set, which turns off the compiler that Drapery's kernels need;"
            f" unset {DISABLE_JIT}"
        )
    return ""


def numba_name(module: str, name: str, plain: str | None = None) -> Any:
    """A name, for kernels, of a module that imports numba.

    plain: the module to use instead where `module` does not fit the version of numba.
    """

    def make() -> Any:
        used = module if plain is None or fits_numba(module) else plain
        return getattr(import_module(used), name)

    files = [ImportedByNumba(each) for each in (module, plain) if each]
    return NumbaName(make, name, *files)


@cache
def fits_numba(module: str) -> bool:
    """Whether numba has what a module is made with, and SIMD does not turn it off; else warns."""
    return os.environ.get(SIMD) != "0" and _is_imported(module, "kernels are slow")


def _is_imported(module: str, effect: str) -> bool:
    """Import a module that leans on parts of numba; warns of the effect if they are missing."""
    try:
        import_module(module)
    except (ImportError, AttributeError, TypeError) as fault:
        warnings.warn(
            f"{effect}, because {module} does not fit this numba ({fault});"
            " install the versions of numba and llvmlite that drapery declares",
            stacklevel=3,
        )
        return False
    return True


def call_by_address(result: type | None, example: tuple[Any, ...] | None = None) -> Any:
    """A function (address, arguments) that kernels call; see `address_of`.

    What a kernel calls so is compiled once, not again as part of each of its callers.
    result: int or None. example: arguments; those of a call must be of the same types. Without it
    a call may have arguments of any types, and its address must be of code for these.
    """

    def make() -> Any:
        from drapery.jit.calls import address_caller

        return address_caller(result, example)

    types = None if example is None else pack(example).types
    return NumbaName(make, result, types, ImportedByNumba("drapery.jit.calls"))


def address_of(function: Any, example: tuple[Any, ...]) -> int:
    """Where the compiled code of an entry point is in memory, for arguments as in `example`."""
    return int(function.compiled(example).address)


@contextmanager
def when_numba_compiles(begin: Callable[[Any], None]) -> Iterator[None]:
    """Call `begin` with the function when one is compiled first in this block; needs no numba."""
    stop: list[Callable[[], None]] = []

    def listen() -> None:
        from drapery.jit.calls import call_at_first_compile

        stop.append(call_at_first_compile(begin))

    if "numba" in sys.modules:
        listen()
    else:
        declarations.append(listen)
    try:
        yield
    finally:
        if listen in declarations:
            declarations.remove(listen)
        for each in stop:
            each()


@contextmanager
def called_next(function: Any, arguments: tuple[Any, ...]) -> Iterator[None]:
    """A block in which another kernel may be compiled; the function is called after it, with
    arguments of these types."""
    before = _expected.set((function, arguments))
    try:
        yield
    finally:
        _expected.reset(before)


def expected_call() -> tuple[str, bytes] | None:
    """The kernel that is called after the block of `called_next`, as a name for
    `compiled_beside`, and the call, for `drapery.jit.beside`; None if none is."""
    call = _expected.get()
    if call is None or not isinstance(call[0], EntryPoint):
        return None
    from drapery.jit.codegen import pickled_call

    return f"{call[0].__module__}.{call[0].__qualname__}", pickled_call(*call)


def compiled_beside(names: str, wait: Callable[[], object]) -> None:
    """Let another process compile kernels: one that is called here and not stored waits for it.

    names: the beginning of their modules and names. wait: returns when the process has ended.
    """
    _beside.append((names, wait))


def _await_others(name: str) -> bool:
    """Wait for the processes that may compile a kernel; whether there is one."""
    found = [each for each in _beside if name.startswith(each[0])]
    for each in found:
        each[1]()
    return bool(found)


def prepare_numba() -> None:
    """What must happen before any kernel is compiled. Called under the lock.

    Raises BackendError if the environment turns the compiler off.
    """
    if fault := compiler_fault():
        raise BackendError(fault)
    if "drapery.jit.compiling" not in sys.modules:
        _is_imported("drapery.jit.compiling", "kernels take longer to compile")
    while declarations:
        declarations.pop(0)()
