"""The kernels as WebAssembly in Node: the same bits as Python's, time and size.

`python -m benchmarks.web` builds the whole module, plays banners in Node and compares; `--quick`
plays fewer steps for the times. Times are of the processor, of a step; "and shown" is with the
vertices of the thick cloth after it, which a page needs once a frame.
"""

import argparse
import gzip
import json
import shutil
import subprocess
import sys
import tempfile
import time
from collections.abc import Sequence
from hashlib import sha256
from itertools import product
from pathlib import Path
from typing import Any

import numpy as np

import drapery.web.wasm
from benchmarks.quick import add_quick, needs
from drapery import Banner, Settings
from drapery.garments import dressed_player, make_wearer
from drapery.packs import open_packs
from drapery.scenes import (
    STEP,
    LivePanel,
    StagedBody,
    live_panels,
    played_body,
    played_garment,
    repeating_garment,
)
from drapery.style import Body, body_of
from drapery.web.wasm.build import METHODS, build_module
from drapery.web.wasm.module import module_info, module_places
from drapery.web.wasm.plan import LANES, write_plan

GRIDS = (5, 9), (11, 21), (16, 31)
STEPS = 600
BANNERS = 20
SCRIPT = Path(drapery.web.wasm.__file__).with_name("cloth.js")

NODE = """
import { readFileSync } from "node:fs";
import { createHash } from "node:crypto";
import { Cloth } from "SCRIPT";
const [module, plan] = process.argv.slice(2, 4).map((path) => readFileSync(path));
const [actions, count, timed] = JSON.parse(process.argv[4]);
const cloth = await Cloth.load(module, plan);
for (const [name, ...values] of actions) cloth[name](...values);
const state = createHash("sha256").update(cloth.positions).update(cloth.velocities).digest("hex");
const cloths = await Promise.all(Array.from({ length: count }, () => Cloth.load(module, plan)));
const ways = [(each) => each.step(), (each) => each.step() ?? each.vertices];
const play = (steps, way) => { for (let n = 0; n < steps; n++) cloths.forEach(way); };
for (let n = 0; n < 10; n++) play(60, ways[1]); // until the engine has compiled the module
const times = ways.map((way) => {
  const start = process.cpuUsage();
  play(timed, way);
  const { user, system } = process.cpuUsage(start);
  return timed ? (user + system) / timed / count : 0;
});
console.log(JSON.stringify([state, ...times]));
"""

Action = list[Any]
WIND: list[Action] = [["step", STEPS]]
PULLS: list[Action] = [
    ["step", 100],
    ["setWind", -3.0, 1.0, 8.0],
    ["step", 100],
    ["pull", 44, 0.2, -1.0, 0.8],
    ["step", 100],
    ["setWind", 0.0, 0.0, 0.0],
    ["step", 50],
    ["pull", 44, -0.2, -0.8, 0.4],
    ["step", 100],
    ["release"],
    ["setWind", 2.0, 0.0, 5.0],
    ["step", 150],
]


def whole_module(quick: bool) -> bytes:
    """The module with the kernels of all methods, or of those of the tests; it is built if it is
    not yet."""
    if quick:
        sys.path.insert(0, str(Path(__file__).parents[1] / "tests"))
        from wasm_player import built_module

        return built_module()
    path = module_places()[-1]
    if not path.is_file() or not {
        f"play_{name}" for name in METHODS if name not in ("picture", "player")
    } <= set(module_info(path.read_bytes())["kernels"]):
        build_module(path)
    return path.read_bytes()


def banner(settings: Settings) -> Body:
    """A white banner."""
    return body_of(Banner.parse("white"), open_packs(()), settings)


def played(folder: Path, plan: bytes, actions: list[Action], count: int, timed: int) -> list[Any]:
    """The digest of a cloth that was played in Node, and microseconds a step of one of `count`: of
    the step, and with the vertices of the thick cloth."""
    (folder / "plan").write_bytes(plan)
    words = [folder / "module.wasm", folder / "plan", json.dumps([actions, count, timed])]
    done = subprocess.run(
        [str(shutil.which("node")), "--input-type=module", "-", *map(str, words)],
        input=NODE.replace("SCRIPT", SCRIPT.as_uri()),
        capture_output=True,
        text=True,
        check=True,
    )
    found: list[Any] = json.loads(done.stdout)
    return found


def native(settings: Settings, steps: int) -> tuple[str, float]:
    """The digest after so many steps of the solver in Python, and microseconds a step."""
    (drape,) = StagedBody(banner(settings), settings).drapes
    moving, forces = drape.begin(STEP), drape.forces(None)
    start = time.process_time()
    state = moving.advance(forces, steps).state
    spent = time.process_time() - start
    return digest(state.positions[0], state.velocities[0]), spent / steps * 1e6


def worn(wear: str, solver: Any) -> tuple[LivePanel, str, float]:
    """The last cloth on a walking player, its digest after STEPS steps in Python, and microseconds
    a step there."""
    garment = dressed_player(make_wearer(motion="walk", speed=1.5), wear=[wear])
    dressed = repeating_garment(garment, open_packs(()), garment.settings(solver=solver))
    drape, subject = dressed.drape(dressed.cloths[-1]), played_garment(dressed)
    moving, forces, pins = subject.cloths[-1].moving, drape.forces(None), drape.pins
    moving.advance(forces, 1, pins)  # loads the kernels
    start = time.process_time()
    state = moving.advance(forces, STEPS, pins).state
    spent = (time.process_time() - start) / STEPS * 1e6
    panel = live_panels(subject, LANES)[-1]
    return panel, digest(state.positions[0], state.velocities[0]), spent


def replayed(panel: LivePanel, actions: list[Action]) -> str:
    """The digest of a cloth that was played by the same kernels in Python."""
    arrays = panel.arrays

    def run(purpose: str) -> None:
        call = panel.calls[purpose]
        assert call.function(*call.arguments) == 0

    run("aim")
    for name, *values in actions:
        if name == "step":
            arrays["clock"][1] = values[0]
            run("play")
        elif name == "setWind":
            arrays["wind"][:] = values
            run("aim")
        elif name == "pull":
            arrays["grab"][0] = values[0]
            arrays["target"][:] = values[1:]
        else:
            arrays["grab"][0] = -1
    return digest(arrays["positions"], arrays["velocities"])


def digest(*arrays: Any) -> str:
    """The SHA-256 of some arrays."""
    return sha256(b"".join(np.ascontiguousarray(array).tobytes() for array in arrays)).hexdigest()


def main(arguments: Sequence[str] | None = None) -> int:
    """Print the tables; the exit status is 1 where bits differ."""
    parser = argparse.ArgumentParser("python -m benchmarks.web", description=__doc__)
    add_quick(parser)
    quick = parser.parse_args(arguments).quick
    needs(shutil.which("node"), "Node")
    timed = 60 if quick else STEPS
    solvers = ("desbrun",) if quick else ("desbrun", "xpbd")
    equal = True
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        start = time.process_time()
        module = whole_module(quick)
        (folder / "module.wasm").write_bytes(module)
        info = module_info(module)
        print(f"module: {len(module)} bytes, gzipped {len(gzip.compress(module))}")
        print(
            "solver   grid   plan, gzipped  wind  wind and pulls  native us  Node us  and shown"
            "  Node/native"
        )
        for solver in solvers:
            for grid in GRIDS[:1] if quick else GRIDS:
                options: Any = {"solver": solver, "grid": grid}
                settings = Settings(**options)
                panel = live_panels(played_body(banner(settings), settings), LANES)[0]
                plan = write_plan(panel, info)
                native(settings, 1)  # loads the kernels
                expected, there = native(settings, STEPS)
                state, here, shown = played(folder, plan, WIND, 1, timed)
                here_too = live_panels(played_body(banner(settings), settings))[
                    0
                ]  # this processor's lanes
                pulled = replayed(here_too, PULLS) == played(folder, plan, PULLS, 0, 0)[0]
                same = state == expected
                equal = equal and same and pulled
                print(
                    f"{solver:8} {grid[0]:2}x{grid[1]:2} {len(gzip.compress(plan)):14}"
                    f" {'equal' if same else 'DIFFERS':>5} {'equal' if pulled else 'DIFFERS':>15}"
                    f" {there:10.0f} {here:8.0f} {shown:10.0f} {here / there:12.2f}",
                    flush=True,
                )
        for solver, wear in product(solvers, ("cape", "elytra")):
            panel, expected, there = worn(wear, solver)
            plan = write_plan(panel, info)
            state, here, _ = played(folder, plan, WIND, 1, timed)
            equal = equal and state == expected
            print(
                f"{wear} on a player, {solver}: plan {len(gzip.compress(plan))} bytes gzipped,"
                f" {'equal' if state == expected else 'DIFFERS'}, native {there:.0f} us,"
                f" Node {here:.0f} us, {here / there:.2f}",
                flush=True,
            )
        for solver in solvers:
            options = {"solver": solver, "grid": (11, 21)}
            settings = Settings(**options)
            panel = live_panels(played_body(banner(settings), settings), LANES)[0]
            each = played(folder, write_plan(panel, info), [], BANNERS, timed)[2]
            frame = each * BANNERS / 1000
            print(
                f"{BANNERS} banners 11x21, {solver}: {frame:.1f} ms a frame of 16.7 ms, one thread"
            )
        print(f"{time.process_time() - start:.0f} s of this process")
    return 0 if equal else 1


if __name__ == "__main__":
    sys.exit(main())
