"""The report of failed checks: a page that compares pictures, and what accepts them as goldens.

A loop is on the page as a sheet of its frames, from which the page draws the same frame of the
expected and of the actual loop at a time; a browser would not keep two APNG files in step.

Workers of pytest-xdist write at the same time: every failure has separate files, and the main
process makes the page from them at the end.
"""

import hashlib
import json
import math
import re
from collections.abc import Collection, Iterator, Sequence
from dataclasses import dataclass
from importlib.resources import files
from pathlib import Path
from typing import Any

import numpy as np

from drapery.arrays import Pixels
from drapery.comparison import (
    EXACT,
    Picture,
    Tolerance,
    as_picture,
    data_of,
    difference_panel,
    eight_bits,
    joined_panels,
    write_text,
)
from drapery.errors import OutputError, counted, quoted
from drapery.output_files import make_folder, replacing
from drapery.render import png_bytes
from drapery.testing.golden import decode, encode
from drapery.testing.naming import ENDINGS

_FACTS = ".failure.json"
_CONTENT = ".golden"
_PICTURES = ("expected", "actual", "panel", "difference")
_PAGE = "index.html"
_MOST_ROWS = 500
"""The most rows of a summary: CI services refuse long ones."""


@dataclass(frozen=True)
class FailedPicture:
    """A failed check as its report holds it.

    id: the beginning of the names of its files. test: what made the check. line: what changed.
    golden: where its golden is or will be, relative to the folder in which the checks ran; empty
    if it is elsewhere. was: the SHA-256 of the golden that was checked, or nothing if there was
    none.
    """

    id: str
    test: str
    name: str
    line: str
    golden: str
    was: str
    folder: Path

    def picture(self, kind: str) -> bytes | None:
        """The PNG that was expected or is actual, if there is one."""
        path = self.folder / f"{self.id}.{kind}.png"
        return path.read_bytes() if path.exists() else None


@dataclass(frozen=True)
class _ShownPicture:
    """A picture on the page. data: its address; a loop is a sheet of its frames in columns."""

    data: str
    frames: int
    columns: int
    fps: float


@dataclass(frozen=True)
class GoldenUpdate:
    """A golden as it would be if the picture were accepted.

    path: of the golden.
    content: the bytes of its file.
    """

    path: Path
    content: bytes


def keep_failure(
    folder: Path,
    test: str,
    label: str,
    expected: Any,
    actual: Any,
    line: str,
    update: GoldenUpdate | None = None,
    *,
    root: Path | None = None,
    tolerance: Tolerance = EXACT,
) -> Path:
    """Write a failure's pictures and facts; returns the picture to look at first.

    folder: of the failures.
    test: the id of the test.
    label: the name of the golden.
    expected: what `as_picture` takes; None if nothing is known of it.
    actual: what `as_picture` takes; None for what has no picture, of which the report shows the
        line.
    line: the fault in one line.
    update: what `accept_failures` writes.
    root: the folder in which `accept_failures` will run; by default the present one.
    tolerance: what does not count.

    Raises OutputError for a folder that cannot be written.
    """
    make_folder(folder)
    stem = failure_id(test, label)
    pictures = {} if actual is None else {"actual": as_picture(actual)}
    if actual is not None and expected is not None:
        pictures["expected"] = as_picture(expected)
        pairs = list(_pairs(pictures["expected"], pictures["actual"]))
        panels = [difference_panel(*pair, tolerance=tolerance) for pair in pairs]
        sheets = [joined_panels(*pair, panel) for pair, panel in zip(pairs, panels, strict=True)]
        pictures["panel"] = _in_time(panels, pictures["actual"])
        pictures["difference"] = _in_time([sheet.pixels for sheet in sheets], pictures["actual"])
    for kind, picture in pictures.items():
        with replacing(folder / f"{stem}.{kind}.png") as part:
            part.write_bytes(encode(picture))
    facts = {"test": test, "name": f"{test} [{label}]", "line": line, "golden": "", "was": ""}
    if update is not None:
        facts["golden"] = _relative(update.path, root)
        facts["was"] = _hash_of(update.path)
        with replacing(folder / (stem + _CONTENT)) as beside:
            beside.write_bytes(update.content)
    write_text(folder / (stem + _FACTS), json.dumps(facts))
    return folder / f"{stem}.{'difference' if 'difference' in pictures else 'actual'}.png"


def failures_in(folder: Path) -> list[FailedPicture]:
    """The failures of the last run, by the names of their files. Raises OutputError."""
    found = []
    for path in sorted(folder.glob(f"*{_FACTS}")):
        try:
            facts = json.loads(path.read_text(encoding="utf-8"))
            words = {key: str(facts[key]) for key in ("test", "name", "line", "golden", "was")}
        except (OSError, ValueError, KeyError, TypeError, RecursionError):
            raise OutputError(f"{path} cannot be read; run the checks again") from None
        found.append(FailedPicture(path.name.removesuffix(_FACTS), folder=folder, **words))
    return found


def write_report(
    folder: Path, page: Path | None = None, *, root: Path | None = None
) -> Path | None:
    """Make the page of all failures in a folder; without failures there is none.

    folder: of the failures.
    page: where to write it, by default index.html in the folder.
    root: the folder in which the failures will be accepted; by default the present one.

    Raises OutputError for a page that cannot be written.
    """
    failures = failures_in(folder)
    page = page or folder / _PAGE
    if not failures:
        _remove(page)
        return None
    write_text(page, _page_of(failures, folder, root))
    return page


def markdown_report(folder: Path) -> str:
    """A table of all failures in a folder, for the summary of a job.

    Raises OutputError.
    """
    failures = failures_in(folder)
    if not failures:
        return "All goldens are as before.\n"
    rows = [f"| {_cell(each.name)} | {_cell(each.line)} |" for each in failures[:_MOST_ROWS]]
    if len(failures) > _MOST_ROWS:
        rows.append(f"| and {len(failures) - _MOST_ROWS} more | |")
    head = [
        f"**{counted(len(failures), 'golden')} changed.**",
        "",
        "| golden | what changed |",
    ]
    return "\n".join([*head, "|---|---|", *rows, ""])


def accept_failures(folder: Path, only: Collection[str] | None = None) -> Iterator[Path]:
    """Write the actual pictures of a report as goldens; yields the path of each.

    folder: of the report.
    only: the ids of those to accept; None for all.

    Raises OutputError, before anything is written, if a golden would lie outside the present
    folder, as in a report that somebody else made, or is not the one that was checked.
    """
    if not folder.is_dir():
        raise OutputError(f"{folder} is not a folder; use the report of drapery golden check")
    known = failures_in(folder)
    unknown = set(only or ()) - {each.id for each in known}
    if unknown:
        raise OutputError(f"{folder} has no picture {min(unknown)!r}; use the report of this run")
    chosen = []
    for each in known:
        content = folder / (each.id + _CONTENT)
        if (only is None or each.id in only) and content.exists():
            chosen.append(GoldenUpdate(_golden_to_replace(each), content.read_bytes()))
    for update in chosen:
        make_folder(update.path.parent)
        with replacing(update.path) as beside:
            beside.write_bytes(update.content)
        yield update.path


def _golden_to_replace(failure: FailedPicture) -> Path:
    """The golden of a failure. Raises OutputError if it must not be written."""
    path = Path(failure.golden)
    inside = "\0" not in failure.golden and path.resolve().is_relative_to(Path.cwd().resolve())
    if not failure.golden or not inside or path.suffix not in ENDINGS:
        raise OutputError(
            f"golden {failure.golden or failure.name!r} is not a golden in this folder; "
            "run this where the checks ran"
        )
    if _hash_of(path) != failure.was:
        raise OutputError(
            f"golden {failure.golden} is not the one that the report compared with; "
            "run the checks again"
        )
    return path


def _hash_of(path: Path) -> str:
    """The SHA-256 of a file; nothing if there is none. Raises OutputError."""
    try:
        return hashlib.sha256(path.read_bytes()).hexdigest()
    except FileNotFoundError:
        return ""
    except OSError as error:
        raise OutputError(f"{path} cannot be read ({error.strerror}); make it readable") from None


def read_approvals(path: Path) -> list[str]:
    """The ids of the accepted pictures in a file that the report's page saved.

    Raises OutputError.
    """
    try:
        accepted = json.loads(path.read_text(encoding="utf-8"))["accepted"]
    except OSError as error:
        raise OutputError(f"{path} cannot be read: {error.strerror}; give its path") from None
    except (ValueError, KeyError, TypeError, RecursionError):
        accepted = None
    if not isinstance(accepted, list) or not all(isinstance(each, str) for each in accepted):
        raise OutputError(f"{path} has no decisions; save them on the page of the report")
    return accepted


def clear_report(folder: Path, page: Path | None = None) -> None:
    """Remove the failures of earlier runs; other files stay.

    folder: of the failures.
    page: see `write_report`.

    Raises OutputError if one cannot be removed, as in a folder of another user.
    """
    found = list(folder.glob(f"*{_FACTS}"))
    for facts in found:
        remove_failure(folder, facts.name.removesuffix(_FACTS))
    if found:
        _remove(page or folder / _PAGE)


def remove_failure(folder: Path, id: str) -> None:
    """Remove a failure from a report, but not from its page. Raises OutputError."""
    for kind in _PICTURES:
        _remove(folder / f"{id}.{kind}.png")
    _remove(folder / (id + _CONTENT))
    _remove(folder / (id + _FACTS))


def _remove(path: Path) -> None:
    try:
        path.unlink(missing_ok=True)
    except NotADirectoryError:
        return
    except OSError as error:
        raise OutputError(
            f"the report of an earlier run in {path.parent} cannot be removed ({error.strerror});"
            " remove the folder, or choose another for reports"
        ) from None


def _page_of(failures: list[FailedPicture], folder: Path, root: Path | None) -> str:
    from jinja2 import Environment

    here = files("drapery.testing")
    texts = {name: (here / f"report.{name}").read_text("utf-8") for name in ("html", "css", "js")}
    entries = [
        {
            "id": each.id,
            "name": each.name,
            "line": each.line,
            "pictures": (pictures := _shown(each)),
            "frames": max((shown.frames for shown in pictures.values()), default=1),
        }
        for each in failures
    ]
    return (
        Environment(autoescape=True)
        .from_string(texts["html"])
        .render(
            summary=f"{counted(len(failures), 'golden')} not as expected.",
            folder=quoted(_relative(folder, root) or folder.name),
            style=texts["css"],
            script=texts["js"],
            entries=entries,
        )
    )


def _shown(failure: FailedPicture) -> dict[str, _ShownPicture]:
    """The pictures of a failure by their names on the page."""
    made = {kind: failure.picture(kind) for kind in ("expected", "actual", "panel")}
    return {
        "difference" if kind == "panel" else kind: _on_page(decode(png)[0])
        for kind, png in made.items()
        if png is not None
    }


def _pairs(a: Picture, b: Picture) -> Iterator[tuple[Pixels, Pixels]]:
    """The frames of two pictures beside each other; the shorter one shows its last frame."""
    both = [[eight_bits(frame) for frame in picture.frames] for picture in (a, b)]
    for number in range(max(map(len, both))):
        yield both[0][min(number, len(both[0]) - 1)], both[1][min(number, len(both[1]) - 1)]


def _in_time(frames: Sequence[Pixels], like: Picture) -> Picture:
    """Frames that are shown as those of another picture; further ones as its last."""
    if len(frames) == 1:
        return Picture((frames[0],))
    known = like.delays or (0.1,)
    delays = [known[min(number, len(known) - 1)] for number in range(len(frames))]
    return Picture(tuple(frames), tuple(delays))


def _on_page(picture: Picture) -> _ShownPicture:
    frames = [eight_bits(frame) for frame in picture.frames]
    columns = math.ceil(math.sqrt(len(frames)))
    sheet = frames[0] if len(frames) == 1 else _sheet(frames, columns)
    fps = len(frames) / sum(picture.delays) if sum(picture.delays) else 1.0
    return _ShownPicture(data_of(png_bytes(sheet), "png"), len(frames), columns, round(fps, 4))


def _sheet(frames: Sequence[Pixels], columns: int) -> Pixels:
    """All frames in one picture, in rows."""
    height, width, channels = frames[0].shape
    rows = -(-len(frames) // columns)
    sheet = np.zeros((rows * height, columns * width, channels), np.uint8)
    for number, frame in enumerate(frames):
        top, left = number // columns * height, number % columns * width
        sheet[top : top + height, left : left + width] = frame
    return sheet


def _relative(path: Path, root: Path | None) -> str:
    """A path relative to a folder, by default the present one; nothing if it lies elsewhere."""
    whole, start = path.resolve(), (root or Path.cwd()).resolve()
    return whole.relative_to(start).as_posix() if whole.is_relative_to(start) else ""


def _cell(text: str) -> str:
    """A text in a table of Markdown that shows it as it is."""
    plain = re.sub(r"([\\`*_{}\[\]<>()#+!|~-])", r"\\\1", " ".join(text.split()))
    return plain.replace("&", "&amp;").replace("@", "&#64;")


def failure_id(test: str, label: str) -> str:
    """The beginning of the names of a failure's files."""
    readable = re.sub(r"[^A-Za-z0-9]+", "-", f"{test} {label}").strip("-")[-80:]
    digest = hashlib.sha256(f"{test}\0{label}".encode()).hexdigest()
    return f"{readable}-{digest[:8]}"
