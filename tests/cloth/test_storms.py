"""Settings that tore cloth, and others at random: `benchmarks/storms.py` has more of them."""

import numpy as np
import pytest

from benchmarks.storms import DEEPEST, LIMIT, SEEN, measured, storms

COUNT = 29
RANDOM = list(storms(COUNT, seed=5, largest=15))
FINE = SEEN[-1]
THICK_CAPES = [
    pytest.param(storm, id=storm.text, marks=[pytest.mark.slow] if storm is FINE else [])
    for storm in (RANDOM.pop(25), FINE)
]
"""They begin nearer to their wearer than their thickness allows, and their pins hold them there."""


def check(storm, seconds):
    found = measured(storm, seconds, crossings=False)
    assert found.stretch <= LIMIT, f"torn: {storm.text}"
    assert found.depth <= DEEPEST, f"in a solid: {storm.text}"


@pytest.mark.filterwarnings("ignore")  # a transient strain that cannot be held is told
@pytest.mark.parametrize("number", range(len(RANDOM)))
def test_an_allowed_setting_tears_nothing(number):
    check(RANDOM[number], 1.0)


@pytest.mark.parametrize("storm", SEEN[:-1], ids=lambda storm: storm.text)
def test_what_tore_is_whole(storm):
    check(storm, 0.5)


@pytest.mark.parametrize("storm", THICK_CAPES)
def test_a_thick_cape_that_its_wearer_stretches_is_finite_and_told(storm):
    with pytest.warns(UserWarning, match="pins or colliders pull cloth 0 apart"):
        assert np.isfinite(measured(storm, 0.5, crossings=False).stretch)
