"""What a kernel is compiled from, found by following what its code names, and a key of it.

A kernel is compiled from its own text and from all that the names in it stand for: other kernels,
functions, constants, attributes of modules, cells of closures. The texts of functions count, not
their code, so that a library that was made ahead of time fits every version of Python. No file is
in a key as a whole, but for modules that numba imports by name.
"""

import hashlib
import re
import sys
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache
from importlib import import_module
from importlib.util import find_spec
from pathlib import Path
from types import CodeType, FunctionType, ModuleType
from typing import Any, cast

SIMD = "DRAPERY_SIMD"
"""The variable of the environment that makes kernels use no registers of lanes if it is 0."""
COMPILERS = sys.stdlib_module_names | {"numba", "numpy", "llvmlite"}
"""Packages of which numba has code of its own: its version says what becomes of their names."""

IMPORT = re.compile(r"^ *from ([\w.]+) import (\([^)]*\)|.*)$", re.MULTILINE)
"""An import of names; the files that numba imports have no other imports of Drapery's."""
PLAIN = {type(None), bool, int, float, complex, str, bytes}
"""Types of values that are the same wherever their texts are."""
END = "", ")", "]", "}"
"""What lines begin with that are part of a function and are indented as it is."""


class Compiled:
    """A name in kernels for what numba makes when it is imported; see `drapery.jit`."""

    @property
    def made_of(self) -> tuple[Any, ...]:
        """The functions, modules and values that decide what it becomes."""
        raise NotImplementedError


@dataclass(frozen=True)
class ImportedByNumba:
    """A module that is imported when numba is. Its whole file counts, and what it imports of other
    modules; these are imported when a key is made."""

    name: str


OWN_NODE = Compiled, ImportedByNumba


@dataclass(frozen=True)
class Node:
    """One thing that a kernel is compiled from. text: of itself. parts: what it names."""

    text: str
    parts: tuple[Any, ...]


class _UnknownError(Exception):
    """Something of which no key can be made."""


@cache
def source_key(function: Any) -> str | None:
    """A key of all that a function is compiled from; None if something of it has no text.

    function: as Python has it, or one that `drapery.jit` made.
    """
    try:
        texts = {node.text for node in reached(function)}
    except _UnknownError:
        return None
    return _hash("\n".join(sorted(texts)))


def reached(function: Any) -> Iterator[Node]:
    """All that a function is compiled from, itself included."""
    todo: list[Any] = [function]
    seen: set[int] = set()
    while todo:
        part = todo.pop()
        if id(part) not in seen:
            seen.add(id(part))
            node = _node(part)
            yield node
            todo += node.parts


@cache
def _node(part: Any) -> Node:
    if isinstance(part, ImportedByNumba):
        named = _imports(part.name)
    elif isinstance(part, FunctionType):
        named = _globals(part)
    else:
        named = {str(number): each for number, each in enumerate(part.made_of)}
    parts: list[Any] = []
    bound = [f"{name} = {_value(named[name], parts)}" for name in sorted(named)]
    return Node("\n".join([_name(part), *bound]), tuple(parts))


@cache
def _name(part: Any) -> str:
    """How a text names something that has a node of its own, with a hash of its source."""
    if isinstance(part, ImportedByNumba):
        return f"module {part.name} {_hash(_module_text(part.name))}"
    if isinstance(part, FunctionType):
        return f"function {part.__module__}.{part.__qualname__} {_hash(function_text(part))}"
    return f"{type(part).__name__} of {_value(part.made_of[0], [])}"


def _hash(text: str) -> str:
    return hashlib.blake2b(text.encode(), digest_size=20).hexdigest()


def _value(value: Any, parts: list[Any]) -> str:
    """A text of a value, the same in each process; what has a node of its own is added to parts.

    Raises _UnknownError.
    """
    kind = type(value)
    if kind in PLAIN:
        return repr(value)
    if isinstance(value, OWN_NODE) or _is_followed(value):
        parts.append(value)
        return _name(value)
    if _is_followed(inner := getattr(value, "py_func", None)):  # numba itself was given it
        return _value(inner, parts)
    if isinstance(value, tuple | list):
        items = ", ".join([_value(each, parts) for each in value])
        return f"{kind.__name__}{fields_of(kind)}({items})"
    if isinstance(value, dict):
        pairs = [f"{_value(key, parts)}: {_value(each, parts)}" for key, each in value.items()]
        return f"dict({', '.join(pairs)})"
    if isinstance(value, type):
        return f"class {value.__module__}.{value.__qualname__}{fields_of(value)}"
    return _foreign(value)


def fields_of(kind: Any) -> str:
    """The names and defaults of the fields of a named tuple, as a text; empty for other types."""
    if not hasattr(kind, "_fields"):
        return ""
    return f"{kind._fields}{_value(kind._field_defaults, [])}"


def _foreign(value: Any) -> str:
    """A value of numpy, or a function or module of another package. Raises _UnknownError."""
    if isinstance(value, ModuleType):
        return f"module {value.__name__}"
    if hasattr(value, "dtype") and hasattr(value, "tobytes"):
        content = _hash(value.tobytes().hex())
        return f"{_value(value.dtype, [])}{value.shape}{content}"
    if hasattr(value, "descr") and hasattr(value, "itemsize"):
        return f"dtype {value.descr} {value.itemsize} {value.isalignedstruct}"
    if type(value).__module__ == "typing":
        return repr(value)
    module = getattr(value, "__module__", None) or type(value).__module__
    if hasattr(value, "__name__") and _is_of_compiler(module):
        return f"{module}.{value.__name__}"
    raise _UnknownError(f"{value!r} of {type(value)}")


def _is_followed(value: Any) -> bool:
    """Whether a function is compiled from its text."""
    return isinstance(value, FunctionType) and not _is_of_compiler(value.__module__)


def _is_of_compiler(module: str | None) -> bool:
    return (module or "").partition(".")[0] in COMPILERS


def _globals(function: FunctionType) -> dict[str, Any]:
    """What the names in a function stand for, those of attributes of modules included.

    Names of other attributes are looked up too: too much is found, never too little. Functions that
    no decorator has changed are left out: numba compiles no call of them.
    """
    cells = zip(function.__code__.co_freevars, function.__closure__ or (), strict=True)
    names = _names(function.__code__)
    found = {name: cell.cell_contents for name, cell in cells}
    found = _with_attributes(found | _looked_up(names, function.__globals__), names)
    if function.__defaults__ or function.__kwdefaults__:
        found["defaults"] = (function.__defaults__, function.__kwdefaults__)
    return {name: value for name, value in found.items() if not isinstance(value, FunctionType)}


def _looked_up(names: set[str], within: dict[str, Any]) -> dict[str, Any]:
    return {name: within[name] for name in names if name in within}


def _with_attributes(found: dict[str, Any], names: set[str]) -> dict[str, Any]:
    """What is found, with what attributes of the modules among it may stand for."""
    whole = dict(found)
    todo = [each for each in found.values() if isinstance(each, ModuleType)]
    seen: set[str] = set()
    while todo:
        module = todo.pop()
        if module.__name__ in seen or _is_of_compiler(module.__name__):
            continue
        seen.add(module.__name__)
        for name, value in _looked_up(names, vars(module)).items():
            whole[f"{module.__name__}.{name}"] = value
            if isinstance(value, ModuleType):
                todo.append(value)
    return whole


def _names(code: CodeType) -> set[str]:
    """All names of globals and attributes in code, and in code within it."""
    found = set(code.co_names)
    for constant in code.co_consts:
        if isinstance(constant, CodeType):
            found |= _names(constant)
    return found


@cache
def function_text(function: FunctionType) -> str:
    """The lines of a function, decorators included. Raises _UnknownError without its source.

    They end where its last line of code ends: before a line that is indented no deeper.
    """
    code = function.__code__
    lines = source_lines(code.co_filename)
    first, last = code.co_firstlineno - 1, _last_line(code)
    if first >= len(lines):
        raise _UnknownError(code.co_filename)
    margin = _indentation(lines[first])
    while last < len(lines) and lines[last - 1].lstrip().startswith(("@", "def ")):
        last += 1  # a function of which no line has code
    while last < len(lines) and (
        _indentation(lines[last]) > margin or lines[last].strip()[:1] in END
    ):
        last += 1
    return "\n".join(lines[first:last]).rstrip()


def _indentation(line: str) -> int:
    return len(line) - len(line.lstrip())


def _last_line(code: CodeType) -> int:
    """The number of the last line on which an instruction begins."""
    own = max(line or 0 for _, _, line in code.co_lines())
    return max([own, *(_last_line(each) for each in code.co_consts if isinstance(each, CodeType))])


@cache
def source_lines(path: str) -> list[str]:
    """The lines of a file of sources. Raises _UnknownError."""
    try:
        with Path(path).open(encoding="utf-8") as file:
            return file.read().split("\n")
    except (OSError, ValueError):
        raise _UnknownError(path) from None


@cache
def _module_text(name: str) -> str:
    spec = find_spec(name)
    return "\n".join(source_lines(str(spec.origin if spec else name)))


def _imports(name: str) -> dict[str, Any]:
    """What a module, which is not imported yet, takes from modules that are no compiler's."""
    text = _module_text(name)
    found: dict[str, Any] = {}
    for module, names in IMPORT.findall(text):
        if not _is_of_compiler(module):
            for each in re.findall(r"(\w+)(?: as \w+)?", names):
                found[f"{module}.{each}"] = _attribute(module, each)
    return _with_attributes(found, set(re.findall(r"\w+", text)))


def _attribute(module: str, name: str) -> Any:
    """An attribute of a module, or its submodule of this name."""
    try:
        return getattr(import_module(module), name)
    except AttributeError:
        return import_module(f"{module}.{name}")


def forget() -> None:
    """Make keys anew, of sources that have changed."""
    for each in (source_key, _node, _name, function_text, _module_text, source_lines):
        cast(Any, each).cache_clear()
