"""YAML from users: one safe loader with bounds on depth, on aliases and on numbers.

The caller limits the length of the text. PyYAML composes recursively and expands aliases, so the
stream of events is checked before any value is built from it. No message quotes PyYAML, whose
limits and texts differ between versions.
"""

from collections.abc import Callable, Iterator
from contextlib import suppress
from typing import Any, NoReturn

import yaml

from drapery.errors import OptionError

MAX_DEPTH = 64
"""The most lists and mappings inside one another."""
MAX_REPEATED = 100_000
"""The most values that aliases may repeat in one document."""
MAX_NUMBER = 100
"""The most characters of one number."""
MAX_KEY = 1024
"""The most characters of a key; YAML 1.2, 7.4.2, has this limit for a key without a `?`."""


class LocatedList(list[Any]):
    """A YAML sequence. lines: the line of each item in the text, from 1."""

    lines: list[int]


def load_yaml(text: str, where: object) -> Any:
    """The value of a YAML document; an empty document is None.

    text: one document of plain YAML: mappings, lists, texts, numbers, dates, true, false, null.
    where: the name of the file, for messages.
    Lists are `LocatedList`. Keys are texts as they are written, also `3`, `yes` and `null`.
    Raises OptionError, with line and column, for a text that is not such a document, that repeats
    a key, or that exceeds MAX_DEPTH, MAX_REPEATED, MAX_NUMBER or MAX_KEY.
    """
    try:
        _check(text)
        return yaml.load(text, _Loader)
    except _YamlFaultError as fault:
        place, reason = _at(fault.mark), fault.reason
    except yaml.MarkedYAMLError as error:
        place, reason = _at(error.problem_mark or error.context_mark), _fault(text, error)
    except yaml.reader.ReaderError as error:
        place, reason = (
            _place(text, error.position),
            f"character {error.character!r} is not allowed",
        )
    except UnicodeEncodeError as error:  # half of a pair of surrogates
        place = _place(text, error.start)
        reason = f"character {text[error.start]!r} is not allowed"
    except yaml.YAMLError:
        place, reason = "", "not YAML"
    raise OptionError(f"{where}{place}: {reason}; correct the YAML there")


class _YamlFaultError(Exception):
    """What this module refuses. mark: PyYAML's mark of the place."""

    def __init__(self, reason: str, mark: Any) -> None:
        self.reason, self.mark = reason, mark


def _at(mark: Any) -> str:
    return "" if mark is None else f", line {mark.line + 1}, column {mark.column + 1}"


def _fault(text: str, error: yaml.MarkedYAMLError) -> str:
    """What cannot stand at a place, and where that begins of which it would be a part."""
    mark, start = error.problem_mark, error.context_mark
    if mark is None:
        return "not YAML"
    what = repr(text[mark.index]) if mark.index < len(text) else "the end of the text"
    if what == "'\\t'":
        return "a tab cannot stand here; use spaces"
    inside = "" if start is None else f" in what begins in line {start.line + 1}"
    return f"{what} cannot stand here{inside}"


def _place(text: str, position: int) -> str:
    before = text[:position]
    column = position - before.rfind("\n")
    return f", line {before.count(chr(10)) + 1}, column {column}"


def _check(text: str) -> None:
    """Raise _YamlFaultError for what is not one document, nests too deeply, or has faulty aliases.

    PyYAML reads up to 1,024 characters of a line ahead of its events, since a bracket may begin a
    key, and some versions refuse the depth that they see there. Which depth is allowed is said
    here, so the events of the text before such a place are looked at first.
    """
    try:
        _check_events(text)
    except yaml.MarkedYAMLError as error:
        if error.problem_mark is not None:
            with suppress(yaml.YAMLError):  # that the text ends, for example
                _check_events(text[: error.problem_mark.index])
        raise


def _check_events(text: str) -> None:
    depth = repeated = count = documents = 0
    sizes: dict[str, int] = {}
    open_nodes: list[tuple[str | None, int]] = []
    for event in yaml.parse(text, BASE):
        if isinstance(event, yaml.DocumentStartEvent):
            documents += 1
            if documents > 1:
                _refuse("a second document begins", event)
        elif isinstance(event, yaml.AliasEvent):
            name = event.anchor or ""
            if any(anchor == name for anchor, _ in open_nodes):
                _refuse(f"*{name} repeats a value inside itself", event)
            if name not in sizes:
                _refuse(f"*{name} repeats nothing: no &{name} stands before it", event)
            repeated, count = repeated + sizes[name], count + sizes[name]
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


def _refuse(reason: str, place: Any) -> NoReturn:
    """Raise _YamlFaultError. place: an event or a node."""
    raise _YamlFaultError(reason, place.start_mark)


BASE: Any = getattr(yaml, "CSafeLoader", yaml.SafeLoader)
"""The loader of PyYAML that reads the events: the one in C where it is built."""


class _Loader(BASE):  # type: ignore[misc]
    """The safe loader with located lists, short numbers, and texts as keys, none of them twice."""


def _sequence(loader: Any, node: yaml.SequenceNode) -> Iterator[LocatedList]:
    items = LocatedList()
    items.lines = [child.start_mark.line + 1 for child in node.value]
    yield items
    items.extend(loader.construct_sequence(node))


def _mapping(loader: Any, node: yaml.MappingNode) -> Iterator[dict[str, Any]]:
    seen: set[str] = set()
    for key, _ in node.value:
        if _key(key) in seen:
            _refuse(f"the key {key.value!r} is given twice", key)
        seen.add(key.value)
    values: dict[str, Any] = {}
    yield values
    loader.flatten_mapping(node)  # a merge key brings in the keys of other mappings
    for key, value in node.value:
        values[_key(key)] = loader.construct_object(value)


def _key(node: yaml.Node) -> str:
    if not isinstance(node, yaml.ScalarNode):
        _refuse("a list or a mapping is no key", node)
    if len(node.value) > MAX_KEY:
        _refuse(f"a key has more than {MAX_KEY} characters", node)
    return str(node.value)


def _scalar(tag: str) -> Callable[[Any, Any], Any]:
    """PyYAML's reader of such values, whose faults get a place and a text of ours."""
    name = tag.rpartition(":")[2]
    construct = BASE.yaml_constructors[tag]

    def read(loader: Any, node: Any) -> Any:
        if name in ("int", "float") and len(node.value) > MAX_NUMBER:
            _refuse(f"a number has more than {MAX_NUMBER} characters", node)
        try:
            return construct(loader, node)
        except (ArithmeticError, AttributeError, LookupError, TypeError, ValueError):
            _refuse(f"{str(node.value)[:40]!r} is not of the type {name}", node)

    return read


def _unknown(_: Any, node: yaml.Node) -> NoReturn:
    _refuse(f"the tag {node.tag[:60]} is not read", node)


_Loader.add_constructor("tag:yaml.org,2002:seq", _sequence)
_Loader.add_constructor("tag:yaml.org,2002:map", _mapping)
for _name in ("null", "bool", "int", "float", "binary", "timestamp"):
    _Loader.add_constructor(f"tag:yaml.org,2002:{_name}", _scalar(f"tag:yaml.org,2002:{_name}"))
_Loader.add_constructor(None, _unknown)
