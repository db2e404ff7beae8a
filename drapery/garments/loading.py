"""Files of garments: TOML, checked as a whole by the models; every fault names its line."""

from collections.abc import Mapping
from pathlib import Path
from typing import Any, TypeVar

from pydantic import BaseModel, ValidationError

from drapery.errors import OptionError, shown
from drapery.model_faults import said_of, wanted
from drapery.toml_text import Place, locate, read_toml

MAX_BYTES = 1 << 16
"""The longest file of a garment [bytes]."""

Model = TypeVar("Model", bound=BaseModel)


def load_tables(
    model: type[Model],
    path: Path,
    given: Mapping[str, Any],
    tables: Mapping[str, type[BaseModel]],
) -> Model:
    """The model of a TOML file.

    given: fields that the file does not set. tables: the models of its tables by name.
    Raises OptionError that names the file, the line, the field and the remedy.
    """
    tree, text = read_toml(path, MAX_BYTES, "a garment")
    if taken := sorted(tree.keys() & given.keys()):
        where = locate(path, text, (taken[0],))
        raise OptionError(f"{where}: {taken[0]} is taken from the file's path; leave it out")
    try:
        return model.model_validate(tree | dict(given))
    except ValidationError as error:
        # An unknown field is often the reason why another one is missing.
        fault = min(error.errors(), key=lambda each: each["type"] != "extra_forbidden")
        place: Place = fault.get("ctx", {}).get("place") or tuple(fault["loc"])
        # The shape of a piece stands in the place between its number and its field.
        tags = set(tables) if len(place) > 1 and isinstance(place[1], int) else set()
        field = (*place[:2], *(part for part in place[2:] if part not in tags - {"texture"}))
        inside = [part for part in place if part in tables]
        known = tables[str(inside[-1])] if inside else model
        message = _complaint(fault, field, known, given if known is model else {})
        raise OptionError(f"{locate(path, text, field)}: {message}") from None


def complaint_of(error: ValidationError, table: type[BaseModel]) -> str:
    """The first fault of one table in a line: the field, and what to use instead."""
    fault = error.errors()[0]
    return _complaint(fault, tuple(fault["loc"]), table, {})


def _complaint(fault: Any, place: Place, table: type[BaseModel], given: Mapping[str, Any]) -> str:
    name = next((str(part) for part in reversed(place) if isinstance(part, str)), "the file")
    if fault["type"] == "extra_forbidden":
        known = ", ".join(each for each in table.model_fields if each not in given)
        return f"{name} is not a field here; use one of: {known}"
    if fault["type"] == "missing":
        if isinstance(place[-1], int):
            return f"{name} has too few values: {place[-1]}; give at least {place[-1] + 1}"
        return f"{name} is missing; add it"
    if fault["type"] == "union_tag_invalid":
        allowed = fault["ctx"]["expected_tags"].replace("'", "")
        return f"shape {shown(fault['ctx']['tag'])} is not known; use one of: {allowed}"
    if (said := said_of(fault)) is not None:
        return said
    return f"{name} {shown(fault['input'])} cannot be used; it should {wanted(fault)}"
