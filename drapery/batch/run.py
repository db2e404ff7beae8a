"""A whole run: what is known is not done again, the rest is worked off, all is written down."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field

from drapery.batch.executor import Executor, RetryPolicy, run_jobs
from drapery.batch.jobs import Job, JobResult
from drapery.batch.results import OutputRecord, ResultsDB
from drapery.batch.stores import LocalStore, Store
from drapery.errors import DraperyError, OutputError


@dataclass
class Progress:
    """How far a run is. Counts of outputs, not of jobs.

    total: of all. drawn: made by this run. copied: of the same key as another. kept: there before.
    failed: each with its reason. notes: warnings, each once. busy: time that jobs took [s].
    """

    total: int
    drawn: int = 0
    copied: int = 0
    kept: int = 0
    failed: list[OutputRecord] = field(default_factory=list)
    notes: dict[str, None] = field(default_factory=dict)
    busy: float = 0.0

    @property
    def done(self) -> int:
        """Outputs that are there."""
        return self.drawn + self.copied + self.kept


def execute(
    jobs: Sequence[Job],
    store: Store,
    results: ResultsDB,
    spawn: Callable[[int], Executor],
    *,
    resume: bool = False,
    retries: RetryPolicy = RetryPolicy(),  # noqa: B008 - it is frozen
    on_event: Callable[[Progress], None] = lambda progress: None,
) -> Progress:
    """Do what is not done yet.

    spawn: makes the executor, once it is known that there is work for it, given the number of jobs.
    resume: what failed before stays failed; otherwise it is tried anew.
    on_event: is called after each result.
    """
    progress = Progress(sum(len(job.outs) for job in jobs))
    todo = _sift(jobs, store, results, progress, resume)
    on_event(progress)
    # A worker that outlived its killed run may leave something beside what is done, too.
    outs = [out for job in jobs for out in job.outs]
    _sweep(store, outs)
    if todo:
        executor = spawn(len(todo))
        try:
            for result, tries in run_jobs(todo, executor, retries):
                _count(progress, result, tries)
                _record(results, result, tries, progress)
                on_event(progress)
        finally:
            executor.close()
            _sweep(store, outs)
    return progress


def _sift(
    jobs: Sequence[Job], store: Store, results: ResultsDB, progress: Progress, resume: bool
) -> list[Job]:
    """The jobs that are to be drawn; the others are counted, copied where that is all."""
    known = results.known()
    there = _intact(known, store)
    todo = []
    for job in jobs:
        missing = [out for out in job.outs if there.get(out) != job.key]
        failed = [known[out] for out in job.outs if out in known]
        if not missing:
            progress.kept += len(job.outs)
        elif _copied(job, missing, store, results, there):
            progress.kept += len(job.outs) - len(missing)
            progress.copied += len(missing)
        elif resume and failed and all(e.state == "failed" and e.key == job.key for e in failed):
            progress.failed += failed
        else:
            todo.append(job)
    return todo


def _intact(known: dict[str, OutputRecord], store: Store) -> dict[str, str]:
    """The keys of outputs that are done and still there in full length."""
    done = [entry for entry in known.values() if entry.state == "done"]
    sizes = store.sizes([entry.out for entry in done])
    return {e.out: e.key for e, size in zip(done, sizes, strict=True) if size == e.size}


def _copied(
    job: Job, missing: list[str], store: Store, results: ResultsDB, there: dict[str, str]
) -> bool:
    """Whether another output has the same picture; then it is copied to those missing."""
    source = next((e for e in results.done_with(job.key) if there.get(e.out) == job.key), None)
    if source is None:
        return False
    try:
        data = store.read(source.out)
        for out in missing:
            store.write(out, data)
    except DraperyError:
        return False
    results.copied(job, source)
    return True


def _count(progress: Progress, result: JobResult, tries: int) -> None:
    job = result.job
    progress.busy += result.seconds
    progress.notes.update(dict.fromkeys(result.notes))
    if result.error is None:
        progress.drawn += 1
        progress.copied += len(job.outs) - 1
        return
    why = (result.error, tries, result.seconds, 0)
    progress.failed += [
        OutputRecord(out, job.key, place, "failed", *why)
        for out, place in zip(job.outs, job.places, strict=True)
    ]


def _record(results: ResultsDB, result: JobResult, tries: int, progress: Progress) -> None:
    """Write a result down. A full disk must not end the run: what is not written down is made
    again by the next."""
    try:
        results.record(result, tries)
    except OutputError as error:
        progress.notes[str(error)] = None


def _sweep(store: Store, outs: list[str]) -> None:
    if isinstance(store, LocalStore):
        store.sweep(outs)
