"""Cloth against its peers on the same workloads: `python -m benchmarks.cloth`.

Every system runs in a process of its own, one after another, and prints steps per second with the
largest stretch it had. W1: 4913 small banners of the size, masses and springs of the project's
seed; W2: one fine banner; W3: one sheet of 257 x 257. W1 has gusts of wind for ours, none for
peers; the others hang in still air. A peer that cannot hold a workload steps fewer cloths, and its
figure is scaled to all of them, marked with ~. A number behind a name is its substeps or passes.
"""

import argparse
import json
import multiprocessing
import resource
from collections.abc import Iterator, Sequence
from dataclasses import asdict, dataclass, replace
from importlib import import_module
from pathlib import Path
from queue import Empty
from time import perf_counter
from typing import Any

import numpy as np
from rich.progress import Progress

from benchmarks.peers import Load, Runner, stretch
from benchmarks.quick import add_quick
from drapery.cloth import Cloth, Fabric, Gravity, SolverDesbrun, SolverXPBD, Wind, grid, rest_state

SEED = {"width": 1.25, "height": 2.5, "mass": 1.0, "stiffness": (50.0, 10.0, 2.0)}
WORKLOADS = {
    "W1": Load(4913, 5, 9, 0, **SEED),
    "W2": Load(1, 21, 41, 0),
    "W3": Load(1, 257, 257, 0, mass=6.3e-6),
}
LIMITS = {"W1": 0.05, "W2": 0.02, "W3": 0.05}
STILL = ("W2", "W3")
"""The workloads without wind."""
OURS = {"W1": (("desbrun", 0), ("xpbd", 0), ("xpbd", 3))}
"""Our solvers and their substeps; 0 is their default."""
LINEAR = 100, 1000, 10_000, 100_000
PEERS = ("numpy_loop", "numpy_vector", "newton", "mujoco", "pypbd", "taichi")
QUICK = ("numpy_loop", "numpy_vector")
SETTLE_STEPS = 120
TIME_LIMIT = 150.0


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
    """Our own solver as a runner."""

    def __init__(self, load: Load, solver: Any, windy: bool) -> None:
        self.load, self.solver, self.cloth = load, solver, our_cloth(load)
        places = np.arange(load.cloths)[:, None] * np.array([1.3, 0.0, 0.7])
        winds = [Wind((1.0, 0.0, 5.0), origins=places)] if windy else []
        self.forces = (Gravity(), *winds)
        self.solver_state = solver.init(self.cloth, load.dt)
        self.state = rest_state(self.cloth, load.cloths, np.float32)

    def step(self, count: int) -> None:
        self.state, self.solver_state = self.solver.step(
            self.cloth, self.state, self.solver_state, self.forces, self.load.dt, steps=count
        )

    def positions(self) -> np.ndarray:
        return self.state.positions.reshape(self.load.cloths, self.load.rows, self.load.columns, 3)


def our_cloth(load: Load) -> Cloth:
    density = load.mass * load.columns * load.rows / (load.width * load.height)
    size = load.columns, load.rows, load.width, load.height
    return grid(*size, fabric=Fabric(density, *load.stiffness))


def our_solver(name: str, threads: int, substeps: int) -> Any:
    kind = {"desbrun": SolverDesbrun, "xpbd": SolverXPBD}[name]
    return kind(threads=threads, substeps=substeps or None)


def measure(workload: str, whole: Load, system: str, effort: int, seconds: float) -> Row:
    """Settle, then step for about this time [s]; the rate is the best of three periods."""
    load, scale = whole, 1.0
    own = system.startswith("drapery")
    if own:
        _, name, count = system.split("-")
        threads, method = int(count), our_solver(name, int(count), effort)
        Ours(Load(1, load.columns, load.rows, 0), method, True).step(
            1
        )  # the code is compiled by now
    else:
        peer = import_module(f"benchmarks.peers.{system}")
        threads = peer.THREADS
        fits = max(1, peer.MOST_PARTICLES // (load.columns * load.rows))
        scale = max(1.0, load.cloths / fits)
        load = replace(load, cloths=min(load.cloths, fits), effort=effort)
    before = peak_memory()
    runner = Ours(load, method, workload not in STILL) if own else peer.start(load)
    rate, worst = _pace(runner, load, seconds)
    rate /= scale
    memory = (peak_memory() - before) / load.particles
    label = f"{system.rsplit('-', 1)[0] if own else system}{f'({effort})' if effort else ''}"
    particle_steps = rate * whole.particles
    return Row(workload, label, threads, rate, particle_steps, worst, memory, scale > 1)


def peak_memory() -> int:
    """Peak memory of this process [bytes]."""
    return 1024 * resource.getrusage(resource.RUSAGE_SELF).ru_maxrss


def _pace(runner: Runner, load: Load, seconds: float) -> tuple[float, float]:
    start = perf_counter()
    runner.step(1)
    first = perf_counter() - start
    # A slow system settles for fewer steps; its stretch is then the value reached so far.
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
    except Exception as fault:  # a peer may fail in any way; continue with the table
        queue.put(
            f"{type(fault).__name__}: {str(fault).splitlines()[0][:100] if str(fault) else ''}"
        )


def run(workload: str, load: Load, system: str, effort: int, seconds: float) -> Row | str:
    """Measure in a new process; returns an error line if that fails."""
    context = multiprocessing.get_context("spawn")
    queue = context.Queue()
    child = context.Process(target=_child, args=(queue, workload, load, system, effort, seconds))
    child.start()
    try:
        found: Row | str = queue.get(timeout=TIME_LIMIT)
    except Empty:
        found = f"took over {TIME_LIMIT:.0f} s"
    child.kill()
    child.join()
    return found


def systems(workload: str, quick: bool) -> Iterator[tuple[str, int]]:
    """The systems to run, with their substeps or passes."""
    for name, substeps in OURS.get(workload, (("desbrun", 0), ("xpbd", 0))):
        for threads in (1, 2) if WORKLOADS[workload].cloths > 1 else (1,):
            yield f"drapery-{name}-{threads}", substeps
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


def ratios(rows: list[Row]) -> Iterator[str]:
    """The speed of each of our solvers relative to the best peers.

    There are two ratios: to the best peer within the workload's stretch limit, and to the best peer
    that stretches no more than our solver.
    """
    for row in (row for row in rows if "drapery" in row.system):
        limit = LIMITS[row.workload]
        peers = [r for r in rows if r.workload == row.workload and "drapery" not in r.system]
        yield (
            f"{row.workload}  {row.system:16} {row.threads} thread{'s' * (row.threads > 1)}: "
            f"{_against(row, peers, limit)} at stretch <= {100 * limit:.0f} %, "
            f"{_against(row, peers, row.max_stretch)} at ours of {100 * row.max_stretch:.1f} %"
        )


def _against(row: Row, peers: list[Row], limit: float) -> str:
    good = [peer for peer in peers if peer.max_stretch <= limit]
    best = max(good, key=lambda peer: peer.steps_per_s, default=None)
    if best is None:
        return "no peer"
    return f"{row.steps_per_s / best.steps_per_s:.1f} x {best.system}"


def rooflines(rows: list[Row]) -> Iterator[str]:
    """A roofline result for each of our solvers on one thread."""
    from benchmarks import roofline

    machine = roofline.measured()
    for row in rows:
        if "drapery" in row.system and row.threads == 1:
            load = WORKLOADS[row.workload]
            name, _, effort = row.system.removeprefix("drapery-").partition("(")
            method, cloth = our_solver(name, 1, int(effort.rstrip(")") or 0)), our_cloth(load)
            cost = roofline.cost(cloth, method.init(cloth, load.dt), row.workload not in STILL)
            label = f"{row.workload}  {row.system}"
            yield roofline.show(label, cost, machine, row.particle_steps_per_s)


def linear(counts: Sequence[int], seconds: float) -> list[Row]:
    """Time desbrun and xpbd in wind on increasing numbers of small banners; shows progress."""
    rows = []
    with Progress() as progress:
        for name in ("desbrun", "xpbd"):
            bar = progress.add_task(name, total=sum(counts))
            for count in counts:
                load = replace(WORKLOADS["W1"], cloths=count)
                found = run(str(count), load, f"drapery-{name}-2", 0, seconds)
                progress.advance(bar, count)
                if isinstance(found, Row):
                    rows.append(found)
                    per_cloth, memory = 1e9 / (found.steps_per_s * count), found.bytes_per_particle
                    progress.print(
                        f"{count:7} cloths, {name:7} {found.steps_per_s:8.1f} steps/s,"
                        f" {per_cloth:5.0f} ns a cloth, {memory:.0f} bytes a particle"
                    )
    return rows


def compare(workloads: Sequence[str], quick: bool) -> list[Row]:
    """The table. quick: few cloths, and of the peers only those of plain numpy."""
    print(
        f"{'':3} {'system':20} {'threads':>7} {'steps/s':>12} {'particle steps':>15}"
        f" {'stretch':>11} {'bytes':>9}"
    )
    rows: list[Row] = []
    for workload in workloads:
        for system, effort in systems(workload, quick):
            load = WORKLOADS[workload]
            if quick:
                load = replace(load, cloths=min(load.cloths, 8))
            found = run(workload, load, system, effort, 0.02 if quick else 2.0)
            if isinstance(found, str):
                print(f"{workload}  {system}({effort}): left out: {found}", flush=True)
            else:
                rows.append(found)
                print(show(found), flush=True)
    print()
    for line in (*ratios(rows), *rooflines(rows)):
        print(line)
    return rows


def main() -> None:
    words = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    add_quick(words)
    words.add_argument("--json", type=Path, metavar="FILE", help="write the rows")
    words.add_argument("--only", nargs="*", metavar="W", choices=WORKLOADS, help="these alone")
    words.add_argument("--linear", action="store_true", help="100 to 100,000 cloths instead")
    words.add_argument(
        "--endurance",
        type=int,
        nargs="?",
        const=1_000_000,
        metavar="STEPS",
        help="so many steps (a million) of every solver in random gusts instead",
    )
    asked = words.parse_args()
    if asked.endurance:
        from benchmarks.endurance import endure_all, show as show_endured

        found: list[Any] = endure_all(asked.endurance)
        print(*map(show_endured, found), sep="\n")
    elif asked.linear:
        found = linear(LINEAR, 2.0)
    else:
        found = compare(asked.only or ("W1", "W2", "W3")[: 2 if asked.quick else 3], asked.quick)
    if asked.json:
        rows = [
            {name: None if value != value else value for name, value in asdict(row).items()}
            for row in found
        ]
        asked.json.write_text(json.dumps(rows, indent=1))


if __name__ == "__main__":
    main()
