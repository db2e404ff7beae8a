"""Tests reach the project by its public names, and no test is a part of another one."""

import ast
import re
from collections.abc import Iterator
from functools import cache
from pathlib import Path

import pytest
from source_modules import modules

TESTS = Path(__file__).parent
FILES = sorted(TESTS.rglob("*.py"))
PROJECT = {"drapery", "assets", "render", "release", "benchmarks"}
FOREIGN = {"_fields", "_replace", "_asdict", "_make", "_optimize_functions"}
"""Names that the standard library and numba give the project, the first four for anyone's use."""
CALLS = {"getattr", "setattr", "delattr", "hasattr", "setitem", "delitem"}
"""Functions that take a name as a text."""


def is_private(name: str) -> bool:
    return re.match(r"_[^_]", name) is not None


def is_own(node: ast.Attribute) -> bool:
    return ast.unparse(node.value) in ("self", "cls")


def defined_in(tree: ast.AST) -> Iterator[str]:
    """The names of all functions, classes, variables and own attributes that a module defines."""
    for node in ast.walk(tree):
        if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef | ast.ClassDef):
            yield node.name
        elif isinstance(node, ast.Name) and isinstance(node.ctx, ast.Store):
            yield node.id
        elif isinstance(node, ast.Attribute) and isinstance(node.ctx, ast.Store) and is_own(node):
            yield node.attr


@cache
def private_names() -> frozenset[str]:
    """Private names of the project."""
    trees = (ast.parse(path.read_text(encoding="utf-8")) for path in modules().values())
    named = frozenset(name for tree in trees for name in defined_in(tree))
    return frozenset(filter(is_private, named)) - FOREIGN


def faults(text: str) -> Iterator[str]:
    """Each use of a private name of the project, and each import of a test."""
    tree = ast.parse(text)
    private = private_names() - set(defined_in(tree))
    for node in ast.walk(tree):
        if isinstance(node, ast.ImportFrom):
            module, names = str(node.module), [alias.name for alias in node.names]
            if any(part.startswith("test_") for part in module.split(".")):
                yield f"line {node.lineno}: imports {module}; move what is shared to a helper"
            if module.partition(".")[0] in PROJECT:
                used = filter(is_private, [*module.split("."), *names])
                yield from (f"line {node.lineno}: imports {name}" for name in used)
        elif isinstance(node, ast.Attribute) and node.attr in private:
            yield f"line {node.lineno}: uses {ast.unparse(node)}"
        elif isinstance(node, ast.keyword) and node.arg in private:
            yield f"line {node.lineno}: gives {node.arg}"
        elif isinstance(node, ast.Call) and ast.unparse(node.func).split(".")[-1] in CALLS:
            texts = (each.value for each in node.args if isinstance(each, ast.Constant))
            for name in (str(each).split(".")[-1] for each in texts):
                if name in private:
                    yield f"line {node.lineno}: uses {name}"


@pytest.mark.parametrize("path", FILES, ids=lambda path: path.relative_to(TESTS).as_posix())
def test_a_test_uses_public_names(path: Path) -> None:
    assert not list(faults(path.read_text(encoding="utf-8")))


def test_the_sweep_finds_private_names_and_tests() -> None:
    name = sorted(private_names())[0]
    text = (
        f"from test_x import y\nfrom drapery.jit import _z\njit.{name}\nsetattr(jit, '{name}', 1)\n"
        f"jit.{name} = 1\njit.make({name}=1)"
    )
    assert [line.partition(":")[0] for line in faults(text)] == [f"line {n}" for n in range(1, 7)]
