"""The page's JavaScript: its unit tests run, and it agrees with the server on bytes and cameras."""

import json
from dataclasses import astuple
from pathlib import Path

import numpy as np
import pytest
from node_program import NODE, run_node

from drapery.render.camera import Camera, clip_matrix
from drapery.render.flatten import composite_layers
from drapery.render.materials import make_material_tables
from drapery.render.scene import Alpha, Material, TextureLayer
from drapery.web.messages import pack

HERE = Path(__file__).parents[1]
VIEWER = HERE.parent / "drapery" / "web" / "viewer"

pytestmark = pytest.mark.skipif(NODE is None, reason="node is not installed (apt: nodejs)")


def run_module(script: str, *words: str | Path) -> object:
    """The JSON that a module of JavaScript prints; `viewer` is the folder of the viewer."""
    script = script.replace("viewer/", f"{VIEWER.as_uri()}/")
    return json.loads(run_node("--input-type=module", "-", *words, stdin=script))


def test_the_unit_tests_pass() -> None:
    run_node("--test")


UNPACK = """
import { readFileSync } from "node:fs";
import { unpack } from "viewer/messages.js";
const bytes = readFileSync(process.argv[2]);
const { header, arrays } = unpack(Uint8Array.from(bytes).buffer);
const listed = Object.entries(arrays).map(([name, a]) => [name, a.constructor.name, [...a]]);
console.log(JSON.stringify([header.kind, listed]));
"""


def test_the_browser_unpacks_what_the_server_packs(tmp_path: Path) -> None:
    arrays = {
        "positions": np.array([1.5, -2.0, 0.25], np.float32),
        "atlas": np.array([0, 255, 7], np.uint8),
        "triangles": np.array([2**32 - 1], np.uint32),
        "runs": np.array([-1, 5], np.int32),
        "nothing": np.zeros(0, np.float32),
    }
    (tmp_path / "message").write_bytes(pack({"kind": "scène"}, arrays))
    types = ("Float32Array", "Uint8Array", "Uint32Array", "Int32Array", "Float32Array")
    assert run_module(UNPACK, tmp_path / "message") == [
        "scène",
        [[name, kind, arrays[name].tolist()] for name, kind in zip(arrays, types, strict=True)],
    ]


CLIP = """
import { clipMatrix, readCamera } from "viewer/matrices.js";
const [camera, aspect] = JSON.parse(process.argv[2]);
console.log(JSON.stringify([...clipMatrix(readCamera(camera), aspect)]));
"""


@pytest.mark.parametrize("height", [None, 2.5])
def test_the_browser_projects_as_the_renderer_does(height: float | None) -> None:
    camera = Camera((3.0, 2.0, 5.0), (0.5, 1.0, -1.0), fov=35.0, height=height)
    found = run_module(CLIP, json.dumps([astuple(camera), 1.6]))
    wanted = clip_matrix(camera, (160, 100))
    np.testing.assert_allclose(np.array(found).reshape(4, 4).T, wanted, rtol=1e-5, atol=1e-6)


COMPOSITED = """
import { composited } from "viewer/texels.js";
const [atlas, width, materials, layers] = JSON.parse(process.argv[2]);
const tables = [materials, layers].map((table) => Int32Array.from(table.flat()));
const { texels, size, rects } = composited(Uint8Array.from(atlas), width, ...tables);
console.log(JSON.stringify([[...texels], size, rects]));
"""


def test_the_browser_composites_layers_as_the_renderer_does() -> None:
    rng = np.random.default_rng(5)

    def layer(width: int, height: int) -> TextureLayer:
        texels = rng.integers(0, 256, (height, width, 4), np.uint8)
        texels[0, :2, 3] = 0, 255
        red, green, blue = (int(each) for each in rng.integers(0, 256, 3))
        return TextureLayer(texels, (red, green, blue))

    modes: tuple[Alpha, ...] = ("opaque", "cutout", "blend")
    materials = [Material((layer(4, 8), layer(8, 2), layer(4, 4)), alpha=mode) for mode in modes]
    tables = make_material_tables([*materials, Material((layer(3, 5),))])
    flat = composite_layers(tables)
    assert len(flat.layer_rects) == len(flat.material_layers), "Python composites them too"
    kinds = np.stack([tables.material_alpha, tables.material_lit], axis=1)
    rows = np.concatenate([tables.material_layers, kinds], axis=1)
    layers = np.concatenate([tables.layer_rects, tables.layer_tints], axis=1)
    lists = [tables.atlas.ravel(), tables.atlas.shape[1], rows, layers]
    found = run_module(COMPOSITED, json.dumps([np.asarray(each).tolist() for each in lists]))
    assert isinstance(found, list)
    data, (width, height), rects = found
    texels = np.array(data, np.uint8).reshape(height, width, 4)
    for rect, (left, top, wide, high) in zip(rects, flat.layer_rects, strict=True):
        x, y, *size = rect
        assert size == [wide, high]
        wanted = flat.atlas[top : top + high, left : left + wide]
        np.testing.assert_array_equal(texels[y : y + high, x : x + wide], wanted)


TWO_SIZES = """
import { composited } from "viewer/texels.js";
const layers = Int32Array.from([0, 0, 2, 1, 255, 255, 255, 2, 0, 3, 1, 255, 255, 255]);
const alphas = { 10: 255, 20: 255, 1: 0, 2: 255, 3: 0 };
const atlas = Uint8Array.from([10, 20, 1, 2, 3].flatMap((red) => [red, 0, 0, alphas[red]]));
const { texels, size } = composited(atlas, 5, Int32Array.from([0, 2, 0, 1]), layers);
console.log(JSON.stringify([size, [...texels].filter((_, place) => place % 4 === 0)]));
"""


def test_layers_that_do_not_divide_each_other_keep_their_texels() -> None:
    assert run_module(TWO_SIZES) == [[6, 1], [10, 10, 2, 2, 20, 20]]
