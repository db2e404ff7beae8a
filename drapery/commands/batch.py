"""`drapery batch`: all pictures of a manifest, on one machine or many."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from time import monotonic
from typing import TYPE_CHECKING, Annotated

import typer

from drapery.commands.notices import bar_of, compile_notice, say

if TYPE_CHECKING:
    from drapery.batch.executor import Executor
    from drapery.batch.jobs import Job
    from drapery.batch.results import ResultsDB
    from drapery.batch.run import Progress
    from drapery.batch.stores import Store

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
    results: Annotated[
        Path | None,
        typer.Option(metavar="FILE", help="What was done.", show_default="in DIR"),
    ] = None,
) -> None:
    """Draw all jobs of a manifest; exit code 0, 1 where some failed, 2 for a bad manifest."""
    from drapery.batch.cluster import LostError
    from drapery.batch.report import numbers, write_page
    from drapery.batch.results import ResultsDB
    from drapery.batch.stores import open_store
    from drapery.option import within

    within("workers", workers or 1, 1, MAX_WORKERS, "processes")
    within("retries", retries, 0, 100)
    within("timeout", timeout, 0.1, 86400, "s")
    within("memory", memory, 16, 1 << 22, "MiB")
    jobs = _jobs(manifest, default or [], format)
    store = open_store(out)
    start = monotonic()
    with ResultsDB(_results_path(store, results, resume)) as database, compile_notice():
        spawn = _spawn(store, workers, cluster, scheduler, timeout, memory << 20, jobs)
        try:
            progress = _execute(jobs, store, database, spawn, resume, retries)
        except LostError as error:
            say(str(error))
            raise typer.Exit(1) from None
        seconds = monotonic() - start
        write_page(f"{manifest.name} in {store.label}", progress, seconds, database.known(), store)
    _summarise(numbers(progress, seconds), progress)
    raise typer.Exit(1 if progress.done < progress.total else 0)


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


def _results_path(store: "Store", given: Path | None, resume: bool) -> Path:
    from drapery.batch.results import FILE
    from drapery.batch.stores import LocalStore
    from drapery.errors import OptionError

    folder = store.folder if isinstance(store, LocalStore) else Path()
    path = given or folder / FILE
    if resume and not path.exists():
        raise OptionError(f"{path}: no results, so nothing to resume; leave out --resume")
    return path


def _spawn(
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

    from drapery.batch.jobs import run_job
    from drapery.batch.pool import JobLimits, ProcessPool
    from drapery.batch.warmup import warm_up

    count, limits = workers or os.cpu_count() or 1, JobLimits(timeout, memory)

    def spawn(todo: int) -> "Executor":
        if scheduler is None:
            moving = [job.seconds is not None for job in jobs]
            warm_up(stills=not all(moving), loops=any(moving))
        if scheduler is None and not cluster:
            return ProcessPool(partial(run_job, store=store), min(count, todo), limits, ahead=2)
        from drapery.batch.cluster import join, local

        if scheduler is None:
            return local(min(count, todo), store, limits)
        return join(scheduler, store, limits)

    return spawn


def _execute(
    jobs: "list[Job]",
    store: "Store",
    database: "ResultsDB",
    spawn: "Callable[[int], Executor]",
    resume: bool,
    retries: int,
) -> "Progress":
    from drapery.batch.executor import RetryPolicy
    from drapery.batch.run import execute

    with _progress(sum(len(job.outs) for job in jobs)) as on_event:
        return execute(
            jobs,
            store,
            database,
            spawn,
            resume=resume,
            retries=RetryPolicy(retries),
            on_event=on_event,
        )


@contextmanager
def _progress(total: int) -> "Iterator[Callable[[Progress], None]]":
    """A bar: done, rate, time left, failures."""
    with bar_of("pictures", "{task.fields[failed]} failed") as bar:
        task = bar.add_task("pictures", total=total, failed=0)

        def on_event(progress: "Progress") -> None:
            ended = progress.done + len(progress.failed)
            bar.update(task, completed=ended, failed=len(progress.failed))

        yield on_event


def _summarise(said: dict[str, str], progress: "Progress") -> None:
    for entry in progress.failed[:MAX_SAID]:
        say(f"{entry.out} ({entry.place}): {entry.why}")
    if len(progress.failed) > MAX_SAID:
        say(f"and {len(progress.failed) - MAX_SAID} more; all are in the results and the report")
    for note in progress.notes:
        say(note)
    width = max(map(len, said))
    for name, value in said.items():
        print(f"{name:{width}}  {value}")
