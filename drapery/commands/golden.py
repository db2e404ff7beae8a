"""`drapery golden`: golden images of a file of cases, for projects without Python."""

from pathlib import Path
from typing import Annotated

import typer

from drapery.commands.notices import compile_notice
from drapery.errors import DraperyError

app = typer.Typer(help="Golden images from a TOML or YAML file of cases.", no_args_is_help=True)

FileArgument = Annotated[
    Path, typer.Argument(metavar="FILE", help="The cases: TOML or YAML.", show_default=False)
]


@app.command()
def check(
    file: FileArgument,
    report: Annotated[Path, typer.Option(help="Folder for the pictures of failures.")] = Path(
        "drapery-report"
    ),
    summary: Annotated[
        Path | None,
        typer.Option(help="A Markdown file to which a table of what changed is added, for CI."),
    ] = None,
) -> None:
    """Draw every case and compare: exit code 0 all as before, 1 some differ, 2 bad input."""
    from drapery.testing.case_check import check_cases, unused_goldens
    from drapery.testing.cases import read_cases
    from drapery.testing.failures import clear_report, markdown_report, write_report

    cases = read_cases(file)
    clear_report(report)
    failed = 0
    try:
        with compile_notice():
            for outcome in check_cases(cases, file.parent, report):
                if outcome.fault is not None:
                    failed += 1
                    print(f"{outcome.name}: {outcome.fault}")
    except DraperyError:
        write_report(report)  # what was found before the case that cannot be drawn
        raise
    for path in unused_goldens(cases, file.parent):
        print(f"unused golden: {path}")
    page = write_report(report)
    if summary is not None:
        with summary.open("a", encoding="utf-8") as text:
            text.write(markdown_report(report))
    print(f"{len(cases.case) - failed} as before, {failed} not" + (f"; see {page}" if page else ""))
    raise typer.Exit(1 if failed else 0)


@app.command()
def update(file: FileArgument) -> None:
    """Draw every case and write the picture as its golden."""
    from drapery.testing.case_check import update_cases
    from drapery.testing.cases import read_cases

    cases = read_cases(file)
    with compile_notice():
        outcomes = list(update_cases(cases, file.parent))
    for outcome in outcomes:
        if outcome.written:
            print(f"wrote {outcome.name}")
    print(f"{sum(o.written for o in outcomes)} of {len(outcomes)} goldens written")


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
    print(f"{len(paths)} goldens written")
