"""Files of styles: TOML, checked as a whole."""

from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Annotated, Any, Literal

from pydantic import BaseModel, ConfigDict, Field, ValidationError

from drapery.errors import OptionError, shown
from drapery.styles.chain import chain_fault
from drapery.styles.palette_files import read_palette
from drapery.styles.step import STEP_KINDS, StyleStep, parameter_faults
from drapery.styles.steps import STEPS
from drapery.toml_text import locate, read_toml

MAX_BYTES = 1 << 16
"""The longest file of a style [bytes]."""
MAX_STEPS = 32
"""The most steps of one kind in a file."""

StepTables = Annotated[list[dict[str, Any]], Field(max_length=MAX_STEPS)]


class StyleFile(BaseModel):
    """The contents of a file: see docs/guides/styles.md."""

    model_config = ConfigDict(extra="forbid")

    description: Annotated[str, Field(max_length=200)] = ""
    light: Literal["game", "flat", "studio"] | None = None
    samples: Literal[1, 4, 16] | None = None
    motion: StepTables = []
    shape: StepTables = []
    material: StepTables = []
    picture: StepTables = []


def read_style_file(path: str | Path) -> tuple[StyleFile, tuple[StyleStep, ...]]:
    """The contents of a file, and its steps.

    Raises OptionError that names the file, the line, the field and the remedy.
    """
    tree, text = read_toml(path, MAX_BYTES, "a style")
    try:
        parsed = StyleFile.model_validate(tree)
    except ValidationError as error:
        fault = error.errors()[0]
        place = tuple(fault["loc"])
        raise OptionError(f"{locate(path, text, place)}: {_complaint(fault, place)}") from None
    steps = tuple(_steps(parsed, path, text))
    if excess := chain_fault(steps):
        where = locate(path, text, (excess.kind, excess.number, "step"))
        raise OptionError(f"{where}: {excess.message}")
    return parsed, steps


def _steps(parsed: StyleFile, path: str | Path, text: str) -> Iterator[StyleStep]:
    for kind in STEP_KINDS:
        tables: list[dict[str, Any]] = getattr(parsed, kind)
        for number, table in enumerate(tables):
            given = dict(table)
            name = given.pop("step", None)
            known = STEPS[kind]
            if not isinstance(name, str) or name not in known:
                where = locate(path, text, (kind, number, "step"))
                said = f"step {shown(name)} is not known" if "step" in table else "step is missing"
                raise OptionError(f"{where}: {said}; use one of: {', '.join(known)}")
            if name == "palette" and "file" in given:
                where = locate(path, text, (kind, number, "file"))
                given = _with_palette(given, Path(path).parent, where)
            for field, fault in parameter_faults(kind, known[name], given).items():
                raise OptionError(f"{locate(path, text, (kind, number, field))}: {name}: {fault}")
            yield StyleStep(kind, known[name], given)


def _with_palette(given: dict[str, Any], folder: Path, where: str) -> dict[str, Any]:
    """The parameters of the step `palette` with the colours of its file, relative to a folder."""
    name = given.pop("file")
    if not isinstance(name, str) or not name:
        raise OptionError(f"{where}: file {shown(name)} is not a path; name a .gpl or .hex file")
    if "colours" in given:
        raise OptionError(f"{where}: palette has both file and colours; leave one out")
    try:
        return given | {"colours": read_palette(folder / name)}
    except OptionError as error:
        raise OptionError(f"{where}: {error}") from None


def _complaint(fault: Mapping[str, Any], place: tuple[int | str, ...]) -> str:
    name = ".".join(str(part) for part in place)
    if fault["type"] == "extra_forbidden":
        return f"{name} is not a field of a style; use one of: {', '.join(StyleFile.model_fields)}"
    remedy = {"description": "a text of at most 200 characters", "samples": "1, 4 or 16"}
    remedy |= {"light": "game, flat or studio"}
    tables = f"at most {MAX_STEPS} tables like [[{place[0]}]]"
    return f"{name} {shown(fault['input'])} cannot be used; use {remedy.get(name, tables)}"
