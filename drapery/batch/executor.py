"""The loop that gives jobs to an executor and tries failed ones again; no job is lost."""

import heapq
import time
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from itertools import count
from typing import Protocol

from drapery.batch.jobs import Job, JobResult

POLL_TIMEOUT = 0.5
"""The longest wait for a result before the executor's workers are checked [s]."""


class Executor(Protocol):
    """Workers that do jobs: processes of this machine, or a cluster's."""

    def free(self) -> int:
        """How many more jobs it accepts now."""

    def ready(self) -> bool:
        """Whether at least one worker is running and can do jobs."""

    def start(self, job: Job) -> None:
        """Begin a job. Call it only while `free` is above 0."""

    def poll(self, timeout: float) -> list[JobResult]:
        """The results that are ready; it waits for the first one for up to `timeout` [s]."""

    def close(self) -> None:
        """End all workers."""


@dataclass(frozen=True)
class RetryPolicy:
    """The number of retries, and the pauses before them, which double each time.

    limit: number of retries; math.inf for no limit. pause: the first [s]. longest: the longest [s].
    """

    limit: float = 2
    pause: float = 1.0
    longest: float = 60.0

    def delay(self, tries: int) -> float:
        """The pause after this number of tries [s]."""
        return min(self.longest, self.pause * 2.0 ** min(tries - 1, 64))


def run_jobs(
    jobs: Iterable[Job], executor: Executor, retries: RetryPolicy
) -> Iterator[tuple[JobResult, int]]:
    """The final result and the number of tries of every job, in the order in which they end."""
    fresh, order = iter(jobs), count()
    delayed: list[tuple[float, int, Job]] = []
    tries: dict[str, int] = {}
    upcoming = next(fresh, None)
    while upcoming is not None or tries:
        while executor.free() > 0:
            if delayed and delayed[0][0] <= time.monotonic():
                job = heapq.heappop(delayed)[2]
            elif upcoming is not None:
                job, upcoming = upcoming, next(fresh, None)
            else:
                break
            tries[job.key] = tries.get(job.key, 0) + 1
            executor.start(job)
        for result in executor.poll(_timeout(delayed)):
            key = result.job.key
            if result.error is not None and result.retryable and tries[key] <= retries.limit:
                due = time.monotonic() + retries.delay(tries[key])
                heapq.heappush(delayed, (due, next(order), result.job))
            else:
                yield result, tries.pop(key)


def _timeout(delayed: list[tuple[float, int, Job]]) -> float:
    if not delayed:
        return POLL_TIMEOUT
    return min(POLL_TIMEOUT, max(0.01, delayed[0][0] - time.monotonic()))
