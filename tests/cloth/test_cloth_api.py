"""The public names of `drapery.cloth`: complete, documented, imported when they are used."""

import inspect
from dataclasses import is_dataclass

import pytest

import drapery.cloth
from drapery.cloth.solvers.registry import SOLVERS

FUNCTIONS_AND_CLASSES = [
    name
    for name in drapery.cloth.__all__
    if inspect.isfunction(getattr(drapery.cloth, name))
    or inspect.isclass(getattr(drapery.cloth, name))
]


def test_every_public_name_is_there_and_each_once():
    names = drapery.cloth.__all__
    assert len(set(names)) == len(names) and dir(drapery.cloth) == sorted(names)
    assert all(getattr(drapery.cloth, name) is not None for name in names)
    assert set(SOLVERS.values()) <= set(names)
    with pytest.raises(AttributeError, match="no attribute 'Silk'"):
        _ = drapery.cloth.Silk


@pytest.mark.parametrize("name", FUNCTIONS_AND_CLASSES)
def test_a_public_name_is_documented_and_typed(name):
    value = getattr(drapery.cloth, name)
    words = inspect.getdoc(value) or ""
    assert len(words.split()) >= 4 and not words.startswith(f"{name}(")
    if inspect.isfunction(value):
        signature = inspect.signature(value)
        assert signature.return_annotation is not signature.empty
        assert all(p.annotation is not p.empty for p in signature.parameters.values())


@pytest.mark.parametrize("name", SOLVERS.values())
def test_a_solver_documents_each_of_its_settings(name):
    solver = getattr(drapery.cloth, name)
    assert is_dataclass(solver)
    words = inspect.getdoc(solver)
    for field in solver.__dataclass_fields__:
        assert f"{field}:" in words or f"{field}," in words, field
