"""A schematic of the size that people share is read whole."""

import random

import world_maker as make
from cost import limited_cost
from tracing import untraced

from drapery.banner.design import Banner, Layer
from drapery.banner.dyes import DYE_NAMES
from drapery.banner.formats.files import find_in_bytes
from drapery.banner.patterns import PATTERN_NAMES


def a_banner(rng: random.Random) -> Banner:
    return Banner(
        rng.choice(DYE_NAMES),
        tuple(Layer(rng.choice(PATTERN_NAMES), rng.choice(DYE_NAMES)) for _ in range(6)),
    )


def test_a_megabyte_with_a_thousand_banners_is_read_in_a_bounded_time():
    rng = random.Random(7)
    banners = [a_banner(rng) for _ in range(1000)]
    blocks = {
        (n % 10, n // 10 % 10, n // 100): (make.block_id(banner), make.entity(banner))
        for n, banner in enumerate(banners)
    }
    tree = make.schem(2, (100, 10, 100), blocks, padding=250)
    # Noise that no packing makes smaller, as the blocks of a real build are.
    tree["BiomeData"] = make.ByteArray([rng.randrange(-128, 128) for _ in range(2**20)])
    data = make.nbt_file(tree)
    assert len(data) > 2**20
    with limited_cost(), untraced():
        found = [one.banner for one in find_in_bytes(data, "f")]
    assert sorted(map(repr, found)) == sorted(map(repr, banners))
