"""Players with capes and elytra in pages: the bits of Python, their poses, textures and limits."""

import gzip
import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest

pytest.importorskip("ziglang", reason="ziglang is not installed (drapery-mc[web-build])")
pytest.importorskip("wasmtime", reason="wasmtime is not installed (drapery-mc[dev])")

from node_program import NODE, run_node
from wasm_player import WasmPlayer, built_module

from drapery.errors import OptionError
from drapery.garments import Garment, dressed_player, find_garment, make_wearer
from drapery.packs import open_packs
from drapery.scenes import Dressed, live_panels, played_garment, repeating_garment
from drapery.style.skins import read_skin
from drapery.web.messages import unpack
from drapery.web.page import page_text
from drapery.web.scene_file import scene_bytes
from drapery.web.wasm.module import module_info
from drapery.web.wasm.plan import LANES, write_plan

MIDDLE = np.array([0.5, 0.0, 0.5])
TEXTURES = Path(__file__).parents[2] / "drapery" / "web" / "component" / "textures.js"


def player(wear: str = "cape", **fields: Any) -> Garment:
    who = make_wearer(**{"motion": "walk", "speed": 1.5, **fields})
    return dressed_player(who, wear=[wear])


def repeating(garment: Garment, **options: Any) -> Dressed:
    settings = garment.settings(solver="desbrun", rotation=0, **options)
    return repeating_garment(garment, open_packs(()), settings)


@pytest.mark.usefixtures("playable")
@pytest.mark.parametrize("wear", ["cape", "elytra"])
def test_600_steps_on_a_walking_player_have_the_bits_of_python(wear: str) -> None:
    worn = repeating(player(wear))
    panel, sewn = live_panels(played_garment(worn), LANES)[-1], worn.cloths[-1]
    here = WasmPlayer(built_module(), write_plan(panel, module_info(built_module())))
    here.step(599)
    here.step(1)
    drape, begun = worn.drape(sewn), played_garment(worn).cloths[-1].moving
    moving = begun.advance(drape.forces(None), 600, drape.pins)
    assert np.array_equal(here.read("positions"), moving.state.positions[0].ravel())
    assert np.array_equal(here.read("velocities"), moving.state.velocities[0].ravel())
    here.run("cover")
    (model,) = sewn.models(moving.state.positions[0].astype(float))
    places = model.mesh.positions + MIDDLE
    assert np.abs(here.read("vertices").reshape(-1, 3) - places).max() < 1e-5


@pytest.mark.usefixtures("playable")
def test_the_legs_move_the_cape_and_the_figure_walks() -> None:
    worn = repeating(player(speed=4.0))
    free = repeating(player(speed=4.0).model_copy(update={"collisions": "none"}))
    info = module_info(built_module())
    plans = [write_plan(live_panels(played_garment(each), LANES)[0], info) for each in (worn, free)]
    first, second = (WasmPlayer(built_module(), plan) for plan in plans)
    for each in (first, second):
        each.step(110)
        each.run("pose")
    assert worn.wearer is not None
    (model,) = worn.wearer.models(110 * worn.step)
    places = model.mesh.positions + MIDDLE
    assert np.abs(first.read("figure").reshape(-1, 3) - places).max() < 1e-5
    assert np.array_equal(first.read("figure"), second.read("figure"))


def test_poses_repeat_to_the_bit_after_their_ramp() -> None:
    worn = repeating(player(motion="wave"))
    assert worn.cycle is not None
    first, period = worn.cycle
    assert first == 60
    assert worn.wearer is not None
    early, *later = (worn.wearer.poses((n + first) * worn.step) for n in (-30, 7, 7 + 3 * period))
    once, again = (each["right_arm"][1] for each in later)
    assert np.array_equal(once, again) and not np.array_equal(early["right_arm"][1], once)


@pytest.mark.parametrize(
    ("garment", "reason"),
    [
        (player("skirt"), "has sewn pieces"),
        (player(shown="head"), "has no cloth"),
        (find_garment("cape").model_copy(update={"collisions": "all"}), "use collisions"),
    ],
)
def test_garments_that_cannot_be_played_are_refused(garment: Garment, reason: str) -> None:
    with pytest.raises(OptionError, match=reason):
        live_panels(played_garment(repeating(garment)))


@pytest.mark.usefixtures("playable")
def test_a_scene_of_a_player_names_its_textures() -> None:
    garment = player("elytra")
    settings = garment.settings(solver="desbrun", size=(96, 128))
    packs = open_packs(())
    header, arrays = unpack(gzip.decompress(scene_bytes(garment, packs, settings)))
    *wings, (plan, start, count, *names) = header["moving"]
    assert wings == [[n, *run, "vertices", "light"] for n, run in enumerate(header["grip"])]
    assert (plan, names) == (0, ["figure", "figureLight"]) and start + count == wings[0][1]
    assert len(wings) == 2 and len(arrays["plan1"]) > 1000
    layers = arrays["layers"].reshape(-1, 7)
    (skin,) = header["textures"]["skin"]["shown"]
    assert [*layers[skin, 2:4]] == header["textures"]["skin"]["area"][2:] == [64, 64]
    assert header["textures"]["cape"]["area"] == [24, 2, 10, 20]


@pytest.mark.usefixtures("playable")
def test_a_scene_of_a_player_has_the_cameras_and_the_light_of_python() -> None:
    packs, own = open_packs(()), player().settings(solver="desbrun", size=(96, 128), view="hero")
    made = (own, own.changed(view="iso", daylight=0.3))
    first, other = (unpack(gzip.decompress(scene_bytes(player(), packs, s)))[0] for s in made)
    assert first["camera"] == first["views"]["hero"]
    assert other["camera"] == first["views"]["iso"] == other["views"]["iso"]
    assert other["tint"] == first["daylights"][3] != first["tint"] == first["daylights"][10]


@pytest.mark.usefixtures("playable")
def test_a_page_of_a_player_is_one_small_file() -> None:
    settings = player().settings(solver="desbrun", size=(96, 128), time=0.0)
    text = page_text(player(), settings)
    assert len(text) < 300_000
    assert '<drapery-player data-cloth kind="player" alt="Player with cape"><img' in text


SKINS = """
import { readFileSync } from "node:fs";
import { isSlim, wholeSkin } from "SCRIPT";
const found = JSON.parse(readFileSync(0)).map(([height, data]) => {
  const whole = wholeSkin({ width: 64, height, data: Uint8ClampedArray.from(data) });
  const slim = isSlim({ width: 64, height, data: Uint8ClampedArray.from(data) });
  return [slim ? "slim" : "classic", [...whole.data]];
});
console.log(JSON.stringify(found));
"""


@pytest.mark.skipif(NODE is None, reason="node is not installed (apt: nodejs)")
def test_skins_of_any_layout_are_read_as_in_python(tmp_path: Path) -> None:
    random = np.random.default_rng(5)
    old, opaque, slim, new = (
        random.integers(0, 256, (height, 64, 4), np.uint8) for height in (32, 32, 64, 64)
    )
    opaque[..., 3] = 255
    slim[20:32, 54:56, 3] = 0
    skins = [old, opaque, slim, new]
    script = tmp_path / "skins.mjs"
    script.write_text(SKINS.replace("SCRIPT", TEXTURES.as_uri()), encoding="utf-8")
    text = json.dumps([[len(skin), skin.ravel().tolist()] for skin in skins])
    found = json.loads(run_node(script, stdin=text))
    for skin, (arms, data) in zip(skins, found, strict=True):
        expected = read_skin(skin)
        assert arms == expected.arms
        assert np.array_equal(data, expected.texels.ravel())
