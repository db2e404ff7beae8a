"""YAML from users: one safe loader with bounds on depth, on aliases and on numbers.

The caller limits the length of the text. PyYAML composes recursively and expands aliases, so the
stream of events is checked before any value is built from it.
"""

from collections.abc import Iterator
from typing import Any

import yaml

from drapery.errors import OptionError

MAX_DEPTH = 64
"""The most lists and mappings inside one another."""
MAX_REPEATED = 100_000
"""The most values that aliases may repeat in one document."""
MAX_NUMBER = 100
"""The most characters of one number."""
MAX_REASON = 200
"""The most characters of the parser's reason in a message."""


class LocatedList(list[Any]):
    """A YAML sequence. lines: the line of each item in the text, from 1."""

    lines: list[int]


def load_yaml(text: str, where: object) -> Any:
    """The value of a YAML document; an empty document is None.

    text: one document of plain YAML: mappings, lists, texts, numbers, dates, true, false, null.
    where: the name of the file, for messages.
    Lists are `LocatedList`. Raises OptionError, with line and column, for a text that is not such
    a document, that repeats a key, or that exceeds MAX_DEPTH, MAX_REPEATED or MAX_NUMBER.
    """
    try:
        _check_events(text)
        return yaml.load(text, _Loader)
    except yaml.MarkedYAMLError as error:
        mark = error.problem_mark or error.context_mark
        place = "" if mark is None else f", line {mark.line + 1}, column {mark.column + 1}"
        reason = ", ".join(filter(None, (error.context, error.problem))) or "not YAML"
    except yaml.reader.ReaderError as error:
        place, reason = (
            _place(text, error.position),
            f"character {error.character!r} is not allowed",
        )
    except (yaml.YAMLError, ValueError, OverflowError) as error:
        place, reason = "", str(error)
    reason = " ".join(reason.split())
    if len(reason) > MAX_REASON:
        reason = reason[:MAX_REASON] + " ..."
    raise OptionError(f"{where}{place}: {reason}; correct the YAML there")


def _place(text: str, position: int) -> str:
    before = text[:position]
    column = position - before.rfind("\n")
    return f", line {before.count(chr(10)) + 1}, column {column}"


def _check_events(text: str) -> None:
    """Raise MarkedYAMLError for a document that nests too deeply or that aliases make too large."""
    depth = repeated = count = 0
    sizes: dict[str, int] = {}
    open_nodes: list[tuple[str | None, int]] = []
    for event in yaml.parse(text, _BASE):
        if isinstance(event, yaml.AliasEvent):
            if any(anchor == event.anchor for anchor, _ in open_nodes):
                _refuse(f"*{event.anchor} repeats a value inside itself", event)
            size = sizes.get(event.anchor or "", 0)
            repeated, count = repeated + size, count + size
            if repeated > MAX_REPEATED:
                _refuse(f"aliases repeat more than {MAX_REPEATED} values", event)
        elif isinstance(event, yaml.ScalarEvent):
            count += 1
            if event.anchor:
                sizes[event.anchor] = 1
        elif isinstance(event, yaml.CollectionStartEvent):
            depth, count = depth + 1, count + 1
            open_nodes.append((event.anchor, count))
            if depth > MAX_DEPTH:
                _refuse(f"lists and mappings nest more than {MAX_DEPTH} deep", event)
        elif isinstance(event, yaml.CollectionEndEvent):
            depth -= 1
            anchor, start = open_nodes.pop()
            if anchor:
                sizes[anchor] = count - start + 1


def _refuse(reason: str, event: Any) -> None:
    raise yaml.MarkedYAMLError(problem=reason, problem_mark=event.start_mark)


_BASE: Any = getattr(yaml, "CSafeLoader", yaml.SafeLoader)


class _Loader(_BASE):  # type: ignore[misc]
    """The safe loader with located lists, short numbers and no key twice in a mapping."""


def _sequence(loader: Any, node: yaml.SequenceNode) -> Iterator[LocatedList]:
    items = LocatedList()
    items.lines = [child.start_mark.line + 1 for child in node.value]
    yield items
    items.extend(loader.construct_sequence(node))


def _mapping(loader: Any, node: yaml.MappingNode) -> Iterator[dict[Any, Any]]:
    seen: set[tuple[str, str]] = set()
    for key, _ in node.value:
        if not isinstance(key, yaml.ScalarNode):
            continue
        if (key.tag, key.value) in seen:
            raise yaml.MarkedYAMLError(
                problem=f"the key {key.value!r} is given twice", problem_mark=key.start_mark
            )
        seen.add((key.tag, key.value))
    values: dict[Any, Any] = {}
    yield values
    values.update(loader.construct_mapping(node))


def _number(tag: str) -> Any:
    construct = _BASE.yaml_constructors[tag]

    def short(loader: Any, node: yaml.ScalarNode) -> Any:
        if len(node.value) > MAX_NUMBER:
            raise yaml.MarkedYAMLError(
                problem=f"a number has more than {MAX_NUMBER} characters",
                problem_mark=node.start_mark,
            )
        return construct(loader, node)

    return short


_Loader.add_constructor("tag:yaml.org,2002:seq", _sequence)
_Loader.add_constructor("tag:yaml.org,2002:map", _mapping)
for _tag in ("tag:yaml.org,2002:int", "tag:yaml.org,2002:float"):
    _Loader.add_constructor(_tag, _number(_tag))
