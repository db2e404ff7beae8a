"""An extension of griffe for our docstrings: lines `name: meaning` become a list."""

import re
from typing import Any

import griffe

LINE = re.compile(r"^(\w+): (.*)$")


class ParameterLists(griffe.Extension):
    """Makes a Markdown list of the lines that describe parameters or attributes."""

    def on_object(self, *, obj: griffe.Object, **_: Any) -> None:
        """Change the docstring of a function or class."""
        if obj.docstring is not None and (obj.is_function or obj.is_class):
            obj.docstring.value = with_lists(obj.docstring.value, _names(obj))


def with_lists(text: str, names: set[str]) -> str:
    """The text with `name: meaning` as an item of a list, if the name is known.

    An item goes on while lines are indented or the last one has no full stop.
    """
    lines: list[str] = []
    listing = False
    for line in text.splitlines():
        found = LINE.match(line)
        if listing and line.strip() and (line.startswith(" ") or not lines[-1].endswith(".")):
            lines[-1] += f" {line.strip()}"
        elif found and found[1] in names:
            lines += [] if listing or not lines or not lines[-1] else [""]
            lines.append(f"- `{found[1]}`: {found[2]}")
            listing = True
        else:
            lines += [""] if listing and line else []
            lines.append(line)
            listing = False
    return "\n".join(lines)


def _names(obj: griffe.Object) -> set[str]:
    parameters = getattr(obj, "parameters", ())
    return {parameter.name for parameter in parameters} | set(obj.members)
