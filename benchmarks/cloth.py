"""Cloth against its peers on the same workloads: `python -m benchmarks.cloth [--quick] [--json F]`.

Every system runs in a process of its own, one after another, and prints steps per second with the
largest stretch it had. W1: 4913 small banners; W2: one fine banner; W3: one sheet of 257 x 257.
Peers run without wind, ours with gusts. A peer that cannot hold a workload steps fewer cloths, and
its figure is scaled to all of them, marked with ~.
"""

import argparse
import json
import multiprocessing
import resource
from collections.abc import Callable, Iterator
from dataclasses import asdict, dataclass
from importlib import import_module
from pathlib import Path
from queue import Empty
from time import perf_counter
from typing import Any

import numpy as np

from benchmarks.peers import Load, Runner, stretch

WORKLOADS = {"W1": Load(4913, 5, 9, 0), "W2": Load(1, 21, 41, 0), "W3": Load(1, 257, 257, 0)}
PEERS = ("numpy_loop", "numpy_vector", "newton", "mujoco", "pypbd", "taichi")
QUICK = ("numpy_loop", "numpy_vector")
SETTLE_STEPS = 120
TIME_LIMIT = 240.0


@dataclass(frozen=True)
class Row:
    """One system on one workload."""

    workload: str
    system: str
    threads: int
    steps_per_s: float
    particle_steps_per_s: float
    max_stretch: float
    bytes_per_particle: float
    scaled: bool = False


class Ours:
    """Our own solver as a runner, wind included."""

    def __init__(self, load: Load, solver: Any) -> None:
        from drapery.cloth import Gravity, Wind, grid, rest_state

        self.load, self.solver = load, solver
        self.cloth = grid(load.columns, load.rows, load.width, load.height)
        places = np.arange(load.cloths)[:, None] * np.array([1.3, 0.0, 0.7])
        self.forces = (Gravity(), Wind((1.0, 0.0, 5.0), origins=places))
        self.memory = solver.init(self.cloth, load.dt)
        self.state = rest_state(self.cloth, load.cloths, np.float32)

    def step(self, count: int) -> None:
        self.state, self.memory = self.solver.step(
            self.cloth, self.state, self.memory, self.forces, self.load.dt, steps=count
        )

    def positions(self) -> np.ndarray:
        return self.state.positions.reshape(self.load.cloths, self.load.rows, self.load.columns, 3)


def ours(name: str, threads: int | None) -> Callable[[Load], Runner]:
    from drapery.cloth import SolverDesbrun, SolverXPBD

    kind = {"desbrun": SolverDesbrun, "xpbd": SolverXPBD}[name]
    return lambda load: Ours(load, kind(threads=threads))


def measure(workload: str, system: str, effort: int, seconds: float) -> Row:
    """Settle, then step for about so many seconds; the best of three stretches of time."""
    load = WORKLOADS[workload]
    scale = 1.0
    if system.startswith("drapery"):
        _, name, count = system.split("-")
        threads, start = int(count), ours(name, int(count))
    else:
        peer = import_module(f"benchmarks.peers.{system}")
        threads, start = peer.THREADS, peer.start
        fits = max(1, peer.MOST_PARTICLES // (load.columns * load.rows))
        scale = max(1.0, load.cloths / fits)
        load = Load(min(load.cloths, fits), load.columns, load.rows, effort)
    before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    runner = start(load)
    rate, worst = _pace(runner, load, seconds)
    memory = 1024 * (resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before)
    rate /= scale
    particles = WORKLOADS[workload].particles
    label = system if system.startswith("drapery") else f"{system}({effort})"
    return Row(
        workload, label, threads, rate, rate * particles, worst, memory / load.particles, scale > 1
    )


def _pace(runner: Runner, load: Load, seconds: float) -> tuple[float, float]:
    start = perf_counter()
    runner.step(1)
    first = perf_counter() - start
    # A slow system is not made to settle for minutes; its stretch is then what it has got to.
    settle = int(min(SETTLE_STEPS, max(2, 4 * seconds / max(first, 1e-9))))
    runner.step(settle)
    worst = stretch(load, runner.positions())
    count, rates = 1, []
    while len(rates) < 3:
        start = perf_counter()
        runner.step(count)
        took = perf_counter() - start
        if took < seconds / 3 and count < 1 << 20:
            count = max(count + 1, int(count * min(8.0, seconds / 3 / max(took, 1e-9))))
            continue
        rates.append(count / took)
    return max(rates), max(worst, stretch(load, runner.positions()))


def _child(queue: Any, *what: Any) -> None:
    try:
        queue.put(measure(*what))
    except Exception as fault:  # a peer may fail in any way; the table goes on
        queue.put(
            f"{type(fault).__name__}: {str(fault).splitlines()[0][:100] if str(fault) else ''}"
        )


def run(workload: str, system: str, effort: int, seconds: float) -> Row | str:
    """Measure in a process of its own; a line of words where that fails."""
    context = multiprocessing.get_context("spawn")
    queue = context.Queue()
    child = context.Process(target=_child, args=(queue, workload, system, effort, seconds))
    child.start()
    try:
        found: Row | str = queue.get(timeout=TIME_LIMIT)
    except Empty:
        found = f"took over {TIME_LIMIT:.0f} s"
    child.kill()
    child.join()
    return found


def systems(quick: bool) -> Iterator[tuple[str, int]]:
    for name in ("desbrun", "xpbd"):
        for threads in (1, 2):
            yield f"drapery-{name}-{threads}", 0
    for name in QUICK if quick else PEERS:
        for effort in import_module(f"benchmarks.peers.{name}").EFFORTS:
            yield name, effort


def show(row: Row) -> str:
    mark = "~" if row.scaled else " "
    return (
        f"{row.workload}  {row.system:20} {row.threads:7} {mark}{row.steps_per_s:11.1f}"
        f" {row.particle_steps_per_s:15.3g} {100 * row.max_stretch:9.2f} %"
        f" {row.bytes_per_particle:9.0f}"
    )


def ratios(rows: list[Row], limits: dict[str, float]) -> Iterator[str]:
    """Ours over the best peer that stretches no more than the workload allows."""
    for workload, limit in limits.items():
        here = [row for row in rows if row.workload == workload]
        good = [r for r in here if "drapery" not in r.system and r.max_stretch <= limit]
        best = max(good, key=lambda row: row.steps_per_s, default=None)
        for row in here:
            if "drapery" in row.system:
                against = (
                    f"{row.steps_per_s / best.steps_per_s:.1f} x {best.system}"
                    if best
                    else "no peer keeps to it"
                )
                yield f"{workload}  {row.system:20} stretch <= {100 * limit:.0f} %: {against}"


def main() -> None:
    words = argparse.ArgumentParser(description=__doc__)
    words.add_argument("--quick", action="store_true", help="W1 and W2, ours and numpy's alone")
    words.add_argument("--json", metavar="FILE", help="write the rows")
    words.add_argument("--only", nargs="*", metavar="W", help="only these workloads")
    asked = words.parse_args()
    chosen = asked.only or (("W1", "W2") if asked.quick else tuple(WORKLOADS))
    print(
        f"{'':3} {'system':20} {'threads':>7} {'steps/s':>12} {'particle steps':>15}"
        f" {'stretch':>11} {'bytes':>9}"
    )
    rows: list[Row] = []
    for workload in chosen:
        for system, effort in systems(asked.quick):
            found = run(workload, system, effort, 0.6 if asked.quick else 2.0)
            if isinstance(found, str):
                print(f"{workload}  {system}({effort}): left out: {found}")
            else:
                rows.append(found)
                print(show(found), flush=True)
    print()
    for line in ratios(rows, {w: {"W1": 0.05, "W2": 0.02, "W3": 0.05}[w] for w in chosen}):
        print(line)
    if asked.json:
        Path(asked.json).write_text(json.dumps([asdict(row) for row in rows], indent=1))


if __name__ == "__main__":
    main()
