"""What kernels are compiled from, found in the text of the modules by following names.

A kernel is whatever `drapery.jit` or numba decorates, or is given as an argument, under any name:
`@kernel`, `@entry_point`, `f = borrowing_kernel(g)`, `@overload(...)`. It is compiled from its own
body and from all that the names in it stand for: functions, constants, attributes of modules,
aliases, names that other modules import again.
"""

import ast
from collections.abc import Collection, Iterable, Iterator
from functools import cache
from importlib.util import resolve_name
from itertools import chain
from typing import NamedTuple

from source_modules import modules

COMPILERS = ("drapery.jit", "drapery.jit.calls", "numba")
"""Modules that make kernels."""
WHOLE = "*"


class Place(NamedTuple):
    """A name at the top of a module; an empty name stands for the module itself, and `WHOLE` for
    all of its names."""

    module: str
    name: str = ""


@cache
def bindings(module: str) -> dict[str, list[ast.AST]]:
    """What binds each name at the top of a module, also below `if` and `try`."""
    found: dict[str, list[ast.AST]] = {}
    for node in _top(ast.parse(modules()[module].read_text(encoding="utf-8"))):
        for name in _bound(node):
            found.setdefault(name, []).append(node)
    return found


def _top(tree: ast.AST) -> Iterator[ast.AST]:
    """The statements of a module that are not part of a function or class."""
    for node in ast.iter_child_nodes(tree):
        yield node
        if not isinstance(node, ast.FunctionDef | ast.ClassDef | ast.Lambda):
            yield from _top(node)


def _bound(node: ast.AST) -> Iterator[str]:
    if isinstance(node, ast.FunctionDef | ast.ClassDef):
        yield node.name
    elif isinstance(node, ast.Import | ast.ImportFrom):
        for alias in node.names:
            yield alias.asname or alias.name.partition(".")[0]
    elif isinstance(node, ast.Assign | ast.AnnAssign | ast.AugAssign | ast.NamedExpr):
        targets = node.targets if isinstance(node, ast.Assign) else [node.target]
        for target in targets:
            yield from (part.id for part in ast.walk(target) if isinstance(part, ast.Name))


def _source_of(module: str, node: ast.ImportFrom) -> str:
    is_package = modules()[module].name == "__init__.py"
    package = module if is_package else module.rpartition(".")[0]
    return resolve_name("." * node.level + (node.module or ""), package)


def origins(place: Place) -> Iterator[Place]:
    """Where a name is really bound: imports are followed. Names of other projects are as imported.
    A submodule counts as bound."""
    if place.module not in modules() or not place.name:
        yield place
        return
    made = bindings(place.module).get(place.name, [])
    if not made and f"{place.module}.{place.name}" in modules():
        yield Place(f"{place.module}.{place.name}")
    for node in made:
        if isinstance(node, ast.ImportFrom):
            source = _source_of(place.module, node)
            for alias in node.names:
                if (alias.asname or alias.name) == place.name:
                    yield from origins(Place(source, alias.name))
        elif isinstance(node, ast.Import):
            for alias in node.names:
                if (alias.asname or alias.name.partition(".")[0]) == place.name:
                    yield Place(alias.name if alias.asname else place.name)
        else:
            yield place


def used(module: str, node: ast.AST) -> Iterator[Place]:
    """The places that an expression or a body names, origins of attributes of modules included.

    Annotations and decorators are no part of what is compiled.
    """
    if isinstance(node, ast.Attribute):
        whole = list(_attribute(module, node))
        if whole:
            yield from whole
            return
    if isinstance(node, ast.Name):
        yield from origins(Place(module, node.id))
    if isinstance(node, ast.Constant) and node.value in modules():
        yield Place(str(node.value), WHOLE)  # as in `numba_name("drapery.cloth.simd_plain", ...)`
    if isinstance(node, ast.ImportFrom):
        for alias in node.names:
            yield from origins(Place(_source_of(module, node), alias.name))
    for name, child in ast.iter_fields(node):
        if name in ("annotation", "returns", "decorator_list"):
            continue
        for part in child if isinstance(child, list) else [child]:
            if isinstance(part, ast.AST):
                yield from used(module, part)


def _attribute(module: str, node: ast.Attribute) -> Iterator[Place]:
    """The origins of `a.b.c` where `a` or `a.b` is a module."""
    value = node.value
    if isinstance(value, ast.Name):
        before: list[Place] = list(origins(Place(module, value.id)))
    elif isinstance(value, ast.Attribute):
        before = list(_attribute(module, value))
    else:
        return
    for place in before:
        if not place.name and place.module.partition(".")[0] in ("drapery", "numba"):
            yield from origins(Place(place.module, node.attr))


def _makes_kernels(module: str, node: ast.AST) -> bool:
    """Whether an expression names what compiles functions, or a variable that stands for it."""
    seen, todo = set(), [*used(module, node)]
    while todo:
        place = todo.pop()
        if place.module.startswith(COMPILERS):
            return True
        if place in seen or place.module not in modules():
            continue
        seen.add(place)
        for made in bindings(place.module).get(place.name, []):
            value = getattr(made, "value", None)
            todo += used(place.module, value) if isinstance(value, ast.AST) else []
    return False


def kernels(module: str) -> Iterator[Place]:
    """The kernels that a module makes."""
    if module in COMPILERS:
        return
    for name, nodes in bindings(module).items():
        for node in nodes:
            decorators = getattr(node, "decorator_list", [])
            value = getattr(node, "value", None)
            called = value.func if isinstance(value, ast.Call) else None
            if any(_makes_kernels(module, each) for each in [*decorators, *filter(None, [called])]):
                yield Place(module, name)


@cache
def _next(place: Place) -> tuple[Place, ...]:
    """What a place is made of."""
    if place.module in COMPILERS:
        return ()
    if place.name == WHOLE:
        return tuple(Place(place.module, name) for name in bindings(place.module))
    nodes = bindings(place.module).get(place.name, [])
    # A kernel makes and reads objects of a class; no method is compiled.
    plain = (node for node in nodes if not isinstance(node, ast.ClassDef))
    return tuple(dict.fromkeys(chain.from_iterable(_needed(place.module, node) for node in plain)))


def _needed(module: str, node: ast.AST) -> Iterator[Place]:
    """What a function is compiled from, or what a value holds: not what only calculated it."""
    if isinstance(node, ast.FunctionDef):
        yield from used(module, node)
    elif not isinstance(node, ast.Call) or _makes_kernels(module, node.func):
        if any(isinstance(each, ast.Call) for each in ast.iter_child_nodes(node)) or isinstance(
            node, ast.Tuple | ast.List | ast.Dict | ast.Assign | ast.AnnAssign
        ):
            for each in ast.iter_child_nodes(node):
                yield from _needed(module, each)
        else:
            yield from used(module, node)


def reached(start: Place) -> set[Place]:
    """All places that a kernel is compiled from, itself included."""
    found: set[Place] = set()
    todo = [start]
    while todo:
        place = todo.pop()
        if place in found or place.module not in modules():
            continue
        found.add(place)
        todo += _next(place)
    return found


def functions(places: Iterable[Place], of_kernels: Collection[Place]) -> Iterator[Place]:
    """The functions among some places that are compiled, or say what is.

    of_kernels: the functions that kernels are made of. All functions of a module count that numba
    imports. Others only made a value that a kernel uses.
    """
    places = set(places)
    whole = {place.module for place in places if place.name == WHOLE}
    for place in sorted(places):
        nodes = bindings(place.module).get(place.name, [])
        compiled = place in of_kernels or place.module in whole
        if compiled and any(isinstance(node, ast.FunctionDef) for node in nodes):
            yield place


def last_line(place: Place) -> int:
    """The number of the last line of a function."""
    (node,) = bindings(place.module)[place.name]
    return getattr(node, "end_lineno", 0)


def forget() -> None:
    """Read the modules anew."""
    bindings.cache_clear()
    _next.cache_clear()
