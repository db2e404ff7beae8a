"""One run over planned jobs: known outputs are skipped, the others are drawn, all is recorded."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field

from drapery.batch.executor import Executor, RetryPolicy, run_jobs
from drapery.batch.jobs import Job, JobResult
from drapery.batch.results import OutputRecord, ResultsDB
from drapery.batch.stores import LocalStore, Store
from drapery.errors import DraperyError, OutputError


@dataclass
class Progress:
    """How far a run is. It changes while the run goes on. Counts are of outputs, not of jobs.

    total: all outputs.
    drawn: those that this run drew.
    copied: those that are a copy of an output of the same key.
    existing: those that an earlier run drew.
    failed: each with its error.
    warnings: each once.
    errors: what else could not be written, such as the results.
    busy: the time that jobs took, all workers together [s].
    """

    total: int
    drawn: int = 0
    copied: int = 0
    existing: int = 0
    failed: list[OutputRecord] = field(default_factory=list)
    warnings: dict[str, None] = field(default_factory=dict)
    errors: dict[str, None] = field(default_factory=dict)
    busy: float = 0.0

    @property
    def done(self) -> int:
        """Outputs that are there."""
        return self.drawn + self.copied + self.existing


OnEvent = Callable[[Progress], None]


def execute(
    jobs: Sequence[Job],
    store: Store,
    results: ResultsDB,
    spawn: Callable[[int], Executor],
    *,
    resume: bool = False,
    retries: RetryPolicy = RetryPolicy(),  # noqa: B008 - it is frozen
    on_event: OnEvent = lambda progress: None,
) -> Progress:
    """Make the outputs that are missing.

    spawn: makes the executor, given the number of jobs; it is not called when there are none.
    resume: what failed before stays failed; otherwise it is tried again.
    on_event: is called before the first job and after each.
    """
    progress = Progress(sum(len(job.outs) for job in jobs))
    pending = _pending(jobs, store, results, progress, resume)
    on_event(progress)
    # A worker that outlived its killed run may leave a partial file beside a finished one.
    outs = [out for job in jobs for out in job.outs]
    _remove_partial_files(store, outs)
    if pending:
        executor = spawn(len(pending))
        try:
            for result, tries in run_jobs(pending, executor, retries):
                _count(progress, result, tries)
                _record(results, result, tries, progress)
                on_event(progress)
        finally:
            executor.close()
            _remove_partial_files(store, outs)
    return progress


def _pending(
    jobs: Sequence[Job], store: Store, results: ResultsDB, progress: Progress, resume: bool
) -> list[Job]:
    """The jobs that are to be drawn; the others are counted, and copied where that is enough."""
    records = results.records()
    present = _intact(records, store)
    pending = []
    for job in jobs:
        missing = [out for out in job.outs if present.get(out) != job.key]
        before = [records[out] for out in job.outs if out in records]
        if not missing:
            progress.existing += len(job.outs)
        elif _copied(job, missing, store, results, present):
            progress.existing += len(job.outs) - len(missing)
            progress.copied += len(missing)
        elif resume and before and all(r.state == "failed" and r.key == job.key for r in before):
            progress.failed += before
        else:
            pending.append(job)
    return pending


def _intact(records: dict[str, OutputRecord], store: Store) -> dict[str, str]:
    """The keys of outputs that are done and still there in full length."""
    done = [record for record in records.values() if record.state == "done"]
    sizes = store.sizes([record.out for record in done])
    return {r.out: r.key for r, size in zip(done, sizes, strict=True) if size == r.size}


def _copied(
    job: Job, missing: list[str], store: Store, results: ResultsDB, present: dict[str, str]
) -> bool:
    """Whether another output has the same picture; then it is copied to those missing."""
    same = (r for r in results.done_with(job.key) if present.get(r.out) == job.key)
    source = next(same, None)
    if source is None:
        return False
    try:
        data = store.read(source.out)
        for out in missing:
            store.write(out, data)
        results.record_copy(job, source)
    except DraperyError:
        # Drawing it again says what is wrong.
        return False
    return True


def _count(progress: Progress, result: JobResult, tries: int) -> None:
    job = result.job
    progress.busy += result.seconds
    progress.warnings.update(dict.fromkeys(result.warnings))
    if result.error is None:
        progress.drawn += 1
        progress.copied += len(job.outs) - 1
        return
    progress.failed += [
        OutputRecord(out, job.key, place, "failed", result.error, tries, result.seconds, 0)
        for out, place in zip(job.outs, job.places, strict=True)
    ]


def _record(results: ResultsDB, result: JobResult, tries: int, progress: Progress) -> None:
    """Record a result. A full disk does not end the run: what is not recorded is drawn again by
    the next run."""
    try:
        results.record(result, tries)
    except OutputError as error:
        progress.errors[str(error)] = None


def _remove_partial_files(store: Store, outs: list[str]) -> None:
    if isinstance(store, LocalStore):
        store.remove_partial_files(outs)
