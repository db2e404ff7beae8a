"""Jobs that die, hang or eat memory fail with their reason; every other job is done, once."""

import os
import signal
from collections import Counter
from dataclasses import replace
from pathlib import Path

from batch_works import job, work
from hypothesis import given
from hypothesis import strategies as st

from drapery.batch.executor import RetryPolicy, run_jobs
from drapery.batch.jobs import Job, JobResult
from drapery.batch.pool import JobLimits, ProcessPool

SOON = RetryPolicy(most=2, pause=0.01)


class Scripted:
    """A executor without processes: each job fails as often as it says."""

    def __init__(self, fails: dict[str, int], hopeless: set[str], room: int) -> None:
        self.fails, self.hopeless, self.room = dict(fails), hopeless, room
        self.running: list[Job] = []
        self.began: Counter[str] = Counter()

    def free(self) -> int:
        return self.room - len(self.running)

    def start(self, one: Job) -> None:
        assert self.free() > 0
        self.began[one.key] += 1
        self.running.append(one)

    def poll(self, timeout: float) -> list[JobResult]:
        ended, self.running = self.running[:2], self.running[2:]
        return [self.result(one) for one in ended]

    def result(self, one: Job) -> JobResult:
        if self.fails[one.key] == 0:
            return JobResult(one)
        self.fails[one.key] -= 1
        return JobResult(one, "it fails", retryable=one.key not in self.hopeless)

    def close(self) -> None:
        pass


@given(st.lists(st.tuples(st.integers(0, 4), st.booleans()), max_size=12), st.integers(1, 3))
def test_every_job_ends_once_after_as_many_tries_as_it_needs(
    script: list[tuple[int, bool]], room: int
) -> None:
    fails = {str(n): count for n, (count, _) in enumerate(script)}
    hopeless = {str(n) for n, (_, never) in enumerate(script) if never}
    executor = Scripted(fails, hopeless, room)
    ended = list(run_jobs([job(name) for name in fails], executor, RetryPolicy(2, 1e-4)))
    assert Counter(result.job.key for result, _ in ended) == Counter(list(fails))
    for result, tries in ended:
        count, key = fails[result.job.key], result.job.key
        most = 1 if key in hopeless else 3
        assert tries == executor.began[key] == min(count + 1, most)
        assert (result.error is None) == (count < most)


def test_a_pool_outlives_what_its_jobs_do() -> None:
    names = ["die", "eat", "hang", "nibble", *(f"fine{n}" for n in range(6))]
    pool = ProcessPool(work, 2, JobLimits(seconds=1.5, memory=200 << 20), ahead=2)
    try:
        ended = dict(_ended(pool, names, RetryPolicy(0)))
    finally:
        pool.close()
    assert set(ended) == set(names)
    fine = {name for name, (fault, _) in ended.items() if fault is None}
    assert fine == {n for n in names if n.startswith("fine")}
    assert "its worker died" in ended["die"][0]
    assert "took over 1.5 s" in ended["hang"][0]
    assert all("more memory" in ended[name][0] for name in ("eat", "nibble"))


def test_a_worker_killed_from_outside_loses_no_job(tmp_path: Path) -> None:
    pool = ProcessPool(work, 2, JobLimits(), ahead=2)
    mark = str(tmp_path / "mark").replace("/", "!")
    names = [f"once-die@{mark}", *(f"fine{n}" for n in range(60))]
    try:
        ended = []
        for result, tries in run_jobs([job(name) for name in names], pool, SOON):
            ended.append((result.job.key, result.error, tries))
            if len(ended) in (15, 40):
                os.kill(pool.pids()[0], signal.SIGKILL)
    finally:
        pool.close()
    assert Counter(key for key, _, _ in ended) == Counter(names)
    assert all(fault is None and tries <= 3 for _, fault, tries in ended)
    assert {tries for key, _, tries in ended if key.startswith("once")} == {2}
    assert pool.pids() == []


def test_a_job_for_very_many_files_does_not_choke_the_pipes() -> None:
    outs = tuple(f"fine{n}.png" for n in range(20_000))
    long = [replace(job(f"fine{n}"), outs=outs, places=outs) for n in range(6)]
    pool = ProcessPool(work, 1, JobLimits(seconds=20), ahead=2)
    try:
        ended = list(run_jobs(long, pool, SOON))
    finally:
        pool.close()
    assert [result.error for result, _ in ended] == [None] * 6


def _ended(pool: ProcessPool, names: list[str], retries: RetryPolicy):
    for result, tries in run_jobs([job(name) for name in names], pool, retries):
        yield result.job.key, (result.error, tries)
