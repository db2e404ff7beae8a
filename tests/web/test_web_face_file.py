"""The faces that an editor lays over each other are those of the packs' sheets."""

import gzip
import json
import random
from pathlib import Path
from typing import Literal

import numpy as np
import pytest
from node_program import NODE, run_node
from pack_maker import BANNER, META, mcmeta, noise, png, zip_pack

from drapery import Banner, Layer
from drapery.banner import DYE_NAMES, FLAG_REGIONS, PATTERN_NAMES, SHIELD_REGIONS, simplify
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


SEEN = """
import { readFileSync } from "node:fs";
import { Faces } from "web/designer/faces.js";
const [file, designs] = process.argv.slice(2);
const faces = Faces.read(Uint8Array.from(readFileSync(file)).buffer);
function seen(design) {
  const unseen = faces.unseen(design);
  return design.layers.filter((each) => !unseen.includes(each));
}
console.log(JSON.stringify(JSON.parse(designs).map(seen)));
"""
WEB = Path(__file__).parents[2] / "drapery" / "web"


@pytest.mark.skipif(NODE is None, reason="node is not installed (apt: nodejs)")
def test_the_editor_leaves_out_the_layers_that_python_leaves_out(tmp_path: Path) -> None:
    chance = random.Random(5)
    packs = open_packs(())
    designs = []
    for _ in range(20):
        dyes = chance.sample(DYE_NAMES, 3)
        layers = [Layer(chance.choice(PATTERN_NAMES), chance.choice(dyes)) for _ in range(6)]
        designs.append(Banner(dyes[0], (*layers, layers[0], layers[0])))
    wanted = [[layer.pattern for layer in simplify(each, packs).layers] for each in designs]
    assert any(len(each) < 8 for each in wanted)
    (tmp_path / "faces").write_bytes(gzip.decompress(face_bytes("banner", packs, PATTERN_NAMES)))
    trees = [
        {
            "base": each.base,
            "layers": [{"pattern": layer.pattern, "dye": layer.dye} for layer in each.layers],
        }
        for each in designs
    ]
    # What no pack has may be seen.
    trees.append({"base": "white", "layers": [{"pattern": "a:b", "dye": "white"}]})
    script = SEEN.replace("web/designer", f"{WEB.as_uri()}/designer")
    args = "--input-type=module", "-", tmp_path / "faces", json.dumps(trees)
    found = json.loads(run_node(*args, stdin=script))
    names = [[layer["pattern"] for layer in each] for each in found]
    assert names == [*wanted, ["a:b"]]
