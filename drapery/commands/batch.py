"""`drapery batch`: all pictures of a manifest, on one machine or many."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from drapery.commands.notices import bar_of, compile_notice, say
from drapery.errors import counted

if TYPE_CHECKING:
    from drapery.batch import BatchResult, Progress

MAX_LINES = 50
"""The most failures that are printed; the report has all."""


def run(
    manifest: Annotated[
        Path,
        typer.Argument(
            metavar="MANIFEST",
            help="CSV, JSON lines or YAML; or a world, region or schematic, each banner a job.",
            show_default=False,
        ),
    ],
    out: Annotated[
        str,
        typer.Option("-o", "--out", metavar="DIR", help="A folder, or an address: s3://bucket/x."),
    ],
    format: Annotated[
        str, typer.Option(help="The ending of jobs that name no file: png, or another.")
    ] = "png",
    default: Annotated[
        list[str] | None,
        typer.Option("--set", metavar="NAME=VALUE", help="An option for jobs that do not set it."),
    ] = None,
    workers: Annotated[
        int | None, typer.Option(help="Processes on this machine.", show_default="one a core")
    ] = None,
    cluster: Annotated[
        bool, typer.Option("--cluster", help="Make the processes a local Dask cluster.")
    ] = False,
    scheduler: Annotated[
        str | None, typer.Option(metavar="ADDRESS", help="A Dask scheduler: tcp://host:8786.")
    ] = None,
    resume: Annotated[
        bool, typer.Option("--resume", help="Continue a run that was stopped.")
    ] = False,
    retries: Annotated[int, typer.Option(help="How often a failed job is tried again.")] = 2,
    timeout: Annotated[float, typer.Option(help="Seconds that one job may take.")] = 300.0,
    memory: Annotated[int, typer.Option(help="MiB that one job may take.")] = 2048,
    results: Annotated[
        Path | None,
        typer.Option(metavar="FILE", help="Where results are recorded.", show_default="in DIR"),
    ] = None,
) -> None:
    """Draw all jobs of a manifest; exit code 0, 1 if some failed, 2 for a bad manifest."""
    from drapery.batch import LostError, ManifestError, run_batch
    from drapery.errors import OptionError

    if cluster and scheduler is not None:
        raise OptionError("--cluster starts a new scheduler; leave out --scheduler")
    defaults = _defaults(default or [])
    try:
        with compile_notice(), _progress() as on_event:
            result = run_batch(
                manifest,
                out,
                defaults=defaults,
                format=format,
                workers=workers,
                scheduler="local" if cluster else scheduler,
                resume=resume,
                retries=retries,
                timeout=timeout,
                memory=memory,
                results=results,
                on_event=on_event,
            )
    except ManifestError as error:
        for fault in error.faults:
            say(f"{manifest}: {fault}")
        raise OptionError(
            f"{manifest}: {counted(len(error.faults), 'fault')}; nothing was drawn"
        ) from None
    except LostError as error:
        say(str(error))
        raise typer.Exit(1) from None
    _summarise(result)
    raise typer.Exit(0 if result.ok else 1)


def _defaults(texts: list[str]) -> dict[str, str]:
    from drapery.errors import OptionError

    for text in texts:
        if "=" not in text:
            raise OptionError(f"--set {text!r} has no value; write NAME=VALUE")
    pairs = (text.split("=", 1) for text in texts)
    return {name.strip(): value.strip() for name, value in pairs}


@contextmanager
def _progress() -> "Iterator[Callable[[Progress], None]]":
    """A bar: done, rate, time left, failures."""
    with bar_of("pictures", "{task.fields[failed]} failed") as bar:
        task = bar.add_task("pictures", total=None, failed=0)

        def on_event(progress: "Progress") -> None:
            failed = len(progress.failed)
            bar.update(task, total=progress.total, completed=progress.done + failed, failed=failed)

        yield on_event


def _summarise(result: "BatchResult") -> None:
    from drapery.batch.report import summary

    for record in result.failed[:MAX_LINES]:
        say(f"{record.out} ({record.place}): {record.error}")
    if len(result.failed) > MAX_LINES:
        say(f"and {len(result.failed) - MAX_LINES} more; the results and the report list all")
    for line in (*result.errors, *result.warnings):
        say(line)
    lines = summary(result, result.seconds)
    width = max(map(len, lines))
    for name, value in lines.items():
        print(f"{name:{width}}  {value}")
