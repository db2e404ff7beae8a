"""`drapery batch`: all pictures of a manifest, on one machine or many."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from time import monotonic
from typing import TYPE_CHECKING, Annotated

import typer

from drapery.commands.notices import bar_of, compile_notice, say

if TYPE_CHECKING:
    from drapery.batch.jobs import Job
    from drapery.batch.results import ResultsDB
    from drapery.batch.run import Progress
    from drapery.batch.stores import Store
    from drapery.batch.work import Executor

MAX_WORKERS = 512
MAX_SAID = 50


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
        str, typer.Option(help="png, webp, gif, apng, mp4 or webm, where a job names no file.")
    ] = "png",
    default: Annotated[
        list[str] | None,
        typer.Option("--set", metavar="NAME=VALUE", help="An option of all jobs without it."),
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
        bool, typer.Option("--resume", help="Go on with a run that was stopped.")
    ] = False,
    retries: Annotated[int, typer.Option(help="How often a failed job is tried again.")] = 2,
    timeout: Annotated[float, typer.Option(help="Seconds that one job may take.")] = 300.0,
    memory: Annotated[int, typer.Option(help="MiB that one job may take.")] = 2048,
    ledger: Annotated[
        Path | None,
        typer.Option(metavar="FILE", help="What was done.", show_default="in DIR"),
    ] = None,
) -> None:
    """Draw all jobs of a manifest; exit code 0, 1 where some failed, 2 for a bad manifest."""
    from drapery.batch.cluster import LostError
    from drapery.batch.page import numbers, write_page
    from drapery.batch.results import ResultsDB
    from drapery.batch.stores import open_store
    from drapery.settings import within

    within("workers", workers or 1, 1, MAX_WORKERS, "processes")
    within("retries", retries, 0, 100)
    within("timeout", timeout, 0.1, 86400, "s")
    within("memory", memory, 16, 1 << 22, "MiB")
    jobs = _jobs(manifest, default or [], format)
    store = open_store(out)
    start = monotonic()
    with ResultsDB(_ledger_path(store, ledger, resume)) as book, compile_notice():
        hire = _hire(store, workers, cluster, scheduler, timeout, memory << 20, jobs)
        try:
            tally = _carry_out(jobs, store, book, hire, resume, retries)
        except LostError as error:
            say(str(error))
            raise typer.Exit(1) from None
        seconds = monotonic() - start
        write_page(f"{manifest.name} in {store.label}", tally, seconds, book.known(), store)
    _summarise(numbers(tally, seconds), tally)
    raise typer.Exit(1 if tally.done < tally.total else 0)


def _jobs(manifest: Path, defaults: list[str], ending: str) -> "list[Job]":
    """The manifest's jobs; all faults are said before the error that ends the command."""
    from drapery.batch.jobs import plan
    from drapery.batch.manifest import ManifestError, read_manifest
    from drapery.errors import OptionError

    for word in defaults:
        if "=" not in word:
            raise OptionError(f"--set {word!r} has no value; write NAME=VALUE")
    pairs = (word.split("=", 1) for word in defaults)
    given = {name.strip(): value.strip() for name, value in pairs}
    try:
        return plan(read_manifest(manifest, given, ending))
    except ManifestError as error:
        for fault in error.faults:
            say(f"{manifest}: {fault}")
        count = len(error.faults)
        raise OptionError(
            f"{manifest}: {count} fault{'s' if count > 1 else ''}; nothing was drawn"
        ) from None


def _ledger_path(store: "Store", given: Path | None, resume: bool) -> Path:
    from drapery.batch.results import FILE
    from drapery.batch.stores import LocalStore
    from drapery.errors import OptionError

    folder = store.folder if isinstance(store, LocalStore) else Path()
    path = given or folder / FILE
    if resume and not path.exists():
        raise OptionError(f"{path}: no ledger, so nothing to resume; leave out --resume")
    return path


def _hire(
    store: "Store",
    workers: int | None,
    cluster: bool,
    scheduler: str | None,
    timeout: float,
    memory: int,
    jobs: "list[Job]",
) -> "Callable[[int], Executor]":
    import os
    from functools import partial

    from drapery.batch.jobs import do
    from drapery.batch.pool import Limits, Pool
    from drapery.batch.warming import warm

    count, limits = workers or os.cpu_count() or 1, Limits(timeout, memory)

    def hire(todo: int) -> "Executor":
        if scheduler is None:
            moving = [job.seconds is not None for job in jobs]
            warm(stills=not all(moving), loops=any(moving))
        if scheduler is None and not cluster:
            return Pool(partial(do, store=store), min(count, todo), limits, ahead=2)
        from drapery.batch.cluster import join, local

        if scheduler is None:
            return local(min(count, todo), store, limits)
        return join(scheduler, store, limits)

    return hire


def _carry_out(
    jobs: "list[Job]",
    store: "Store",
    book: "ResultsDB",
    hire: "Callable[[int], Executor]",
    resume: bool,
    retries: int,
) -> "Progress":
    from drapery.batch.run import execute
    from drapery.batch.work import Retries

    with _progress(sum(len(job.outs) for job in jobs)) as tell:
        return execute(jobs, store, book, hire, resume=resume, retries=Retries(retries), tell=tell)


@contextmanager
def _progress(total: int) -> "Iterator[Callable[[Progress], None]]":
    """A bar: done, rate, time left, failures."""
    with bar_of("pictures", "{task.fields[failed]} failed") as bar:
        task = bar.add_task("pictures", total=total, failed=0)

        def tell(tally: "Progress") -> None:
            ended = tally.done + len(tally.failed)
            bar.update(task, completed=ended, failed=len(tally.failed))

        yield tell


def _summarise(said: dict[str, str], tally: "Progress") -> None:
    for entry in tally.failed[:MAX_SAID]:
        say(f"{entry.out} ({entry.place}): {entry.why}")
    if len(tally.failed) > MAX_SAID:
        say(f"and {len(tally.failed) - MAX_SAID} more; all are in the ledger and the report")
    for note in tally.notes:
        say(note)
    width = max(map(len, said))
    for name, value in said.items():
        print(f"{name:{width}}  {value}")
