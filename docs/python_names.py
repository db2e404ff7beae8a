"""The public names of a module with their signatures and docstrings, as Markdown."""

import re
import shutil
import tempfile
from collections.abc import Iterator
from functools import cache
from pathlib import Path

import griffe
from parameter_lists import ParameterLists
from public_names import PublicNames

ROOT = Path(__file__).resolve().parent.parent
WIDTH = 88
"""The longest signature that stands in one line."""


def names_of(module: str) -> str:
    """What a module is, and a section of each public name with those of its members."""
    home = _package()
    if module != "drapery":
        home = home[module.removeprefix("drapery.")]
    sections = [f"{home.docstring.value.strip()}\n"] if home.docstring else []
    for name in map(str, home.exports or ()):
        found = home.members[name]
        target = found.final_target if isinstance(found, griffe.Alias) else found
        sections.append(_section(f"## {name}", name, target))
        for each in _members(target):
            sections.append(_section(f"### {name}.{each.name}", each.name, each))
    return "\n".join(sections)


@cache
def _package() -> griffe.Module:
    """The package as it is installed, from its sources."""
    with tempfile.TemporaryDirectory() as folder:
        copy_sources(Path(folder, "drapery"))
        extensions = griffe.load_extensions(ParameterLists(), PublicNames())
        loaded = griffe.load(
            "drapery", search_paths=[folder], try_relative_path=False, extensions=extensions
        )
    assert isinstance(loaded, griffe.Module)
    return loaded


def copy_sources(target: Path) -> None:
    """Copy the package with `render/` in it, as it is installed."""
    sources = shutil.ignore_patterns("__pycache__", "*.png", "*.js", "*.wasm")
    shutil.copytree(ROOT / "drapery", target, ignore=sources)
    shutil.copytree(ROOT / "render", target / "render", ignore=sources)


def _members(found: griffe.Object) -> Iterator[griffe.Object]:
    """The public members of a class that have a docstring, in the order of the source."""
    members = found.members.items() if found.is_class else ()
    for name, member in members:
        target = member.final_target if isinstance(member, griffe.Alias) else member
        if not name.startswith("_") and target.has_docstring:
            yield target


def _section(heading: str, name: str, found: griffe.Object) -> str:
    text = found.docstring.value.strip() if found.docstring else ""
    return f"{heading}\n\n```python\n{_signature(name, found)}\n```\n\n{text}\n"


def _signature(name: str, found: griffe.Object) -> str:
    if isinstance(found, griffe.Class):
        if "Protocol" in map(str, found.bases) and "__call__" in found.members:
            return _signature(name, found["__call__"])  # a name of functions
        parameters = list(_parameters(found.parameters))
        return _call(f"class {name}", parameters, "") if parameters else f"class {name}"
    if isinstance(found, griffe.Function):
        returns = f" -> {found.returns}" if found.returns else ""
        return _call(name, list(_parameters(found.parameters)), returns)
    annotation, value = getattr(found, "annotation", None), str(getattr(found, "value", ""))
    if alias := re.fullmatch(r"TypeAliasType\('\w+', (.*)\)", value):
        return f"{name} = {alias[1]}"
    if str(annotation) in ("None", "TypeAlias") and name[:2] != name[:2].upper():
        return f"{name} = {value}"  # a name of types
    return f"{name}: {annotation}" if annotation else name


def _call(name: str, parameters: list[str], returns: str) -> str:
    line = f"{name}({', '.join(parameters)}){returns}"
    if len(line) <= WIDTH:
        return line
    return f"{name}(\n" + "".join(f"    {each},\n" for each in parameters) + f"){returns}"


def _parameters(parameters: griffe.Parameters) -> Iterator[str]:
    keywords = False
    for each in parameters:
        if each.name in ("self", "cls"):
            continue
        if each.kind is griffe.ParameterKind.keyword_only and not keywords:
            keywords = True
            yield "*"
        variadic = {"variadic positional": "*", "variadic keyword": "**"}
        stars = variadic.get(each.kind.value if each.kind else "", "")
        keywords = keywords or stars == "*"
        kind = f": {each.annotation}" if each.annotation else ""
        default = "" if each.default is None or stars else f" = {_short(str(each.default))}"
        yield f"{stars}{each.name}{kind}{default}"


def _short(text: str) -> str:
    """A default value; that of an option is the first argument of a call that describes it."""
    found = re.match(r"option_field\((.*?), ", text)
    return found[1] if found else text
