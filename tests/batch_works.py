"""Work for pools of processes that goes wrong in every way a job can."""

import json
import os
import sys
import time
from pathlib import Path

from drapery.banner.design import Banner
from drapery.batch.jobs import Job, JobResult
from drapery.settings import Settings

DYES = ("white", "red", "blue", "lime", "black", "pink")


def job(name: str, design: str = "white") -> Job:
    """A job that nothing has to draw."""
    settings = Settings(size=(16, 16), grid=(2, 2), time=0.05)
    return Job(name, (f"{name}.png",), (f"line {name}",), Banner(design), settings, None, "1")


def work(one: Job) -> JobResult:
    """Do what the job's name says; `once-…` goes wrong the first time only."""
    kind, _, mark = one.outs[0].removesuffix(".png").partition("@")
    if kind.startswith("once-"):
        path = Path(mark.replace("!", "/"))
        kind = "fine" if path.exists() else kind.removeprefix("once-")
        path.touch()
    if kind.startswith("die"):
        os.kill(os.getpid(), 9)
    if kind.startswith("hang"):
        time.sleep(600)
    if kind.startswith("compile"):
        compile_for(0.8)
    if kind.startswith("eat"):
        return JobResult(one, None, size=len(bytearray(8 << 30)))
    if kind.startswith("nibble"):
        blocks = []
        while True:
            blocks.append(b"x" * (1 << 20))
    return JobResult(one, None, size=os.getpid())


def compile_for(seconds: float) -> None:
    """Tell what numba tells while it compiles a kernel that calls another one."""
    from numba.core import event

    with event.trigger_event("numba:compile"), event.trigger_event("numba:compile"):
        time.sleep(seconds)


def command(version: str, words: list[str]) -> None:
    """The command line in a separate process, for one version of a checkout that may change."""
    from drapery import cli
    from drapery.batch import jobs, keys

    jobs.code_version = keys.code_version = lambda: version  # type: ignore[assignment]
    sys.argv = ["drapery", *words]
    cli.main()


def manifest(path: Path, count: int, **defaults: object) -> Path:
    """Write a manifest of small pictures."""
    few = {"size": "16x24", "grid": "2x3", "time": 0.1, **defaults}
    jobs = [
        {"name": f"j{n}", "design": f"{DYES[n % 6]} border:{DYES[(n + 1) % 6]}", "seed": n}
        for n in range(count)
    ]
    lines = [{"defaults": few}, *jobs]
    path.write_text("\n".join(map(json.dumps, lines)), encoding="utf-8")
    return path


def pictures(folder: Path) -> dict[str, bytes]:
    """The PNG files of a folder, by name."""
    return {path.name: path.read_bytes() for path in folder.rglob("*.png")}
