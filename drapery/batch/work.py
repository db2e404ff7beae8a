"""The loop that hands jobs to a crew, tries failed ones again, and loses none."""

import heapq
import time
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from itertools import count
from typing import Protocol

from drapery.batch.jobs import Job, Outcome

PATIENCE = 0.5
"""The longest wait for an outcome before the crew is looked after [s]."""


class Executor(Protocol):
    """Workers: processes here, or a cluster's."""

    def free(self) -> int:
        """How many more jobs it takes now."""

    def start(self, job: Job) -> None:
        """Begin a job."""

    def finished(self, patience: float) -> list[Outcome]:
        """What ended, waiting for the first up to so many seconds."""

    def close(self) -> None:
        """End all workers."""


@dataclass(frozen=True)
class Retries:
    """How failed jobs are tried again: so many times, after a pause [s] that doubles each time."""

    most: int = 2
    pause: float = 1.0

    def delay(self, tries: int) -> float:
        """The pause after so many tries [s]."""
        return min(60.0, self.pause * 2.0 ** (tries - 1))


def work_off(
    jobs: Iterable[Job], crew: Executor, retries: Retries
) -> Iterator[tuple[Outcome, int]]:
    """The final outcome of every job, with how often it was tried, as they come."""
    fresh, order = iter(jobs), count()
    later: list[tuple[float, int, Job]] = []
    tries: dict[str, int] = {}
    ahead = next(fresh, None)
    while ahead is not None or tries:
        while crew.free() > 0:
            if later and later[0][0] <= time.monotonic():
                job = heapq.heappop(later)[2]
            elif ahead is not None:
                job, ahead = ahead, next(fresh, None)
            else:
                break
            tries[job.key] = tries.get(job.key, 0) + 1
            crew.start(job)
        for outcome in crew.finished(_patience(later)):
            key = outcome.job.key
            if outcome.fault is not None and outcome.again and tries[key] <= retries.most:
                due = time.monotonic() + retries.delay(tries[key])
                heapq.heappush(later, (due, next(order), outcome.job))
            else:
                yield outcome, tries.pop(key)


def _patience(later: list[tuple[float, int, Job]]) -> float:
    if not later:
        return PATIENCE
    return min(PATIENCE, max(0.01, later[0][0] - time.monotonic()))
