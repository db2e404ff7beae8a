"""A run that is killed, starved or disturbed ends, after --resume, as if nothing had been."""

import os
import random
import re
import shutil
import signal
import sqlite3
import subprocess
import sys
import time
from contextlib import closing, suppress
from dataclasses import replace
from multiprocessing import get_context
from multiprocessing.process import BaseProcess
from pathlib import Path

import numpy as np
import psutil
import pytest
from batch_works import command, manifest, pictures
from conftest import Run
from pack_maker import make_pack
from PIL import Image

from drapery import Banner, draw
from drapery.batch import run_batch
from drapery.batch.jobs import JobResult, plan, run_job
from drapery.batch.keys import code_version
from drapery.batch.manifest import read_manifest
from drapery.batch.results import FILE, ResultsDB
from drapery.batch.stores import open_store
from drapery.errors import OptionError, OutputError


def rows(folder: Path) -> list[tuple[object, ...]]:
    with closing(sqlite3.connect(folder / FILE)) as db:
        return db.execute("SELECT out, state, why, tries FROM outputs ORDER BY out").fetchall()


def test_a_batch_draws_what_draw_draws_and_draws_it_once(drapery: Run, tmp_path: Path) -> None:
    out = tmp_path / "out"
    path = tmp_path / "m.csv"
    path.write_text(
        "name,design,size,grid,out\n"
        "a,white creeper:lime,24x32,3x5,\n"
        "b,white creeper:lime,24x32,3x5,\n"
        ",red,16x16,2x3,deep/er/c.webp\n"
        ",red,16x16,2x3,d.gif\n"
    )
    words = ("batch", path, "-o", out, "--workers", "2", "--set", "fps=10", "--set", "seconds=0.3")
    code, said, _ = drapery(*words)
    assert code == 0, said
    drawn = draw(Banner.parse("white creeper:lime"), size=(24, 32), grid=(3, 5))
    assert np.array_equal(np.asarray(Image.open(out / "a.png")), drawn.pixels)
    assert (out / "a.png").read_bytes() == (out / "b.png").read_bytes()
    with Image.open(out / "d.gif") as gif:
        assert gif.n_frames == 3
    page = (out / "report.html").read_text()
    assert page.count("<img") == 4
    stamps = {p: p.stat().st_mtime_ns for p in out.rglob("*.*") if p.suffix in (".png", ".gif")}
    (out / "b.png").unlink()
    code, said, _ = drapery(*words)
    assert code == 0
    assert "drawn               0" in said
    assert (out / "a.png").read_bytes() == (out / "b.png").read_bytes()
    assert all(p.stat().st_mtime_ns == t for p, t in stamps.items() if p.name != "b.png")


@pytest.mark.usefixtures("untraced_processes")
@pytest.mark.slow
def test_a_run_killed_at_ten_random_moments_ends_as_one_undisturbed(
    drapery: Run, tmp_path: Path
) -> None:
    path = manifest(tmp_path / "m.jsonl", 60)
    calm, torn = tmp_path / "calm", tmp_path / "torn"
    for job in plan(read_manifest(path)):
        assert run_job(job, open_store(str(calm))).error is None
    torn.mkdir()
    words = ["batch", str(path), "-o", str(torn), "--workers", "2", "--retries", "20"]
    chance = random.Random(1)
    for end in (30, 59):
        before = stamps(torn)
        run = get_context("spawn").Process(target=command, args=(code_version(), words))
        run.start()
        first = len(before)
        for victims in range(1, 5):
            _wait_for_pictures(torn, first + (end - first) * victims // 5, run)
            _kill_a_worker(run, chance)
        _wait_for_pictures(torn, end, run)
        run.kill()
        run.join()
        assert _in_flight(before, torn) <= 4
        if "--resume" not in words:
            words.append("--resume")
    recorded = sum(state == "done" for _, state, _, _ in rows(torn))
    assert len(pictures(torn)) - recorded <= 4, "only what was in flight is not in the results"
    code, said, _ = drapery(*words)
    assert code == 0
    assert f"there before        {recorded}" in said
    assert pictures(torn) == pictures(calm)
    assert not list(torn.glob(".*.part"))


def stamps(folder: Path) -> dict[str, int]:
    return {path.name: path.stat().st_mtime_ns for path in folder.glob("*.png")}


def _in_flight(before: dict[str, int], folder: Path) -> int:
    """How many pictures were drawn again since, for the killed run had not written them down."""
    now = stamps(folder)
    return sum(now[name] != moment for name, moment in before.items())


def _kill_a_worker(run: BaseProcess, chance: random.Random) -> None:
    workers = [p for p in psutil.Process(run.pid).children() if "spawn_main" in str(p.cmdline())]
    with suppress(psutil.NoSuchProcess, IndexError):
        chance.choice(workers).kill()


def _wait_for_pictures(folder: Path, count: int, run: BaseProcess) -> None:
    end = time.monotonic() + 60
    while len(list(folder.glob("*.png"))) < count and run.is_alive():
        assert time.monotonic() < end
        time.sleep(0.005)


def test_what_fails_is_reported_and_the_rest_is_done(drapery: Run, tmp_path: Path) -> None:
    pack = make_pack(tmp_path / "pack")
    path = manifest(tmp_path / "m.jsonl", 4)
    out = tmp_path / "out"
    (out / "j2.png").mkdir(parents=True)
    words = ("batch", path, "-o", out, "--workers", "2", "--retries", "0")
    code, said, err = drapery(*words, "--set", f"packs={pack}")
    assert code == 1
    assert "failed              1" in said
    assert "j2.png (line 4): cannot write" in err
    assert [(o, s) for o, s, _, _ in rows(out)] == [
        *(("j0.png", "done"), ("j1.png", "done"), ("j2.png", "failed"), ("j3.png", "done"))
    ]
    assert "it is a folder" in (out / "report.html").read_text()
    (out / "j2.png").rmdir()
    code, said, _ = drapery(*words, "--set", f"packs={pack}", "--resume")
    assert code == 1, "what failed in the run that is resumed stays failed"
    code, said, _ = drapery(*words, "--set", f"packs={pack}")
    assert code == 0, "a run anew tries it again"
    assert "drawn               1" in said


def test_a_pack_removed_in_the_run_fails_its_jobs_alone(tmp_path: Path) -> None:
    pack = make_pack(tmp_path / "pack")
    jobs = plan(read_manifest(manifest(tmp_path / "m.jsonl", 2, packs="pack")))
    plain = plan(read_manifest(manifest(tmp_path / "m.jsonl", 2)))
    shutil.rmtree(pack)
    results = [run_job(job, open_store(str(tmp_path / "out"))) for job in (*jobs, *plain)]
    assert [result.error is None for result in results] == [False, False, True, True]
    assert "does not exist" in results[0].error
    assert results[0].retryable


def test_a_full_disk_leaves_no_half_file(tmp_path: Path, monkeypatch) -> None:
    (job,) = plan(read_manifest(manifest(tmp_path / "m.jsonl", 1)))
    out = tmp_path / "out"

    def full(self: Path, target: Path) -> Path:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(Path, "replace", full)
    result = run_job(job, open_store(str(out)))
    assert "No space left on device" in result.error
    assert result.retryable
    assert list(out.iterdir()) == []


def test_a_results_file_is_of_one_run_at_a_time(tmp_path: Path) -> None:
    with ResultsDB(tmp_path / FILE), pytest.raises(OutputError, match="another run"):
        ResultsDB(tmp_path / FILE)
    with ResultsDB(tmp_path / FILE) as again:
        assert again.records() == {}


def test_a_target_that_is_not_a_folder_is_refused(drapery: Run, tmp_path: Path) -> None:
    path = manifest(tmp_path / "m.jsonl", 1)
    for target, reason in ((path, "cannot make"), (f"nothing://{tmp_path}", "cannot be opened")):
        code, _, err = drapery("batch", path, "-o", target)
        assert code == 2
        assert reason in err.splitlines()[-1]


def test_resume_needs_a_run_to_go_on_with(drapery: Run, tmp_path: Path) -> None:
    path = manifest(tmp_path / "m.jsonl", 1)
    code, _, err = drapery("batch", path, "-o", tmp_path / "out", "--resume")
    assert code == 2
    assert "nothing to resume" in err


PROGRAM = """
from drapery.batch import run_batch

if __name__ == "__main__":
    rows = [{"name": dye, "design": f"{dye} border:black"} for dye in ("red", "blue", "red")]
    rows[2]["name"] = "again"
    few = {"size": "16x24", "grid": "2x3", "time": 0.1}
    seen = []
    first = run_batch(rows, "out", workers=1, defaults=few, on_event=lambda p: seen.append(p.done))
    print(first.drawn, seen, run_batch(rows, "out", defaults=few).existing)
"""


def test_a_program_runs_a_batch_with_one_call(tmp_path: Path) -> None:
    (tmp_path / "program.py").write_text(PROGRAM)
    command = [sys.executable, "program.py"]
    ran = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, check=True)
    assert ran.stdout == "2 [0, 2, 3] 3\n"
    out = tmp_path / "out"
    assert (out / "red.png").read_bytes() == (out / "again.png").read_bytes()


def test_arguments_of_a_batch_are_checked_before_anything_is_drawn(tmp_path: Path) -> None:
    rows = [{"design": "red"}]
    for wrong in (
        {"workers": 0},
        {"retries": -1},
        {"timeout": 0},
        {"memory": 1},
        {"format": "jpg"},
        {"resume": True},
    ):
        with pytest.raises(OptionError, match=str(next(iter(wrong)))):
            run_batch(rows, tmp_path, **wrong)
    assert list(tmp_path.iterdir()) == []


FULL_DISK = """
mount -t tmpfs -o size=160k tmpfs out
{python} -m drapery batch m.jsonl -o out --workers 1 --retries 0
code=$?
cp out/*.png .
[ $code = 1 ] || exit 99
mount -o remount,size=64m out
{python} -m drapery batch m.jsonl -o out --workers 1
"""


@pytest.mark.slow
def test_a_disk_that_fills_fails_jobs_with_reasons_and_the_next_run_makes_them(
    tmp_path: Path,
) -> None:
    manifest(tmp_path / "m.jsonl", 12, size="512x640", samples=4)
    out = tmp_path / "out"
    out.mkdir()
    command = ["unshare", "--user", "--map-root-user", "--mount", "bash", "-c"]
    if shutil.which("unshare") is None or subprocess.run([*command, "true"]).returncode:
        pytest.skip("this system lets no test mount a small disk")
    script = FULL_DISK.format(python=sys.executable)
    ran = subprocess.run([*command, script], cwd=tmp_path, capture_output=True, text=True)
    assert ran.returncode == 0, ran.stderr
    reasons = [line for line in ran.stderr.splitlines() if "No space left" in line]
    assert any(re.search(r"j\d+\.png \(line \d+\): cannot write", line) for line in reasons)
    assert any("report.html" in line for line in reasons)
    assert "Traceback" not in ran.stderr
    written = len(list(tmp_path.glob("*.png")))
    assert 0 < written < 12
    assert f"drawn               {written}" in ran.stdout
    assert f"drawn               {12 - written}" in ran.stdout


@pytest.mark.skipif(sys.platform == "win32", reason="Windows ends processes without a signal")
@pytest.mark.parametrize("name, code", [("SIGTERM", 143), ("SIGINT", 130)])
def test_a_stopped_run_leaves_no_partial_file(name: str, code: int, tmp_path: Path) -> None:
    manifest(tmp_path / "m.jsonl", 200, size="256x320", samples=4)
    words = ["batch", "m.jsonl", "-o", "out", "--workers", "2"]
    run = subprocess.Popen([sys.executable, "-m", "drapery", *words], cwd=tmp_path)
    out = tmp_path / "out"
    end = time.monotonic() + 60
    while len(list(out.glob("*.png"))) < 4:
        assert time.monotonic() < end and run.poll() is None
        time.sleep(0.01)
    run.send_signal(getattr(signal, name))
    assert run.wait(10) == code
    assert not list(out.glob(".*.part"))


def test_damaged_results_are_an_error_with_the_remedy(drapery: Run, tmp_path: Path) -> None:
    path, out = manifest(tmp_path / "m.jsonl", 1), tmp_path / "out"
    out.mkdir()
    with ResultsDB(out / FILE) as results:
        outs = tuple(f"{number:0200d}" for number in range(500))
        job = replace(plan(read_manifest(path))[0], outs=outs, places=outs)
        results.record(JobResult(job), tries=1)
    data = bytearray((out / FILE).read_bytes())
    data[8192:20480] = os.urandom(12288)
    (out / FILE).write_bytes(bytes(data))
    code, _, err = drapery("batch", path, "-o", out)
    assert code == 2
    assert "is damaged" in err and "--results" in err
    (out / FILE).write_bytes(b"nothing that SQLite wrote" * 100)
    code, _, err = drapery("batch", path, "-o", out)
    assert code == 2
    assert "is damaged" in err


def test_results_whose_schema_is_no_text_are_damaged(tmp_path: Path) -> None:
    """SQLite quotes what it cannot read, and Python cannot decode that message."""
    path = tmp_path / FILE
    with ResultsDB(path):
        pass
    path.write_bytes(path.read_bytes().replace(b"out TEXT", b"\x80ut \x81EXT"))
    with pytest.raises(OutputError, match="is damaged; delete it"), ResultsDB(path) as results:
        results.records()
