"""The same jobs by a cluster of real processes, which may be killed."""

import os
import signal
import warnings
from functools import partial
from pathlib import Path

import pytest
from test_batch_keys import make_pack
from test_batch_run import manifest, pictures

from drapery.batch import artifacts, cluster, jobs
from drapery.batch.keys import Digests, our_version
from drapery.batch.manifest import read_manifest
from drapery.batch.pool import Limits
from drapery.batch.results import FILE, ResultsDB
from drapery.batch.run import execute
from drapery.batch.stores import RemoteStore, open_store
from drapery.batch.work import Retries
from drapery.errors import BackendError, OutputError


def test_a_cluster_draws_the_same_and_survives_a_killed_worker(tmp_path: Path) -> None:
    our_version.cache_clear()
    make_pack(tmp_path / "pack")
    planned = jobs.plan(read_manifest(manifest(tmp_path / "m.jsonl", 16, packs="pack")))
    calm = open_store(str(tmp_path / "calm"))
    assert all(jobs.do(job, calm).fault is None for job in planned)
    torn = open_store(str(tmp_path / "torn"))
    crews: list[cluster.DaskCrew] = []

    def hire(_: int) -> cluster.DaskCrew:
        crews.append(cluster.local(2, torn, Limits()))
        return crews[-1]

    def tell(tally) -> None:
        if tally.drawn == 5:
            pid = next(iter(crews[-1].client.run(os.getpid).values()))
            os.kill(pid, signal.SIGKILL)

    with ResultsDB(tmp_path / FILE) as book, warnings.catch_warnings():
        warnings.simplefilter("ignore")
        tally = execute(planned, torn, book, hire, retries=Retries(3, 0.1), tell=tell)
        assert (tally.drawn, tally.failed) == (16, [])
        again = execute(planned, torn, book, hire, resume=True)
    assert (again.kept, again.drawn, len(crews)) == (16, 0, 1)
    assert pictures(tmp_path / "torn") == pictures(tmp_path / "calm")


def test_short_jobs_travel_several_in_a_task() -> None:
    crew = cluster.DaskCrew(None, RemoteStore("memory://x"), Limits(), _counted=1e12, _threads=3)
    assert crew.free() == 6
    for pace, count in ((1.0, 1), (0.05, 5), (0.001, 32), (0.0, 32)):
        crew._pace = pace
        assert crew.free() == 6 * count


def test_the_address_of_no_scheduler_is_an_error() -> None:
    with pytest.raises(BackendError, match="no scheduler at"):
        cluster.join("tcp:/nowhere", RemoteStore("memory://x"), Limits())


def test_a_worker_of_another_version_refuses() -> None:
    (job,) = [jobs.Job("k", ("k.png",), ("line 1",), None, None, None, None, "0+other")]
    (outcome,) = cluster.task([job], RemoteStore("memory://x"), Limits(), {})
    assert our_version() in outcome.fault
    assert not outcome.again


def test_packs_travel_as_the_same_bytes(tmp_path: Path, monkeypatch) -> None:
    monkeypatch.setattr(artifacts.tempfile, "gettempdir", lambda: str(tmp_path / "worker"))
    pack = make_pack(tmp_path / "pack")
    (job,) = jobs.plan(read_manifest(manifest(tmp_path / "m.jsonl", 1, packs="pack")))
    parcel = artifacts.packed(pack, Digests())
    assert parcel == artifacts.packed(pack, Digests())
    there = artifacts.settled(job, (parcel,))
    (path,) = there.settings.packs
    assert tmp_path / "worker" in Path(path).parents
    assert there.key == job.key
    for store, one in (("here", job), ("there", there)):
        assert jobs.do(one, open_store(str(tmp_path / store))).fault is None
    assert pictures(tmp_path / "here") == pictures(tmp_path / "there")


def test_outputs_go_to_any_target_of_fsspec(tmp_path: Path) -> None:
    planned = jobs.plan(read_manifest(manifest(tmp_path / "m.jsonl", 3)))
    far, near = open_store("memory://drapery/test"), open_store(str(tmp_path / "near"))
    for store in (far, near):
        assert all(jobs.do(job, store).fault is None for job in planned)
    outs = [out for job in planned for out in job.outs]
    assert {out: far.read(out) for out in outs} == pictures(tmp_path / "near")
    assert far.sizes([*outs, "none.png"]) == [*near.sizes(outs), None]
    with ResultsDB(tmp_path / FILE) as book:
        for job, size in zip(planned, near.sizes(outs), strict=True):
            book.record(jobs.Outcome(job, size=size), 1)
        tally = execute(planned, far, book, partial(pytest.fail, "nothing is to be drawn"))
    assert tally.kept == 3
    with pytest.raises(OutputError, match="cannot read"):
        far.read("none.png")
