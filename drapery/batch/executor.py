"""The loop that hands jobs to an executor, tries failed ones again, and loses none."""

import heapq
import time
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from itertools import count
from typing import Protocol

from drapery.batch.jobs import Job, JobResult

PATIENCE = 0.5
"""The longest wait for a result before the executor is looked after [s]."""


class Executor(Protocol):
    """Workers: processes here, or a cluster's."""

    def free(self) -> int:
        """How many more jobs it takes now."""

    def start(self, job: Job) -> None:
        """Begin a job."""

    def poll(self, timeout: float) -> list[JobResult]:
        """What ended, waiting for the first up to so many seconds."""

    def close(self) -> None:
        """End all workers."""


@dataclass(frozen=True)
class RetryPolicy:
    """How failed jobs are tried again: so many times, after a pause [s] that doubles each time."""

    most: int = 2
    pause: float = 1.0

    def delay(self, tries: int) -> float:
        """The pause after so many tries [s]."""
        return min(60.0, self.pause * 2.0 ** (tries - 1))


def run_jobs(
    jobs: Iterable[Job], executor: Executor, retries: RetryPolicy
) -> Iterator[tuple[JobResult, int]]:
    """The final result of every job, with how often it was tried, as they come."""
    fresh, order = iter(jobs), count()
    later: list[tuple[float, int, Job]] = []
    tries: dict[str, int] = {}
    ahead = next(fresh, None)
    while ahead is not None or tries:
        while executor.free() > 0:
            if later and later[0][0] <= time.monotonic():
                job = heapq.heappop(later)[2]
            elif ahead is not None:
                job, ahead = ahead, next(fresh, None)
            else:
                break
            tries[job.key] = tries.get(job.key, 0) + 1
            executor.start(job)
        for result in executor.poll(_patience(later)):
            key = result.job.key
            if result.error is not None and result.retryable and tries[key] <= retries.most:
                due = time.monotonic() + retries.delay(tries[key])
                heapq.heappush(later, (due, next(order), result.job))
            else:
                yield result, tries.pop(key)


def _patience(later: list[tuple[float, int, Job]]) -> float:
    if not later:
        return PATIENCE
    return min(PATIENCE, max(0.01, later[0][0] - time.monotonic()))
