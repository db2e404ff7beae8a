"""Checks a file of cases: each is drawn and compared with its golden, or replaces it."""

from collections.abc import Collection, Iterator
from dataclasses import asdict, dataclass
from pathlib import Path

from drapery import Banner, animate, draw
from drapery.banner import read_design
from drapery.comparison import Picture, as_picture
from drapery.errors import DraperyError, OptionError
from drapery.packs import open_packs
from drapery.testing.cases import Case, CaseFile
from drapery.testing.check import GoldenCheck, GoldenResult, check_golden
from drapery.testing.explain import LayerNote, layer_notes
from drapery.testing.failures import failure_id, failures_in, remove_failure

TEST = "case"
"""What the failures of cases have as their test in a report."""


@dataclass(frozen=True)
class CaseResult:
    """The result of a case.

    name: of the case.
    fault: one line, or None if the picture agrees with its golden.
    written: whether the golden was written.
    broken: whether it could not be drawn, or its files not be read or written.
    """

    name: str
    fault: str | None = None
    written: bool = False
    broken: bool = False


def check_cases(
    cases: CaseFile, folder: Path, report: Path, only: Collection[str] = ()
) -> Iterator[CaseResult]:
    """Draw each case and compare it with its golden. A case that cannot be drawn has a fault.

    cases: the cases of a file.
    folder: of the file.
    report: the folder for pictures of failures.
    only: the names of the cases to check; all if empty.

    Raises OptionError for a name that no case has.
    """
    for case in chosen_cases(cases, only):
        try:
            result = _checked(cases, case, folder, report, update=False)
        except DraperyError as error:
            yield CaseResult(case.name, str(error), broken=True)
            continue
        fault = result.fault
        if fault is not None and fault.startswith("no golden at"):
            fault += "; write it with `drapery golden update`"
        yield CaseResult(case.name, fault, broken=fault is not None and result.failure is None)


def update_cases(cases: CaseFile, folder: Path, only: Collection[str] = ()) -> Iterator[CaseResult]:
    """Draw each case and write it as the new golden where the present one does not agree.

    cases: the cases of a file.
    folder: of the file.
    only: the names of the cases to draw; all if empty.

    Raises OptionError for a name that no case has, OutputError for a golden that cannot be written.
    """
    for case in chosen_cases(cases, only):
        try:
            result = _checked(cases, case, folder, folder, update=True)
        except DraperyError as error:
            yield CaseResult(case.name, str(error), broken=True)
            continue
        written = result.written is not None
        yield CaseResult(case.name, result.fault, written, broken=result.fault is not None)


def chosen_cases(cases: CaseFile, only: Collection[str]) -> list[Case]:
    """The cases of these names, or all. Raises OptionError for a name that no case has."""
    unknown = set(only) - {case.name for case in cases.case}
    if unknown:
        known = ", ".join(case.name for case in cases.case[:8])
        raise OptionError(f"there is no case {min(unknown)!r}; the first cases are {known}")
    return [case for case in cases.case if not only or case.name in only]


def clear_cases(report: Path, only: Collection[str] = ()) -> None:
    """Remove the failures of cases from a report; those of tests stay. Raises OutputError.

    only: the names of the cases; all if empty.
    """
    ids = {failure_id(TEST, name) for name in only}
    for failure in failures_in(report):
        if failure.test == TEST and (not only or failure.id in ids):
            remove_failure(report, failure.id)


def _checked(
    cases: CaseFile, case: Case, folder: Path, report: Path, *, update: bool
) -> GoldenResult:
    """Raises a DraperyError for a case that cannot be drawn."""
    banner = None if case.design is None else read_design(case.design)
    check = GoldenCheck(
        test=TEST,
        label=case.name,
        path=_golden_path(cases, case, folder),
        tolerance=case.tolerance,
        update=update,
        variant=None,
        report=report,
        root=Path.cwd(),
    )
    return check_golden(check, _picture(case, banner), lambda: _notes(case, banner))


def _notes(case: Case, banner: Banner | None) -> list[LayerNote] | None:
    """The layers of the banner."""
    if banner is None:
        return None
    return layer_notes(banner, open_packs(case.settings.packs, format=case.settings.format))


def unused_goldens(cases: CaseFile, folder: Path) -> list[Path]:
    """Goldens in the folder of a file's goldens that no case names.

    cases: the cases of a file.
    folder: of the file.
    """
    used = {_golden_path(cases, case, folder) for case in cases.case}
    found = (path for kind in ("*.png", "*.sha256") for path in (folder / cases.goldens).glob(kind))
    return sorted(path for path in found if path not in used)


def _picture(case: Case, banner: Banner | None) -> Picture:
    settings = case.settings_for(banner)
    if case.timing is None:
        return as_picture(draw(banner, settings))
    return as_picture(animate(banner, settings, **asdict(case.timing)))


def _golden_path(cases: CaseFile, case: Case, folder: Path) -> Path:
    backend = "" if case.settings.backend in ("auto", "soft") else f"-{case.settings.backend}"
    ending = "sha256" if case.hashed else "png"
    return folder / cases.goldens / f"{case.name}{backend}.{ending}"
