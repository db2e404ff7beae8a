"""Settings that tore cloth, and others at random: `benchmarks/storms.py` has more of them."""

import pytest

from benchmarks.storms import DEEPEST, LIMIT, SEEN, measured, storms

COUNT = 29
RANDOM = list(storms(COUNT, seed=5, largest=15))


def check(storm, seconds):
    found = measured(storm, seconds, crossings=False)
    assert found.stretch <= LIMIT, f"torn: {storm.text}"
    assert found.depth <= DEEPEST, f"in a solid: {storm.text}"


@pytest.mark.filterwarnings("ignore")  # a transient strain that cannot be held is told
@pytest.mark.parametrize("number", range(len(RANDOM)))
def test_an_allowed_setting_tears_nothing(number):
    check(RANDOM[number], 1.0)


@pytest.mark.parametrize("storm", SEEN, ids=lambda storm: storm.text)
def test_what_tore_is_whole(storm):
    check(storm, 0.5)
