"""The page's JavaScript: its unit tests run, and it agrees with the server on bytes and cameras."""

import json
import shutil
import subprocess
from dataclasses import astuple
from pathlib import Path

import numpy as np
import pytest

from drapery.render.camera import Camera, clip_matrix
from drapery.web.messages import pack

NODE = shutil.which("node")
HERE = Path(__file__).parent
VIEWER = HERE.parent / "drapery" / "web" / "viewer"

pytestmark = pytest.mark.skipif(NODE is None, reason="node is not installed (apt: nodejs)")


def run_node(*words: str | Path, stdin: str = "") -> str:
    """What node prints; AssertionError with all its output if it fails."""
    command = [str(NODE), *map(str, words)]
    done = subprocess.run(
        command, input=stdin, cwd=HERE / "js", capture_output=True, text=True, timeout=120
    )
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout


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
