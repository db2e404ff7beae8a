"""Processes on this machine that may be killed, hang or eat memory without harm to the others."""

import contextlib
import os
import time
from collections import deque
from collections.abc import Callable
from dataclasses import dataclass, field
from multiprocessing import get_context
from multiprocessing.connection import Connection, wait
from multiprocessing.process import BaseProcess
from pathlib import Path

from drapery.batch import worker
from drapery.batch.jobs import OUT_OF_MEMORY, Job, Outcome
from drapery.errors import BackendError

LOOK = 0.1
"""How often the workers' time and memory are looked at [s]."""
MOST_STILLBORN = 10
"""Workers in a row that die before they report. Something outside may kill a few."""
MOST_AHEAD = 100
"""Outputs of a job that is sent while its worker is at another."""
PAGE = os.sysconf("SC_PAGE_SIZE") if hasattr(os, "sysconf") else 4096


@dataclass(frozen=True)
class Limits:
    """What one job may use: time [s], and memory beyond its worker's own [bytes]."""

    seconds: float = 300.0
    memory: int = 2 << 30


@dataclass
class _Worker:
    """One worker process. ready: it has reported. resting: its memory without a job [bytes].

    jobs: sent to it, of which it does the first; began: when it began that.
    """

    process: BaseProcess
    pipe: Connection
    ready: bool = False
    resting: int = 0
    jobs: deque[Job] = field(default_factory=deque)
    began: float = 0.0


@dataclass
class Pool:
    """A crew of processes on this machine; see `work.Executor`.

    work: what does a job, a function of a module. workers: how many processes.
    threads: of each; by default its share of the cores.
    ahead: jobs sent to a worker; with 2, the next is there when one ends.
    """

    work: Callable[[Job], Outcome]
    workers: int
    limits: Limits = Limits()
    threads: int | None = None
    ahead: int = 1
    _backlog: deque[Job] = field(default_factory=deque)
    _hands: list[_Worker] = field(default_factory=list)
    _stillborn: int = 0
    _looked: float = 0.0

    def __post_init__(self) -> None:
        self._hands = [self._hire() for _ in range(self.workers)]

    def free(self) -> int:
        """See `Executor`."""
        taken = len(self._backlog) + sum(len(hand.jobs) for hand in self._hands)
        return self.ahead * sum(hand.ready for hand in self._hands) - taken

    def start(self, job: Job) -> None:
        """See `Executor`."""
        self._backlog.append(job)
        self._deal()

    def _deal(self) -> None:
        """Send what waits to the workers that have least."""
        while self._backlog:
            hand = min(
                (hand for hand in self._hands if hand.ready and len(hand.jobs) < self.ahead),
                key=lambda hand: len(hand.jobs),
                default=None,
            )
            # A pipe holds little, so a long job must not be sent to one who is not reading.
            if hand is None or (hand.jobs and len(self._backlog[0].outs) > MOST_AHEAD):
                return
            if not hand.jobs:
                hand.began = time.monotonic()
            hand.jobs.append(self._backlog.popleft())
            # A dead worker shows at its pipe's end, in `finished`.
            with contextlib.suppress(OSError):
                hand.pipe.send(hand.jobs[-1])

    def finished(self, patience: float) -> list[Outcome]:
        """See `Executor`. Raises BackendError where no worker starts."""
        end = time.monotonic() + patience
        while True:
            left = max(0.0, min(LOOK, end - time.monotonic()))
            heard = wait([hand.pipe for hand in self._hands], left)
            listened = [hand for hand in self._hands if hand.pipe in heard]
            woke = any(not hand.ready for hand in listened)
            outcomes = [o for hand in listened for o in self._hear(hand)]
            if time.monotonic() - self._looked >= LOOK:
                self._looked = time.monotonic()
                outcomes += [o for hand in list(self._hands) for o in self._check(hand)]
            self._deal()
            if outcomes or woke or time.monotonic() >= end:
                return outcomes

    def pids(self) -> list[int]:
        """The workers' process ids."""
        return [hand.process.pid or 0 for hand in self._hands]

    def close(self) -> None:
        """See `Executor`."""
        for hand in self._hands:
            hand.process.kill()
        for hand in self._hands:
            hand.process.join()
            hand.pipe.close()
        self._hands = []

    def _hire(self) -> _Worker:
        # A fresh interpreter: forking one that has threads is not safe.
        context = get_context("spawn")
        ours, theirs = context.Pipe()
        threads = self.threads or max(1, (os.cpu_count() or 1) // self.workers)
        process = context.Process(
            target=worker.live,
            args=(theirs, self.work, self.limits.memory, threads),
            name="drapery-worker",
            daemon=True,
        )
        process.start()
        theirs.close()
        return _Worker(process, ours)

    def _hear(self, hand: _Worker) -> list[Outcome]:
        try:
            said = hand.pipe.recv()
        except (EOFError, OSError):
            return self._lost(hand, "its worker died")
        if not hand.ready:
            hand.ready, hand.resting, self._stillborn = True, said, 0
            return []
        if said is None:
            # What is left of a heap that was full is not trusted.
            return self._lost(hand, OUT_OF_MEMORY)
        hand.jobs.popleft()
        hand.began = time.monotonic()
        return [said]

    def _check(self, hand: _Worker) -> list[Outcome]:
        """End a worker whose job is over its limits."""
        if not hand.jobs or hand not in self._hands:
            return []
        if time.monotonic() - hand.began > self.limits.seconds:
            return self._lost(hand, f"it took over {self.limits.seconds:g} s; raise --timeout")
        if _resident(hand.process.pid) > hand.resting + self.limits.memory:
            return self._lost(hand, OUT_OF_MEMORY)
        return []

    def _lost(self, hand: _Worker, why: str) -> list[Outcome]:
        if not hand.ready:
            self._stillborn += 1
            if self._stillborn >= MOST_STILLBORN:
                raise BackendError("workers die as they start; run the jobs with `drapery render`")
        took, pid = time.monotonic() - hand.began, hand.process.pid
        self._replace(hand)
        if not hand.jobs:
            return []
        first, *others = hand.jobs
        # It had not begun these.
        self._backlog.extendleft(reversed(others))
        return [Outcome(first, f"{why} (process {pid})", True, took)]

    def _replace(self, hand: _Worker) -> None:
        hand.process.kill()
        hand.process.join()
        hand.pipe.close()
        self._hands[self._hands.index(hand)] = self._hire()


def _resident(pid: int | None) -> int:
    """A process's memory [bytes]; 0 where the system does not say."""
    try:
        return int(Path(f"/proc/{pid}/statm").read_text().split()[1]) * PAGE
    except (OSError, IndexError, ValueError):
        return 0
