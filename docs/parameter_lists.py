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
    """The text with `name, name: meaning` as an item of a list, if all of these names are known."""
    lines: list[str] = []
    listing = False
    for line in text.splitlines():
        found = LINE.match(line)
        if found and set(found[1].split(", ")) <= names:
            shown = ", ".join(f"`{name}`" for name in found[1].split(", "))
            if not listing and lines and lines[-1]:
                lines.append("")
            lines.append(f"- {shown}: {found[2]}")
            listing = True
        elif listing and line.startswith(" ") and line.strip():
            lines.append(f"  {line.strip()}")
        else:
            if listing and line:
                lines.append("")
            lines.append(line)
            listing = False
    return "\n".join(lines)


def _names(obj: griffe.Object) -> set[str]:
    parameters = getattr(obj, "parameters", ())
    return {parameter.name for parameter in parameters} | set(obj.members)
