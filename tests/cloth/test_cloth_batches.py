"""A cloth moves by the same bits alone, in a batch, on any number of threads and any processor."""

import hashlib
import os
import subprocess
import sys
from dataclasses import replace
from itertools import islice
from pathlib import Path

import numpy as np
import pytest

from drapery.cloth import (
    Drag,
    Gravity,
    SolverDesbrun,
    SolverXPBD,
    State,
    Wind,
    grid,
    rest_state,
    simulate,
)

SOLVERS = {"desbrun": SolverDesbrun, "xpbd": SolverXPBD}
each = pytest.mark.parametrize("name", SOLVERS)
COUNT = 70
PHASES = np.linspace(0, 9, COUNT)
ORIGINS = np.random.default_rng(3).normal(size=(COUNT, 3))


def blown(count=slice(None)):
    wind = Wind((2.0, 0.0, 5.0), seed=4, phases=PHASES[count], origins=ORIGINS[count])
    return [Gravity(), wind, Drag(0.05)]


def moved(cloth, solver, forces, count, *, steps=20, every=1, dt=1 / 60, **options) -> State:
    start = rest_state(cloth, count)
    frames = simulate(cloth, solver, forces, dt, start=start, every=every, **options)
    return next(islice(frames, steps // every, None))


def digest(state):
    parts = (state.positions, state.velocities)
    whole = b"".join(np.ascontiguousarray(part).tobytes() for part in parts)
    return hashlib.sha256(whole).hexdigest()


@each
def test_threads_and_blocks_change_no_bit(name, monkeypatch):
    cloth = grid(5, 9, 0.8, 1.6)
    hashes = {
        digest(moved(cloth, SOLVERS[name](threads=threads), blown(), COUNT))
        for threads in (1, 2, 3)
    }
    monkeypatch.setattr("drapery.cloth.lanes.BLOCK_BYTES", 1)
    hashes |= {digest(moved(cloth, SOLVERS[name](threads=2), blown(), COUNT))}
    assert len(hashes) == 1


FOLDERS = [str(folder) for folder in Path(__file__).parents[:2]]
PROGRAM = """
import sys
sys.path[:0] = {folders}
from test_cloth_batches import *
print(swung())
"""


def swung():
    """A batch; `.ci/versions` compares all solvers and sheets, for each takes long to compile."""
    return digest(moved(grid(5, 9, 0.8, 1.6), SolverXPBD(threads=1), blown(), COUNT))


FORK = """
import os, sys
sys.path[:0] = {folders}
from test_cloth_batches import *

def end():
    states = simulate(grid(5, 9, 0.8, 1.6), SolverDesbrun(threads=2), count=256)
    return digest(next(islice(states, 3, None)))

def child():
    print(end(), flush=True)
    os._exit(0)

print(end(), flush=True)
if os.fork() == 0:
    child()
os.wait()
"""


@pytest.mark.skipif(not hasattr(os, "fork"), reason="this system has no fork")
def test_a_forked_child_simulates_with_new_threads():
    program = FORK.format(folders=FOLDERS)
    command = [sys.executable, "-W", "ignore::DeprecationWarning", "-c", program]
    run = subprocess.run(command, capture_output=True, text=True, timeout=120, check=True)
    parent, child = run.stdout.split()
    assert parent == child


@each
def test_each_cloth_of_a_batch_may_have_its_own_pin_path(name):
    cloth = grid(4, 6, 0.8, 1.6)
    still = cloth.rest_positions[:4]
    end = moved(cloth, SOLVERS[name](), [Gravity()], 2, pins=lambda t: np.stack([still, still + t]))
    np.testing.assert_allclose(end.positions[1, :4] - end.positions[0, :4], 1 / 3, atol=1e-6)


@each
def test_a_custom_force_that_is_gravity_is_gravity(name):
    class Pull:
        def acceleration(self, cloth, state):
            return np.broadcast_to([0.0, -9.81, 0.0], cloth.rest_positions.shape)

    cloth = grid(4, 6, 0.8, 1.6)
    known, custom = (moved(cloth, SOLVERS[name](), [force], 1) for force in (Gravity(), Pull()))
    np.testing.assert_allclose(known.positions, custom.positions, atol=5e-3)


@each
def test_slow_motion_is_flushed_to_rest_and_never_subnormal(name):
    cloth = grid(4, 6, 0.8, 1.6)
    start = rest_state(cloth)
    start = replace(start, velocities=start.velocities + np.float32(1e-12))
    end = next(islice(simulate(cloth, SOLVERS[name](), [], start=start), 50, None))
    for values in (end.positions, end.velocities):
        size = np.abs(values[values != 0])
        assert not ((size > 0) & (size < np.finfo(np.float32).tiny)).any()
    assert not end.velocities.any()
