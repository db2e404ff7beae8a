"""One check of a picture against its golden, which may be several approved pictures."""

import math
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from drapery.comparison import MAX_FILE, Difference, Picture, Tolerance, measure_pictures
from drapery.errors import OutputError
from drapery.output_files import make_folder, replacing
from drapery.testing.explain import LayerNote, explain_change
from drapery.testing.failures import GoldenUpdate, failure_id, keep_failure
from drapery.testing.golden import GoldenError, decode, encode, fingerprint
from drapery.testing.naming import approved_paths, variant_path
from drapery.user_files import open_user_file, reason

Notes = Callable[[], list[LayerNote] | None]
"""Makes the notes of a design's layers, which only a failure and an update need."""


@dataclass(frozen=True)
class GoldenCheck:
    """What to compare a picture with, and what to do where they differ.

    test, label: the id of the test, and the name of the golden in it.
    path: of the golden; its ending says whether it holds pixels or a hash.
    update: whether to write the picture where no approved one agrees.
    variant: the approved picture to write; None for the golden itself, or for the only one.
    report: the folder for the pictures of failures. root: the folder that its paths start from.
    """

    test: str
    label: str
    path: Path
    tolerance: Tolerance
    update: bool
    variant: str | None
    report: Path
    root: Path


@dataclass(frozen=True)
class GoldenResult:
    """What a check found.

    fault: one line, or None. picture: what to look at, in the report; None if there is nothing.
    failure: the id of the failure in the report, or None. written: the golden that was written.
    """

    fault: str | None = None
    picture: Path | None = None
    failure: str | None = None
    written: Path | None = None


def check_golden(check: GoldenCheck, picture: Picture, notes: Notes) -> GoldenResult:
    """Compare a picture with its approved pictures, or write one of them in an update."""
    known: list[_Approved] = []
    for path in approved_paths(check.path):
        try:
            approved = _compared(check, path, picture)
        except OSError as error:
            said = f"{path}: {reason(error)}; make the file readable and writable"
            return GoldenResult(said)
        if approved.agrees:
            return GoldenResult()
        known.append(approved)
    closest = min(known, key=lambda each: each.distance, default=_Approved(check.path))
    target = closest.path if check.variant is None else variant_path(check.path, check.variant)
    if check.update:
        return _written(target, _content(target, picture, notes))
    line = closest.line
    if closest.picture is not None:
        line = explain_change(closest.picture, picture, closest.notes, notes(), check.tolerance)
    line = line or f"no golden at {check.path}"
    update = GoldenUpdate(target, _content(target, picture, notes))
    return _failed(check, line, update, closest.picture, picture)


def check_content(
    check: GoldenCheck, content: bytes, changed: Callable[[bytes], str]
) -> GoldenResult:
    """Compare what is no picture with its approved files, or write one of them in an update.

    content: of a golden of the present values. changed: what differs from the content of a golden
    in a line, or nothing; it raises GoldenError.
    """
    lines = []
    for path in approved_paths(check.path):
        try:
            line = changed(_read(path))
        except OSError as error:
            return GoldenResult(f"{path}: {reason(error)}; make the file readable and writable")
        except GoldenError as error:
            line = f"{path}: {error}; restore the file"
        if not line:
            return GoldenResult()
        lines.append(line)
    target = check.path if check.variant is None else variant_path(check.path, check.variant)
    if check.update:
        return _written(target, content)
    line = lines[0] if lines else f"no golden at {check.path}"
    return _failed(check, line, GoldenUpdate(target, content))


@dataclass(frozen=True)
class _Approved:
    """An approved picture beside the present one.

    agrees: whether it does. difference: of their pixels; None if the file has none.
    picture, notes: what the file holds, or None. line: why the picture cannot be shown, or nothing.
    """

    path: Path
    agrees: bool = False
    difference: Difference | None = None
    picture: Picture | None = None
    notes: list[LayerNote] | None = None
    line: str = ""

    @property
    def distance(self) -> float:
        """How many pixels are beyond the tolerance; infinite for other sizes, and unknown."""
        if self.difference is None or self.difference.unlike:
            return math.inf
        return self.difference.beyond


def _compared(check: GoldenCheck, path: Path, picture: Picture) -> _Approved:
    """Compare with one file. Raises OSError."""
    try:
        data = _read(path)
    except GoldenError as error:
        return _Approved(path, line=f"{path}: {error}")
    if path.suffix == ".sha256":
        now = fingerprint(picture)
        was = data.decode("ascii", "replace").strip()
        line = f"the hash changed from {was} to {now.decode().strip()}"
        return _Approved(path, data == now, line=line)
    try:
        expected, notes = decode(data)
    except GoldenError as error:
        return _Approved(path, line=f"{path}: {error}; restore the file")
    found = measure_pictures(expected, picture, check.tolerance)
    return _Approved(path, found.agrees, found, expected, notes)


def _read(path: Path) -> bytes:
    """What a golden holds. Raises OSError, and GoldenError for one that is too large."""
    with open_user_file(path) as file:
        data = file.read(MAX_FILE + 1)
    if len(data) > MAX_FILE:
        raise GoldenError(f"it has over {MAX_FILE} bytes; draw smaller pictures")
    return data


def _content(path: Path, picture: Picture, notes: Notes) -> bytes:
    return fingerprint(picture) if path.suffix == ".sha256" else encode(picture, notes())


def _written(path: Path, content: bytes) -> GoldenResult:
    try:
        make_folder(path.parent)
        with replacing(path) as beside:
            beside.write_bytes(content)
    except OutputError as error:
        return GoldenResult(str(error))
    return GoldenResult(written=path)


def _failed(
    check: GoldenCheck,
    line: str,
    update: GoldenUpdate,
    expected: Picture | None = None,
    picture: Picture | None = None,
) -> GoldenResult:
    """Keep the failure for the report, and say what to do."""
    words = check.test, check.label, expected, picture, line, update
    try:
        kept = keep_failure(
            *(check.report, *words),
            root=check.root,
            tolerance=check.tolerance,
        )
    except OutputError as error:
        return GoldenResult(f"{line}; {error}")
    shown = None if picture is None else kept
    return GoldenResult(line, shown, failure_id(check.test, check.label))
