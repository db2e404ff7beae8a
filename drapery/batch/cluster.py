"""Jobs as tasks of Dask distributed on many machines (extra `cluster`)."""

import logging
import threading
import time
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import partial
from multiprocessing import current_process
from pathlib import Path
from queue import Empty, SimpleQueue
from typing import Any

from drapery.batch.artifacts import Artifact, bundle, paths_of, resolved
from drapery.batch.jobs import OUT_OF_MEMORY, Job, JobResult, run_job
from drapery.batch.keys import DigestCache, code_version
from drapery.batch.pool import JobLimits, ProcessPool
from drapery.batch.stores import Store
from drapery.errors import BackendError, DraperyError

AHEAD = 2
"""Tasks sent for each of the cluster's threads: one that runs and one that waits. With few tasks in
flight a killed run has little to repeat, and the scheduler's memory does not grow."""
TASK_SECONDS = 0.25
"""Intended duration of a task [s]. A scheduler handles about a thousand tasks a second, so several
short jobs are put into one task; see benchmarks/batch.py."""
MAX_IN_TASK = 32
COUNT_INTERVAL = 3.0
"""How often the cluster's threads are counted, since workers come and go [s]."""
LOST_AFTER = 15.0
"""How long the scheduler may be silent [s]."""


class LostError(BackendError):
    """The cluster's scheduler ended while jobs were running."""


@dataclass
class DaskExecutor:
    """The workers of a cluster; see `executor.Executor`.

    cluster: closed with it, or None.
    threads: of all its workers, when they were last counted.
    counted: when that was, by the monotonic clock [s].
    pace: mean duration of the last jobs [s].
    """

    client: Any
    store: Store
    limits: JobLimits
    cluster: Any = None
    _running: dict[str, tuple[Any, list[Job]]] = field(default_factory=dict)
    _ended: SimpleQueue[str] = field(default_factory=SimpleQueue)
    _sent: dict[Path, Any] = field(default_factory=dict)
    _digests: DigestCache = field(default_factory=DigestCache)
    _gathered: list[Job] = field(default_factory=list)
    _number: int = 0
    threads: int = 0
    counted: float = -COUNT_INTERVAL
    _heard: float = 0.0
    pace: float = TASK_SECONDS

    def free(self) -> int:
        """See `Executor`."""
        if time.monotonic() - self.counted > COUNT_INTERVAL:
            self._count()
        busy = sum(len(jobs) for _, jobs in self._running.values()) + len(self._gathered)
        return AHEAD * max(1, self.threads) * self._in_task() - busy

    def ready(self) -> bool:
        """See `Executor`."""
        return self.threads > 0

    def start(self, job: Job) -> None:
        """See `Executor`. Jobs are sent in groups, at the latest when `poll` is called."""
        self._gathered.append(job)
        if len(self._gathered) >= self._in_task():
            self._submit()

    def poll(self, timeout: float) -> list[JobResult]:
        """See `Executor`. Raises LostError if the scheduler has ended."""
        self._submit()
        self._check_scheduler()
        try:
            keys = [self._ended.get(timeout=timeout)]
            while not self._ended.empty():
                keys.append(self._ended.get())
        except Empty:
            return []
        results = []
        for future, jobs in map(self._running.pop, keys):
            received = _results_of(future)
            if received is None:
                # A worker that ended may have had the only copy of an artifact.
                self._sent.clear()
            results += received or _lost(future, jobs)
        for result in results:
            self.pace += 0.1 * (result.seconds - self.pace)
        return results

    def _in_task(self) -> int:
        """The number of jobs in a task, from the duration of the last jobs."""
        return max(1, min(MAX_IN_TASK, round(TASK_SECONDS / max(self.pace, 1e-3))))

    def _submit(self) -> None:
        """Send the gathered jobs as one task."""
        jobs, self._gathered = self._gathered, []
        if not jobs:
            return
        self._number += 1
        key = f"drapery-{self._number}-{jobs[0].key[:12]}"
        try:
            needed = {str(path): self._send(path) for job in jobs for path in paths_of(job)}
        except DraperyError as error:
            self._running[key] = ([JobResult(job, str(error), True) for job in jobs], jobs)
            self._ended.put(key)
            return
        future = self.client.submit(
            task, jobs, self.store, self.limits, needed, key=key, pure=False, retries=0
        )
        self._running[key] = (future, jobs)
        future.add_done_callback(lambda _: self._ended.put(key))

    def close(self) -> None:
        """See `Executor`."""
        for end in (self.client, self.cluster):
            if end is not None:
                try:
                    end.close(timeout=5)
                except Exception as error:
                    # The scheduler was killed or is ending; the results are already recorded.
                    logging.getLogger(__name__).debug("closing: %s", error)

    def _count(self) -> None:
        self.counted = time.monotonic()
        try:
            self.threads = sum(self.client.nthreads().values())
        except Exception as error:
            # Asked again soon; `poll` reports when the scheduler has ended.
            logging.getLogger(__name__).debug("the threads cannot be counted: %s", error)
            self.threads = 0

    def _check_scheduler(self) -> None:
        now = time.monotonic()
        if self.client.status == "running" or not self._heard:
            self._heard = now
        if self.client.status == "closed" or now - self._heard > LOST_AFTER:
            raise LostError(
                "the cluster's scheduler has ended; start it again and continue with --resume"
            )

    def _send(self, path: Path) -> Any:
        """The artifact's future; each worker fetches it once, from another worker."""
        if path not in self._sent:
            artifact = bundle(path, self._digests)
            # Not broadcast, so that workers that join later can also fetch it.
            self._sent[path] = self.client.scatter(artifact, hash=True)
        return self._sent[path]


def task(
    jobs: Sequence[Job], store: Store, limits: JobLimits, artifacts: Mapping[str, Artifact]
) -> list[JobResult]:
    """Jobs on a worker, one after the other. artifacts: packs and textures by their paths."""
    return [_one(job, store, limits, artifacts) for job in jobs]


def _one(job: Job, store: Store, limits: JobLimits, artifacts: Mapping[str, Artifact]) -> JobResult:
    if job.version != code_version():
        error = (
            f"the worker runs drapery {code_version()}, the job is of {job.version};"
            " install the same everywhere"
        )
        return JobResult(job, error)
    try:
        here = resolved(job, tuple(artifacts[str(path)] for path in paths_of(job)))
    except DraperyError as reason:
        return JobResult(job, str(reason), True)
    try:
        result = run_job(here, store) if _must_stay(store) else _guarded(here, store, limits)
    except MemoryError:
        return JobResult(job, OUT_OF_MEMORY, True)
    fault = None if result.error is None else _named(result.error, job, here)
    noted = tuple(_named(warning, job, here) for warning in result.warnings)
    return replace(result, job=job, error=fault, warnings=noted)


def _named(text: str, job: Job, here: Job) -> str:
    """A text of a worker with the paths that a job gives to files, in place of the worker's."""
    for its, given in zip(paths_of(here), paths_of(job), strict=True):
        text = text.replace(str(its), str(given))
    return text


def local_cluster(workers: int, store: Store, limits: JobLimits) -> DaskExecutor:
    """A cluster of processes on this machine. Raises BackendError if Dask is missing."""
    distributed = _distributed()
    import dask

    # Each worker runs jobs in a separate process, so that one which hangs can be ended.
    dask.config.set({"distributed.worker.daemon": False})
    cluster = distributed.LocalCluster(
        n_workers=workers,
        threads_per_worker=1,
        processes=True,
        dashboard_address=None,
        silence_logs=logging.CRITICAL,
    )
    return DaskExecutor(distributed.Client(cluster), store, limits, cluster)


def connect(address: str, store: Store, limits: JobLimits) -> DaskExecutor:
    """The cluster of a scheduler. Raises BackendError if there is no scheduler."""
    distributed = _distributed()
    client = distributed.Client.__new__(distributed.Client)
    try:
        client.__init__(address, timeout=15)
        return DaskExecutor(client, store, limits)
    except Exception as error:
        # A client that did not start closes itself as garbage, at any moment: while the next one
        # starts, that waits for ever for the lock that the start holds.
        client.__del__()
        # Dask's protocols raise different errors: TypeError for tls:// without certificates.
        name = type(error).__name__
        raise BackendError(f"no scheduler at {address} ({name}); check the address") from None


def _distributed() -> Any:
    try:
        import distributed
    except ImportError:
        raise BackendError('Dask is missing; pip install "drapery-mc[cluster]"') from None
    return distributed


def _results_of(future: Any) -> list[JobResult] | None:
    """The results of a task; None if it failed or its worker was lost."""
    if isinstance(future, list):
        return future
    if future.status != "finished":
        return None
    try:
        results: list[JobResult] = future.result()
    except Exception as error:  # Dask reports lost results by several errors
        logging.getLogger(__name__).debug("results are lost: %s", error)
        return None
    return results


def _lost(future: Any, jobs: Sequence[Job]) -> list[JobResult]:
    error = future.exception() if future.status == "error" else None
    reason = " ".join(str(error or "the cluster lost it").split())[:200]
    return [JobResult(job, f"{reason}; see the cluster's log", True) for job in jobs]


def _must_stay(store: Store) -> bool:
    """Whether jobs run in the worker itself, under the limits of its nanny only.

    A daemonic worker may not start processes, and `memory://` exists in one process.
    """
    return current_process().daemon or store.label.startswith("memory://")


_thread = threading.local()


def _guarded(job: Job, store: Store, limits: JobLimits) -> JobResult:
    """Do a job in a process of this thread, which may be killed."""
    if getattr(_thread, "limits", None) != (store, limits):
        if hasattr(_thread, "pool"):
            _thread.pool.close()
        _thread.pool, _thread.limits = (
            ProcessPool(partial(run_job, store=store), 1, limits, threads=1),
            (store, limits),
        )
    pool: ProcessPool = _thread.pool
    while pool.free() < 1:
        pool.poll(1.0)
    pool.start(job)
    while True:
        for result in pool.poll(1.0):
            return result
