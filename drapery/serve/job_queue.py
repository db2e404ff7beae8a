"""A queue for the jobs of many requests: permanent workers draw equal jobs only once."""

import logging
import math
import threading
from collections.abc import Callable
from concurrent.futures import Future
from dataclasses import dataclass, field
from typing import Generic, TypeAlias, TypeVar

from drapery.batch.executor import Executor, RetryPolicy
from drapery.batch.jobs import Job, JobResult

T = TypeVar("T")
RESTARTS = RetryPolicy(limit=math.inf, pause=0.5, longest=30.0)
"""A failed executor is replaced after growing pauses, without a limit."""
CLOSE_TIMEOUT = 3.0
"""How long `close` waits for the thread [s]."""


class BusyError(Exception):
    """The queue is full."""


@dataclass(frozen=True)
class Unavailable:
    """The answer if no worker could do the job. reason: a line for the log."""

    reason: str


Answer: TypeAlias = Future[T | Unavailable]


@dataclass
class _Pending(Generic[T]):
    """A queued or running job. waiters: the number of requests that wait for it."""

    job: Job
    answer: Answer[T] = field(default_factory=Future)
    waiters: int = 0


class JobQueue(Generic[T]):
    """A thread that gives jobs to an executor, and makes a new one when it fails."""

    def __init__(
        self,
        spawn: Callable[[], Executor],
        finish: Callable[[JobResult], T],
        limit: int = 64,
        restarts: RetryPolicy = RESTARTS,
    ) -> None:
        """Start the thread.

        spawn: makes the executor. finish: converts a result to an answer. The thread calls both.
        limit: the most queued jobs.
        """
        self._spawn, self._finish, self._limit = spawn, finish, limit
        self._restarts = restarts
        self._pending: dict[str, _Pending[T]] = {}
        self._queued: dict[str, None] = {}
        self._changed = threading.Condition()
        self._closing = threading.Event()
        self._ready = False
        self._failures = 0
        self._thread = threading.Thread(target=self._run, name="drapery-queue", daemon=True)
        self._thread.start()

    def __len__(self) -> int:
        """The number of jobs that are queued or running."""
        return len(self._pending)

    @property
    def ready(self) -> bool:
        """Whether a worker can do jobs."""
        return self._ready and self.alive

    @property
    def alive(self) -> bool:
        """Whether the thread runs."""
        return self._thread.is_alive()

    def ask(self, job: Job, known: Callable[[], T | None] = lambda: None) -> Answer[T]:
        """The answer to a job; equal jobs share one answer. Raises BusyError if the queue is full.

        known: returns the answer if it exists already; it is called after `finish` has returned.
        Call `leave` once after each call of `ask`.
        """
        with self._changed:
            pending = self._pending.get(job.key)
            if pending is None:
                value = known()
                if value is not None or self._closing.is_set():
                    answer: Answer[T] = Future()
                    answer.set_result(Unavailable("closing") if value is None else value)
                    return answer
                if len(self._queued) >= self._limit:
                    raise BusyError
                pending = self._pending[job.key] = _Pending(job)
                self._queued[job.key] = None
                self._changed.notify()
            pending.waiters += 1
            return pending.answer

    def leave(self, job: Job, answer: Answer[T]) -> None:
        """End the wait of one request; removes a queued job if no other request waits for it."""
        with self._changed:
            pending = self._pending.get(job.key)
            if pending is None or pending.answer is not answer:
                return
            pending.waiters -= 1
            if pending.waiters <= 0 and job.key in self._queued:
                del self._queued[job.key], self._pending[job.key]

    def close(self) -> None:
        """End the workers; requests that still wait get `Unavailable`."""
        self._closing.set()
        self._thread.join(CLOSE_TIMEOUT)

    def _run(self) -> None:
        while not self._closing.is_set():
            try:
                self._work()
            except Exception as error:
                self._failures += 1
                pause = self._restarts.delay(self._failures)
                logging.getLogger(__name__).warning(
                    "the workers ended (%s); they are started again in %.1f s", error, pause
                )
                self._give_up("the workers ended; ask again")
                self._closing.wait(pause)
        self._give_up("the service is closing")

    def _work(self) -> None:
        """Give jobs to one executor until the queue closes or the executor raises."""
        executor = self._spawn()
        running: set[str] = set()
        try:
            while not self._closing.is_set():
                self._ready = executor.ready()
                self._begin(executor, running)
                for result in executor.poll(_timeout(executor.free(), bool(running))):
                    running.discard(result.job.key)
                    self._failures = 0
                    self._answer(result)
        finally:
            self._ready = False
            executor.close()

    def _begin(self, executor: Executor, running: set[str]) -> None:
        while executor.free() > 0:
            with self._changed:
                if not self._queued and not running:
                    self._changed.wait(0.1)
                if not self._queued:
                    return
                key = next(iter(self._queued))
                del self._queued[key]
                job = self._pending[key].job
            running.add(key)
            executor.start(job)

    def _answer(self, result: JobResult) -> None:
        value: T | Unavailable
        try:
            value = self._finish(result)
        except Exception:
            logging.getLogger(__name__).exception("a result is lost")
            value = Unavailable("the result is lost; ask again")
        with self._changed:
            pending = self._pending.pop(result.job.key, None)
        if pending is not None:
            pending.answer.set_result(value)

    def _give_up(self, reason: str) -> None:
        with self._changed:
            lost, self._pending = list(self._pending.values()), {}
            self._queued.clear()
        for pending in lost:
            pending.answer.set_result(Unavailable(reason))


def _timeout(free: int, running: bool) -> float:
    """How long to wait for a result [s].

    The wait is short while a worker is free, because the arrival of a new job does not end it.
    """
    if not free:
        return 0.1
    return 0.005 if running else 0.0
