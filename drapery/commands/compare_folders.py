"""`drapery compare OLD NEW` with two folders of pictures."""

import json
import sys
from collections import Counter
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from drapery.errors import OptionError
from drapery.file_formats import Kind, format_of

if TYPE_CHECKING:
    from drapery.comparison import FilePair, ReportEntry, Tolerance

REPORTS: tuple[Kind, ...] = ("page", "data")
"""What a report can be."""
MAX_PAGE = 256 << 20
"""The most characters of pictures in a page; further entries have none."""

_WORDS = {
    "same": "the same",
    "within": "within the limits",
    "different": "different",
    "removed": "removed",
    "added": "added",
    "broken": "cannot be compared",
}


def folders_of(subjects: Sequence[str]) -> tuple[Path, Path] | None:
    """The two folders of pictures among what is compared, or None.

    Raises OptionError for a folder beside something else.
    """
    from drapery.comparison import is_pack

    found = [text for text in subjects if Path(text).is_dir() and not is_pack(text)]
    if not found:
        return None
    if len(found) != 2 or len(subjects) != 2:
        raise OptionError(
            f"{found[0]} is a folder of pictures; compare it with one other such folder"
        )
    return Path(found[0]), Path(found[1])


def compare(
    folders: tuple[Path, Path],
    tolerance: "Tolerance",
    targets: Sequence[Path],
    *,
    perceptual: bool,
) -> int:
    """Compare two folders, print what differs, and write reports; returns the exit code."""
    from drapery.comparison import compare_folders, folder_files, html_report, write_text

    others = sum(folder_files(folder).others for folder in folders)
    paged = any(format_of(target, *REPORTS).kind() == "page" for target in targets)
    verdicts: Counter[str] = Counter()
    entries: list[ReportEntry] = []
    facts: list[dict[str, Any]] = []
    room = MAX_PAGE
    for pair in compare_folders(*folders, tolerance, perceptual=perceptual):
        verdicts[pair.verdict] += 1
        facts.append(_facts(pair))
        if pair.verdict == "same":
            continue
        print(pair.line(), file=sys.stderr if pair.verdict == "broken" else None)
        if paged:
            entries.append(_entry(pair, pictured=room > 0))
            room -= sum(len(data) for _, data in entries[-1].pictures)
    summary = ", ".join(
        f"{verdicts[name]} {text}" for name, text in _WORDS.items() if verdicts[name]
    )
    if others:
        summary += f"; files that are no pictures and are left out: {others}"
    print(summary)
    if room <= 0:
        summary += f"; pictures after the first {MAX_PAGE >> 20} MiB are left out of this page"
    for target in targets:
        if format_of(target, *REPORTS).kind() == "page":
            write_text(target, html_report("Comparison of two folders", f"{summary}.", entries))
        else:
            words = {"files": facts, "counts": dict(verdicts), "left_out": others}
            write_text(target, json.dumps(words, indent=2) + "\n")
    if verdicts["broken"]:
        return 2
    return 1 if any(verdicts[name] for name in ("different", "removed", "added")) else 0


def _facts(pair: "FilePair") -> dict[str, Any]:
    from drapery.comparison import pair_facts

    known = {"name": pair.name, "verdict": pair.verdict}
    if pair.comparison is not None:
        return known | pair_facts(pair.comparison)
    return known | ({"fault": pair.fault} if pair.fault else {})


def _entry(pair: "FilePair", *, pictured: bool) -> "ReportEntry":
    from drapery.comparison import ReportEntry, Variant, data_address, pair_entry, read_picture

    pictures: tuple[tuple[str, str], ...] = ()
    if pair.comparison is not None:
        entry = pair_entry(pair.comparison, pictured=pictured)
        return ReportEntry(pair.name, entry.same, pair.words(), entry.facts, entry.pictures)
    line = pair.words()
    if pair.path is not None and pictured:
        try:
            frame = Variant(pair.name, read_picture(pair.path)).frame
            pictures = ((pair.verdict, data_address(frame)),)
        except OptionError as error:
            line += f"; {error}"
    return ReportEntry(pair.name, False, line, pictures=pictures)
