"""Manifests as rows: each file's form, read with the place of every row kept."""

import csv
import io
import json
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, TypeAlias

from drapery.banner.design import Banner
from drapery.errors import DesignError, DraperyError, OptionError
from drapery.options import one_line

MAX_TEXT = 512 << 20
MAX_YAML = 16 << 20
"""YAML is read as a tree, which takes some fifty times its length."""
MAX_CELL = 1 << 20


@dataclass(frozen=True)
class ManifestRow:
    """One job as it is written. words: by the names of options. banner: found in a world."""

    place: str
    words: dict[str, Any] = field(default_factory=dict)
    banner: Banner | None = None
    where: str = ""


@dataclass(frozen=True)
class ManifestFault:
    """What is wrong at a place of the manifest, in one line with the remedy."""

    place: str
    line: str

    def __str__(self) -> str:
        return f"{self.place}: {self.line}"


Rows: TypeAlias = Iterator[ManifestRow | ManifestFault]


def read_rows(path: Path) -> Rows:
    """The rows of a manifest, and the faults of what is no row.

    A CSV file has a row of names; lines `# name = value` before it are defaults. In JSON lines,
    an object with the one key `defaults` holds for the lines after it. YAML is a list of jobs, or
    `jobs` beside `defaults`. A world's folder, a region or a schematic has a row for each banner.

    Raises OptionError for a file that is none of these, DesignError for a broken world.
    """
    reader = _READERS.get(path.suffix.lower())
    if path.is_file() and reader is not None:
        yield from reader(path)
    elif path.is_dir() or path.is_file():
        yield from _banners(path)
    else:
        raise OptionError(f"{path}: no such file or folder; name a manifest, world or schematic")


def _text(path: Path, limit: int) -> str:
    try:
        if path.stat().st_size > limit:
            raise OptionError(f"{path} is larger than {limit >> 20} MiB; split it")
        return path.read_text(encoding="utf-8-sig")
    except OSError as error:
        raise OptionError(f"{path}: {error.strerror}; make it readable") from None
    except UnicodeDecodeError as error:
        raise OptionError(f"{path}: byte {error.start} is not UTF-8; save it as UTF-8") from None


def _csv(path: Path) -> Rows:
    text = _text(path, MAX_TEXT)
    defaults, skipped = _csv_defaults(text)
    body = io.StringIO(text, newline="")
    for _ in range(skipped):
        body.readline()
    csv.field_size_limit(MAX_CELL)
    reader = csv.reader(body, strict=True)
    names: list[str] = []
    line = skipped + 1
    try:
        for cells in reader:
            place, line = f"line {line}", skipped + reader.line_num + 1
            if not names:
                names = [cell.strip() for cell in cells]
            elif len(cells) > len(names):
                yield ManifestFault(
                    place, f"{len(cells)} cells for {len(names)} columns; quote commas"
                )
            elif any(cell.strip() for cell in cells):
                filled = {n: c.strip() for n, c in zip(names, cells, strict=False) if c.strip()}
                yield ManifestRow(place, {**defaults, **filled})
    except csv.Error as error:
        yield ManifestFault(f"line {line}", f"{error}; mend the quotes there")


def _csv_defaults(text: str) -> tuple[dict[str, str], int]:
    """Defaults in the lines before the names, and how many lines those are."""
    defaults, skipped = {}, 0
    for line in text.splitlines():
        if line.strip() and not line.startswith("#"):
            break
        skipped += 1
        name, equals, value = line.lstrip("#").partition("=")
        if equals:
            defaults[name.strip()] = value.strip()
    return defaults, skipped


def _json_lines(path: Path) -> Rows:
    defaults: dict[str, Any] = {}
    for number, line in enumerate(_text(path, MAX_TEXT).split("\n"), 1):
        place = f"line {number}"
        if not line.strip():
            continue
        try:
            words = json.loads(line)
        except (ValueError, RecursionError) as error:
            yield ManifestFault(
                place, f"no JSON ({one_line(str(error))}); write one object on a line"
            )
            continue
        if not isinstance(words, dict):
            yield ManifestFault(place, "no object; write {...} with the job's options")
        elif set(words) == {"defaults"} and isinstance(words["defaults"], dict):
            defaults = words["defaults"]
        else:
            yield ManifestRow(place, {**defaults, **words})


def _yaml(path: Path) -> Rows:
    import yaml

    text = _text(path, MAX_YAML)
    loader = getattr(yaml, "CSafeLoader", yaml.SafeLoader)(text)
    try:
        root = loader.get_single_node()
        nodes, defaults = _yaml_jobs(path, loader, root)
        for node in nodes:
            place = f"line {node.start_mark.line + 1}"
            words = loader.construct_object(node, deep=True)
            if isinstance(words, dict) and all(isinstance(key, str) for key in words):
                yield ManifestRow(place, {**defaults, **words})
            else:
                yield ManifestFault(place, "no job; write names of options, each with a value")
    except (yaml.YAMLError, RecursionError, ValueError) as error:
        mark = getattr(error, "problem_mark", None)
        place = f"line {mark.line + 1}" if mark is not None else str(path)
        reason = getattr(error, "problem", None) or str(error)
        yield ManifestFault(place, f"no YAML ({one_line(reason)}); mend it there")
    finally:
        loader.dispose()


def _yaml_jobs(path: Path, loader: Any, root: Any) -> tuple[list[Any], dict[str, Any]]:
    """The nodes of the jobs, and the defaults."""
    import yaml

    if isinstance(root, yaml.SequenceNode):
        return root.value, {}
    parts = {k.value: v for k, v in root.value} if isinstance(root, yaml.MappingNode) else {}
    jobs = parts.pop("jobs", None)
    defaults = parts.pop("defaults", None)
    if not isinstance(jobs, yaml.SequenceNode) or parts:
        raise OptionError(f"{path}: write a list of jobs, or `jobs` and `defaults`")
    read = {} if defaults is None else loader.construct_object(defaults, deep=True)
    if not isinstance(read, dict):
        raise OptionError(f"{path}: defaults are names of options, each with a value")
    return jobs.value, read


def _banners(path: Path) -> Rows:
    """One row for each banner; what is broken in a world is warned of by the reader."""
    from drapery.banner.formats import read_designs

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
