"""A schematic of the size that people share is read in well under a second."""

import random
import time

import world_maker as make
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


def test_a_megabyte_with_a_thousand_banners_is_read_under_a_second():
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
    times = []
    for _ in range(3):
        start = time.process_time()
        with untraced():
            found = [one.banner for one in find_in_bytes(data, "f")]
        times.append(time.process_time() - start)
    assert sorted(map(repr, found)) == sorted(map(repr, banners))
    assert min(times) < 1
