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
`design`, `tolerance`, `pixels` and `hashed`; `defaults` gives them to every case. A cape or elytra
has a `texture` in place of a design.
"""

import re
import tomllib
from pathlib import Path
from typing import Any, cast

from pydantic import BaseModel, ConfigDict, Field, ValidationError, field_validator

from drapery.errors import OptionError
from drapery.settings import (
    Facing,
    Kind,
    LayerMode,
    Lighting,
    Options,
    Placement,
    Pose,
    Samples,
    Settings,
    SolverName,
    pair,
)

MAX_FILE = 4 << 20
MAX_CASES = 100_000


class Case(BaseModel):
    """One picture to be kept: what is drawn, and how exactly it must stay."""

    model_config = ConfigDict(extra="forbid", frozen=True)

    name: str = Field(pattern=r"^[A-Za-z0-9][A-Za-z0-9 ._-]{0,99}$")
    design: str | None = None
    tolerance: int = Field(default=0, ge=0, le=255)
    pixels: int = Field(default=0, ge=0)
    hashed: bool = False
    packs: tuple[str, ...] = ()
    format: int | None = Settings.format
    kind: Kind = Settings.kind
    texture: str | None = None
    pose: Pose = Settings.pose
    placement: Placement = Settings.placement
    rotation: int = Settings.rotation
    facing: Facing | None = Settings.facing
    view: str = Settings.view
    size: tuple[int, int] = (256, 256)
    grid: tuple[int, int] = Settings.grid
    solver: SolverName = Settings.solver
    wind: float = Settings.wind
    time: float = Settings.time
    seed: int = Settings.seed
    layers: LayerMode = Settings.layers
    pbr: bool = Settings.pbr
    thickness: float = Settings.thickness
    background: str = Settings.background
    samples: Samples = Settings.samples
    pixel: int = Settings.pixel
    light: Lighting = Settings.light
    block_light: int = Settings.block_light
    sky_light: int = Settings.sky_light
    daylight: float = Settings.daylight
    shadow: bool = Settings.shadow
    backend: str = Settings.backend

    @field_validator("size", "grid", mode="before")
    @classmethod
    def _as_pair(cls, value: Any) -> Any:
        return pair("size or grid", value) if isinstance(value, str) else value

    def options(self, folder: Path) -> Options:
        """The case's picture options, with paths from the file's folder."""
        chosen = self.model_dump(include=set(Options.__optional_keys__))
        paths = {
            "packs": tuple(folder / pack for pack in self.packs),
            "texture": None if self.texture is None else folder / self.texture,
        }
        return cast(Options, chosen | paths)


class CaseFile(BaseModel):
    """The whole file."""

    model_config = ConfigDict(extra="forbid", frozen=True)

    goldens: str = "goldens"
    defaults: dict[str, Any] = Field(default_factory=dict)
    case: tuple[Case, ...] = Field(min_length=1, max_length=MAX_CASES)


def read_cases(path: Path) -> CaseFile:
    """Read a file of cases. Raises OptionError, naming the file, the case and the key."""
    raw = _load(path)
    defaults = raw.get("defaults")
    cases = raw.get("case")
    if isinstance(defaults, dict) and isinstance(cases, list):
        raw["case"] = [{**defaults, **c} if isinstance(c, dict) else c for c in cases]
    try:
        read = CaseFile.model_validate(raw)
    except ValidationError as error:
        raise OptionError(f"{path}: {_first_fault(error)}") from None
    except OptionError as error:
        raise OptionError(f"{path}: {error}") from None
    _check_names(path, read.case)
    return read


def _load(path: Path) -> dict[str, Any]:
    import yaml

    try:
        data = path.read_bytes()
        if len(data) > MAX_FILE:
            raise OptionError(f"{path} is larger than {MAX_FILE >> 20} MiB; split it")
        text = data.decode("utf-8")
        if path.suffix.lower() in (".yaml", ".yml"):
            loaded = yaml.safe_load(text)
        else:
            loaded = tomllib.loads(text)
    except OSError as error:
        raise OptionError(f"{path}: {error.strerror}; name a TOML or YAML file") from None
    except (ValueError, RecursionError, yaml.YAMLError) as error:
        raise OptionError(f"{path}: {_one_line(str(error))}; mend it there") from None
    if not isinstance(loaded, dict):
        raise OptionError(f"{path} holds no cases; write [[case]] with name and design")
    return loaded


def _check_names(path: Path, cases: tuple[Case, ...]) -> None:
    seen: set[str] = set()
    for case in cases:
        # Some file systems do not tell case apart.
        if case.name.lower() in seen:
            raise OptionError(f"{path}: two cases are named {case.name!r}; give each its own name")
        seen.add(case.name.lower())


def _first_fault(error: ValidationError) -> str:
    faults = error.errors()
    first = faults[0]
    place = ".".join(str(part) for part in first["loc"])
    more = f" (and {len(faults) - 1} more)" if len(faults) > 1 else ""
    return f"{place}: {_one_line(first['msg'])}{more}"


def _one_line(text: str) -> str:
    return re.sub(r"\s+", " ", text).strip()
