"""What `help` says of garments."""

import pydoc

import pytest

from drapery import garments

TABLES = [name for name in garments.__all__ if hasattr(getattr(garments, name), "model_fields")]


@pytest.mark.parametrize("name", TABLES)
def test_help_shows_the_fields_and_nothing_of_pydantic(name: str) -> None:
    table = getattr(garments, name)
    text = pydoc.plain(pydoc.render_doc(table))
    described = text.replace(", ", ":\n").partition("Method resolution order")[0]
    own = [field for field in table.model_fields if field in vars(table).get("__annotations__", ())]
    assert own and all(f" {field}:" in described for field in own)
    for internal in ("model_dump", "__pydantic", "Annotated", "FieldInfo", "BeforeValidator"):
        assert internal not in text
