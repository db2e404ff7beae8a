"""The report of failed checks: expected, actual and difference of each, and a page of them all.

Workers of pytest-xdist write at the same time: every failure has separate files, and the main
process makes the page from them at the end.
"""

import hashlib
import json
import re
from pathlib import Path

from drapery.comparison import ReportEntry, data_of, html_report, side_by_side, write_text
from drapery.errors import OutputError
from drapery.render import Frame, make_folder

_FACTS = ".failure.json"
_PICTURES = ("expected", "actual", "difference")
_PAGE = "index.html"


def keep_failure(
    folder: Path, test: str, label: str, expected: Frame | None, actual: Frame, line: str
) -> Path:
    """Write a failure's pictures and facts; returns the picture to look at first.

    Raises OutputError.
    """
    make_folder(folder)
    stem = _stem(test, label)
    pictures = {"actual": actual}
    if expected is not None:
        pictures["expected"] = expected
        if expected.pixels.shape == actual.pixels.shape:
            pictures["difference"] = side_by_side(expected.pixels, actual.pixels)
    for kind, frame in pictures.items():
        frame.save(folder / f"{stem}.{kind}.png")
    write_text(folder / (stem + _FACTS), json.dumps({"name": f"{test} [{label}]", "line": line}))
    return folder / f"{stem}.{'difference' if 'difference' in pictures else 'actual'}.png"


def write_report(folder: Path) -> Path | None:
    """Make the page of all failures in a folder; None if there are none. Raises OutputError."""
    entries = [_entry(facts) for facts in sorted(folder.glob(f"*{_FACTS}"))]
    if not entries:
        return None
    page = folder / _PAGE
    plural = "s" if len(entries) > 1 else ""
    summary = f"{len(entries)} picture{plural} not as expected."
    write_text(page, html_report("Golden images", summary, entries))
    return page


def clear_report(folder: Path) -> None:
    """Remove the failures of earlier runs; other files stay.

    Raises OutputError if one cannot be removed, as in a folder of another user.
    """
    try:
        for facts in folder.glob(f"*{_FACTS}"):
            stem = facts.name.removesuffix(_FACTS)
            for kind in _PICTURES:
                (folder / f"{stem}.{kind}.png").unlink(missing_ok=True)
            facts.unlink()
            (folder / _PAGE).unlink(missing_ok=True)
    except OSError as error:
        raise OutputError(
            f"the report of an earlier run in {folder} cannot be removed ({error.strerror});"
            " remove the folder, or choose another for reports"
        ) from None


def _entry(facts: Path) -> ReportEntry:
    known = json.loads(facts.read_text(encoding="utf-8"))
    stem = facts.name.removesuffix(_FACTS)
    paths = [(kind, facts.parent / f"{stem}.{kind}.png") for kind in _PICTURES]
    pictures = [(kind, data_of(path.read_bytes(), "png")) for kind, path in paths if path.exists()]
    return ReportEntry(known["name"], False, known["line"], pictures=tuple(pictures))


def _stem(test: str, label: str) -> str:
    readable = re.sub(r"[^A-Za-z0-9]+", "-", f"{test} {label}").strip("-")[-80:]
    digest = hashlib.sha256(f"{test}\0{label}".encode()).hexdigest()
    return f"{readable}-{digest[:8]}"
