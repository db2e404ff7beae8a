"""`drapery golden`: golden images of a file of cases, for projects without Python."""

import sys
from pathlib import Path
from typing import Annotated

import typer

from drapery.commands.notices import compile_notice
from drapery.errors import counted

app = typer.Typer(help="Golden images from a TOML or YAML file of cases.", no_args_is_help=True)

FileArgument = Annotated[
    Path, typer.Argument(metavar="FILE", help="The cases: TOML or YAML.", show_default=False)
]


OnlyOption = Annotated[
    list[str] | None, typer.Option("--only", metavar="NAME", help="The case of this name alone.")
]


@app.command()
def check(
    file: FileArgument,
    only: OnlyOption = None,
    report: Annotated[Path, typer.Option(help="Folder for the pictures of failures.")] = Path(
        "drapery-report"
    ),
    summary: Annotated[
        Path | None,
        typer.Option(help="A Markdown file to which a table of what changed is added, for CI."),
    ] = None,
) -> None:
    """Draw every case and compare: exit code 0 all as before, 1 some differ, 2 bad input."""
    from drapery.testing.case_check import check_cases, clear_cases, unused_goldens
    from drapery.testing.cases import read_cases
    from drapery.testing.failures import markdown_report, write_report

    cases, names = read_cases(file), only or ()
    clear_cases(report, names)
    with compile_notice():
        outcomes = []
        for outcome in check_cases(cases, file.parent, report, names):
            outcomes.append(outcome)
            if outcome.fault is not None:
                print(
                    f"{outcome.name}: {outcome.fault}", file=sys.stderr if outcome.broken else None
                )
    if not names:
        for path in unused_goldens(cases, file.parent):
            print(f"unused golden: {path}")
    page = write_report(report)
    if summary is not None:
        with summary.open("a", encoding="utf-8") as text:
            text.write(markdown_report(report))
    broken = sum(each.broken for each in outcomes)
    failed = sum(each.fault is not None for each in outcomes) - broken
    counts = f"{len(outcomes) - failed - broken} as before, {failed} not"
    counts += f", {broken} cannot be checked" if broken else ""
    print(counts + (f"; see {page}" if page else ""))
    raise typer.Exit(2 if broken else 1 if failed else 0)


@app.command()
def update(file: FileArgument, only: OnlyOption = None) -> None:
    """Draw every case and write the picture as its golden."""
    from drapery.testing.case_check import update_cases
    from drapery.testing.cases import read_cases

    cases = read_cases(file)
    with compile_notice():
        outcomes = list(update_cases(cases, file.parent, only or ()))
    for outcome in outcomes:
        if outcome.fault is not None:
            print(f"{outcome.name}: {outcome.fault}", file=sys.stderr)
        elif outcome.written:
            print(f"wrote {outcome.name}")
    print(f"{sum(o.written for o in outcomes)} of {counted(len(outcomes), 'golden')} written")
    raise typer.Exit(2 if any(o.fault for o in outcomes) else 0)


@app.command()
def accept(
    report: Annotated[
        Path, typer.Argument(metavar="REPORT", help="The folder of a report.")
    ] = Path("drapery-report"),
    only: Annotated[
        Path | None,
        typer.Option(
            metavar="FILE", help="The decisions that the report's page saved; else all are written."
        ),
    ] = None,
) -> None:
    """Write the failed pictures of a report as goldens, as its page decided."""
    from drapery.testing.failures import accept_failures, read_approvals

    paths = list(accept_failures(report, None if only is None else read_approvals(only)))
    for path in paths:
        print(f"wrote {path.as_posix()}")
    print(f"{counted(len(paths), 'golden')} written")
