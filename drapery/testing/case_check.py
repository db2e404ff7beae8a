"""Checks a file of cases: each is drawn and compared with its golden, or replaces it."""

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from drapery import Banner, animate, draw
from drapery.banner import read_design
from drapery.comparison import Tolerance
from drapery.errors import DraperyError
from drapery.packs import open_packs
from drapery.render import make_folder, replacing
from drapery.settings import LOOP_OPTIONS
from drapery.testing.cases import Case, CaseFile
from drapery.testing.explain import LayerNote, explain_change, layer_notes
from drapery.testing.failures import GoldenUpdate, keep_failure
from drapery.testing.golden import (
    GoldenError,
    Picture,
    agrees,
    decode,
    encode,
    fingerprint,
)
from drapery.user_files import read_user_file

MAX_BYTES = 1 << 30
"""The longest golden file [bytes]."""


@dataclass(frozen=True)
class CaseResult:
    """The result of a case. fault: one line, or None if the picture agrees with its golden."""

    name: str
    fault: str | None = None
    written: bool = False


def check_cases(cases: CaseFile, folder: Path, report: Path) -> Iterator[CaseResult]:
    """Draw each case and compare it with its golden; pictures of failures go to `report`.

    Raises a DraperyError that names the case if it cannot be drawn.
    """
    for case in cases.case:
        drawn = _draw(case)
        yield CaseResult(case.name, _fault(drawn, _golden_path(cases, case, folder), report))


def update_cases(cases: CaseFile, folder: Path) -> Iterator[CaseResult]:
    """Draw each case and write it as the new golden if it differs from the present one.

    Raises OutputError, or a DraperyError that names the case if it cannot be drawn.
    """
    for case in cases.case:
        path = _golden_path(cases, case, folder)
        new = _draw(case).golden()
        changed = not path.exists() or read_user_file(path, MAX_BYTES) != new
        if changed:
            make_folder(path.parent)
            with replacing(path) as beside:
                beside.write_bytes(new)
        yield CaseResult(case.name, written=changed)


def unused_goldens(cases: CaseFile, folder: Path) -> list[Path]:
    """Goldens in the folder that no case names."""
    used = {_golden_path(cases, case, folder) for case in cases.case}
    found = (path for kind in ("*.png", "*.sha256") for path in (folder / cases.goldens).glob(kind))
    return sorted(path for path in found if path not in used)


@dataclass(frozen=True)
class _DrawnCase:
    """A case, its banner and its picture. Notes and files are made only where they are needed."""

    case: Case
    banner: Banner | None
    picture: Picture

    def notes(self) -> list[LayerNote] | None:
        """The layers of the banner."""
        if self.banner is None:
            return None
        settings = self.case.settings
        return layer_notes(self.banner, open_packs(settings.packs, format=settings.format))

    def golden(self) -> bytes:
        """The content of the golden file."""
        if self.case.hashed:
            return fingerprint(self.picture)
        return encode(self.picture, self.notes())


def _draw(case: Case) -> _DrawnCase:
    try:
        banner = None if case.design is None else read_design(case.design)
        return _DrawnCase(case, banner, _picture(case, banner))
    except DraperyError as error:
        raise type(error)(f"case {case.name!r}: {error}") from None


def _picture(case: Case, banner: Banner | None) -> Picture:
    if case.seconds is None and case.fps is None:
        return draw(banner, case.settings)
    seconds = LOOP_OPTIONS["seconds"].default if case.seconds is None else case.seconds
    fps = LOOP_OPTIONS["fps"].default if case.fps is None else case.fps
    return animate(banner, case.settings, seconds=seconds, fps=fps)


def _golden_path(cases: CaseFile, case: Case, folder: Path) -> Path:
    backend = "" if case.settings.backend in ("auto", "soft") else f"-{case.settings.backend}"
    ending = "sha256" if case.hashed else "png"
    return folder / cases.goldens / f"{case.name}{backend}.{ending}"


def _fault(drawn: _DrawnCase, path: Path, report: Path) -> str | None:
    case, picture = drawn.case, drawn.picture

    def keep(line: str, expected: Picture | None = None) -> str:
        update = GoldenUpdate(path, drawn.golden())
        keep_failure(report, "case", case.name, expected, picture, line, update)
        return line

    if not path.exists():
        keep("there is no golden yet")
        return f"no golden at {path}; write it with `drapery golden update`"
    data = read_user_file(path, MAX_BYTES)
    if case.hashed:
        found = fingerprint(picture)
        return None if data == found else keep(f"the hash changed to {found.decode().strip()}")
    try:
        expected, before = decode(data)
    except GoldenError as error:
        return keep(f"{path}: {error}; restore it, or replace it with `drapery golden update`")
    if agrees(expected, picture, Tolerance(case.tolerance, case.pixels)):
        return None
    return keep(explain_change(expected, picture, before, drawn.notes()), expected)
