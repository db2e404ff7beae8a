"""A manifest read and checked whole: all of its jobs, or all of its faults."""

import re
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from pydantic import BaseModel, ConfigDict, Field, ValidationError

from drapery.banner.design import Banner
from drapery.batch.rows import ManifestFault, ManifestRow, read_rows
from drapery.errors import BackendError, DesignError, OptionError, PackError
from drapery.options import NAMES, check_options, one_line, unknown
from drapery.settings import Settings

MAX_JOBS = 1_000_000
STILLS = ("png",)
EITHER = ("webp",)
ANIMATIONS = ("gif", "apng", "mp4", "webm")
ENDINGS = (*STILLS, *EITHER, *ANIMATIONS)

_STEP = re.compile(r"[\w(][\w .,+@()'-]{0,119}")


class ManifestError(OptionError):
    """A manifest with faults. faults: all of them, in the manifest's order."""

    def __init__(self, path: Path, faults: list[ManifestFault]) -> None:
        self.faults = faults
        many = f"; {len(faults)} faults in all" if len(faults) > 1 else ""
        super().__init__(f"{path}: {faults[0]}{many}")


class RowFields(BaseModel):
    """What a row says beside the options of the picture."""

    model_config = ConfigDict(extra="forbid", frozen=True, coerce_numbers_to_str=True)

    design: str | None = Field(default=None, max_length=1 << 20)
    name: str | None = None
    out: str | None = None
    seconds: float | None = None
    fps: float | None = None


@dataclass(frozen=True)
class PictureRequest:
    """One picture that is asked for, checked.

    place: where in the manifest. out: its file, relative to where outputs go.
    seconds, fps: of an animation; None for a still.
    """

    place: str
    out: str
    banner: Banner | None
    settings: Settings
    seconds: float | None = None
    fps: float | None = None


def read_manifest(
    path: str | Path, defaults: Mapping[str, Any] | None = None, ending: str = "png"
) -> list[PictureRequest]:
    """All jobs of a manifest.

    defaults: options under all those that the manifest gives; their paths start here, the
    manifest's own in its folder. ending: the format of rows that name no file.

    Raises ManifestError with every fault, OptionError or DesignError if it cannot be read at all.
    """
    path = Path(path)
    if ending not in ENDINGS:
        raise OptionError(f"format {ending!r} is not known; use one of: {', '.join(ENDINGS)}")
    faults: list[ManifestFault] = []
    requests: list[PictureRequest] = []
    for number, row in enumerate(read_rows(path), 1):
        if number > MAX_JOBS:
            raise OptionError(f"{path} has over {MAX_JOBS} jobs; split it")
        if isinstance(row, ManifestFault):
            faults.append(row)
            continue
        read = _request(_under(row, defaults or {}), number, ending, path.parent)
        if isinstance(read, PictureRequest):
            requests.append(read)
        else:
            faults += [ManifestFault(row.place, line) for line in read]
    requests = list(_apart(requests))
    faults += [*_same_targets(requests), *_unusable(requests)]
    if faults:
        raise ManifestError(path, faults)
    if not requests:
        raise OptionError(f"{path} holds no jobs; write a row for each picture")
    return requests


def _under(row: ManifestRow, defaults: Mapping[str, Any]) -> ManifestRow:
    here = {k: _from_here(k, v) for k, v in defaults.items() if k not in row.words}
    return replace(row, words={**here, **row.words}) if here else row


def _from_here(name: str, value: Any) -> Any:
    """Paths given at the command line start where it runs."""
    if name == "texture":
        return Path(value).absolute()
    if name in ("pack", "packs"):
        parts = value.split(";") if isinstance(value, str) else value
        return [Path(part).absolute() for part in parts if part]
    return value


def _request(
    row: ManifestRow, number: int, ending: str, folder: Path
) -> PictureRequest | list[str]:
    words = dict(row.words)
    if "pack" in words:
        words["packs"] = words.pop("pack")
    options = {name: words.pop(name) for name in list(words) if name in NAMES}
    known = frozenset(RowFields.model_fields) | NAMES
    unknown_names = [unknown(name, known) for name in words if name not in RowFields.model_fields]
    said, faults = _said({k: v for k, v in words.items() if k in RowFields.model_fields})
    settings = check_options(options, folder)
    faults = [*unknown_names, *faults, *(settings if isinstance(settings, list) else [])]
    if said is None:
        return faults
    banner = row.banner or _design(said.design, folder, faults)
    out = _out(said, row, number, ending, faults)
    times = _times(out, said, faults)
    if faults or isinstance(settings, list):
        return faults
    return PictureRequest(row.place, out, banner, settings, *times)


def _said(words: dict[str, Any]) -> tuple[RowFields | None, list[str]]:
    try:
        return RowFields.model_validate(words), []
    except ValidationError as error:
        faults = error.errors(include_url=False, include_input=False)
        return None, [f"{'.'.join(map(str, f['loc']))}: {one_line(f['msg'])}" for f in faults]


def _design(text: str | None, folder: Path, faults: list[str]) -> Banner | None:
    from drapery.banner.formats import parse_banner, read_design

    try:
        if text is None:
            return None
        file = folder / text if len(text) < 200 and "\0" not in text else None
        if file is not None and "\n" not in text and file.is_file():
            return read_design(file)
        return parse_banner(text)
    except (DesignError, OSError) as error:
        faults.append(f"design: {error}")
        return None


def _out(said: RowFields, row: ManifestRow, number: int, ending: str, faults: list[str]) -> str:
    """The job's file: as it says, or after its name, its place in a world, or its number."""
    if said.out is not None:
        out = said.out
    elif said.name is not None:
        out = f"{said.name}.{ending}"
    elif row.where:
        out = f"{_slug(row.where)}.{ending}"
    else:
        out = f"{number:05d}.{ending}"
    steps = out.split("/")
    if not all(_STEP.fullmatch(step) for step in steps) or len(out) > 300:
        faults.append(
            f"{out[:80]!r} is no file name here; use max_length, digits, '-', '.' and '/'"
        )
    elif _ending(out) not in ENDINGS or out.endswith(".sheet.png"):
        faults.append(f"{out}: the ending is one of {', '.join(f'.{e}' for e in ENDINGS)}")
    return out


def _ending(out: str) -> str:
    return out.rpartition(".")[2].lower() if "." in out else ""


def _slug(where: str) -> str:
    return re.sub(r"[^\w.-]+", "_", where).strip("._-")[:100] or "banner"


def _times(out: str, said: RowFields, faults: list[str]) -> tuple[float | None, float | None]:
    """Length and rate; a WebP is a still unless one of them is given."""
    from drapery.pictures import frame_count

    given = said.seconds is not None or said.fps is not None
    if _ending(out) in STILLS or (_ending(out) in EITHER and not given):
        return None, None
    seconds, fps = (4.0 if said.seconds is None else said.seconds), (said.fps or 20.0)
    try:
        frame_count(seconds, fps)
    except OptionError as error:
        faults.append(str(error))
    return seconds, fps


def _apart(requests: list[PictureRequest]) -> Iterator[PictureRequest]:
    """Places of a world that read alike as file names get numbers."""
    seen: dict[str, int] = {}
    for request in requests:
        stem, _, ending = request.out.rpartition(".")
        if request.place.startswith("line "):
            yield request
            continue
        count = seen[request.out.lower()] = seen.get(request.out.lower(), 0) + 1
        yield request if count == 1 else replace(request, out=f"{stem}-{count}.{ending}")


def _same_targets(requests: list[PictureRequest]) -> Iterator[ManifestFault]:
    first: dict[str, str] = {}
    for request in requests:
        # Some file systems do not tell case apart.
        other = first.setdefault(request.out.lower(), request.place)
        if other != request.place:
            yield ManifestFault(
                request.place, f"{request.out} is written by {other} too; name it apart"
            )


def _unusable(requests: Iterable[PictureRequest]) -> Iterator[ManifestFault]:
    """What the options name and is not there: packs, views, backends, placements."""
    verdicts: dict[object, str | None] = {}
    for request in requests:
        s, kind = request.settings, getattr(request.banner, "kind", None)
        key = (s.packs, s.format, s.view, s.backend, s.kind, s.placement, s.texture, kind)
        if key not in verdicts:
            verdicts[key] = _verdict(request)
        line = verdicts[key]
        if line is not None:
            yield ManifestFault(request.place, line)


def _verdict(request: PictureRequest) -> str | None:
    from drapery.banner.packs import open_packs
    from drapery.render.backends import backend
    from drapery.render.views import VIEWS
    from drapery.style.kinds import check_kind

    settings = request.settings
    try:
        open_packs(settings.packs, format=settings.format)
        backend(settings.backend)
        check_kind(request.banner, settings)
        if request.banner is None and settings.kind in ("auto", "banner"):
            return "no design is given; write one like 'white creeper:lime border:black'"
        if settings.view not in VIEWS:
            names = ", ".join(VIEWS)
            return f"view {settings.view!r} is not known; use one of: {names}"
        if settings.texture is not None and not Path(settings.texture).is_file():
            return f"texture {settings.texture} does not exist: check the path"
    except (BackendError, OptionError, PackError) as error:
        return str(error)
    return None
