"""Batches and the service, measured: `python -m benchmarks.batch WHAT [--jobs N] …`.

WHAT is one of
  overhead   a pool of one worker against a loop in one process, and the memory of the loop
  workers    the gain in speed from a second worker process
  kills      a run that is killed at random moments and resumed, against an uninterrupted run
  dask       a mixed manifest on a local Dask cluster whose workers and run are killed
  scheduler  a mixed manifest on a Dask cluster of separate processes, whose scheduler is killed
  catalogue  all 16 x 43 banners with one layer, as GIFs, on a local Dask cluster
  soak       the service under many clients for a while
  scale      a simulated cluster: jobs, workers, the cost of each part
Run them on a machine that does no other work.
"""

import argparse
import heapq
import json
import os
import random
import resource
import signal
import subprocess
import sys
import threading
import time
import urllib.request
from collections import Counter
from contextlib import suppress
from dataclasses import dataclass, field
from functools import partial
from http.client import HTTPConnection, HTTPException
from pathlib import Path
from tempfile import TemporaryDirectory

from benchmarks.quick import add_quick
from drapery.banner.dyes import DYE_NAMES
from drapery.banner.patterns import PATTERN_NAMES
from drapery.batch.jobs import Job, plan, run_job
from drapery.batch.manifest import read_manifest
from drapery.batch.pool import ProcessPool, warm_up
from drapery.batch.results import FILE, ResultsDB
from drapery.batch.run import Progress, execute
from drapery.batch.stores import open_store


def mixed(path: Path, count: int, size: str = "48x48", loops: int = 10) -> Path:
    """A manifest of random banners; every `loops`-th job is a short GIF."""
    chance = random.Random(0)
    lines: list[dict[str, object]] = [{"defaults": {"size": size, "grid": "3x5"}}]
    for number in range(count):
        layers = [f"{chance.choice(PATTERN_NAMES)}:{chance.choice(DYE_NAMES)}" for _ in range(3)]
        words = {"design": " ".join([chance.choice(DYE_NAMES), *layers]), "seed": number % 7}
        moving = loops and number % loops == 0
        words |= {"out": f"{number}.gif", "seconds": 0.5} if moving else {"out": f"{number}.png"}
        lines.append(words)
    path.write_text("\n".join(map(json.dumps, lines)), encoding="utf-8")
    return path


def catalogue_manifest(path: Path, size: str, most: int | None) -> Path:
    """All banners with one layer, or at most so many, as loops of one second."""
    lines: list[dict[str, object]] = [{"defaults": {"size": size, "seconds": 1, "fps": 20}}]
    lines += [
        {"design": f"{'white' if dye != 'white' else 'black'} {pattern}:{dye}",
         "out": f"{pattern}/{dye}.gif"}
        for pattern in PATTERN_NAMES
        for dye in DYE_NAMES
    ]  # fmt: skip
    path.write_text("\n".join(map(json.dumps, lines[: most and most + 1])), encoding="utf-8")
    return path


def by_pool(
    jobs: list[Job], folder: Path, workers: int, on_event=lambda progress: None
) -> Progress:
    """Run jobs in a process pool and store the results in a folder."""
    store = open_store(str(folder))
    with ResultsDB(folder / FILE) as results:
        return execute(
            jobs,
            store,
            results,
            lambda _: ProcessPool(partial(run_job, store=store), workers, ahead=2),
            on_event=on_event,
        )


FIRST = 20
"""The number of first jobs that are not timed, because a process starts slowly."""


def timed_pool(jobs: list[Job], folder: Path, workers: int) -> tuple[float, float]:
    """Time per job in a running pool [s], and the fraction of it spent outside of the jobs."""
    moments: list[tuple[float, float]] = []
    by_pool(
        jobs, folder, workers, lambda progress: moments.append((time.perf_counter(), progress.busy))
    )
    (start, idle), (end, busy) = moments[FIRST], moments[-1]
    count = len(moments) - 1 - FIRST
    return (end - start) / count, 1 - (busy - idle) / workers / (end - start)


def overhead(jobs: list[Job], folder: Path) -> None:
    """Time a loop in one process, then a pool of one worker with the same number of threads."""
    warm_up()
    store = open_store(str(folder / "loop"))
    memory = []
    start = 0.0
    for number, job in enumerate(jobs):
        start = time.perf_counter() if number == FIRST else start
        assert run_job(job, store).error is None
        if number in (len(jobs) // 4, len(jobs) - 1):
            memory.append(resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024)
    loop = (time.perf_counter() - start) / (len(jobs) - FIRST)
    pooled, around = timed_pool(jobs, folder / "pool", 1)
    print(f"loop {1000 * loop:.2f} ms a job, pool of one {1000 * pooled:.2f} ms")
    print(f"overhead against the loop {100 * (pooled / loop - 1):.1f} %")
    print(f"of the pool's time {100 * around:.1f} % is not in its jobs")
    print(f"peak memory after a quarter {memory[0]:.0f} MiB, at the end {memory[1]:.0f} MiB")


def workers(jobs: list[Job], folder: Path) -> None:
    """Compare one worker with two; each has one thread."""
    os.environ["NUMBA_NUM_THREADS"] = "1"
    warm_up()
    times = {}
    for number in (1, 2):
        times[number], _ = timed_pool(jobs, folder / str(number), number)
        print(f"{number} workers: {1 / times[number]:.1f} jobs/s")
    print(f"gain {times[1] / times[2]:.2f}")


def outputs(folder: Path) -> dict[str, bytes]:
    """All pictures of a folder."""
    kinds = (".png", ".gif")
    found = (p for p in folder.rglob("*") if p.suffix in kinds and not p.name.startswith("."))
    return {path.relative_to(folder).as_posix(): path.read_bytes() for path in found}


def kills(manifest: Path, folder: Path, count: int, *words: str) -> None:
    """Kill workers, or the whole run, at random moments; let it finish and compare outputs.

    The moments are spread over about the time that an uninterrupted run takes.
    """
    chance = random.Random(os.getpid())
    calm, torn = folder / "calm", folder / "torn"
    command = [sys.executable, "-m", "drapery", "batch", str(manifest), *words]
    start = time.perf_counter()
    subprocess.run([*command, "-o", str(calm)], check=True, stdout=subprocess.DEVNULL)
    pause = (time.perf_counter() - start) / count
    on_result: Counter[str] = Counter()
    again = 0
    for number in range(count):
        before = written(torn)
        more = ["--resume"] if (torn / FILE).exists() else []
        run = subprocess.Popen([*command, "-o", str(torn), *more], stdout=subprocess.DEVNULL)
        _await_more(torn, run)
        time.sleep(chance.uniform(0.0, pause))
        victim = chance.choice(["worker", "run"])
        on_result[_kill(run, victim)] += 1
        print(f"kill {number + 1}: {victim}, {len(outputs(torn))} pictures", flush=True)
        if victim == "worker":
            time.sleep(chance.uniform(0.0, pause))
            _kill(run, "run")
        run.wait()
        again += rewritten(before, torn)
    before = written(torn)
    subprocess.run([*command, "-o", str(torn), "--resume"], check=True)
    again += rewritten(before, torn)
    print(f"killed {dict(on_result)}; identical: {outputs(torn) == outputs(calm)}")
    print(f"drawn twice, since they were in flight: {again} of {len(outputs(torn))}")
    print(f"half-written files left: {len(list(torn.rglob('.*.part')))}")


def schedulers(manifest: Path, folder: Path, count: int, port: int) -> None:
    """Kill the scheduler of one cluster after another; the last cluster runs to the end."""
    chance = random.Random(os.getpid())
    calm, torn = folder / "calm", folder / "torn"
    batch = [sys.executable, "-m", "drapery", "batch", str(manifest)]
    subprocess.run([*batch, "-o", str(calm)], check=True, stdout=subprocess.DEVNULL)
    for number in range(count + 1):
        address = f"tcp://127.0.0.1:{port + number}"
        cluster = _cluster(address, 2, folder)
        more = ["--resume"] if (torn / FILE).exists() else []
        run = subprocess.Popen([*batch, "-o", str(torn), "--scheduler", address, *more])
        if number < count:
            _await_more(torn, run)
            time.sleep(chance.uniform(0.0, 1.0))
            cluster[0].kill()
            print(f"kill {number + 1}: the scheduler, {len(outputs(torn))} pictures", flush=True)
        print(f"the run ended with exit code {run.wait()}", flush=True)
        for process in cluster:
            process.kill()
            process.wait()
    print(f"identical: {outputs(torn) == outputs(calm)}")
    print(f"half-written files left: {len(list(torn.rglob('.*.part')))}")


def _cluster(address: str, workers: int, folder: Path) -> list[subprocess.Popen[bytes]]:
    """Start a scheduler and its workers, each in its own process."""
    host, port = address.removeprefix("tcp://").split(":")
    dask = [sys.executable, "-m", "dask"]
    commands = [[*dask, "scheduler", "--host", host, "--port", port, "--no-dashboard"]]
    work = [*dask, "worker", address, "--nthreads", "1", "--no-nanny", "--no-dashboard"]
    commands += [[*work, "--local-directory", str(folder / "dask")]] * workers
    quiet = {"stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL}
    return [subprocess.Popen(command, **quiet) for command in commands]


def written(folder: Path) -> dict[str, int]:
    """When each picture of a folder was written [ns]."""
    return {name: (folder / name).stat().st_mtime_ns for name in outputs(folder)}


def rewritten(before: dict[str, int], folder: Path) -> int:
    """The number of pictures that were written again."""
    now = written(folder)
    return sum(now[name] != moment for name, moment in before.items())


def _await_more(folder: Path, run: subprocess.Popen[bytes]) -> None:
    """Wait for the first new picture, because a kill while workers start tests little."""
    before, end = len(outputs(folder)), time.monotonic() + 60
    while len(outputs(folder)) == before and run.poll() is None and time.monotonic() < end:
        time.sleep(0.05)


def _kill(run: subprocess.Popen[bytes], victim: str) -> str:
    """Kill -9 the run, or one of its processes; returns what was killed."""
    import psutil

    try:
        family = psutil.Process(run.pid).children(recursive=True)
    except psutil.NoSuchProcess:
        return "ended"
    if victim == "run" or not family:
        run.kill()
        return "run"
    try:
        random.choice(family).kill()
    except psutil.NoSuchProcess:
        return "ended"
    return "worker"


def soak(seconds: float, clients: int, port: int, pause: float) -> None:
    """Let clients request pictures until the time is over; kill a worker after every pause [s].

    Half of the requests are for 20 pictures, whose bytes must be those that `draw` makes.
    """
    command = [sys.executable, "-m", "drapery", "serve", "--port", str(port), "--rate", "0"]
    server = subprocess.Popen(command)
    _await_server(f"http://127.0.0.1:{port}")
    right = [_drawn_bytes(seed) for seed in range(20)]
    end = time.monotonic() + seconds
    seen = SoakAnswers()
    tasks = [
        threading.Thread(target=_client, args=(port, n, end, right, seen)) for n in range(clients)
    ]
    killer = threading.Thread(target=_kill_workers, args=(server.pid, end, pause, seen))
    for task in (*tasks, killer):
        task.start()
    memory = _watch(server.pid, end)
    for task in (*tasks, killer):
        task.join()
    start = time.monotonic()
    server.send_signal(signal.SIGTERM)
    server.wait(20)
    took = sorted(seen.seconds)
    print(f"{clients} clients, {seconds:.0f} s, {seen.kills} workers killed: {dict(seen.codes)}")
    print(f"wrong pictures: {seen.wrong}; ended {time.monotonic() - start:.1f} s after SIGTERM")
    print(f"median {1000 * took[len(took) // 2]:.0f} ms, slowest {took[-1]:.2f} s")
    print(f"memory of all processes, MiB, each fifth of the time: {memory}")


@dataclass
class SoakAnswers:
    """What the clients got. codes: answers by status, -1 for none. seconds: of each request."""

    codes: Counter[int] = field(default_factory=Counter)
    seconds: list[float] = field(default_factory=list)
    wrong: int = 0
    kills: int = 0


def _drawn_bytes(seed: int) -> bytes:
    from drapery import Banner, draw

    frame = draw(Banner.parse("red border:black"), size=(48, 64), grid=(3, 5), seed=seed)
    with TemporaryDirectory() as folder:
        path = Path(folder, "x.png")
        frame.save(path)
        return path.read_bytes()


def _client(port: int, number: int, end: float, right: list[bytes], seen: SoakAnswers) -> None:
    chance = random.Random(number)
    source = f"127.0.{1 + number // 250}.{1 + number % 250}"  # a client of the limits is an address
    while time.monotonic() < end:
        known = chance.random() < 0.5
        seed = chance.randrange(len(right)) if known else chance.randrange(100, 1 << 31)
        path = f"/banner.png?design=red+border:black&size=48x64&grid=3x5&seed={seed}"
        start, code = time.monotonic(), -1
        connection = HTTPConnection("127.0.0.1", port, timeout=60, source_address=(source, 0))
        try:
            connection.request("GET", path)
            answer = connection.getresponse()
            code, data = answer.status, answer.read()
            seen.wrong += code == 200 and known and data != right[seed]
        except (OSError, HTTPException):
            pass
        finally:
            connection.close()
        seen.codes[code] += 1
        seen.seconds.append(time.monotonic() - start)


def _kill_workers(pid: int, end: float, pause: float, seen: SoakAnswers) -> None:
    import psutil

    chance = random.Random(0)
    while pause and time.monotonic() + pause < end:
        time.sleep(pause)
        with suppress(psutil.Error):
            family = psutil.Process(pid).children()
            workers = [p for p in family if "spawn_main" in " ".join(p.cmdline())]
            if workers:
                chance.choice(workers).kill()
                seen.kills += 1


def _await_server(base: str) -> None:
    for _ in range(300):
        try:
            urllib.request.urlopen(f"{base}/metrics", timeout=1).read()
            return
        except OSError:
            time.sleep(0.2)
    raise SystemExit("the service did not start")


def _watch(pid: int, end: float) -> list[int]:
    import psutil

    seen, pause = [], (end - time.monotonic()) / 5
    for _ in range(5):
        time.sleep(max(0.0, pause))
        family = [psutil.Process(pid), *psutil.Process(pid).children(recursive=True)]
        seen.append(round(sum(p.memory_info().rss for p in family) / 2**20))
    return seen


@dataclass(frozen=True)
class Costs:
    """The time that the parts of a run take [s].

    job: draw and store. schedule: the scheduler's work for one task. client: submit a task and
    record its result. trip: the way to the worker and back.
    """

    job: float
    schedule: float
    client: float
    trip: float = 0.001


def simulate(jobs: int, machines: int, ahead: int, bundle: int, costs: Costs) -> float:
    """The time that a run takes [s], from a discrete-event simulation.

    Client and scheduler are each one thread that does one thing at a time. A worker runs one task
    and has a queue of tasks that were sent ahead. A task passes client, scheduler, worker,
    scheduler, client. bundle: the number of jobs in a task.
    """
    client = scheduler = end = 0.0
    free = [0.0] * machines
    heapq.heapify(free)
    window: list[float] = []
    for _ in range(-(-jobs // bundle)):
        begin = heapq.heappop(window) if len(window) >= ahead * machines else 0.0
        client = max(client, begin) + costs.client / 2
        scheduler = max(scheduler, client) + costs.schedule / 2
        start = max(heapq.heappop(free), scheduler + costs.trip / 2)
        done = start + costs.job * bundle
        heapq.heappush(free, done)
        # Add the second halves for scheduler and client here already: over many tasks, only the
        # sums matter.
        scheduler += costs.schedule / 2
        client += costs.client / 2
        end = max(end, done + costs.trip / 2)
        heapq.heappush(window, end if done > end else done + costs.trip / 2)
    return max(end, scheduler, client)


def measured(folder: Path, count: int) -> Costs:
    """Measure the costs on this machine.

    A job is timed with `run_job`, a task as an empty one on a local cluster, a record on its own.
    """
    import distributed

    warm_up()
    jobs = plan(read_manifest(mixed(folder / "m.jsonl", count, "256x320", 0)))
    store = open_store(str(folder / "costs"))
    start = time.perf_counter()
    job_results = [run_job(job, store) for job in jobs]
    job = (time.perf_counter() - start) / count
    with ResultsDB(folder / FILE) as results:
        start = time.perf_counter()
        for result in job_results:
            results.record(result, 1)
        record = (time.perf_counter() - start) / count
    tasks = 2000
    with (
        distributed.LocalCluster(
            n_workers=1, threads_per_worker=1, processes=True, dashboard_address=None
        ) as cluster,
        distributed.Client(cluster) as client,
    ):
        client.submit(abs, 1).result()
        start, used = time.perf_counter(), time.process_time()
        client.gather([client.submit(abs, n, pure=False) for n in range(tasks)])
        task = (time.perf_counter() - start) / tasks
        # Scheduler and client share this process, so estimate half of its time for each.
        share = (time.process_time() - used) / tasks / 2
    print(f"measured: job {1000 * job:.1f} ms, a record {1e6 * record:.0f} us,")
    print(f"empty task {1000 * task:.2f} ms, of which the scheduler about {1000 * share:.2f} ms")
    return Costs(job, share, share + record)


def scale(costs: Costs, jobs: int, machines: int) -> None:
    """The time of a large run, and the number of workers at which the scheduler limits it."""
    for bundle in (1, 10):
        seconds = simulate(jobs, machines, 2, bundle, costs)
        ideal = jobs * costs.job / machines
        print(
            f"{jobs} jobs, {machines} workers, {bundle} a task: {seconds / 3600:.2f} h,"
            f" {100 * ideal / seconds:.0f} % of the workers' time used"
        )
    slowest = max(costs.schedule, costs.client)
    print(f"the limit is 1 / {1000 * slowest:.2f} ms = {1 / slowest:.0f} tasks/s,")
    print(f"reached by {costs.job / slowest:.0f} workers at {1000 * costs.job:.1f} ms a job")
    for count in (10, 30, 100, 300, 1000):
        seconds = simulate(20 * count, count, 2, 1, costs)
        used = 20 * costs.job / seconds
        print(f"  {count:5d} workers: {100 * used:3.0f} % used, {20 * count / seconds:6.0f} jobs/s")


def main() -> None:
    words = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    names = ("overhead", "workers", "kills", "dask", "scheduler", "catalogue", "soak", "scale")
    words.add_argument("what", nargs="?", choices=names)
    add_quick(words)
    words.add_argument("--jobs", type=int)
    words.add_argument("--size", default="48x48")
    words.add_argument("--kills", type=int, default=20)
    words.add_argument("--seconds", type=float, default=300)
    words.add_argument("--clients", type=int, default=50)
    words.add_argument("--kill-every", type=float, default=0, help="pause between kills [s]")
    words.add_argument("--machines", type=int, default=100)
    words.add_argument("--port", type=int, default=8799)
    asked = words.parse_args()
    if not asked.quick and asked.what is None:
        words.error(f"name one of: {', '.join(names)}")
    if asked.quick:
        asked.jobs, asked.kills, asked.seconds, asked.clients, asked.machines = (
            2 * FIRST,
            1,
            1.0,
            2,
            2,
        )
    for what in names if asked.quick else [asked.what]:
        with TemporaryDirectory() as temporary:
            asked.what = what
            _measure(asked, Path(temporary))


def _measure(asked: argparse.Namespace, folder: Path) -> None:
    manifest = folder / "manifest.jsonl"
    if asked.what in ("overhead", "workers"):
        jobs = plan(read_manifest(mixed(manifest, asked.jobs or 10_000, asked.size)))
        {"overhead": overhead, "workers": workers}[asked.what](jobs, folder)
    elif asked.what in ("kills", "dask"):
        more = ("--cluster",) if asked.what == "dask" else ()
        path = mixed(manifest, asked.jobs or 1000, asked.size)
        kills(path, folder, asked.kills, "--workers", "2", *more)
    elif asked.what == "scheduler":
        schedulers(mixed(manifest, asked.jobs or 1000, asked.size), folder, asked.kills, asked.port)
    elif asked.what == "catalogue":
        path = catalogue_manifest(manifest, asked.size, asked.jobs)
        kills(path, folder, asked.kills, "--workers", "2", "--cluster")
    elif asked.what == "soak":
        soak(asked.seconds, asked.clients, asked.port, asked.kill_every)
    else:
        scale(measured(folder, 50), asked.jobs or 1_000_000, asked.machines)


if __name__ == "__main__":
    main()
