"""Reads and checks a whole manifest: the result is all of its jobs, or all of its faults."""

import os
import re
import unicodedata
from collections.abc import Container, Iterable, Iterator, Mapping
from dataclasses import dataclass, replace
from functools import lru_cache
from pathlib import Path
from typing import TYPE_CHECKING, Any

from drapery import Banner
from drapery.batch.rows import ManifestFault, ManifestRow, Rows, read_rows
from drapery.errors import BackendError, DesignError, OptionError, PackError, shown
from drapery.file_formats import FileFormat, formats_of, known_format
from drapery.option import Option, Output, Subject
from drapery.option_checks import check_options, one_line, unknown_names
from drapery.player_settings import PLAYER_OPTIONS, PlayerSettings
from drapery.settings import LOOP_OPTIONS, OPTIONS, LoopSettings, Settings, settled_for
from drapery.user_files import reason

if TYPE_CHECKING:
    from drapery.garments import Garment

MAX_JOBS = 1_000_000
ENDINGS = tuple(
    ending[1:] for each in formats_of("still", "loop") if each.single for ending in each.endings
)
TEXTS = ("design", "garment", "name", "out")
"""The fields of a row that are texts; the others are options."""
FILE_COLUMNS = ("garment", "skin", "cape", "wear", "motion")
"""Fields that hold names, or paths of files with a certain ending."""
MAX_TEXT = 1 << 20
"""The most characters of a text."""

MAX_NAME = 230
"""Bytes of a file or folder name. File systems allow 255, of which partial files need some."""
_NAME = re.compile(r"[\w(][\w .,+@()'-]{0,119}")
_RESERVED = re.compile(r"(con|prn|aux|nul|(com|lpt)[0-9¹²³]) *(\..*)?", re.IGNORECASE)
"""Names that Windows gives to devices, with any ending."""


class ManifestError(OptionError):
    """A manifest with faults.

    name: of the manifest.
    faults: all of them, in the manifest's order.
    """

    def __init__(self, name: object, faults: list[ManifestFault]) -> None:
        self.faults = faults
        count = f"; {len(faults)} faults in all" if len(faults) > 1 else ""
        super().__init__(f"{name}: {faults[0]}{count}")


@dataclass(frozen=True)
class RowFields:
    """The fields of a row that are no options."""

    design: str | None = None
    garment: str | None = None
    name: str | None = None
    out: str | None = None


@dataclass(frozen=True)
class PictureRequest:
    """One checked picture of a manifest.

    place: of its row in the manifest.
    out: its file, relative to the output folder.
    banner: a banner or garment; None for what needs no design.
    settings: the options of the picture.
    timing: the options of an animation; None for a still.
    """

    place: str
    out: str
    banner: "Banner | Garment | None"
    settings: Settings
    timing: LoopSettings | None = None

    @property
    def seconds(self) -> float | None:
        """Length of an animation [s]; None for a still."""
        return None if self.timing is None else self.timing.seconds

    @property
    def fps(self) -> float | None:
        """Rate of an animation [frames/s]; None for a still."""
        return None if self.timing is None else self.timing.fps


def read_manifest(
    manifest: str | Path | Iterable[Mapping[str, Any]],
    defaults: Mapping[str, Any] | None = None,
    format: str = "png",
) -> list[PictureRequest]:
    """All pictures of a manifest.

    manifest: a file or world, or rows in memory: mappings of option names to values, where
        `design` is a text or a `Banner`; their paths are relative to the current folder.
    defaults: options of all rows that do not set them. Their paths are relative to the current
        folder; those of a manifest file are relative to its folder.
    format: the ending of rows that name no file.

    Raises ManifestError with every fault, OptionError or DesignError if it cannot be read.
    """
    if format not in ENDINGS:
        raise OptionError(f"format {format!r} is not known; use one of: {', '.join(ENDINGS)}")
    if isinstance(manifest, str | Path):
        name, rows, folder = str(manifest), read_rows(Path(manifest)), Path(manifest).parent
    else:
        name, rows, folder = "the manifest", _rows_in_memory(manifest), Path()
    faults: list[ManifestFault] = []
    requests: list[PictureRequest] = []
    used: dict[str, int] = {}
    for number, row in enumerate(rows, 1):
        if number > MAX_JOBS:
            raise OptionError(f"{name} has over {MAX_JOBS} jobs; split it")
        if isinstance(row, ManifestFault):
            faults.append(row)
            continue
        request = _request(row, _unset(row, defaults or {}), number, format, folder)
        if isinstance(request, PictureRequest):
            requests.append(numbered(request, used) if row.where else request)
        else:
            faults += [ManifestFault(row.place, line) for line in request]
    faults += [*_clashing_files(requests), *_unusable(requests)]
    if faults:
        raise ManifestError(name, faults)
    if not requests:
        raise OptionError(f"{name} holds no jobs; write a row for each picture")
    return requests


def _rows_in_memory(rows: Iterable[Mapping[str, Any]]) -> Rows:
    for number, row in enumerate(rows, 1):
        place = f"job {number}"
        if not isinstance(row, Mapping) or not all(isinstance(name, str) for name in row):
            yield ManifestFault(place, "not a mapping; write {'design': 'red', ...}")
            continue
        values = dict(row)
        banner = values.pop("design") if isinstance(values.get("design"), Banner) else None
        yield ManifestRow(place, values, banner)


def _unset(row: ManifestRow, defaults: Mapping[str, Any]) -> dict[str, Any]:
    """The defaults of what the row does not set. defaults: those that no manifest holds."""
    given = _one_name(row.values)
    outer = {n: _from_current_folder(n, value) for n, value in _one_name(defaults).items()}
    unset = {**outer, **_one_name(row.defaults)}
    return {name: value for name, value in unset.items() if name not in given}


def _one_name(values: Mapping[str, Any]) -> dict[str, Any]:
    """The fields of a row; packs may be called `pack`."""
    return {"packs" if name == "pack" else name: value for name, value in values.items()}


def _from_current_folder(name: str, value: Any) -> Any:
    """These defaults' paths are relative to the current folder, so they are made absolute.

    What names a file is decided as where a row is read: by the table of options, by the ending of
    fields that hold files, and of a design by whether there is such a file.
    """
    if isinstance(value, list | tuple):
        return [_from_current_folder(name, each) for each in value]
    option = OPTIONS.get(name)
    if isinstance(value, str) and ((option and option.several) or name in FILE_COLUMNS):
        parts = (part.strip() for part in value.split(";"))
        return ";".join(_absolute(name, part, option) for part in parts if part)
    return _absolute(name, value, option) if isinstance(value, str | Path) else value


FILE_ENDINGS = (".toml", ".png", ".json", ".snbt")
"""The endings by which the value of a column of FILE_COLUMNS names a file."""


def _absolute(name: str, value: str | Path, option: Option | None) -> str:
    text = str(value)
    if option is not None:
        is_file = option.is_path(value)
    elif name == "design":
        is_file = _is_file(Path(), text)
    else:
        is_file = name in FILE_COLUMNS and text.lower().endswith(FILE_ENDINGS)
    return str(Path(text).absolute()) if is_file else text


def _is_file(folder: Path, text: str) -> bool:
    """Whether a text, which may be far too long for that, is the path of a file."""
    # `Path.is_file` raises where a name is too long.
    return "\n" not in text and os.path.isfile(folder / text)  # noqa: PTH113


def _request(
    row: ManifestRow, unset: Mapping[str, Any], number: int, ending: str, folder: Path
) -> PictureRequest | list[str]:
    """The picture of a row, or its faults. unset: defaults; what does nothing is left out."""
    values = {**unset, **_one_name(row.values)}
    options = {name: values.pop(name) for name in list(values) if name in OPTIONS}
    player = {name: values.pop(name) for name in list(values) if name in PLAYER_OPTIONS}
    loop = {name: values.pop(name) for name in list(values) if name in LOOP_OPTIONS}
    known = frozenset((*TEXTS, *LOOP_OPTIONS, *OPTIONS, *PLAYER_OPTIONS))
    faults = unknown_names(values, known)
    fields = _fields(values, faults)
    settings = check_options(options, folder, unset.keys())
    if not isinstance(settings, list):
        faults += _objects(settings, options)
        settings = _with_styles(settings)
    if isinstance(settings, list):
        faults += settings
    design = row.banner or _design(fields.design, folder, faults)
    banner: Banner | Garment | None = design
    if fields.garment is not None and not isinstance(settings, list):
        banner = _garment(fields.garment, design, folder, faults)
    if player and not isinstance(settings, list):
        if banner is not None:
            faults.append("a player takes no design or garment; use head, shield or wear")
        banner = _player(player, folder, faults, settings)
    out = _out(fields, row, number, ending, faults)
    timing = _timing(out, loop, faults, row.values)
    if not (faults or isinstance(settings, list)):
        own = {name: value for name, value in settings.given_values.items() if name in unset}
        try:
            output: Output = "still" if timing is None else "loop"
            settings = settled_for(banner, settings, output, own)
        except OptionError as error:
            faults.append(one_line(str(error)))
    if faults or isinstance(settings, list):
        return faults
    return PictureRequest(row.place, out, banner, settings, timing)


def _fields(values: Mapping[str, Any], faults: list[str]) -> RowFields:
    """The fields of a row; wrong ones are None."""
    read: dict[str, Any] = {}
    for name, value in values.items():
        if value is None:
            continue
        if name in TEXTS:
            # A name such as 7 is a number in JSON and YAML.
            text = str(value) if isinstance(value, int | float) else value
            if not isinstance(text, str):
                faults.append(f"{name} {shown(value)} is not a text; put it in quotes")
            elif len(text) > MAX_TEXT:
                faults.append(f"{name} has over {MAX_TEXT} characters; write it shorter")
            else:
                read[name] = text
    return RowFields(**read)


def _with_styles(settings: Settings) -> Settings | list[str]:
    """The settings with files of styles read, as workers may run elsewhere; or the fault."""
    from drapery.styles import combined_style, find_style

    option = OPTIONS["style"]
    try:
        read = [
            find_style(each) if option.is_path(each) else each
            for each in option.check(settings.style)
        ]
        combined_style(read)
    except OptionError as error:
        return [one_line(str(error))]
    return settings.changed(style=tuple(read)) if read else settings


def _objects(settings: Settings, options: Mapping[str, Any]) -> list[str]:
    """Faults for options that are Python objects: workers accept only names and numbers."""
    values = {name: getattr(settings, name) for name in options}
    return [
        f"{name} is an object, which a batch cannot send to its workers; give its name or path"
        for name, value in values.items()
        if not all(
            each is None or isinstance(each, str | int | float | Path)
            for each in (value if isinstance(value, tuple) else (value,))
        )
    ]


def _design(text: str | None, folder: Path, faults: list[str]) -> Banner | None:
    from drapery.banner import read_design

    design: Banner | str
    try:
        if text is None:
            return None
        if _is_file(folder, text):
            return read_design(folder / text)
        design = _parsed(text)
    except DesignError as error:
        design = str(error)
    except OSError as error:
        design = f"{shown(text)} cannot be read: {reason(error)}"
    if isinstance(design, Banner):
        return design
    faults.append(f"design: {design}")
    return None


def _garment(text: str, banner: Banner | None, folder: Path, faults: list[str]) -> "Garment | None":
    """A garment by its name or file, with a design."""
    from drapery.garments import find_garment

    try:
        found = find_garment(folder / text if text.endswith(".toml") else text)
        return found if banner is None else found.with_design(banner)
    except OptionError as error:
        faults.append(one_line(str(error)))
        return None


def _player(
    values: Mapping[str, Any], folder: Path, faults: list[str], settings: Settings
) -> "Garment | None":
    """A player. settings: of its picture."""
    from drapery.garments import player_of

    chosen: dict[str, Any] = {}
    for name, value in values.items():
        try:
            chosen[name] = PLAYER_OPTIONS[name].parse(value)
        except OptionError as error:
            faults.append(one_line(str(error)))
    refusal = OPTIONS["texture"].refusal(Subject("player"))
    if settings.texture is not None and refusal is not None:
        faults.append(refusal)
    if faults:
        return None
    try:
        return player_of(PlayerSettings(**chosen), folder.absolute())
    except (DesignError, OptionError) as error:
        faults.append(one_line(str(error)))
        return None


@lru_cache(maxsize=1024)
def _parsed(text: str) -> Banner | str:
    """The banner of a text, or what is wrong with it. Rows of a manifest often repeat a text."""
    try:
        return Banner.parse(text)
    except DesignError as error:
        return str(error)


def _out(fields: RowFields, row: ManifestRow, number: int, ending: str, faults: list[str]) -> str:
    """The job's file: given by the row, or made of its name, its place in a world or its number."""
    if fields.out is not None:
        out = fields.out
    elif fields.name is not None:
        out = f"{fields.name}.{ending}"
    elif row.where:
        out = f"{_slug(row.where)}.{ending}"
    else:
        out = f"{number:05d}.{ending}"
    fault = _name_fault(out)
    if fault is None and _format_of(out) is None:
        fault = f"{out}: the ending is one of {', '.join(f'.{e}' for e in ENDINGS)}"
    if fault is not None:
        faults.append(fault)
    return out


def _name_fault(out: str) -> str | None:
    """Why this is not a valid file name on every system that may run or read the batch."""
    names = out.split("/")
    if len(out) > 300 or not all(_NAME.fullmatch(name) for name in names):
        return f"{out[:80]!r} is not a file name; use letters, digits, '-', '.' and '/'"
    for name in names:
        if len(name.encode()) > MAX_NAME:
            return f"{name[:20]!r}... has over {MAX_NAME} bytes; use a shorter name"
        if name[-1] in ". ":
            return f"{name!r} ends with a dot or space, which Windows removes; rename it"
        if _RESERVED.fullmatch(name):
            return f"{name!r} is the name of a device on Windows; rename it"
    return None


def _format_of(out: str) -> FileFormat | None:
    """The format of an output; None for what is no single file with a picture."""
    found = known_format(out, "still", "loop")
    return found if found is not None and found.single else None


def _slug(where: str) -> str:
    return re.sub(r"[^\w.-]+", "_", where).strip("._-")[:100] or "banner"


def _timing(
    out: str, values: Mapping[str, Any], faults: list[str], given: Container[str]
) -> LoopSettings | None:
    """The options of an animation; None for a still, which some formats hold unless one is given.

    given: the names of what the row sets, which does not stand in a row of a still.
    """
    timed: dict[str, Any] = {}
    for name, value in values.items():
        if value is None:
            continue
        try:
            timed[name] = LOOP_OPTIONS[name].parse(value)
        except OptionError as error:
            faults.append(one_line(str(error)))
    format = _format_of(out)
    if format is not None and format.kind(timed=bool(timed)) == "still":
        refusals = (LOOP_OPTIONS[name].refusal(output="still") for name in timed if name in given)
        faults += sorted(f"{out}: {refusal}" for refusal in refusals)
        return None
    try:
        return LoopSettings(**timed)
    except OptionError as error:
        faults.append(str(error))
        return None


def numbered(request: PictureRequest, used: dict[str, int]) -> PictureRequest:
    """The request with a number in its file name if another banner of the world has that name.

    used: the names that are taken, each with the last number that was added to it.
    """
    key = _same_file(request.out)
    if key not in used:
        used[key] = 1
        return request
    stem, _, ending = request.out.rpartition(".")
    number = used[key] + 1
    while _same_file(f"{stem}-{number}.{ending}") in used:
        number += 1
    used[key] = number
    out = f"{stem}-{number}.{ending}"
    used[_same_file(out)] = 1
    return replace(request, out=out)


def _same_file(out: str) -> str:
    """Equal for names that are the same file on some file systems, which ignore case or compose
    characters and accents."""
    return unicodedata.normalize("NFC", out).casefold()


def _clashing_files(requests: list[PictureRequest]) -> Iterator[ManifestFault]:
    """Faults for outputs that two jobs write, or that are both a file and a folder."""
    first: dict[str, PictureRequest] = {}
    for request in requests:
        other = first.setdefault(_same_file(request.out), request)
        if other is not request:
            yield ManifestFault(
                request.place, f"{request.out} is written by {other.place} too; rename one"
            )
    for request in requests:
        folders = _same_file(request.out).split("/")[:-1]
        for depth in range(1, len(folders) + 1):
            file = first.get("/".join(folders[:depth]))
            if file is not None:
                yield ManifestFault(
                    request.place,
                    f"{request.out} needs a folder where {file.place} writes {file.out};"
                    " rename one",
                )


def _unusable(requests: Iterable[PictureRequest]) -> Iterator[ManifestFault]:
    """Faults for options that name missing packs, views, backends or placements."""
    verdicts: dict[object, str | None] = {}
    for request in requests:
        s, drawn = request.settings, request.banner
        kind: object = getattr(drawn, "kind", None)
        if drawn is not None and not isinstance(drawn, Banner):
            kind = (drawn.folder, drawn.name, drawn.wearer, drawn.paths)
        key = (s.packs, s.format, s.view, s.backend, s.kind, s.placement, s.texture, kind)
        if key not in verdicts:
            verdicts[key] = _verdict(request)
        line = verdicts[key]
        if line is not None:
            yield ManifestFault(request.place, line)


def _verdict(request: PictureRequest) -> str | None:
    from drapery.packs import open_packs
    from drapery.render import backend
    from drapery.style import check_kind

    settings, drawn = request.settings, request.banner
    try:
        packs = open_packs(settings.packs, format=settings.format)
        backend(settings.backend)
        if drawn is None or isinstance(drawn, Banner):
            check_kind(drawn, settings)
        else:
            from drapery.scenes import Dressed

            Dressed(drawn, packs, settings).check()
        if drawn is None and settings.kind in ("auto", "banner"):
            return "no design is given; write one like 'white creeper:lime border:black'"
        if settings.texture_path is not None and not Path(settings.texture_path).is_file():
            return f"texture {settings.texture} does not exist: check the path"
    except (BackendError, OptionError, PackError) as error:
        return str(error)
    return None
