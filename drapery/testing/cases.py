"""Golden images without writing Python: a TOML or YAML file of cases.

    goldens = "goldens"

    [defaults]
    packs = ["."]
    size = "256x256"

    [[case]]
    name = "creeper"
    design = "white creeper:lime"
    view = "hero"

Paths are relative to the file. A case's keys are the options of `drapery render`, beside `name`,
`design`, `hashed` and the limits of `drapery compare`. `defaults` gives them to every case for
which they do something. A cape or elytra has a `texture` in place of a design. With `seconds` or
`fps` the picture is a loop, as of `drapery animate`.
"""

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from pydantic import BaseModel, ConfigDict, Field, InstanceOf, ValidationError

from drapery import Banner
from drapery.comparison import EXACT, LIMIT_OPTIONS, Tolerance, read_tolerance
from drapery.errors import OptionError, shown
from drapery.model_faults import said_of, wanted
from drapery.option_checks import NAMES, check_options, one_line, unknown_names
from drapery.settings import LOOP_OPTIONS, LoopSettings, Settings, settled_for
from drapery.toml_text import parse_toml
from drapery.user_files import read_user_file
from drapery.yaml_text import load_yaml

MAX_FILE = 4 << 20
MAX_CASES = 100_000
DEFAULTS = Settings(size=(256, 256))
OWN = ("name", "design", "hashed", *LIMIT_OPTIONS, *LOOP_OPTIONS)
"""Keys of a case beside the options of its picture."""


class Case(BaseModel):
    """One picture: its design and options, and how much it may differ from its golden.

    name: its name, which its golden has too.
    design: a text in any form; None for what needs no design.
    tolerance: all limits together; a hashed case has none.
    hashed: whether the golden is a hash in place of a picture.
    timing: the options of a loop, which are keys of a case; None for a still.
    settings: the options of the picture.
    defaulted: the names of options that the defaults of its file give.
    """

    model_config = ConfigDict(extra="forbid", frozen=True)

    name: str = Field(pattern=r"^[A-Za-z0-9][A-Za-z0-9 ._-]{0,99}$")
    design: str | None = None
    tolerance: InstanceOf[Tolerance] = EXACT
    hashed: bool = False
    timing: InstanceOf[LoopSettings] | None = None
    settings: InstanceOf[Settings] = DEFAULTS
    defaulted: frozenset[str] = frozenset()

    def settings_for(self, banner: Banner | None) -> Settings:
        """The settings of its picture of a banner.

        Raises OptionError for what does nothing.
        """
        values = self.settings.given_values.items()
        own = {name: value for name, value in values if name in self.defaulted}
        return settled_for(banner, self.settings, "loop" if self.timing else "still", own)


class CaseFile(BaseModel):
    """A file of cases.

    goldens: their folder, relative to the folder of the file and inside it.
    defaults: options of all cases that do not give them.
    case: the cases.
    """

    model_config = ConfigDict(extra="forbid", frozen=True)

    goldens: str = "goldens"
    defaults: dict[str, Any] = Field(default_factory=dict)
    case: tuple[Case, ...] = Field(min_length=1, max_length=MAX_CASES)


def read_cases(path: Path) -> CaseFile:
    """Read a file of cases.

    Raises OptionError, naming the file, the case and the key.
    """
    raw = _load(path)
    defaults = raw.get("defaults", {})
    cases = raw.get("case")
    if isinstance(defaults, dict) and isinstance(cases, list):
        raw["case"] = [
            _case(path, number, words, defaults) if isinstance(words, dict) else words
            for number, words in enumerate(cases, 1)
        ]
    try:
        read = CaseFile.model_validate(raw)
    except ValidationError as error:
        raise OptionError(f"{path}: {_first_fault(error)}") from None
    _check_folder(path, read.goldens)
    _check_names(path, read.case)
    return read


def _check_folder(path: Path, goldens: str) -> None:
    """Raise OptionError for a folder elsewhere: a stranger's file must not choose it."""
    folder = path.parent.resolve()
    try:
        inside = (folder / goldens).resolve().is_relative_to(folder)
    except (OSError, ValueError):  # a name that no folder can have
        inside = False
    if not inside:
        raise OptionError(
            f"{path}: goldens {shown(goldens)} is not in the folder of the file; name one there,"
            ' such as "goldens"'
        )


def _case(
    path: Path, number: int, given: dict[str, Any], defaults: dict[str, Any]
) -> dict[str, Any]:
    """The keys of a case with its checked limits and settings. Raises OptionError."""
    words = defaults | given
    own = {name: value for name, value in words.items() if name in OWN}
    options = {name: value for name, value in words.items() if name in NAMES}
    known = NAMES.union(OWN)
    faults = unknown_names(words, known)
    defaulted = frozenset(("size", *defaults)).difference(given)
    settings = check_options({"size": DEFAULTS.size} | options, path.parent, defaulted)
    if isinstance(settings, list):
        faults += settings
    faults += [
        f"{name} {shown(own[name])} is not a text; put it in quotes"
        for name in ("name", "design")
        if not isinstance(own.get(name), str | None)
    ]
    limits = {name: own.pop(name) for name in LIMIT_OPTIONS if name in own}
    try:
        own["tolerance"] = read_tolerance(limits, path.parent)
    except OptionError as error:
        faults.append(one_line(str(error)))
    if own.get("hashed") and limits.keys() & given:
        faults.append(f"{min(limits.keys() & given)} does nothing in a hashed case; leave one out")
    timed = {name: own.pop(name) for name in LOOP_OPTIONS if name in own}
    if timed:
        try:
            parsed = {name: LOOP_OPTIONS[name].parse(value) for name, value in timed.items()}
            own["timing"] = LoopSettings(**parsed)
        except OptionError as error:
            faults.append(one_line(str(error)))
    if faults:
        name = words.get("name", number)
        more = f" (and {len(faults) - 1} more)" if len(faults) > 1 else ""
        raise OptionError(f"{path}: case {str(name)[:100]!r}: {faults[0]}{more}")
    return own | {"settings": settings, "defaulted": defaulted}


def _load(path: Path) -> dict[str, Any]:
    data = read_user_file(path, MAX_FILE, remedy="name a TOML or YAML file", shorter="split it")
    try:
        text = data.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        raise OptionError(f"{path}: byte {error.start} is not UTF-8; save it as UTF-8") from None
    is_yaml = path.suffix.lower() in (".yaml", ".yml")
    loaded = load_yaml(text, path) if is_yaml else parse_toml(text, path)
    if not isinstance(loaded, dict):
        raise OptionError(f"{path} has no cases; write [[case]] with name and design")
    return loaded


def _check_names(path: Path, cases: tuple[Case, ...]) -> None:
    seen: set[str] = set()
    for case in cases:
        # Some file systems ignore case.
        if case.name.lower() in seen:
            raise OptionError(f"{path}: two cases are named {case.name!r}; rename one of them")
        seen.add(case.name.lower())


def _first_fault(error: ValidationError) -> str:
    faults = error.errors()
    first = faults[0]
    place = ".".join(str(part) for part in first["loc"])
    more = f" (and {len(faults) - 1} more)" if len(faults) > 1 else ""
    return f"{place}: {_complaint(first)}{more}"


def _complaint(fault: Mapping[str, Any]) -> str:
    if fault["type"] == "missing":
        return "it is missing; add it"
    if fault["type"] == "extra_forbidden":
        return "it is not a key here; leave it out"
    return said_of(fault) or f"{shown(fault['input'])} cannot be used; it should {wanted(fault)}"
