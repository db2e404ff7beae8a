"""`run_batch`: draws all pictures of a manifest with one call."""

import os
import time
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any

from drapery.batch.executor import Executor, RetryPolicy
from drapery.batch.jobs import Job, plan, run_job
from drapery.batch.manifest import read_manifest
from drapery.batch.pool import JobLimits, ProcessPool, warm_up
from drapery.batch.report import write_report
from drapery.batch.results import FILE, OutputRecord, ResultsDB
from drapery.batch.run import OnEvent, Progress, execute
from drapery.batch.stores import LocalStore, Store, open_store
from drapery.errors import OptionError, OutputError
from drapery.option import within

MAX_WORKERS = 512


@dataclass(frozen=True)
class BatchResult:
    """The result of a run, as numbers of output files.

    total: all outputs of the manifest.
    drawn: those that this run drew.
    copied: those that are a copy of an equal output.
    existing: those that an earlier run drew.
    failed: the records of failed outputs, with their errors.
    warnings: each once.
    errors: errors of writing results or the report.
    seconds: duration of the run [s].
    """

    total: int
    drawn: int
    copied: int
    existing: int
    failed: tuple[OutputRecord, ...]
    warnings: tuple[str, ...]
    errors: tuple[str, ...]
    seconds: float

    @property
    def ok(self) -> bool:
        """Whether every output exists and the results and the report were written."""
        return self.drawn + self.copied + self.existing == self.total and not self.errors


def run_batch(
    manifest: str | Path | Iterable[Mapping[str, Any]],
    out: str | Path,
    *,
    defaults: Mapping[str, Any] | None = None,
    format: str = "png",
    workers: int | None = None,
    scheduler: str | None = None,
    resume: bool = False,
    retries: int = 2,
    timeout: float = 300.0,
    memory: int = 2048,
    results: str | Path | None = None,
    on_event: OnEvent | None = None,
) -> BatchResult:
    """Draw all pictures of a manifest; pictures of earlier runs are not drawn again.

    A failed picture does not raise: it is listed in `BatchResult.failed`.

    Workers are started by multiprocessing, so a script must call this below `if __name__ ==
    "__main__":`.

    manifest: a file (CSV, JSON lines or YAML), a world, region or schematic, or rows in memory:
        mappings of option names to values. A row's `design` is a text or a `Banner`.
    out: a folder, or an address that fsspec knows, such as `s3://bucket/folder`.
    defaults: options of all rows that do not set them.
    format: the ending of rows that name no file, without its dot.
    workers: processes on this machine; None is one for each core.
    scheduler: None for processes of this machine, `local` for a Dask cluster on this machine, or
        the address of a Dask scheduler, such as `tcp://host:8786`.
    resume: continue a stopped run; jobs that failed in it after all retries are not tried again.
    retries: how often a failed job is tried again.
    timeout: longest time of one job [s].
    memory: most memory of one job [MiB].
    results: the file that records the results; None is `drapery-batch.sqlite` in `out`.
    on_event: called with the run's `Progress` before the first job and after each job.

    Raises ManifestError with all faults of the manifest, OptionError for other bad arguments,
    DesignError for a broken world, OutputError if `out` or `results` cannot be used, LostError (a
    BackendError) if the cluster's scheduler ends.
    """
    within("workers", 1 if workers is None else workers, 1, MAX_WORKERS, "processes")
    within("retries", retries, 0, 100)
    within("timeout", timeout, 0.1, 86400, "s")
    within("memory", memory, 16, 1 << 22, "MiB")
    jobs = plan(read_manifest(manifest, defaults, format))
    store = open_store(str(out))
    start = time.monotonic()
    with ResultsDB(_results_path(store, results, resume)) as database:
        spawn = _spawner(jobs, store, workers, scheduler, JobLimits(timeout, memory << 20))
        policy = RetryPolicy(retries)
        listen = _ignore if on_event is None else on_event
        progress = execute(
            jobs, store, database, spawn, resume=resume, retries=policy, on_event=listen
        )
        seconds = time.monotonic() - start
        name = Path(manifest).name if isinstance(manifest, str | Path) else "pictures"
        try:
            write_report(f"{name} in {store.label}", progress, seconds, database.records(), store)
        except OutputError as error:
            progress.errors[str(error)] = None
    return _result(progress, seconds)


def _ignore(progress: Progress) -> None:
    pass


def _result(progress: Progress, seconds: float) -> BatchResult:
    return BatchResult(
        progress.total,
        progress.drawn,
        progress.copied,
        progress.existing,
        tuple(progress.failed),
        tuple(progress.warnings),
        tuple(progress.errors),
        seconds,
    )


def _results_path(store: Store, given: str | Path | None, resume: bool) -> Path:
    folder = store.folder if isinstance(store, LocalStore) else Path()
    path = folder / FILE if given is None else Path(given)
    if resume and not path.exists():
        raise OptionError(f"{path} does not exist, so there is nothing to resume; do not resume")
    return path


def _spawner(
    jobs: list[Job], store: Store, workers: int | None, scheduler: str | None, limits: JobLimits
) -> Callable[[int], Executor]:
    """A function that makes the executor for a number of jobs."""
    most = (os.cpu_count() or 1) if workers is None else workers

    def spawn(todo: int) -> Executor:
        from drapery.batch import cluster

        if scheduler not in (None, "local"):
            return cluster.connect(str(scheduler), store, limits)
        animated = [job.timing is not None for job in jobs]
        warm_up(stills=not all(animated), loops=any(animated))
        if scheduler == "local":
            return cluster.local_cluster(min(most, todo), store, limits)
        return ProcessPool(partial(run_job, store=store), min(most, todo), limits, ahead=2)

    return spawn
