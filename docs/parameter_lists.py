"""An extension of griffe for our docstrings: lines `name: meaning` become a list."""

import re
from typing import Any

import griffe

LINE = re.compile(r"^(\w+(?:, \w+)*): (.*)$")


class ParameterLists(griffe.Extension):
    """Makes a Markdown list of the lines that describe parameters or attributes."""

    def on_object(self, *, obj: griffe.Object, **_: Any) -> None:
        """Change the docstring of a function or class."""
        if obj.docstring is not None and (obj.is_function or obj.is_class):
            obj.docstring.value = with_lists(obj.docstring.value, _names(obj))


def with_lists(text: str, names: set[str]) -> str:
    """The text with `name, name: meaning` as an item of a list, if all of these names are known.

    An item goes on while lines are indented or the last one has no full stop; several in one
    line become several.
    """
    lines: list[str] = []
    listing = False
    for line in text.splitlines():
        if listing and line.strip() and (line.startswith(" ") or not lines[-1].endswith(".")):
            lines[-1] += f" {line.strip()}"
        elif _is_item(line, names):
            lines += [] if listing or not lines or not lines[-1] else [""]
            lines.append(line)
            listing = True
        else:
            lines += [""] if listing and line else []
            lines.append(line)
            listing = False
    return "\n".join(shown for line in lines for shown in _items(line, names))


def _is_item(line: str, names: set[str]) -> bool:
    found = LINE.match(line)
    return found is not None and set(found[1].split(", ")) <= names


def _items(line: str, names: set[str]) -> list[str]:
    """A line, or the items of a list that it holds."""
    if not _is_item(line, names):
        return [line]
    items: list[str] = []
    for part in re.split(r"(?<=\.) (?=\w+(?:, \w+)*: )", line):
        if _is_item(part, names):
            listed, _, meaning = part.partition(": ")
            items.append(f"- {', '.join(f'`{name}`' for name in listed.split(', '))}: {meaning}")
        else:
            items[-1] += f" {part}"
    return items


def _names(obj: griffe.Object) -> set[str]:
    parameters = getattr(obj, "parameters", ())
    return {parameter.name for parameter in parameters} | set(obj.members)
