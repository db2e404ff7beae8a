"""Checks a file of cases: each is drawn and compared with its golden, or replaces it."""

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from drapery import Banner, animate, draw
from drapery.banner import read_design
from drapery.errors import DraperyError
from drapery.packs import open_packs
from drapery.render import make_folder, replacing
from drapery.settings import LOOP_OPTIONS, Settings
from drapery.testing.cases import Case, CaseFile
from drapery.testing.explain import LayerNote, explain_change, layer_notes
from drapery.testing.failures import GoldenUpdate, keep_failure
from drapery.testing.golden import (
    GoldenError,
    Picture,
    Tolerance,
    agrees,
    decode,
    encode,
    fingerprint,
)


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
        picture, notes = _draw(case)
        path = _golden_path(cases, case, folder)
        yield CaseResult(case.name, _fault(case, path, picture, notes, report))


def update_cases(cases: CaseFile, folder: Path) -> Iterator[CaseResult]:
    """Draw each case and write it as the new golden if it differs from the present one.

    Raises OutputError, or a DraperyError that names the case if it cannot be drawn.
    """
    for case in cases.case:
        picture, notes = _draw(case)
        path = _golden_path(cases, case, folder)
        new = fingerprint(picture) if case.hashed else encode(picture, notes)
        changed = not path.exists() or path.read_bytes() != new
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


def _draw(case: Case) -> tuple[Picture, list[LayerNote] | None]:
    try:
        banner = None if case.design is None else read_design(case.design)
        return _picture(case, banner), _notes(banner, case.settings)
    except DraperyError as error:
        raise type(error)(f"case {case.name!r}: {error}") from None


def _picture(case: Case, banner: Banner | None) -> Picture:
    if case.seconds is None and case.fps is None:
        return draw(banner, case.settings)
    seconds = LOOP_OPTIONS["seconds"].default if case.seconds is None else case.seconds
    fps = LOOP_OPTIONS["fps"].default if case.fps is None else case.fps
    return animate(banner, case.settings, seconds=seconds, fps=fps)


def _notes(banner: Banner | None, settings: Settings) -> list[LayerNote] | None:
    if banner is None:
        return None
    return layer_notes(banner, open_packs(settings.packs, format=settings.format))


def _golden_path(cases: CaseFile, case: Case, folder: Path) -> Path:
    backend = "" if case.settings.backend in ("auto", "soft") else f"-{case.settings.backend}"
    ending = "sha256" if case.hashed else "png"
    return folder / cases.goldens / f"{case.name}{backend}.{ending}"


def _fault(
    case: Case, path: Path, picture: Picture, notes: list[LayerNote] | None, report: Path
) -> str | None:
    new = GoldenUpdate(path, fingerprint(picture) if case.hashed else encode(picture, notes))
    if not path.exists():
        keep_failure(report, "case", case.name, None, picture, "there is no golden yet", new)
        return f"no golden at {path}; write it with `drapery golden update`"
    data = path.read_bytes()
    if case.hashed:
        if data == fingerprint(picture):
            return None
        line = f"the hash changed to {fingerprint(picture).decode().strip()}"
        keep_failure(report, "case", case.name, None, picture, line, new)
        return line
    try:
        expected, before = decode(data)
    except GoldenError as error:
        line = f"{path}: {error}; restore it, or replace it with `drapery golden update`"
        keep_failure(report, "case", case.name, None, picture, line, new)
        return line
    if agrees(expected, picture, Tolerance(case.tolerance, case.pixels)):
        return None
    line = explain_change(expected, picture, before, notes)
    keep_failure(report, "case", case.name, expected, picture, line, new)
    return line
