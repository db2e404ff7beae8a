"""Jobs that die, hang or eat memory fail with their reason; every other job is done, once."""

import math
import os
import time
from collections import Counter
from dataclasses import replace
from itertools import pairwise
from multiprocessing.context import SpawnProcess
from pathlib import Path

import psutil
import pytest
from batch_works import job, work
from hypothesis import given, strategies as st

from drapery.batch import worker
from drapery.batch.executor import RetryPolicy, run_jobs
from drapery.batch.jobs import Job, JobResult
from drapery.batch.pool import JobLimits, ProcessPool
from drapery.errors import BackendError

pytestmark = pytest.mark.usefixtures("untraced_processes")

SOON = RetryPolicy(limit=2, pause=0.01)


class Scripted:
    """A executor without processes: each job fails as often as it says."""

    def __init__(self, fails: dict[str, int], hopeless: set[str], room: int) -> None:
        self.fails, self.hopeless, self.room = dict(fails), hopeless, room
        self.running: list[Job] = []
        self.began: Counter[str] = Counter()

    def free(self) -> int:
        return self.room - len(self.running)

    def ready(self) -> bool:
        return True

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
    pool = ProcessPool(work, 2, JobLimits(seconds=6, memory=200 << 20), ahead=2)
    try:
        ended = dict(_ended(pool, names, RetryPolicy(0)))
    finally:
        pool.close()
    assert set(ended) == set(names)
    fine = {name for name, (fault, _) in ended.items() if fault is None}
    assert fine == {n for n in names if n.startswith("fine")}
    assert "its worker died" in ended["die"][0]
    assert "took over 6 s" in ended["hang"][0]
    assert all("more memory" in ended[name][0] for name in ("eat", "nibble"))


def test_time_for_compiling_kernels_is_not_the_time_of_a_job() -> None:
    """A cold service ended every worker that compiled for over 20 s, and so did the next one."""
    pool = ProcessPool(work, 1, JobLimits(seconds=0.3))
    try:
        ended = dict(_ended(pool, ["compile", "fine", "hang"], RetryPolicy(0)))
    finally:
        pool.close()
    assert ended["compile"][0] is ended["fine"][0] is None
    assert "took over 0.3 s" in ended["hang"][0]


def test_a_worker_killed_from_outside_loses_no_job(tmp_path: Path) -> None:
    pool = ProcessPool(work, 2, JobLimits(), ahead=2)
    mark = str(tmp_path / "mark").replace("/", "!")
    names = [f"once-die@{mark}", *(f"fine{n}" for n in range(60))]
    try:
        ended = []
        for result, tries in run_jobs([job(name) for name in names], pool, SOON):
            ended.append((result.job.key, result.error, tries))
            if len(ended) in (15, 40):
                psutil.Process(pool.pids()[0]).kill()
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


def test_workers_that_die_as_they_start_are_started_again_after_growing_pauses() -> None:
    pool = ProcessPool(work, 1, restarts=RetryPolicy(limit=math.inf, pause=0.05, longest=0.4))
    starts: list[float] = []
    pids: set[int] = set()
    try:
        while len(starts) < 6:
            for pid in set(pool.pids()) - pids:
                pids.add(pid)
                starts.append(time.monotonic())
                psutil.Process(pid).kill()
            pool.poll(0.01)
            assert not pool.ready()
        pauses = [later - before for before, later in pairwise(starts)]
        assert all(p >= least for p, least in zip(pauses, (0.05, 0.1, 0.2, 0.4, 0.4), strict=True))
        (result,) = _until_results(pool, job("fine"))
        assert (result.error, pool.ready()) == (None, True)
    finally:
        pool.close()


def test_a_pool_whose_workers_never_start_gives_up_with_the_reason() -> None:
    pool = ProcessPool(work, 1, restarts=RetryPolicy(limit=2, pause=0.01))
    try:
        with pytest.raises(BackendError, match=r"3 workers in a row .*killed by signal 9"):
            while True:
                for pid in pool.pids():
                    psutil.Process(pid).kill()
                pool.poll(0.05)
    finally:
        pool.close()


def test_a_system_that_refuses_processes_is_asked_again(monkeypatch) -> None:
    refusals = iter([OSError(11, "Resource temporarily unavailable")] * 2)
    start = SpawnProcess.start

    def refuse(self: SpawnProcess) -> None:
        for error in refusals:
            raise error
        start(self)

    monkeypatch.setattr(SpawnProcess, "start", refuse)
    pool = ProcessPool(work, 1, restarts=RetryPolicy(limit=9, pause=0.01))
    try:
        (result,) = _until_results(pool, job("fine"))
        assert result.error is None
    finally:
        pool.close()


def test_the_pauses_of_a_policy_double_up_to_the_longest() -> None:
    policy = RetryPolicy(limit=math.inf, pause=1.0, longest=60.0)
    assert [policy.delay(tries) for tries in (1, 2, 3, 7, 10_000)] == [1.0, 2.0, 4.0, 60.0, 60.0]


def test_a_worker_runs_where_the_system_has_no_limits(monkeypatch) -> None:
    monkeypatch.setattr(worker.sys, "platform", "win32")
    monkeypatch.delattr(os, "sysconf")
    monkeypatch.setitem(worker.sys.modules, "resource", None)  # an import of it fails
    worker.limit_memory(1 << 20)
    assert worker.memory_of("self", worker.RESIDENT) == 0


def _until_results(pool: ProcessPool, one: Job) -> list[JobResult]:
    while pool.free() < 1:
        pool.poll(0.1)
    pool.start(one)
    while True:
        results = pool.poll(0.1)
        if results:
            return results


def _ended(pool: ProcessPool, names: list[str], retries: RetryPolicy):
    for result, tries in run_jobs([job(name) for name in names], pool, retries):
        yield result.job.key, (result.error, tries)
