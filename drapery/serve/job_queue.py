"""Jobs taken from many requests at once: each is drawn once, by a pool that outlives its jobs."""

import threading
from collections.abc import Callable
from concurrent.futures import Future
from queue import Empty, Full, Queue
from typing import TypeAlias

from drapery.batch.executor import Executor
from drapery.batch.jobs import Job, JobResult

Answer: TypeAlias = Future[JobResult]


class BusyError(Exception):
    """More jobs wait than the queue takes."""


class JobQueue:
    """A thread that hands jobs to an executor.

    spawn: makes the executor, in that thread. most: how many may wait.
    on_result: hears of each result in that thread, before those who asked.
    """

    def __init__(
        self,
        spawn: Callable[[], Executor],
        most: int = 64,
        on_result: Callable[[JobResult], None] = lambda result: None,
    ) -> None:
        self._spawn, self._told = spawn, on_result
        self._waiting: Queue[Job] = Queue(most)
        self._answers: dict[str, Answer] = {}
        self._lock = threading.Lock()
        self._closing = threading.Event()
        self._thread = threading.Thread(target=self._live, name="drapery-queue", daemon=True)
        self._thread.start()

    def __len__(self) -> int:
        """How many jobs wait or are being drawn."""
        return len(self._answers)

    def ask(self, job: Job, made: Callable[[], bool] = lambda: False) -> Answer | None:
        """The result of a job, when it is there; equal jobs share one. Raises BusyError.

        made: whether the picture is there by now, so that nothing is to be done: None. What was
        on_result of a result holds when this is asked.
        """
        with self._lock:
            answer = self._answers.get(job.key)
            if answer is None:
                if made():
                    return None
                try:
                    self._waiting.put_nowait(job)
                except Full:
                    raise BusyError from None
                answer = self._answers[job.key] = Future()
            return answer

    def close(self) -> None:
        """End the executor; what waits is answered with a fault."""
        self._closing.set()
        self._thread.join()

    def _live(self) -> None:
        executor = self._spawn()
        running: dict[str, Job] = {}
        try:
            while not self._closing.is_set():
                self._begin(executor, running)
                for result in executor.poll(_patience(executor.free(), bool(running))):
                    running.pop(result.job.key, None)
                    self._told(result)
                    self._answer(result)
        except Exception as error:
            self._closing.set()
            self._give_up(f"the pool has ended: {error}")
            raise
        finally:
            executor.close()
            self._give_up("the service is closing")

    def _begin(self, executor: Executor, running: dict[str, Job]) -> None:
        while executor.free() > 0:
            try:
                job = self._waiting.get(block=not running, timeout=0.1)
            except Empty:
                return
            running[job.key] = job
            executor.start(job)

    def _answer(self, result: JobResult) -> None:
        with self._lock:
            answer = self._answers.pop(result.job.key, None)
        if answer is not None and answer.set_running_or_notify_cancel():
            answer.set_result(result)

    def _give_up(self, why: str) -> None:
        with self._lock:
            answers, self._answers = list(self._answers.values()), {}
        for answer in answers:
            if answer.set_running_or_notify_cancel():
                answer.set_exception(RuntimeError(why))


def _patience(free: int, running: bool) -> float:
    """How long to wait for a result [s]: short while a new job, which cannot wake this wait,
    could begin at once."""
    if not free:
        return 0.1
    return 0.005 if running else 0.0
