"""The faces that an editor lays over each other are those of the packs' sheets."""

import gzip
from pathlib import Path
from typing import Literal

import numpy as np
import pytest
from pack_maker import BANNER, META, mcmeta, noise, png, zip_pack

from drapery.banner import FLAG_REGIONS, PATTERN_NAMES, SHIELD_REGIONS
from drapery.packs import open_packs
from drapery.web.face_file import MAX_SCALE, face_bytes
from drapery.web.messages import unpack


@pytest.mark.parametrize("kind", ["banner", "shield"])
def test_each_pattern_has_the_texels_of_its_front(kind: Literal["banner", "shield"]) -> None:
    packs = open_packs(())
    header, arrays = unpack(gzip.decompress(face_bytes(kind, packs, PATTERN_NAMES)))
    assert header["sheets"] == ["", *PATTERN_NAMES] and header["scale"] == 1
    front = (FLAG_REGIONS if kind == "banner" else SHIELD_REGIONS)["front"]
    width, height = header["front"]["width"], header["front"]["height"]
    masks = arrays["masks"].reshape(-1, height, width, 4)
    for name in ("creeper", "gradient"):
        wanted = front.sample(packs.sheet(name, kind), 1)
        np.testing.assert_array_equal(masks[header["sheets"].index(name)], wanted)


@pytest.mark.parametrize(("side", "scale"), [(128, 2), (1024, MAX_SCALE)])
def test_a_larger_pack_has_larger_faces(tmp_path: Path, side: int, scale: int) -> None:
    files = {META: mcmeta(), f"{BANNER}creeper.png": png(noise(1, side))}
    packs = open_packs((zip_pack(tmp_path / "large.zip", files),))
    header, arrays = unpack(gzip.decompress(face_bytes("banner", packs, ("creeper",))))
    assert header["scale"] == scale
    assert header["front"] == {"width": 20 * scale, "height": 40 * scale}
    assert len(arrays["masks"]) == 3 * 4 * 20 * 40 * scale * scale
