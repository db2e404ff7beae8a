"""The service's queue answers everyone who asks, whatever happens to its workers."""

import math
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from itertools import pairwise

import psutil
import pytest
from batch_works import job, work

from drapery.batch.executor import Executor, RetryPolicy
from drapery.batch.jobs import Job, JobResult
from drapery.batch.pool import JobLimits, ProcessPool
from drapery.serve.job_queue import BusyError, JobQueue, Unavailable

SOON = RetryPolicy(limit=math.inf, pause=0.05, longest=0.2)


class ManualExecutor:
    """Ends its jobs when the test says so."""

    def __init__(self) -> None:
        self.may_end, self.began, self.running = threading.Event(), [], []

    def free(self) -> int:
        return 2 - len(self.running)

    def ready(self) -> bool:
        return True

    def start(self, one: Job) -> None:
        self.began.append(one.key)
        self.running.append(one)

    def poll(self, timeout: float) -> list[JobResult]:
        self.may_end.wait(timeout)
        if not self.may_end.is_set():
            return []
        ended, self.running = self.running, []
        return [JobResult(one) for one in ended]

    def close(self) -> None:
        pass


@contextmanager
def queue_of(spawn: Callable[[], Executor], limit: int = 64) -> Iterator[JobQueue[JobResult]]:
    queue = JobQueue(spawn, lambda result: result, limit, SOON)
    try:
        yield queue
    finally:
        start = time.monotonic()
        queue.close()
        assert time.monotonic() - start < 30
        assert not queue.alive


def pool(restarts: RetryPolicy = SOON) -> ProcessPool:
    return ProcessPool(work, 2, JobLimits(30.0), restarts=restarts)


def test_equal_jobs_are_drawn_once_and_a_full_queue_says_so() -> None:
    executor = ManualExecutor()
    with queue_of(lambda: executor, 2) as queue:
        first = queue.ask(job("a"))
        assert queue.ask(job("a")) is first
        others = []
        with pytest.raises(BusyError):
            for number in range(10):
                others.append(queue.ask(job(str(number))))
        executor.may_end.set()
        keys = [answer.result(5).job.key for answer in (first, *others)]
        assert sorted(executor.began) == sorted(keys)
        assert len(set(keys)) == len(keys)
        assert len(queue) == 0


def test_a_known_answer_needs_no_worker() -> None:
    executor = ManualExecutor()
    known = JobResult(job("a"))
    with queue_of(lambda: executor) as queue:
        assert queue.ask(job("a"), lambda: known).result(0) is known
    assert executor.began == []


def test_queued_jobs_that_nobody_waits_for_are_dropped() -> None:
    executor = ManualExecutor()
    with queue_of(lambda: executor) as queue:
        answers = {name: queue.ask(job(name)) for name in "abcdef"}
        queue.ask(job("e"))
        _wait_until(lambda: len(executor.began) == 2)
        for name, answer in answers.items():
            queue.leave(job(name), answer)
        # a and b are being drawn; one client still waits for e.
        assert len(queue) == 3
        executor.may_end.set()
        assert answers["e"].result(5).error is None
        _wait_until(lambda: len(queue) == 0)
    assert executor.began == ["a", "b", "e"]


def test_one_who_leaves_late_takes_no_place_of_another() -> None:
    executor = ManualExecutor()
    executor.may_end.set()
    with queue_of(lambda: executor) as queue:
        old = queue.ask(job("a"))
        old.result(5)
        executor.may_end.clear()
        busy = [queue.ask(job(name)) for name in "xy"]
        _wait_until(lambda: len(executor.running) == 2)
        new = queue.ask(job("a"))
        queue.leave(job("a"), old)
        executor.may_end.set()
        assert new.result(5).job.key == "a"
        assert all(answer.result(5) for answer in busy)


def test_workers_killed_as_they_start_come_back_and_answer() -> None:
    pools: list[ProcessPool] = []

    def spawn() -> ProcessPool:
        pools.append(pool())
        return pools[-1]

    with queue_of(spawn) as queue:
        answer = queue.ask(job("fine"))
        killed = _kill_workers(pools, 3.0)
        assert not queue.ready and queue.alive
        assert len(killed) > 4
        assert answer.result(30).error is None
        assert queue.ready


def test_an_executor_that_gives_up_is_made_again() -> None:
    pools: list[ProcessPool] = []

    def spawn() -> ProcessPool:
        pools.append(pool(RetryPolicy(limit=1, pause=0.01)))
        return pools[-1]

    with queue_of(spawn) as queue:
        lost = queue.ask(job("fine"))
        _kill_workers(pools, 3.0)
        answer = lost.result(5)
        assert isinstance(answer, Unavailable)
        assert answer.reason == "the workers ended; ask again"
        assert queue.alive
        # The pool whose workers were killed last may still refuse a job.
        _wait_until(lambda: not isinstance(queue.ask(job("fine")).result(30), Unavailable))
    assert len(pools) > 2


def test_an_executor_that_cannot_be_made_is_tried_after_growing_pauses() -> None:
    moments: list[float] = []
    executor = ManualExecutor()
    executor.may_end.set()

    def spawn() -> Executor:
        moments.append(time.monotonic())
        if len(moments) < 5:
            raise OSError(11, "Resource temporarily unavailable")
        return executor

    with queue_of(spawn) as queue:
        _wait_until(lambda: len(moments) == 5)
        assert queue.ask(job("a")).result(5).error is None
    pauses = [later - before for before, later in pairwise(moments)]
    assert all(p >= least for p, least in zip(pauses, (0.05, 0.1, 0.2, 0.2), strict=True))


def test_a_result_that_cannot_be_read_is_an_answer_too() -> None:
    executor = ManualExecutor()
    executor.may_end.set()

    def fail(result: JobResult) -> JobResult:
        raise FileNotFoundError("gone")

    queue = JobQueue(lambda: executor, fail)
    try:
        assert isinstance(queue.ask(job("a")).result(5), Unavailable)
        assert queue.alive
    finally:
        queue.close()


def test_a_queue_that_closes_answers_all() -> None:
    with queue_of(ManualExecutor) as queue:
        answers = [queue.ask(job(str(number))) for number in range(5)]
    assert all(isinstance(answer.result(0), Unavailable) for answer in answers)
    assert isinstance(queue.ask(job("late")).result(0), Unavailable)


def _kill_workers(pools: list[ProcessPool], seconds: float) -> set[int]:
    """Kill every worker that starts within some time; which they were."""
    end, killed = time.monotonic() + seconds, set()
    while time.monotonic() < end:
        for pid in pools[-1].pids() if pools else []:
            if pid not in killed:
                killed.add(pid)
                with suppress(psutil.NoSuchProcess):
                    psutil.Process(pid).kill()
        time.sleep(0.005)
    return killed


def _wait_until(condition: Callable[[], bool]) -> None:
    end = time.monotonic() + 30
    while not condition():
        assert time.monotonic() < end
        time.sleep(0.005)
