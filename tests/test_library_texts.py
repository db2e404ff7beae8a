"""No message quotes the text of an error of another library, which a release may change."""

import ast
from collections.abc import Iterator

import pytest
from source_modules import modules, names_of

TEXTS = {"args", "message", "msg", "problem", "context", "reason"}
"""Attributes of errors that hold a text."""
ALLOWED = {
    "drapery.batch.jobs": "a defect of the program, which the user is asked to report",
    "drapery.cloth.colliders.user_defined": "what the user's own function raises or numba refuses",
    "drapery.jit": "a defect of the installation, for whoever looks for it",
    "drapery.render.backends": "what another package raises while it is imported",
    "drapery.output_files": "an error of the system without its own text",
    "drapery.render.gl.platform": "what OpenGL raises on this machine",
    "drapery.toml_text": "the place of a fault, which only its text has before Python 3.14",
}
"""Modules that may, and why."""


def own_errors() -> set[str]:
    """The classes of errors that this package defines."""
    return {
        node.name
        for path in modules().values()
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8")))
        if isinstance(node, ast.ClassDef) and node.name.endswith("Error")
    }


def quoted(node: ast.AST, name: str) -> bool:
    """Whether a part of the code makes a text of the error of this name."""
    if isinstance(node, ast.FormattedValue):
        return isinstance(node.value, ast.Name) and node.value.id == name
    if isinstance(node, ast.Call) and ast.unparse(node.func) in ("str", "repr", "one_line"):
        return [ast.unparse(each) for each in node.args] == [name]
    is_text = isinstance(node, ast.Attribute) and node.attr in TEXTS
    return is_text and ast.unparse(node.value) == name  # type: ignore[attr-defined]


def errors_of(tree: ast.AST) -> Iterator[tuple[set[str], str, list[ast.stmt]]]:
    """The classes of the errors, their name, and the code that has them."""
    for node in ast.walk(tree):
        if isinstance(node, ast.ExceptHandler) and node.name:
            yield names_of(node.type), node.name, node.body
        elif isinstance(node, ast.FunctionDef):
            for each in node.args.args:
                classes = names_of(each.annotation) if each.annotation else set()
                if all(name.endswith(("Error", "Exception")) for name in classes) and classes:
                    yield classes, each.arg, node.body


def quotes(text: str, own: set[str]) -> Iterator[str]:
    """Where a module makes a text of an error that is not its own, by line."""
    for classes, name, body in errors_of(ast.parse(text)):
        if classes <= own:
            continue
        for statement in body:
            for node in ast.walk(statement):
                if quoted(node, name):
                    line = getattr(node, "lineno", statement.lineno)
                    yield f"line {line}: the text of {', '.join(sorted(classes))}"


def test_no_message_quotes_another_library() -> None:
    own = own_errors()
    found = {
        name: [*quotes(path.read_text(encoding="utf-8"), own)] for name, path in modules().items()
    }
    lines = [
        f"{name} {line}" for name, each in found.items() if name not in ALLOWED for line in each
    ]
    assert not lines, "say it in words of ours:\n" + "\n".join(lines)
    assert {name for name in ALLOWED if not found[name]} == set(), "they need no exception"


TRY = "try:\n    f()\nexcept {}:\n    raise OptionError({})\n"
QUOTING = (
    TRY.format("ValueError as error", 'f"it is not JSON: {error}"'),
    TRY.format("(DesignError, ValueError) as error", "str(error)"),
    TRY.format("json.JSONDecodeError as error", 'f"line {error.lineno}: {error.msg}"'),
    "def reason(fault: Exception) -> str:\n    return str(fault)\n",
)
FINE = (
    TRY.format("DesignError as error", 'f"line 1: {error}"'),
    TRY.format("OSError as error", 'f"it cannot be read: {error.strerror}"'),
    TRY.format("Exception as error", 'f"it failed ({type(error).__name__})"'),
    TRY.format("ValueError", '"it is not JSON"'),
)


@pytest.mark.parametrize("text", QUOTING)
def test_a_quoted_text_is_found(text: str) -> None:
    assert [*quotes(text, {"DesignError"})]


@pytest.mark.parametrize("text", FINE)
def test_words_of_ours_are_no_fault(text: str) -> None:
    assert not [*quotes(text, {"DesignError"})]
