"""The public names of packages that load them when they are first used."""

import ast
import inspect
from importlib import import_module

import pytest
from source_modules import modules

pytestmark = pytest.mark.quick

PACKAGES = [
    name
    for name, path in modules().items()
    if path.name == "__init__.py" and "import_lazily" in path.read_text(encoding="utf-8")
]


@pytest.mark.parametrize("package", PACKAGES)
def test_every_public_name_is_there_documented_and_seen_by_type_checkers(package: str) -> None:
    module = import_module(package)
    tree = ast.parse(modules()[package].read_text(encoding="utf-8"))
    (checked,) = (node for node in tree.body if isinstance(node, ast.If) and node.orelse)
    imported = {
        alias.asname or alias.name: node.module
        for node in checked.body
        if isinstance(node, ast.ImportFrom)
        for alias in node.names
    }
    assert all(alias.name == alias.asname for node in checked.body for alias in node.names)
    for name, source in imported.items():
        assert getattr(module, name) is getattr(import_module(str(source)), name)
    assert dir(module) == sorted(imported) == sorted(module.__all__)
    for name in module.__all__:
        value = getattr(module, name)
        if inspect.isfunction(value) or inspect.isclass(value):
            assert value.__doc__, name
    with pytest.raises(AttributeError, match=f"module '{package}' has no attribute 'absent'"):
        module.absent  # noqa: B018
