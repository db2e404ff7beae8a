"""Inner packages never import outer ones, no modules import in a circle, and all are installed."""

import ast
import tomllib
from collections.abc import Iterable, Iterator
from dataclasses import MISSING, fields, is_dataclass
from functools import cache
from graphlib import CycleError, TopologicalSorter
from importlib import import_module
from pathlib import Path
from typing import NamedTuple

import pytest
from public_api import PACKAGES
from source_modules import FOLDERS, ROOT, modules

FOUNDATION = {
    *("errors", "elementary", "mesh", "option", "option_checks", "settings", "yaml_text", "jit"),
    *("arrays", "lazy", "toml_text", "player_settings", "version"),
    *("user_files", "picture_file", "picture_pixels", "mesh_file", "mesh_headers", "sqlite_faults"),
    *("json_text", "model_faults", "file_formats", "output_files", "module_process"),
}
CORE = {"cloth", "banner", "packs", "render", "style", "styles", "garments", "assets"}
PICTURES = {"stage", "scenes", "pictures", "comparison", "sheets", "match"}
APPLICATIONS = {"commands", "testing", "batch", "serve", "studio", "web", "beet", "cli", "__main__"}
RINGS = (FOUNDATION, CORE, PICTURES, APPLICATIONS)
"""From the innermost ring to the outermost; none imports one that is further out."""

# Within a ring, and in the foundation, each package names those that it may import.
ALLOWED: dict[str, set[str]] = {
    "errors": set(),
    "elementary": set(),
    "lazy": set(),
    "version": set(),
    "jit": {"errors"},
    "arrays": set(),
    "mesh": {"arrays", "errors"},
    "option": {"errors"},
    "settings": {"errors", "option"},
    "option_checks": {"errors", "option", "settings"},
    "player_settings": {"option"},
    "yaml_text": {"errors"},
    "user_files": {"errors"},
    "toml_text": {"errors", "user_files"},
    "file_formats": {"errors"},
    "output_files": {"errors"},
    "picture_file": {"errors", "file_formats"},
    "picture_pixels": {"errors"},
    "sqlite_faults": set(),
    "json_text": set(),
    "model_faults": set(),
    "module_process": set(),
    "mesh_headers": {"errors", "json_text", "picture_file"},
    "mesh_file": {"arrays", "errors", "mesh", "mesh_headers", "user_files"},
    "assets": set(),
    "banner": {"assets"},
    "packs": {"banner"},
    "cloth": set(),
    "render": set(),
    "style": {"banner", "render", "cloth"},
    "styles": {"style", "render", "banner", "cloth"},
    "garments": {"style", "render", "banner", "cloth"},
    "stage": set(),
    "scenes": {"stage"},
    "pictures": {"stage"},
    "comparison": {"pictures", "stage"},
    "sheets": {"pictures", "comparison", "scenes", "stage"},
    "match": {"pictures", "sheets"},
    "testing": set(),
    "beet": {"testing"},
    "batch": set(),
    "serve": {"batch"},
    "web": set(),
    "studio": {"serve", "web"},
    "commands": {"testing", "batch", "serve", "studio", "web"},
    "cli": {"commands"},
    "__main__": {"cli"},
}
KNOWS_NO_SETTINGS = {"cloth", "banner", "packs", "render", "assets"}
"""Packages that others use without Drapery's options."""

SHARED = {
    *("drapery.pictures", "drapery.render.contact", "drapery.render.doctor"),
    "drapery.jit.kernel_cache",
    *("drapery.render.drawlist", "drapery.render.encode", "drapery.render.encode.quick_png"),
    *(f"drapery.{name}" for name in FOUNDATION),
}
"""Modules that are not public, whose names our applications may import."""


def package_of(name: str) -> str:
    return name.split(".")[1] if "." in name else "__init__"


def ring_of(package: str) -> int:
    return next(number for number, ring in enumerate(RINGS) if package in ring)


class Source(NamedTuple):
    """What the tests ask of one file, so that each is parsed once.

    imports: names of modules, and of names within modules. typed: those for type checkers too.
    named: the modules and names of `from … import …`. functions: of the module itself. classes: of
    any depth. changes: the lines that set an attribute or item of a module that is imported.
    """

    imports: frozenset[str]
    typed: frozenset[str]
    named: tuple[tuple[str, str], ...]
    functions: frozenset[str]
    classes: tuple[str, ...]
    changes: tuple[str, ...]


@cache
def source_of(path: Path) -> Source:
    tree = ast.parse(path.read_text(encoding="utf-8"))
    nodes = list(ast.walk(tree))
    named = [node for node in nodes if isinstance(node, ast.ImportFrom)]
    return Source(
        frozenset(_imported(_running(tree))),
        frozenset(_imported(nodes)),
        tuple((node.module or "", alias.name) for node in named for alias in node.names),
        frozenset(node.name for node in tree.body if isinstance(node, ast.FunctionDef)),
        tuple(node.name for node in nodes if isinstance(node, ast.ClassDef)),
        tuple(_changes(tree)),
    )


def _for_types_only(node: ast.AST) -> bool:
    return isinstance(node, ast.If) and "TYPE_CHECKING" in ast.unparse(node.test)


def _running(tree: ast.AST) -> Iterator[ast.AST]:
    """All nodes below, those of imports for type checkers left out."""
    left = [tree]
    while left:
        for child in ast.iter_child_nodes(left.pop()):
            if not _for_types_only(child):
                yield child
                left.append(child)


def _imported(nodes: Iterable[ast.AST]) -> Iterator[str]:
    for node in nodes:
        if isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            for alias in node.names:
                inner = f"{node.module}.{alias.name}"
                yield inner if inner in modules() else "." * node.level + (node.module or "")


def _changes(tree: ast.Module) -> Iterator[str]:
    imported = {
        alias.asname or alias.name.partition(".")[0]
        for node in tree.body
        if isinstance(node, ast.Import | ast.ImportFrom)
        for alias in node.names
    }
    for node in tree.body:
        if isinstance(node, ast.Assign | ast.AugAssign | ast.AnnAssign):
            targets = node.targets if isinstance(node, ast.Assign) else [node.target]
            for target in targets:
                if isinstance(target, ast.Attribute | ast.Subscript):
                    named = {part.id for part in ast.walk(target) if isinstance(part, ast.Name)}
                    if named & imported:
                        yield f"line {node.lineno}: {ast.unparse(node)}"


def imports_of(name: str, types: bool = False) -> frozenset[str]:
    """The modules of ours that a module imports, at any depth of its code.

    types: count imports for type checkers too.
    """
    source = source_of(modules()[name])
    return (source.typed if types else source.imports) & modules().keys()


def test_imports_are_written_from_the_top() -> None:
    assert [
        f"{name}: {target}"
        for name, path in modules().items()
        for target in source_of(path).typed
        if target.startswith(".")
    ] == []


def test_imports_lead_inwards() -> None:
    assert [fault for name in modules() for fault in _outward(name)] == []


def _outward(name: str) -> Iterator[str]:
    package = package_of(name)
    if package == "__init__":
        return
    if package not in ALLOWED:
        yield f"{package} has no place in the import contract"
        return
    for target in sorted(imports_of(name)):
        other = package_of(target)
        if other in (package, "__init__"):
            continue
        if ring_of(other) > ring_of(package):
            yield f"{name} -> {target}: outwards"
        elif ring_of(other) == ring_of(package) and other not in ALLOWED[package]:
            yield f"{name} -> {target}: not in the contract"
        if package in KNOWS_NO_SETTINGS and other in ("settings", "option_checks", "option"):
            yield f"{name} -> {target}: has no settings"


def test_no_modules_import_each_other_in_a_circle_for_types_either() -> None:
    try:
        TopologicalSorter({name: imports_of(name, types=True) for name in modules()}).prepare()
    except CycleError as error:
        pytest.fail(" -> ".join(reversed(error.args[1])))


def private_imports(package: str) -> list[str]:
    """The imports of modules that are not public by a package of another ring."""
    return [
        f"{name} -> {target}"
        for name in modules()
        if package_of(name) == package
        for target in sorted(imports_of(name))
        if package_of(target) != package
        and target not in SHARED.union(PACKAGES)
        and package_of(target) not in APPLICATIONS
    ]


@pytest.mark.parametrize("package", sorted(APPLICATIONS))
def test_applications_import_from_public_modules(package: str) -> None:
    assert not private_imports(package)


@pytest.mark.parametrize("package", sorted(APPLICATIONS))
def test_applications_import_public_names(package: str) -> None:
    private = [
        f"{name} -> {module}.{each}"
        for name, path in modules().items()
        if package_of(name) == package
        for module, each in source_of(path).named
        if module in PACKAGES
        and package_of(module) not in APPLICATIONS
        and f"{module}.{each}" not in SHARED.union(PACKAGES)
        and each not in import_module(module).__all__
    ]
    assert not private


def test_every_shared_module_is_used_by_an_application() -> None:
    used = {
        target
        for name in modules()
        if package_of(name) in APPLICATIONS
        for target in imports_of(name)
    }
    assert not SHARED - used - {f"drapery.{name}" for name in FOUNDATION}


def test_every_package_is_installed() -> None:
    config = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))
    listed = set(config["tool"]["setuptools"]["packages"])
    here = {
        name if path.name == "__init__.py" else name.rpartition(".")[0]
        for name, path in modules().items()
    }
    assert listed == here


def test_no_module_has_the_name_of_its_function() -> None:
    for name, path in modules().items():
        own = name.rsplit(".", 1)[-1]
        functions = source_of(path).functions
        assert own not in functions, f"{name} holds a function of its own name"


def test_an_import_changes_no_other_module() -> None:
    """Kernels that were made after such a change wrote outside of memory, in other tests."""
    assert [
        f"{name} {change}" for name, path in modules().items() for change in source_of(path).changes
    ] == []


def test_class_names_are_unique() -> None:
    places: dict[str, list[str]] = {}
    for folder in FOLDERS.values():
        for path in sorted(folder.rglob("*.py")):
            for name in source_of(path).classes:
                places.setdefault(name, []).append(f"{path.relative_to(ROOT)}")
    assert not {name: found for name, found in places.items() if len(found) > 1}


def test_defaults_of_dataclasses_can_be_hashed() -> None:
    """Python 3.11 refuses a default whose type has no hash, such as MappingProxyType."""
    classes = {
        each
        for name in sorted(set(modules()) - {"drapery.__main__"})
        for each in vars(import_module(name)).values()
        if isinstance(each, type) and is_dataclass(each)
    }
    faults = [
        f"{each.__module__}.{each.__name__}.{field.name}"
        for each in classes
        for field in fields(each)
        if not (
            field.default is MISSING or isinstance(field.default, tuple) or _has_hash(field.default)
        )
    ]
    assert not faults, f"{sorted(faults)}: use field(default_factory=...)"


def _has_hash(value: object) -> bool:
    try:
        hash(value)
    except TypeError:
        return False
    return True
