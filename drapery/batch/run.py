"""A whole run: what is known is not done again, the rest is worked off, all is written down."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field

from drapery.batch.jobs import Job, Outcome
from drapery.batch.results import Entry, ResultsDB
from drapery.batch.stores import LocalStore, Store
from drapery.batch.work import Executor, Retries, work_off
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
    failed: list[Entry] = field(default_factory=list)
    notes: dict[str, None] = field(default_factory=dict)
    busy: float = 0.0

    @property
    def done(self) -> int:
        """Outputs that are there."""
        return self.drawn + self.copied + self.kept


def execute(
    jobs: Sequence[Job],
    store: Store,
    ledger: ResultsDB,
    hire: Callable[[int], Executor],
    *,
    resume: bool = False,
    retries: Retries = Retries(),  # noqa: B008 - it is frozen
    tell: Callable[[Progress], None] = lambda tally: None,
) -> Progress:
    """Do what is not done yet.

    hire: makes the crew, once it is known that there is work for it, given the number of jobs.
    resume: what failed before stays failed; otherwise it is tried anew.
    tell: is called after each outcome.
    """
    tally = Progress(sum(len(job.outs) for job in jobs))
    todo = _sift(jobs, store, ledger, tally, resume)
    tell(tally)
    # A worker that outlived its killed run may leave something beside what is done, too.
    outs = [out for job in jobs for out in job.outs]
    _sweep(store, outs)
    if todo:
        crew = hire(len(todo))
        try:
            for outcome, tries in work_off(todo, crew, retries):
                _count(tally, outcome, tries)
                _record(ledger, outcome, tries, tally)
                tell(tally)
        finally:
            crew.close()
            _sweep(store, outs)
    return tally


def _sift(
    jobs: Sequence[Job], store: Store, ledger: ResultsDB, tally: Progress, resume: bool
) -> list[Job]:
    """The jobs that are to be drawn; the others are counted, copied where that is all."""
    known = ledger.known()
    there = _intact(known, store)
    todo = []
    for job in jobs:
        missing = [out for out in job.outs if there.get(out) != job.key]
        failed = [known[out] for out in job.outs if out in known]
        if not missing:
            tally.kept += len(job.outs)
        elif _copied(job, missing, store, ledger, there):
            tally.kept += len(job.outs) - len(missing)
            tally.copied += len(missing)
        elif resume and failed and all(e.state == "failed" and e.key == job.key for e in failed):
            tally.failed += failed
        else:
            todo.append(job)
    return todo


def _intact(known: dict[str, Entry], store: Store) -> dict[str, str]:
    """The keys of outputs that are done and still there in full length."""
    done = [entry for entry in known.values() if entry.state == "done"]
    sizes = store.sizes([entry.out for entry in done])
    return {e.out: e.key for e, size in zip(done, sizes, strict=True) if size == e.size}


def _copied(
    job: Job, missing: list[str], store: Store, ledger: ResultsDB, there: dict[str, str]
) -> bool:
    """Whether another output has the same picture; then it is copied to those missing."""
    source = next((e for e in ledger.done_with(job.key) if there.get(e.out) == job.key), None)
    if source is None:
        return False
    try:
        data = store.read(source.out)
        for out in missing:
            store.write(out, data)
    except DraperyError:
        return False
    ledger.copied(job, source)
    return True


def _count(tally: Progress, outcome: Outcome, tries: int) -> None:
    job = outcome.job
    tally.busy += outcome.seconds
    tally.notes.update(dict.fromkeys(outcome.notes))
    if outcome.fault is None:
        tally.drawn += 1
        tally.copied += len(job.outs) - 1
        return
    why = (outcome.fault, tries, outcome.seconds, 0)
    tally.failed += [
        Entry(out, job.key, place, "failed", *why)
        for out, place in zip(job.outs, job.places, strict=True)
    ]


def _record(ledger: ResultsDB, outcome: Outcome, tries: int, tally: Progress) -> None:
    """Write an outcome down. A full disk must not end the run: what is not written down is made
    again by the next."""
    try:
        ledger.record(outcome, tries)
    except OutputError as error:
        tally.notes[str(error)] = None


def _sweep(store: Store, outs: list[str]) -> None:
    if isinstance(store, LocalStore):
        store.sweep(outs)
