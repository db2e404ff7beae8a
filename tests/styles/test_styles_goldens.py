"""A picture of each preset that has been looked at."""

import pytest

from drapery import Banner, draw
from drapery.styles.catalogue import PRESETS
from drapery.testing.plugin import Golden

BANNER = Banner.parse("white creeper:lime border:black")


@pytest.mark.parametrize("name", PRESETS)
def test_a_preset_looks_as_it_did(name: str, golden: Golden) -> None:
    golden(draw(BANNER, style=name, size=(144, 192), grid=(9, 17), time=2.0), name)
