"""Processes on this machine that may be killed, hang or eat memory without harm to the others."""

import contextlib
import os
import time
from collections import deque
from collections.abc import Callable
from dataclasses import dataclass, field
from multiprocessing import get_context
from multiprocessing.connection import Connection, wait
from multiprocessing.process import BaseProcess
from pathlib import Path

from drapery.batch import worker as worker_process
from drapery.batch.jobs import OUT_OF_MEMORY, Job, JobResult
from drapery.errors import BackendError

LOOK = 0.1
"""How often the workers' time and memory are looked at [s]."""
MAX_FAILED_STARTS = 10
"""Workers in a row that die before they report. Something outside may kill a few."""
MAX_AHEAD = 100
"""Outputs of a job that is sent while its worker is at another."""
PAGE = os.sysconf("SC_PAGE_SIZE") if hasattr(os, "sysconf") else 4096


@dataclass(frozen=True)
class JobLimits:
    """What one job may use: time [s], and memory beyond its worker's own [bytes]."""

    seconds: float = 300.0
    memory: int = 2 << 30


@dataclass
class _Worker:
    """One worker process. ready: it has reported. resting: its memory without a job [bytes].

    jobs: sent to it, of which it does the first; began: when it began that.
    """

    process: BaseProcess
    pipe: Connection
    ready: bool = False
    resting: int = 0
    jobs: deque[Job] = field(default_factory=deque)
    began: float = 0.0


@dataclass
class ProcessPool:
    """An executor of processes on this machine; see `executor.Executor`.

    work: what does a job, a function of a module. workers: how many processes.
    threads: of each; by default its share of the cores.
    ahead: jobs sent to a worker; with 2, the next is there when one ends.
    """

    work: Callable[[Job], JobResult]
    workers: int
    limits: JobLimits = JobLimits()
    threads: int | None = None
    ahead: int = 1
    _backlog: deque[Job] = field(default_factory=deque)
    _workers: list[_Worker] = field(default_factory=list)
    _failed_starts: int = 0
    _looked: float = 0.0

    def __post_init__(self) -> None:
        self._workers = [self._spawn() for _ in range(self.workers)]

    def free(self) -> int:
        """See `Executor`."""
        taken = len(self._backlog) + sum(len(worker.jobs) for worker in self._workers)
        return self.ahead * sum(worker.ready for worker in self._workers) - taken

    def start(self, job: Job) -> None:
        """See `Executor`."""
        self._backlog.append(job)
        self._deal()

    def _deal(self) -> None:
        """Send what waits to the workers that have least."""
        while self._backlog:
            worker = min(
                (
                    worker
                    for worker in self._workers
                    if worker.ready and len(worker.jobs) < self.ahead
                ),
                key=lambda worker: len(worker.jobs),
                default=None,
            )
            # A pipe holds little, so a long job must not be sent to one who is not reading.
            if worker is None or (worker.jobs and len(self._backlog[0].outs) > MAX_AHEAD):
                return
            if not worker.jobs:
                worker.began = time.monotonic()
            worker.jobs.append(self._backlog.popleft())
            # A dead worker shows at its pipe's end, in `poll`.
            with contextlib.suppress(OSError):
                worker.pipe.send(worker.jobs[-1])

    def poll(self, timeout: float) -> list[JobResult]:
        """See `Executor`. Raises BackendError where no worker starts."""
        end = time.monotonic() + timeout
        while True:
            left = max(0.0, min(LOOK, end - time.monotonic()))
            heard = wait([worker.pipe for worker in self._workers], left)
            listened = [worker for worker in self._workers if worker.pipe in heard]
            woke = any(not worker.ready for worker in listened)
            results = [o for worker in listened for o in self._hear(worker)]
            if time.monotonic() - self._looked >= LOOK:
                self._looked = time.monotonic()
                results += [o for worker in list(self._workers) for o in self._check(worker)]
            self._deal()
            if results or woke or time.monotonic() >= end:
                return results

    def pids(self) -> list[int]:
        """The workers' process ids."""
        return [worker.process.pid or 0 for worker in self._workers]

    def close(self) -> None:
        """See `Executor`."""
        for worker in self._workers:
            worker.process.kill()
        for worker in self._workers:
            worker.process.join()
            worker.pipe.close()
        self._workers = []

    def _spawn(self) -> _Worker:
        # A fresh interpreter: forking one that has threads is not safe.
        context = get_context("spawn")
        ours, theirs = context.Pipe()
        threads = self.threads or max(1, (os.cpu_count() or 1) // self.workers)
        process = context.Process(
            target=worker_process.live,
            args=(theirs, self.work, self.limits.memory, threads),
            name="drapery-worker",
            daemon=True,
        )
        process.start()
        theirs.close()
        return _Worker(process, ours)

    def _hear(self, worker: _Worker) -> list[JobResult]:
        try:
            said = worker.pipe.recv()
        except (EOFError, OSError):
            return self._lost(worker, "its worker died")
        if not worker.ready:
            worker.ready, worker.resting, self._failed_starts = True, said, 0
            return []
        if said is None:
            # What is left of a heap that was full is not trusted.
            return self._lost(worker, OUT_OF_MEMORY)
        worker.jobs.popleft()
        worker.began = time.monotonic()
        return [said]

    def _check(self, worker: _Worker) -> list[JobResult]:
        """End a worker whose job is over its limits."""
        if not worker.jobs or worker not in self._workers:
            return []
        if time.monotonic() - worker.began > self.limits.seconds:
            return self._lost(worker, f"it took over {self.limits.seconds:g} s; raise --timeout")
        if _resident(worker.process.pid) > worker.resting + self.limits.memory:
            return self._lost(worker, OUT_OF_MEMORY)
        return []

    def _lost(self, worker: _Worker, why: str) -> list[JobResult]:
        if not worker.ready:
            self._failed_starts += 1
            if self._failed_starts >= MAX_FAILED_STARTS:
                raise BackendError("workers die as they start; run the jobs with `drapery render`")
        took, pid = time.monotonic() - worker.began, worker.process.pid
        self._replace(worker)
        if not worker.jobs:
            return []
        first, *others = worker.jobs
        # It had not begun these.
        self._backlog.extendleft(reversed(others))
        return [JobResult(first, f"{why} (process {pid})", True, took)]

    def _replace(self, worker: _Worker) -> None:
        worker.process.kill()
        worker.process.join()
        worker.pipe.close()
        self._workers[self._workers.index(worker)] = self._spawn()


def _resident(pid: int | None) -> int:
    """A process's memory [bytes]; 0 where the system does not say."""
    try:
        return int(Path(f"/proc/{pid}/statm").read_text().split()[1]) * PAGE
    except (OSError, IndexError, ValueError):
        return 0
