"""No part of the program hides an error that the user should know of."""

import ast
import errno
import os
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from source_modules import modules, names_of

from drapery.banner.formats.files import world_files
from drapery.banner.packs.folders import FolderSource
from drapery.batch.keys import DigestCache
from drapery.errors import PackError
from drapery.studio.document import Document

ANY = {"Exception", "BaseException"}
BROAD = {"OSError", "IOError", "EnvironmentError", "DraperyError", "RuntimeError", "Warning"}
"""Classes of errors of many causes. Such a handler says in a comment why nobody need know."""


def tells(handler: ast.ExceptHandler) -> bool:
    """Whether a handler raises an error, logs it, or uses it, such as in a message."""
    inside = [part for statement in handler.body for part in ast.walk(statement)]
    return any(
        isinstance(part, ast.Raise)
        or (isinstance(part, ast.Name) and part.id == handler.name)
        or (isinstance(part, ast.Attribute) and part.attr == "exception")
        for part in inside
    )


def swallowed(text: str) -> Iterator[str]:
    """The handlers of a module that hide errors, by line."""
    lines = text.splitlines()

    def explained(first: int, last: int) -> bool:
        return any("#" in line for line in lines[first - 1 : last])

    for node in ast.walk(ast.parse(text)):
        if isinstance(node, ast.Call) and ast.unparse(node.func) == "os.walk":
            if not any(given.arg == "onerror" for given in node.keywords):
                yield f"line {node.lineno}: folders that cannot be listed are hidden; give onerror"
            continue
        if isinstance(node, ast.ExceptHandler) and not tells(node):
            caught = names_of(node.type)
            first, last = node.lineno, node.body[0].lineno
        elif isinstance(node, ast.Call) and ast.unparse(node.func).endswith("suppress"):
            caught = set().union(*map(names_of, node.args))
            first, last = node.lineno, node.lineno + 1
        else:
            continue
        if caught & ANY:
            yield f"line {node.lineno}: any error is hidden; name its classes, log it or raise it"
        elif caught & BROAD and not explained(first, last):
            yield f"line {node.lineno}: {', '.join(caught & BROAD)} is hidden; say why in a comment"


def test_errors_are_told() -> None:
    texts = {path: path.read_text(encoding="utf-8") for path in modules().values()}
    found = [f"{path} {line}" for path, text in texts.items() for line in swallowed(text)]
    assert not found, "\n".join(found)


TRY = "try:\n    f()\nexcept {}:\n    {}\n"
HIDDEN = (
    TRY.format("Exception", "pass"),
    TRY.format("Exception as error", "found = {}"),
    TRY.format("(ValueError, Exception)", "return None  # none of our business"),
    TRY.format("OSError", "pass"),
    TRY.format("builtins.OSError", "found = {}"),
    "with suppress(Exception):\n    f()\n",
    "with contextlib.suppress(ValueError, OSError):\n    f()\n",
    "try:\n    f()\nexcept:\n    pass\n",
    "for top, folders, names in os.walk(folder):\n    pass\n",
)
TOLD = (
    TRY.format("Exception as error", "say(error)"),
    TRY.format("Exception", "LOG.exception('it failed')"),
    TRY.format("OSError", "raise OutputError('cannot') from None"),
    TRY.format("OSError", "return  # there is no such file"),
    TRY.format("ValueError", "pass"),
    "with suppress(OSError):  # another process removes it too\n    f()\n",
)


def test_the_check_knows_what_is_hidden(tmp_path: Path) -> None:
    assert all([*swallowed(text)] for text in HIDDEN)
    assert not any([*swallowed(text)] for text in TOLD)


@pytest.fixture
def unlisted(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder with a folder `assets` that may not be listed."""
    (tmp_path / "assets").mkdir()
    scan = os.scandir

    def refuse(path: Any = ".") -> Any:
        if Path(path).name == "assets":
            raise PermissionError(errno.EACCES, "Permission denied", str(path))
        return scan(path)

    monkeypatch.setattr(os, "scandir", refuse)
    return tmp_path


def test_a_folder_that_cannot_be_listed_is_named(unlisted: Path) -> None:
    pack = FolderSource(unlisted, "mine")
    for look in (pack.files, pack.folders):
        assert look("none") == ()
        with pytest.raises(PackError, match="mine: assets cannot be read: Permission denied"):
            look("assets")
    with pytest.raises(PackError, match="cannot be read: Permission denied"):
        DigestCache().of(unlisted)
    said: list[Exception] = []
    assert not [*world_files(unlisted, said.append)]
    assert "assets: Permission denied; make it readable" in str(said[0])


def test_a_tab_closes_wholly_and_its_fault_is_logged(caplog: pytest.LogCaptureFixture) -> None:
    document, closed = Document(), []

    def fail() -> None:
        raise ValueError("a fault in a panel")

    for call in (lambda: closed.append(1), fail, lambda: closed.append(2)):
        document.on_close(call)
    document.close()
    assert closed == [2, 1]
    assert "a fault in a panel" in caplog.text
