"""The signatures of all public names, read from the sources without importing them.

`python tests/public_api.py` writes them to `tests/public_api.txt`, as of a release; the test
compares what is there now with that file and with the CHANGELOG.
"""

import re
import runpy
import shutil
import tempfile
from collections.abc import Iterator
from pathlib import Path

import griffe

ROOT = Path(__file__).parent.parent
RECORD = Path(__file__).with_suffix(".txt")
PUBLIC_NAMES = ROOT / "docs" / "public_names.py"
PACKAGES: tuple[str, ...] = tuple(runpy.run_path(str(PUBLIC_NAMES))["PACKAGES"])
"""Those that others may import."""


def load() -> griffe.Module:
    """The package as it is installed; `render` lies beside it in the checkout."""
    with tempfile.TemporaryDirectory() as folder:
        package = Path(folder) / "drapery"
        sources = shutil.ignore_patterns("__pycache__", "*.png")
        shutil.copytree(ROOT / "drapery", package, ignore=sources)
        shutil.copytree(ROOT / "render", package / "render", ignore=sources)
        loaded = griffe.load(
            "drapery",
            search_paths=[folder],
            try_relative_path=False,
            extensions=griffe.load_extensions(str(PUBLIC_NAMES)),
        )
    assert isinstance(loaded, griffe.Module)
    return loaded


def public_objects(package: griffe.Module) -> Iterator[tuple[str, griffe.Object]]:
    """The objects that every public package exports, by their public names, sorted."""
    for prefix in PACKAGES:
        home = package if prefix == "drapery" else package[prefix.removeprefix("drapery.")]
        for name in sorted(str(export) for export in home.exports or ()):
            found = home.members[name]
            yield f"{prefix}.{name}", found.final_target if found.is_alias else found


def signatures() -> dict[str, str]:
    """Every public name, and those of public members, with its signature."""
    lines: dict[str, str] = {}
    for name, found in public_objects(load()):
        lines[name] = _signature(found)
        if found.is_class:
            for member in found.all_members.values():
                if member.is_public and not member.name.startswith("_"):
                    lines[f"{name}.{member.name}"] = _signature(member)
    return lines


def read_record() -> dict[str, str]:
    """The signatures that the last release had."""
    lines = RECORD.read_text(encoding="utf-8").splitlines()
    return dict(line.split(" ", 1) for line in lines)


def changed(before: dict[str, str], now: dict[str, str]) -> list[str]:
    """Names that came, went or have another signature."""
    return sorted(n for n in before.keys() | now.keys() if before.get(n) != now.get(n))


def announced(changelog: str) -> set[str]:
    """Names in backquotes in the changelog's newest section."""
    newest = re.split(r"(?m)^## ", changelog)[1]
    return {part for code in re.findall(r"`([^`]+)`", newest) for part in re.findall(r"\w+", code)}


def _signature(found: griffe.Object) -> str:
    if isinstance(found, griffe.Function | griffe.Class):
        returns = f" -> {found.returns}" if isinstance(found, griffe.Function) else ""
        return f"{found.kind.value}({', '.join(_parameters(found))}){returns}"
    return f"{found.kind.value}: {getattr(found, 'annotation', None)}"


def _parameters(found: griffe.Function | griffe.Class) -> Iterator[str]:
    kind = None
    for parameter in found.parameters:
        if parameter.name == "self":
            continue
        if parameter.kind is griffe.ParameterKind.keyword_only and kind is not parameter.kind:
            yield "*"
        kind = parameter.kind
        default = "" if parameter.default is None else f" = {parameter.default}"
        yield f"{parameter.name}: {parameter.annotation}{default}"


if __name__ == "__main__":
    listed = "".join(f"{name} {shown}\n" for name, shown in sorted(signatures().items()))
    RECORD.write_text(listed, encoding="utf-8")
