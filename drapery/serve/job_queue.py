"""Jobs taken from many requests at once: each is drawn once, by a pool that outlives its jobs."""

import threading
from collections.abc import Callable
from concurrent.futures import Future
from queue import Empty, Full, Queue
from typing import TypeAlias

from drapery.batch.jobs import Job, Outcome
from drapery.batch.work import Executor

Answer: TypeAlias = Future[Outcome]


class BusyError(Exception):
    """More jobs wait than the desk takes."""


class JobQueue:
    """A thread that hands jobs to a crew.

    hire: makes the crew, in that thread. most: how many may wait.
    told: hears of each outcome in that thread, before those who asked.
    """

    def __init__(
        self,
        hire: Callable[[], Executor],
        most: int = 64,
        told: Callable[[Outcome], None] = lambda outcome: None,
    ) -> None:
        self._hire, self._told = hire, told
        self._waiting: Queue[Job] = Queue(most)
        self._answers: dict[str, Answer] = {}
        self._lock = threading.Lock()
        self._closing = threading.Event()
        self._thread = threading.Thread(target=self._live, name="drapery-desk", daemon=True)
        self._thread.start()

    def __len__(self) -> int:
        """How many jobs wait or are being drawn."""
        return len(self._answers)

    def ask(self, job: Job, made: Callable[[], bool] = lambda: False) -> Answer | None:
        """The outcome of a job, when it is there; equal jobs share one. Raises BusyError.

        made: whether the picture is there by now, so that nothing is to be done: None. What was
        told of an outcome holds when this is asked.
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
        """End the crew; what waits is answered with a fault."""
        self._closing.set()
        self._thread.join()

    def _live(self) -> None:
        crew = self._hire()
        running: dict[str, Job] = {}
        try:
            while not self._closing.is_set():
                self._begin(crew, running)
                for outcome in crew.finished(_patience(crew.free(), bool(running))):
                    running.pop(outcome.job.key, None)
                    self._told(outcome)
                    self._answer(outcome)
        except Exception as error:
            self._closing.set()
            self._give_up(f"the pool has ended: {error}")
            raise
        finally:
            crew.close()
            self._give_up("the service is closing")

    def _begin(self, crew: Executor, running: dict[str, Job]) -> None:
        while crew.free() > 0:
            try:
                job = self._waiting.get(block=not running, timeout=0.1)
            except Empty:
                return
            running[job.key] = job
            crew.start(job)

    def _answer(self, outcome: Outcome) -> None:
        with self._lock:
            answer = self._answers.pop(outcome.job.key, None)
        if answer is not None and answer.set_running_or_notify_cancel():
            answer.set_result(outcome)

    def _give_up(self, why: str) -> None:
        with self._lock:
            answers, self._answers = list(self._answers.values()), {}
        for answer in answers:
            if answer.set_running_or_notify_cancel():
                answer.set_exception(RuntimeError(why))


def _patience(free: int, running: bool) -> float:
    """How long to wait for an outcome [s]: short while a new job, which cannot wake this wait,
    could begin at once."""
    if not free:
        return 0.1
    return 0.005 if running else 0.0
