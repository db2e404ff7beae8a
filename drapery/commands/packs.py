"""`drapery packs`: the contents of packs: what they have, lack and override, and their faults."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from drapery.commands import options as o

if TYPE_CHECKING:
    from drapery.packs import PackReport


def run(
    packs: Annotated[
        list[Path],
        typer.Argument(
            metavar="PATH...",
            help="Resource packs (folders, zips, jars); the last one with a file counts.",
            show_default=False,
        ),
    ],
    out: Annotated[
        Path | None,
        typer.Option(
            "-o", "--out", metavar="FILE", help="All their patterns, as a picture or page."
        ),
    ] = None,
    format: o.FormatOption = None,
) -> None:
    """List what packs have, lack and override; exit code 1 if something in them is broken."""
    from drapery.packs import describe_packs, open_packs
    from drapery.render.encode import check_target
    from drapery.settings import check_format
    from drapery.sheets import contents_sheet

    check_format(format)
    if out is not None:
        check_target(out, "still", "page")
    reports = describe_packs(packs, format=format)
    print("\n\n".join("\n".join(_lines(report)) for report in reports))
    if out is not None:
        contents_sheet(open_packs(packs, format=format)).save(out)
    raise typer.Exit(1 if any(report.problems for report in reports) else 0)


def _lines(report: "PackReport") -> list[str]:
    """The report as lines of text, one for each fact."""
    total = len(report.has) + len(report.lacks)
    facts = {
        "description": report.description,
        "format": _format(report),
        "overlays": ", ".join(report.overlays),
        "patterns": f"{len(report.has)} of {total}",
        "lacks": ", ".join(report.lacks) if report.has else "",
        "adds": ", ".join(report.added),
        "extra": ", ".join(report.extra),
        "for shields": f"{len(report.shields)} of {total}" if report.shield_sides else "",
        "shields lack": ", ".join(report.lacks_for_shields),
        "bases": ", ".join(report.bases) or "none",
        "sheets": _sizes(report.sides),
        "shield sheets": _sizes(report.shield_sides),
        "animated": ", ".join(report.animated),
        "normal maps": ", ".join(report.normal_maps),
        "specular maps": ", ".join(report.specular_maps),
        "overrides": _overridden(report),
        "not checked": _too_many(report.unchecked),
    }
    lines = [f"  {name:13} {' '.join(text.split())}" for name, text in facts.items() if text]
    lines += [f"  note          {line}" for line in report.notes]
    return [report.label, *lines, *(f"  problem       {line}" for line in report.problems)]


def _format(report: "PackReport") -> str:
    """The formats that the pack supports, and the one that it was read as where they differ."""
    lowest, highest = report.formats or (report.format, report.format)
    own = "unknown" if lowest is None else str(lowest)
    if lowest != highest:
        own = f"{lowest} to {highest}"
    return own if lowest == highest == report.format else f"{own}, read as {report.format}"


def _sizes(sides: "tuple[tuple[int, int], ...]") -> str:
    return ", ".join(f"{count} of {side} x {side} px" for side, count in sides)


def _too_many(names: "tuple[str, ...]") -> str:
    return f"{', '.join(names)} (the pack's sheets are too large in all)" if names else ""


def _overridden(report: "PackReport") -> str:
    """The patterns that the pack overrides, by the pack that they are from."""
    hidden: dict[str, list[str]] = {}
    for pattern, label in report.overrides:
        hidden.setdefault(label, []).append(pattern)
    return "; ".join(f"{', '.join(names)} of {label}" for label, names in hidden.items())
