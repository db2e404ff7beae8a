"""Worker processes on this machine. One that dies, hangs or lacks memory does not affect others."""

import contextlib
import os
import time
from collections import deque
from collections.abc import Callable
from dataclasses import dataclass, field
from multiprocessing import get_context
from multiprocessing.connection import wait
from multiprocessing.process import BaseProcess
from typing import Any, TypeAlias

from drapery.batch import worker as worker_process
from drapery.batch.executor import RetryPolicy
from drapery.batch.jobs import OUT_OF_MEMORY, Job, JobResult
from drapery.errors import BackendError
from drapery.user_files import reason

CHECK_INTERVAL = 0.1
"""How often the workers' time and memory are checked [s]."""
RESTARTS = RetryPolicy(limit=9, pause=0.1, longest=1.0)
"""How often a worker that ends before it is ready is started again; the system may kill some."""
MAX_COMPILING = 300.0
"""The longest time of a job for compiling kernels, once for each kernel and machine [s]."""
MAX_AHEAD = 100
"""The most outputs of a job that is sent to a worker that is busy with another."""

Pipe: TypeAlias = Any
"""multiprocessing's Connection, or its PipeConnection on Windows."""


@dataclass(frozen=True)
class JobLimits:
    """Limits of one job: time [s], and memory in addition to its worker's [bytes].

    The time for compiling kernels does not count, up to MAX_COMPILING: a worker that is ended while
    it compiles would have to begin anew, and so would the next.
    """

    seconds: float = 300.0
    memory: int = 2 << 30


@dataclass(eq=False)
class _Worker:
    """One worker process. ready: it has reported. resting: its memory without a job [bytes].

    jobs: sent to it; it runs the first. began: when it began that one. compiling: since when it
    compiles kernels; 0 if it does not. compiled: how long it did, for this job [s].
    """

    process: BaseProcess
    pipe: Pipe
    ready: bool = False
    resting: int = 0
    jobs: deque[Job] = field(default_factory=deque)
    began: float = 0.0
    compiling: float = 0.0
    compiled: float = 0.0

    def begin(self) -> None:
        """Count the time of a job from now on."""
        self.began, self.compiled = time.monotonic(), 0.0

    def report(self, state: worker_process.Compiling) -> None:
        """Note that the worker begins or ends to compile."""
        now = time.monotonic()
        if state is worker_process.Compiling.BEGINS:
            self.compiling = now
        elif self.compiling:
            self.compiled += now - self.compiling
            self.compiling = 0.0

    def seconds(self) -> float:
        """How long the job runs, less the time for compiling."""
        now = time.monotonic()
        compiled = self.compiled + (now - self.compiling if self.compiling else 0.0)
        return now - self.began - min(compiled, MAX_COMPILING)


@dataclass
class ProcessPool:
    """Worker processes on this machine; see `executor.Executor`.

    work: runs a job; a function of a module. workers: number of processes.
    threads: of each worker; None divides the cores among the workers.
    ahead: jobs sent to a worker; with 2, the next job is already there when one ends.
    restarts: how often, and after which pause, workers that end before they are ready are started
        again; the count is reset when a worker is ready.
    """

    work: Callable[[Job], JobResult]
    workers: int
    limits: JobLimits = JobLimits()
    threads: int | None = None
    ahead: int = 1
    restarts: RetryPolicy = RESTARTS
    _backlog: deque[Job] = field(default_factory=deque)
    _workers: list[_Worker] = field(default_factory=list)
    _due: list[float] = field(default_factory=list)
    _failed_starts: int = 0
    _checked: float = 0.0

    def __post_init__(self) -> None:
        self._due = [0.0] * self.workers
        self._spawn_due()

    def free(self) -> int:
        """See `Executor`."""
        taken = len(self._backlog) + sum(len(worker.jobs) for worker in self._workers)
        return self.ahead * sum(worker.ready for worker in self._workers) - taken

    def ready(self) -> bool:
        """See `Executor`."""
        return any(worker.ready for worker in self._workers)

    def start(self, job: Job) -> None:
        """See `Executor`."""
        self._backlog.append(job)
        self._assign()

    def _assign(self) -> None:
        """Send waiting jobs to the workers that have the fewest."""
        while self._backlog:
            able = (w for w in self._workers if w.ready and len(w.jobs) < self.ahead)
            worker = min(able, key=lambda worker: len(worker.jobs), default=None)
            # A pipe has a small buffer, so a long job must not be sent to a worker that is busy.
            if worker is None or (worker.jobs and len(self._backlog[0].outs) > MAX_AHEAD):
                return
            if not worker.jobs:
                worker.begin()
            worker.jobs.append(self._backlog.popleft())
            with contextlib.suppress(OSError):  # `poll` finds a dead worker by the end of its pipe
                worker.pipe.send(worker.jobs[-1])

    def poll(self, timeout: float) -> list[JobResult]:
        """See `Executor`. Raises BackendError if workers cannot start."""
        end = time.monotonic() + timeout
        while True:
            self._spawn_due()
            left = max(0.0, min(CHECK_INTERVAL, end - time.monotonic()))
            readable = self._readable(left)
            starting = any(not worker.ready for worker in readable)
            results = [result for worker in readable for result in self._receive(worker)]
            if time.monotonic() - self._checked >= CHECK_INTERVAL:
                self._checked = time.monotonic()
                results += [r for worker in list(self._workers) for r in self._check(worker)]
            self._assign()
            if results or starting or time.monotonic() >= end:
                return results

    def _readable(self, timeout: float) -> list[_Worker]:
        """The workers that have sent something, or have ended."""
        if not self._workers:
            time.sleep(timeout)
        pipes = wait([worker.pipe for worker in self._workers], timeout)
        return [worker for worker in self._workers if worker.pipe in pipes]

    def pids(self) -> list[int]:
        """The workers' process ids."""
        return [worker.process.pid or 0 for worker in self._workers]

    def close(self) -> None:
        """See `Executor`."""
        for worker in self._workers:
            worker.process.kill()
        for worker in list(self._workers):
            self._remove(worker)
        self._due = []

    def _spawn_due(self) -> None:
        """Start missing workers whose pause is over."""
        now = time.monotonic()
        due = [moment for moment in self._due if moment <= now]
        for moment in due:
            self._due.remove(moment)
            try:
                self._workers.append(self._spawn())
            except OSError as error:
                self._start_failed(reason(error))

    def _spawn(self) -> _Worker:
        # A new interpreter: a fork of a process with threads is not safe.
        context = get_context("spawn")
        ours, theirs = context.Pipe()
        threads = self.threads or max(1, (os.cpu_count() or 1) // self.workers)
        process = context.Process(
            target=worker_process.run,
            args=(theirs, self.work, self.limits.memory, threads),
            name="drapery-worker",
            daemon=True,
        )
        try:
            process.start()
        except OSError:
            ours.close()
            raise
        finally:
            theirs.close()
        return _Worker(process, ours)

    def _receive(self, worker: _Worker) -> list[JobResult]:
        try:
            message = worker.pipe.recv()
        except (EOFError, OSError):  # a worker that dies closes its pipe
            return self._lost(worker, "its worker died")
        if not worker.ready:
            worker.ready, worker.resting, self._failed_starts = True, message, 0
            return []
        if message is None:
            # A worker that ran out of memory is not used again.
            return self._lost(worker, OUT_OF_MEMORY)
        if isinstance(message, worker_process.Compiling):
            worker.report(message)
            return []
        worker.jobs.popleft()
        worker.begin()
        return [message]

    def _check(self, worker: _Worker) -> list[JobResult]:
        """End a worker whose job exceeds its limits."""
        if not worker.jobs:
            return []
        if worker.seconds() > self.limits.seconds:
            reason = f"it took over {self.limits.seconds:g} s; raise --timeout"
            return self._lost(worker, reason, timed_out=True)
        if _resident(worker.process.pid) > worker.resting + self.limits.memory:
            return self._lost(worker, OUT_OF_MEMORY)
        return []

    def _lost(self, worker: _Worker, reason: str, timed_out: bool = False) -> list[JobResult]:
        """Replace a worker that has ended or must be ended; its job fails."""
        pid = worker.process.pid
        self._remove(worker)
        if worker.ready:
            self._due.append(0.0)
        else:
            self._start_failed(_ending(worker.process.exitcode))
        if not worker.jobs:
            return []
        first, *others = worker.jobs
        # The worker had not begun these jobs.
        self._backlog.extendleft(reversed(others))
        seconds = time.monotonic() - worker.began
        line = f"{reason} (process {pid})"
        return [JobResult(first, line, True, seconds, timed_out=timed_out)]

    def _start_failed(self, reason: str) -> None:
        self._failed_starts += 1
        if self._failed_starts > self.restarts.limit:
            raise BackendError(
                f"{self._failed_starts} workers in a row ended as they started ({reason}); a script"
                ' must start a batch below `if __name__ == "__main__":`; else see `drapery doctor`'
            )
        self._due.append(time.monotonic() + self.restarts.delay(self._failed_starts))

    def _remove(self, worker: _Worker) -> None:
        worker.process.kill()
        worker.process.join()
        worker.pipe.close()
        self._workers.remove(worker)


def _ending(code: int | None) -> str:
    return f"killed by signal {-code}" if code is not None and code < 0 else f"exit code {code}"


def _resident(pid: int | None) -> int:
    """A process's memory [bytes]; 0 if the system does not report it."""
    return worker_process.memory_of(pid, worker_process.RESIDENT)


def warm_up(*, stills: bool = True, loops: bool = True) -> None:
    """Fill numba's cache before workers start: draw tiny pictures of the sorts that they draw."""
    from drapery import Banner, animate, draw

    if stills:
        draw(Banner(), size=(8, 8), time=0.05)
    if loops:
        animate(Banner(), size=(8, 8), seconds=0.1, fps=10)
