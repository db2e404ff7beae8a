"""What a preset of a fabric must keep to; this is the test kit for a new one."""

from itertools import islice
from typing import get_args

import numpy as np
import pytest

from drapery.cloth import FABRICS, Gravity, Wind, grid, max_stretch, simulate
from drapery.settings import FabricName


def test_every_fabric_can_be_named_in_an_option() -> None:
    assert get_args(FabricName) == tuple(FABRICS)


@pytest.mark.parametrize("name", FABRICS)
def test_a_fabric_hangs_and_waves_without_much_stretch(name: str) -> None:
    cloth = grid(5, 9, 0.8, 1.6, fabric=FABRICS[name])
    forces = (Gravity(), Wind((0.0, 0.0, 4.0)))
    for state in islice(simulate(cloth, forces=forces, every=60), 1, 4):
        assert np.isfinite(state.positions).all()
        assert max_stretch(state.positions, cloth) < 0.1
