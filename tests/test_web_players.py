"""Players with capes and elytra in pages: the bits of Python, their poses and limits."""

import gzip
from typing import Any

import numpy as np
import pytest

pytest.importorskip("ziglang", reason="ziglang is not installed (drapery[web-build])")
pytest.importorskip("wasmtime", reason="wasmtime is not installed (drapery[dev])")

from wasm_player import WasmPlayer, built_module

from drapery.errors import OptionError
from drapery.garments import Garment, dressed_player, find_garment, make_wearer
from drapery.packs import open_packs
from drapery.scenes import PlayedGarment, live_garment, played_garment
from drapery.web.messages import unpack
from drapery.web.scene_file import garment_scene_bytes
from drapery.web.wasm.module import module_info
from drapery.web.wasm.plan import LANES, write_plan

MIDDLE = np.array([0.5, 0.0, 0.5])


def player(wear: str = "cape", **fields: Any) -> Garment:
    who = make_wearer(**{"motion": "walk", "speed": 1.5, **fields})
    return dressed_player(who, wear=[wear])


def played(garment: Garment, **options: Any) -> PlayedGarment:
    settings = garment.settings(solver="desbrun", **options)
    return played_garment(garment, open_packs(()), settings)


@pytest.mark.parametrize("wear", ["cape", "elytra"])
def test_600_steps_on_a_walking_player_have_the_bits_of_python(wear: str) -> None:
    worn = played(player(wear))
    panel, sewn = live_garment(worn, LANES)[-1], worn.cloths[-1]
    here = WasmPlayer(built_module(), write_plan(panel, module_info(built_module())))
    here.step(599)
    here.step(1)
    moving = worn.begun(sewn).advance(worn.forces(sewn, None), 600, worn.pins(sewn))
    assert np.array_equal(here.read("positions"), moving.state.positions[0].ravel())
    assert np.array_equal(here.read("velocities"), moving.state.velocities[0].ravel())
    here.run("cover")
    (model,) = sewn.models(moving.state.positions[0].astype(float))
    places = model.mesh.positions + MIDDLE
    assert np.abs(here.read("vertices").reshape(-1, 3) - places).max() < 1e-5


def test_the_legs_move_the_cape_and_the_figure_walks() -> None:
    worn = played(player(speed=4.0))
    free = played(player(speed=4.0).model_copy(update={"collisions": "none"}))
    info = module_info(built_module())
    plans = [write_plan(live_garment(each, LANES)[0], info) for each in (worn, free)]
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
    worn = played(player(motion="wave"))
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
        (find_garment("cape").model_copy(update={"collisions": "all"}), "use contact world"),
    ],
)
def test_garments_that_cannot_be_played_are_refused(garment: Garment, reason: str) -> None:
    with pytest.raises(OptionError, match=reason):
        live_garment(played(garment))


def test_a_scene_of_a_player_names_its_textures() -> None:
    built_module()
    garment = player("elytra")
    settings = garment.settings(solver="desbrun", size=(96, 128))
    packs = open_packs(())
    header, arrays = unpack(gzip.decompress(garment_scene_bytes(garment, packs, settings)))
    (start, count), grip = header["figure"], header["grip"]
    assert start + count == grip[0][0] and len(grip) == 2 and len(arrays["plan1"]) > 1000
    assert header["textures"]["skin"] == {"vertices": [start], "area": [0, 0, 64, 64]}
    assert header["textures"]["cape"]["area"] == [24, 2, 10, 20]
