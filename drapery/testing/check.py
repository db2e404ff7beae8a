"""One check of a picture against its golden, which may be several approved pictures."""

import math
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from drapery.comparison import Tolerance
from drapery.errors import OutputError
from drapery.render import make_folder, replacing
from drapery.testing.explain import LayerNote, explain_change
from drapery.testing.failures import GoldenUpdate, keep_failure
from drapery.testing.golden import (
    GoldenError,
    Picture,
    beyond,
    decode,
    encode,
    fingerprint,
)
from drapery.testing.naming import approved_paths, variant_path
from drapery.user_files import open_user_file

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

    fault: one line, or None. failure: the id of the failure in the report, or None.
    written: the golden that was written, or None.
    """

    fault: str | None = None
    failure: str | None = None
    written: Path | None = None


def check_golden(check: GoldenCheck, picture: Picture, notes: Notes) -> GoldenResult:
    """Compare a picture with its approved pictures, or write one of them in an update."""
    known: list[_Approved] = []
    for path in approved_paths(check.path):
        try:
            approved = _compared(path, picture, check.tolerance)
        except OSError as error:
            return GoldenResult(_unusable(check, path, error))
        if approved.beyond == 0:
            return GoldenResult()
        known.append(approved)
    closest = min(known, key=lambda each: each.beyond, default=_Approved(check.path, math.inf))
    target = closest.path if check.variant is None else variant_path(check.path, check.variant)
    if check.update:
        return _written(check, target, picture, notes)
    line = closest.line
    if closest.picture is not None:
        line = explain_change(closest.picture, picture, closest.notes, notes())
    line = line or f"no golden at {check.path}"
    return _failed(check, line, target, closest.picture, picture, notes)


@dataclass(frozen=True)
class _Approved:
    """An approved picture beside the present one.

    beyond: how many pixels are beyond the tolerance; 0 if the pictures agree. picture, notes: what
    the file holds, or None. line: why the picture cannot be shown, or nothing.
    """

    path: Path
    beyond: float
    picture: Picture | None = None
    notes: list[LayerNote] | None = None
    line: str = ""


def _compared(path: Path, picture: Picture, tolerance: Tolerance) -> _Approved:
    """Compare with one file. Raises OSError."""
    with open_user_file(path) as file:
        data = file.read()
    if path.suffix == ".sha256":
        now = fingerprint(picture)
        was = data.decode("ascii", "replace").strip()
        line = f"the hash changed from {was} to {now.decode().strip()}"
        return _Approved(path, 0 if data == now else math.inf, line=line)
    try:
        expected, notes = decode(data)
    except GoldenError as error:
        return _Approved(path, math.inf, line=f"{path}: {error}; restore the file")
    return _Approved(path, beyond(expected, picture, tolerance), expected, notes)


def _content(path: Path, picture: Picture, notes: Notes) -> bytes:
    return fingerprint(picture) if path.suffix == ".sha256" else encode(picture, notes())


def _written(check: GoldenCheck, path: Path, picture: Picture, notes: Notes) -> GoldenResult:
    try:
        make_folder(path.parent)
        with replacing(path) as beside:
            beside.write_bytes(_content(path, picture, notes))
    except OutputError as error:
        return GoldenResult(f"golden {check.label!r}: {error}")
    return GoldenResult(written=path)


def _unusable(check: GoldenCheck, path: Path, error: OSError) -> str:
    reason = error.strerror or str(error)
    return f"golden {check.label!r}: {path}: {reason}; make the file readable and writable"


def _failed(
    check: GoldenCheck,
    line: str,
    target: Path,
    expected: Picture | None,
    picture: Picture,
    notes: Notes,
) -> GoldenResult:
    """Keep the failure for the report, and say what to do."""
    update = GoldenUpdate(target, _content(target, picture, notes))
    words = check.test, check.label, expected, picture, line, update
    start = f"golden {check.label!r}: {line}; "
    try:
        kept = keep_failure(check.report, *words, root=check.root)
    except OutputError as error:
        return GoldenResult(f"{start}{error}")
    fault = f"{start}see {kept}; accept it with --drapery-update"
    return GoldenResult(fault, failure=kept.name.partition(".")[0])
