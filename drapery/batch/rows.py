"""Reads a manifest file as rows, each with its place in the file."""

import csv
import io
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, TypeAlias

from drapery import Banner
from drapery.errors import DesignError, DraperyError, OptionError, counted
from drapery.json_text import JSONTextError, parse_json
from drapery.user_files import read_user_file, reason, shown_path

MAX_TEXT = 512 << 20
MAX_YAML = 16 << 20
"""The tree of a YAML text takes about fifty times the memory of the text."""
MAX_CELL = 1 << 20


@dataclass(frozen=True)
class ManifestRow:
    """One row of a manifest.

    place: of the row, for messages. values: by the names of options. banner: found in a world or
    given as an object. where: its place in a world; empty for other manifests.
    defaults: those of the manifest, by the names of options.
    """

    place: str
    values: dict[str, Any] = field(default_factory=dict)
    banner: Banner | None = None
    where: str = ""
    defaults: Mapping[str, Any] = field(default_factory=dict)


@dataclass(frozen=True)
class ManifestFault:
    """A fault of a manifest.

    place: its place in the manifest.
    message: the fault in one line with the remedy.
    """

    place: str
    message: str

    def __str__(self) -> str:
        return f"{self.place}: {self.message}"


Rows: TypeAlias = Iterator[ManifestRow | ManifestFault]


def read_rows(path: Path) -> Rows:
    """The rows of a manifest, and a fault for each part that is not a row.

    A CSV file has a row of names; lines `# name = value` before it are defaults. In JSON lines,
    an object with the one key `defaults` holds for the lines after it. YAML is a list of jobs, or
    `jobs` beside `defaults`. A world's folder, a region or a schematic has a row for each banner.

    Raises OptionError for a file that is none of these, DesignError for a broken world.
    """
    reader = _READERS.get(path.suffix.lower())
    try:
        exists, is_folder = path.exists(), path.is_dir()
    except (OSError, ValueError) as error:
        raise OptionError(f"{shown_path(path)}: {reason(error)}; check the path") from None
    if not exists:
        raise OptionError(
            f"{shown_path(path)}: no such file or folder; name a manifest, world or schematic"
        )
    yield from _banners(path) if is_folder or reader is None else reader(path)


def _text(path: Path, limit: int) -> str:
    data = read_user_file(path, limit, remedy="make it readable", shorter="split it")
    try:
        return io.TextIOWrapper(io.BytesIO(data), encoding="utf-8-sig").read()
    except UnicodeDecodeError as error:
        raise OptionError(f"{path}: byte {error.start} is not UTF-8; save it as UTF-8") from None


def _csv(path: Path) -> Rows:
    text = io.StringIO(_text(path, MAX_TEXT), newline="")
    defaults, skipped = _csv_defaults(text)
    csv.field_size_limit(MAX_CELL)
    reader = csv.reader(text, strict=True)
    names: list[str] = []
    line = skipped + 1
    try:
        for cells in reader:
            place, line = f"line {line}", skipped + reader.line_num + 1
            if not names:
                names = [cell.strip() for cell in cells]
                if len(names) == 1 and ";" in names[0]:
                    message = "columns are separated by semicolons; separate them by commas"
                    yield ManifestFault(place, message)
                    return
            elif len(cells) > len(names):
                message = f"{len(cells)} cells for {counted(len(names), 'column')}; quote commas"
                yield ManifestFault(place, message)
            elif any(cell.strip() for cell in cells):
                filled = {n: c.strip() for n, c in zip(names, cells, strict=False) if c.strip()}
                yield ManifestRow(place, filled, defaults=defaults)
    except csv.Error:
        message = f"not CSV; close its quotes, and use at most {MAX_CELL} characters in a cell"
        yield ManifestFault(f"line {line}", message)


def _csv_defaults(text: io.StringIO) -> tuple[dict[str, str], int]:
    """The defaults in the lines before the names, and how many lines those are.

    The text is left at the line of names. Lines end as csv ends them, not at U+2028 or form feed.
    """
    defaults: dict[str, str] = {}
    skipped = 0
    while True:
        start = text.tell()
        line = text.readline()
        if not line or (line.strip() and not line.startswith("#")):
            text.seek(start)
            return defaults, skipped
        skipped += 1
        name, equals, value = line.lstrip("#").partition("=")
        if equals:
            defaults[name.strip()] = value.strip()


def _json_lines(path: Path) -> Rows:
    defaults: dict[str, Any] = {}
    for number, line in enumerate(_text(path, MAX_TEXT).split("\n"), 1):
        place = f"line {number}"
        if not line.strip():
            continue
        try:
            values = parse_json(line)
        except JSONTextError:
            yield ManifestFault(place, "not JSON; write one object on a line")
            continue
        if not isinstance(values, dict):
            yield ManifestFault(place, "not an object; write {...} with the job's options")
        elif set(values) == {"defaults"} and isinstance(values["defaults"], dict):
            defaults = values["defaults"]
        else:
            yield ManifestRow(place, values, defaults=defaults)


def _yaml(path: Path) -> Rows:
    from drapery.yaml_text import LocatedList, load_yaml

    root = load_yaml(_text(path, MAX_YAML), path)
    parts = root if isinstance(root, dict) else {"jobs": root}
    jobs, defaults = parts.get("jobs"), parts.get("defaults")
    defaults = {} if defaults is None else defaults
    if not isinstance(jobs, LocatedList) or not set(parts) <= {"jobs", "defaults"}:
        raise OptionError(f"{path}: write a list of jobs, or `jobs` and `defaults`")
    if not isinstance(defaults, dict):
        raise OptionError(f"{path}: write defaults as names of options, each with a value")
    for job, line in zip(jobs, jobs.lines, strict=True):
        place = f"line {line}"
        if isinstance(job, dict):
            yield ManifestRow(place, dict(job), defaults=defaults)
        else:
            message = "not a job; write names of options, each with a value"
            yield ManifestFault(place, message)


def _banners(path: Path) -> Rows:
    """One row for each banner; the reader warns of the broken parts of a world."""
    from drapery import read_designs

    try:
        found = read_designs(path)
    except DesignError:
        raise
    except DraperyError as error:
        raise OptionError(f"{path}: {error}") from None
    for one in found:
        yield ManifestRow(one.where or path.name, {}, one.banner, one.where)


_READERS = {
    ".csv": _csv,
    ".jsonl": _json_lines,
    ".ndjson": _json_lines,
    ".yaml": _yaml,
    ".yml": _yaml,
}
