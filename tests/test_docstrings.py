"""The docstrings of public names: each parameter has a line `name: meaning [unit], shape`."""

import ast
import re
from collections.abc import Iterator
from functools import cache
from importlib import import_module
from pathlib import Path

import griffe
import pytest
from public_api import PACKAGES, ROOT, load, public_objects

from drapery.errors import DraperyError

UNITS = {
    **dict.fromkeys(("seconds", "time", "times", "dt", "step", "period", "timeout"), "[s]"),
    **dict.fromkeys(("fps",), "[frames/s]"),
    **dict.fromkeys(("thickness", "radius", "depth", "length"), "["),  # of metres, or of texels
}
"""What the line of a number of this name says."""
ARRAYS = re.compile(
    r"\b(\w*Vectors|Floats|Integers|Bytes|Mask|Pixels|Texels|UVs|Pairs|Triangles)\b"
)
"""Types of arrays whose line gives the shape."""
SHAPE = re.compile(r"\[[^\]]*(,|\b[A-Z]\b|\b\d\b)[^\]]*\]|`[^`]+`")
LINE = re.compile(r"\w+: ")
RAISES = re.compile(r"Raises? ")


class Described:
    """A public function or class, and what its docstring says. text: the docstring."""

    def __init__(self, name: str, found: griffe.Function | griffe.Class) -> None:
        self.name = name
        self.found = found
        self.text = found.docstring.value if found.docstring else ""

    @property
    def parameters(self) -> list[griffe.Parameter | griffe.Attribute]:
        """Those of its own that nothing else describes, as the help of an option does.

        A class that takes none by position, as a protocol or a model, has its attributes.
        """
        taken = list(self.found.parameters) or [
            each for each in self.found.members.values() if isinstance(each, griffe.Attribute)
        ]
        return [
            each
            for each in taken
            if each.name not in ("self", "cls", "model_config")
            and not each.name.startswith("_")
            and not str(_value(each)).startswith("option_field(")
            and not _has_docstring(self.found, each.name)
        ]

    @property
    def lines(self) -> dict[str, str]:
        """The line of each parameter, with those that continue it."""
        return {item.partition(":")[0]: item for item in self._items if LINE.match(item)}

    @property
    def errors_described(self) -> str:
        return " ".join(item for item in self._items if RAISES.match(item))

    @property
    def _items(self) -> list[str]:
        parts = re.split(r"\n\s*\n|\n(?=\w+: |Raises )", self.text)
        return [" ".join(part.split()) for part in parts]

    def faults(self) -> Iterator[str]:
        parameters = self.parameters
        if len(parameters) > 1:
            for parameter in parameters:
                yield from self._parameter_faults(parameter)
        for error in sorted(raised(self.found)):
            if error not in self.errors_described:
                yield f"a line `Raises {error} ...`"
        if any(". Raises " in item for item in self._items):
            yield "`Raises` at the start of a line"

    def _parameter_faults(self, parameter: griffe.Parameter | griffe.Attribute) -> Iterator[str]:
        line = self.lines.get(parameter.name)
        kind = str(parameter.annotation)
        if line is None:
            yield f"a line `{parameter.name}: ...`"
            return
        others = "|".join(each.name for each in self.parameters)
        if re.search(rf"[.;] (?:{others}): ", line):
            yield f"one parameter in the line of {parameter.name}"
        unit = UNITS.get(parameter.name, "") if "float" in kind else ""
        if unit not in line and "see `" not in line:
            yield f"the unit in the line of {parameter.name}"
        if ARRAYS.match(kind) and not SHAPE.search(line):
            yield f"the shape in the line of {parameter.name}"


def described(name: str, found: griffe.Object) -> Iterator[Described]:
    """A public function, or a class and its public methods, without those of a protocol.

    A method without a docstring is that of a protocol, whose docstring `help` shows.
    """
    if isinstance(found, griffe.Function):
        yield Described(name, found)
    if isinstance(found, griffe.Class):
        yield Described(name, found)
        for member in found.members.values():
            if isinstance(member, griffe.Function) and member.is_public and member.has_docstring:
                yield Described(f"{name}.{member.name}", member)


def raised(found: griffe.Function | griffe.Class) -> set[str]:
    """The names of errors of ours that a function, or the making of an object, raises.

    Functions of the same module that it calls count.
    """
    functions, classes = _definitions(_source(found))
    if isinstance(found, griffe.Class):
        made = classes.get(found.name, {})
        waiting = [made[name] for name in ("__init__", "__post_init__") if name in made]
    elif isinstance(found.parent, griffe.Class):
        own = classes.get(found.parent.name, {}).get(found.name)
        waiting = [own] if own else []
    else:
        waiting = [functions[found.name]] if found.name in functions else []
    errors: set[str] = set()
    seen: set[str] = set()
    while waiting:
        for node in ast.walk(waiting.pop()):
            if isinstance(node, ast.Raise) and isinstance(node.exc, ast.Call):
                errors.add(ast.unparse(node.exc.func))
            elif isinstance(node, ast.Call) and isinstance(node.func, ast.Name):
                name = node.func.id
                if name in functions and name not in seen:
                    seen.add(name)
                    waiting.append(functions[name])
    return errors & _our_errors()


@cache
def _definitions(
    path: Path,
) -> tuple[dict[str, ast.FunctionDef], dict[str, dict[str, ast.FunctionDef]]]:
    """The functions of a module, and the methods of its classes, by name."""
    body = ast.parse(path.read_text("utf-8")).body
    methods = {
        each.name: {part.name: part for part in each.body if isinstance(part, ast.FunctionDef)}
        for each in body
        if isinstance(each, ast.ClassDef)
    }
    return {each.name: each for each in body if isinstance(each, ast.FunctionDef)}, methods


@cache
def _our_errors() -> frozenset[str]:
    for name in PACKAGES:
        import_module(name)
    found, waiting = {"DraperyError"}, [DraperyError]
    while waiting:
        below = waiting.pop().__subclasses__()
        waiting += below
        found |= {each.__name__ for each in below}
    return frozenset(found)


def _source(found: griffe.Object) -> Path:
    """The file of the checkout; `load` reads a copy."""
    first, *rest = found.module.path.split(".")[1:] or [""]
    home = ROOT / "render" if first == "render" else ROOT / "drapery" / first
    path = home.joinpath(*rest)
    return path / "__init__.py" if path.is_dir() else path.with_suffix(".py")


def _value(of: griffe.Parameter | griffe.Attribute) -> object:
    return of.default if isinstance(of, griffe.Parameter) else of.value


def _has_docstring(found: griffe.Object, name: str) -> bool:
    return name in found.members and found.members[name].has_docstring


@pytest.fixture(scope="module")
def names() -> dict[str, griffe.Object]:
    return dict(public_objects(load()))


@pytest.mark.parametrize("package", PACKAGES)
def test_every_parameter_has_a_line_and_errors_are_named(
    package: str, names: dict[str, griffe.Object]
) -> None:
    found = [
        f"{each.name}: {fault}"
        for name, objects in names.items()
        if name.rpartition(".")[0] == package
        for each in described(name, objects)
        for fault in each.faults()
    ]
    assert not found, "\n".join(["write in the docstrings:", *found])


def _of(code: str) -> list[str]:
    module = griffe.visit("drapery.pictures", filepath=ROOT / "drapery/pictures.py", code=code)
    (found,) = (each for each in module.members.values() if isinstance(each, griffe.Function))
    return list(Described("example.f", found).faults())


@pytest.mark.parametrize(
    "text",
    [
        "A sum of a and b.",
        "A sum.\n\n    a, b: numbers.",
        "A sum.\n\n    a: a number. b: another.",
        "A sum.\n\n    a: a number.\n    b: another. Raises OptionError.",
    ],
)
def test_docstrings_of_another_form_are_noticed(text: str) -> None:
    assert _of(f'def f(a: int, b: int) -> int:\n    """{text}"""\n')


def test_units_and_shapes_are_asked_for() -> None:
    head = "def f(positions: Vectors, dt: float) -> None:"
    bare = f'{head}\n    """Step.\n\n    positions: of particles.\n    dt: one step.\n    """\n'
    full = f'{head}\n    """Step.\n\n    positions: [m], shape [N, 3].\n    dt: [s].\n    """\n'
    assert len(_of(bare)) == 2
    assert not _of(full)
