"""Any sequence of stops, losses and damage leaves a folder that the next run completes."""

import shutil
import tempfile
from functools import cache, partial
from pathlib import Path
from typing import Any

from hypothesis import settings, strategies as st
from hypothesis.stateful import RuleBasedStateMachine, initialize, rule

from drapery import Banner, draw
from drapery.batch.executor import RetryPolicy
from drapery.batch.jobs import Job, JobResult, plan, run_job
from drapery.batch.manifest import read_manifest
from drapery.batch.results import FILE, ResultsDB
from drapery.batch.run import Progress, execute
from drapery.batch.stores import LocalStore
from drapery.errors import OutputError

OPTIONS: dict[str, Any] = {"size": (16, 20), "grid": (3, 5), "time": 0.1}
OUTS = st.sampled_from(["a.png", "b.png", "in/c.png", "d.webp"])
DESIGNS = st.sampled_from(["red", "white creeper:lime", "blue border:black"])
ONCE = RetryPolicy(limit=0)


class InlineExecutor:
    """Does its jobs in this process."""

    def __init__(self, store: LocalStore) -> None:
        self.store, self.waiting = store, list[Job]()

    def free(self) -> int:
        return 1 - len(self.waiting)

    def ready(self) -> bool:
        return True

    def start(self, job: Job) -> None:
        self.waiting.append(job)

    def poll(self, timeout: float) -> list[JobResult]:
        jobs, self.waiting = self.waiting, []
        return [run_job(job, self.store) for job in jobs]

    def close(self) -> None:
        pass


@cache
def picture(design: str, ending: str) -> bytes:
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder, f"x{ending}")
        draw(Banner.parse(design), **OPTIONS).save(path)
        return path.read_bytes()


class BatchMachine(RuleBasedStateMachine):
    """One manifest and its folder; `blocked` outputs have a folder in their place."""

    @initialize()
    def begin(self) -> None:
        """An empty folder and a manifest of two rows."""
        self.temporary = tempfile.TemporaryDirectory()
        self.folder = Path(self.temporary.name)
        self.manifest = {"a.png": "red", "b.png": "red"}
        self.blocked: set[str] = set()

    def teardown(self) -> None:
        """Remove the folder."""
        self.temporary.cleanup()

    def execute(self, stop_after: int | None = None, resume: bool = False) -> Progress:
        rows = [{"design": d, "out": out, **OPTIONS} for out, d in self.manifest.items()]
        store, events = LocalStore(self.folder), iter(range(1000))

        def on_event(progress: Progress) -> None:
            if next(events) == stop_after:
                raise KeyboardInterrupt

        with ResultsDB(self.folder / FILE) as results:
            spawn = partial(InlineExecutor, store)
            return execute(
                plan(read_manifest(rows)),
                store,
                results,
                lambda number: spawn(),
                resume=resume,
                retries=ONCE,
                on_event=on_event,
            )

    @rule(out=OUTS, design=DESIGNS)
    def edit(self, out: str, design: str) -> None:
        """A row is added or changes its design."""
        self.manifest[out] = design

    @rule(out=OUTS)
    def block(self, out: str) -> None:
        """A folder takes the place of an output, so that it cannot be written."""
        path = self.folder / out
        if path.is_file():
            path.unlink()
        (path / "x").mkdir(parents=True, exist_ok=True)
        self.blocked.add(out)

    @rule(out=OUTS)
    def unblock(self, out: str) -> None:
        """The folder goes."""
        if out in self.blocked:
            shutil.rmtree(self.folder / out)
            self.blocked.discard(out)

    @rule(out=OUTS, length=st.integers(0, 40))
    def truncate(self, out: str, length: int) -> None:
        """An output loses its end, as after a power cut."""
        path = self.folder / out
        if path.is_file():
            path.write_bytes(path.read_bytes()[:length])

    @rule(out=OUTS)
    def lose(self, out: str) -> None:
        """Someone deletes an output."""
        if out not in self.blocked:
            (self.folder / out).unlink(missing_ok=True)

    @rule()
    def lose_results(self) -> None:
        """Someone deletes the record of all runs."""
        for path in self.folder.glob(FILE + "*"):
            path.unlink()

    @rule(place=st.integers(0, 4096), junk=st.binary(min_size=1, max_size=64))
    def damage_results(self, place: int, junk: bytes) -> None:
        """The record is damaged: the run goes on as always, or names the file and the remedy."""
        path = self.folder / FILE
        if not path.exists():
            return
        data = path.read_bytes()
        path.write_bytes(data[:place] + junk + data[place + len(junk) :])
        try:
            self.execute()
        except OutputError as error:
            assert str(path) in str(error) and "--results" in str(error)
        self.lose_results()

    @rule(events=st.integers(0, 3))
    def stop(self, events: int) -> None:
        """Ctrl-C after some jobs."""
        try:
            self.execute(stop_after=events)
        except KeyboardInterrupt:
            assert not list(self.folder.rglob("*.part"))

    @rule()
    def resume(self) -> None:
        """A resumed run leaves out only what had failed."""
        progress = self.execute(resume=True)
        assert progress.done + len(progress.failed) == progress.total == len(self.manifest)

    @rule()
    def run(self) -> None:
        """Every output holds its design's picture, or has failed with its reason."""
        progress = self.execute()
        assert progress.done + len(progress.failed) == progress.total == len(self.manifest)
        failed = {record.out for record in progress.failed}
        blocked = self.blocked & set(self.manifest)
        # Equal pictures are one job, which fails if one of its files cannot be written.
        assert blocked <= failed
        assert {self.manifest[out] for out in failed} == {self.manifest[out] for out in blocked}
        assert all("cannot write" in str(record.error) for record in progress.failed)
        for out, design in self.manifest.items():
            if out not in failed:
                assert (self.folder / out).read_bytes() == picture(design, Path(out).suffix)
        assert not list(self.folder.rglob("*.part"))
        again = self.execute()
        assert (again.drawn, again.existing) == (0, progress.done)


BatchMachine.TestCase.settings = settings(
    max_examples=15, stateful_step_count=15, deadline=None, derandomize=True
)
TestBatch = BatchMachine.TestCase
