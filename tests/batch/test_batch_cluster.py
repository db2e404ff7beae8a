"""The same jobs by a cluster of real processes, which may be killed."""

import gc
import os
import warnings
from functools import partial
from pathlib import Path
from types import SimpleNamespace

import distributed
import fsspec
import psutil
import pytest
from batch_works import manifest, pictures
from pack_maker import make_pack

from drapery.batch import artifacts, cluster, jobs, run_batch
from drapery.batch.executor import RetryPolicy
from drapery.batch.keys import DigestCache, code_version
from drapery.batch.manifest import read_manifest
from drapery.batch.pool import JobLimits
from drapery.batch.results import FILE, ResultsDB
from drapery.batch.run import execute
from drapery.batch.stores import RemoteStore, open_store
from drapery.errors import BackendError, OutputError

pytestmark = pytest.mark.usefixtures("untraced_processes")


@pytest.mark.slow
def test_a_cluster_draws_the_same_and_survives_a_killed_worker(tmp_path: Path) -> None:
    code_version.cache_clear()
    make_pack(tmp_path / "pack")
    planned = jobs.plan(read_manifest(manifest(tmp_path / "m.jsonl", 16, packs="pack")))
    calm = open_store(str(tmp_path / "calm"))
    assert all(jobs.run_job(job, calm).error is None for job in planned)
    torn = open_store(str(tmp_path / "torn"))
    executors: list[cluster.DaskExecutor] = []

    def spawn(_: int) -> cluster.DaskExecutor:
        executors.append(cluster.local_cluster(2, torn, JobLimits()))
        return executors[-1]

    def on_event(progress) -> None:
        if progress.drawn == 5:
            pid = next(iter(executors[-1].client.run(os.getpid).values()))
            psutil.Process(pid).kill()

    with ResultsDB(tmp_path / FILE) as results, warnings.catch_warnings():
        warnings.simplefilter("ignore")
        progress = execute(
            planned, torn, results, spawn, retries=RetryPolicy(3, 0.1), on_event=on_event
        )
        assert (progress.drawn, progress.failed) == (16, [])
        again = execute(planned, torn, results, spawn, resume=True)
    assert (again.existing, again.drawn, len(executors)) == (16, 0, 1)
    assert pictures(tmp_path / "torn") == pictures(tmp_path / "calm")


def test_short_jobs_travel_several_in_a_task() -> None:
    executor = cluster.DaskExecutor(
        None, RemoteStore("memory://x"), JobLimits(), counted=1e12, threads=3
    )
    assert executor.free() == 6
    for pace, count in ((1.0, 1), (0.05, 5), (0.001, 32), (0.0, 32)):
        executor.pace = pace
        assert executor.free() == 6 * count


def test_an_address_without_a_scheduler_is_an_error() -> None:
    for address in ("tcp:/nowhere", "tls://127.0.0.1:1", "tcp://", "nothing://x", ""):
        with pytest.raises(BackendError, match="no scheduler at") as caught:
            cluster.connect(address, RemoteStore("memory://x"), JobLimits())
        assert "\n" not in str(caught.value)


def test_a_client_that_found_no_scheduler_is_closed_at_once() -> None:
    """One that closed itself while the next one started waited for ever."""
    with pytest.raises(BackendError):
        cluster.connect("nothing://x", RemoteStore("memory://x"), JobLimits())
    clients = [each for each in gc.get_objects() if isinstance(each, distributed.Client)]
    assert {each.status for each in clients} <= {"closed", "newly-created"}


def test_a_worker_of_another_version_refuses() -> None:
    (job,) = [jobs.Job("k", ("k.png",), ("line 1",), None, None, None, "0+other")]
    (result,) = cluster.task([job], RemoteStore("memory://x"), JobLimits(), {})
    assert code_version() in result.error
    assert not result.retryable


def test_packs_travel_as_the_same_bytes(tmp_path: Path, monkeypatch) -> None:
    folder = SimpleNamespace(name=str(tmp_path / "worker"))
    (tmp_path / "worker").mkdir()
    monkeypatch.setattr(artifacts, "temporary_folder", lambda: folder)
    pack = make_pack(tmp_path / "pack")
    (job,) = jobs.plan(read_manifest(manifest(tmp_path / "m.jsonl", 1, packs="pack")))
    artifact = artifacts.bundle(pack, DigestCache())
    assert artifact == artifacts.bundle(pack, DigestCache())
    there = artifacts.resolved(job, (artifact,))
    (path,) = there.settings.packs
    assert tmp_path / "worker" in Path(path).parents
    assert there.key == job.key
    for store, one in (("here", job), ("there", there)):
        assert jobs.run_job(one, open_store(str(tmp_path / store))).error is None
    assert pictures(tmp_path / "here") == pictures(tmp_path / "there")


def test_a_worker_names_packs_as_the_manifest_does(tmp_path: Path) -> None:
    pack = make_pack(tmp_path / "pack")
    (job,) = jobs.plan(read_manifest(manifest(tmp_path / "m.jsonl", 1, packs="pack")))
    sent = {str(path): artifacts.bundle(path, DigestCache()) for path in artifacts.paths_of(job)}
    (result,) = cluster.task([job], RemoteStore("memory://drapery/named"), JobLimits(), sent)
    assert result.error is None and result.warnings
    assert all(str(pack) in warning for warning in result.warnings)
    assert not any("drapery-packs-" in warning for warning in result.warnings)


def test_a_store_that_cannot_be_listed_is_no_empty_store(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Else all pictures would be drawn again."""
    far = open_store("memory://drapery/none")
    assert far.sizes(["a.png"]) == [None]

    def refuse(*_: object, **__: object) -> None:
        raise PermissionError("Forbidden: the token has expired")

    monkeypatch.setattr("fsspec.implementations.memory.MemoryFileSystem.find", refuse)
    with pytest.raises(
        OutputError, match=r"cannot list memory://drapery/none: PermissionError; check"
    ):
        far.sizes(["a.png"])
    near = open_store(str(tmp_path))
    assert near.sizes(["a.png", "a.png/b.png"]) == [None, None]
    monkeypatch.setattr(Path, "stat", refuse)
    with pytest.raises(OutputError, match="cannot find out whether"):
        near.sizes(["a.png"])


def test_no_bucket_is_made_where_the_address_has_a_typo(monkeypatch: pytest.MonkeyPatch) -> None:
    def makes(*_: object, **__: object) -> None:
        pytest.fail("a bucket is made")

    monkeypatch.setattr("fsspec.implementations.memory.MemoryFileSystem.makedirs", makes)
    store = open_store("memory://drapery-typo/test")
    store.write("guilds/red.png", b"red")
    assert store.read("guilds/red.png") == b"red"


class Buckets:
    """A target with one bucket, one that may not be listed, and one that does not answer."""

    def info(self, path: str) -> dict[str, str]:
        if path == "closed":
            raise PermissionError("Forbidden")
        if path == "far":
            raise TimeoutError("no answer")
        if path != "flags":
            raise FileNotFoundError(path)
        return {"name": path}


def test_a_missing_bucket_is_noticed_before_a_job_is_drawn(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:

    def opened(url: str) -> tuple[Buckets, str]:
        return Buckets(), url.partition("://")[2]

    monkeypatch.setattr("fsspec.core.url_to_fs", opened)
    assert open_store("gs://flags/guilds").label == "gs://flags/guilds"
    assert open_store("gs://closed/guilds").label == "gs://closed/guilds"
    with pytest.raises(OutputError, match=r"^gs://far/x cannot be opened: TimeoutError; check"):
        open_store("gs://far/x")
    rows = [{"design": "red", "size": "16x16"}]
    missing = r"^gs://flgas/guilds: there is no bucket flgas; make it, or correct the address$"
    with pytest.raises(OutputError, match=missing):
        run_batch(rows, "gs://flgas/guilds", results=tmp_path / FILE, workers=1)
    assert not (tmp_path / FILE).exists()


def test_the_library_that_an_address_needs_is_named() -> None:
    fsspec.register_implementation("far", "no_library.Far", errtxt="Install far-fs to access Far")
    with pytest.raises(OutputError, match=r"^far://bucket/x: no_library is missing; install it$"):
        open_store("far://bucket/x")


def test_outputs_go_to_any_target_of_fsspec(tmp_path: Path) -> None:
    planned = jobs.plan(read_manifest(manifest(tmp_path / "m.jsonl", 3)))
    far, near = open_store("memory://drapery/test"), open_store(str(tmp_path / "near"))
    for store in (far, near):
        assert all(jobs.run_job(job, store).error is None for job in planned)
    outs = [out for job in planned for out in job.outs]
    assert {out: far.read(out) for out in outs} == pictures(tmp_path / "near")
    assert far.sizes([*outs, "none.png"]) == [*near.sizes(outs), None]
    with ResultsDB(tmp_path / FILE) as results:
        for job, size in zip(planned, near.sizes(outs), strict=True):
            results.record(jobs.JobResult(job, size=size), 1)
        progress = execute(planned, far, results, partial(pytest.fail, "nothing is to be drawn"))
    assert progress.existing == 3
    with pytest.raises(OutputError, match="cannot read"):
        far.read("none.png")
