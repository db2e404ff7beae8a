"""The kernels as WebAssembly: a page moves cloth with the bits of Python."""

import json
import re
import shutil
import subprocess
from hashlib import sha256
from pathlib import Path
from typing import Any

import numpy as np
import pytest

pytest.importorskip("ziglang", reason="ziglang is not installed (drapery-mc[web-build])")
pytest.importorskip("wasmtime", reason="wasmtime is not installed (drapery-mc[dev])")

from scene_helpers import flag_of
from wasm_player import WasmPlayer, built_module, quick_settings, white_banner

from drapery import Banner, DraperyError, Settings
from drapery.cloth import SolverPBD, State, Wind
from drapery.cloth.forces import lower_forces
from drapery.cloth.wind import COLUMN
from drapery.packs import open_packs
from drapery.render import draw_scene
from drapery.scenes import StagedBody, live_panels, live_picture, played_body, still
from drapery.stage.forces import forces_of, wind_of
from drapery.style import Body, body_of
from drapery.web.wasm import build
from drapery.web.wasm.module import module_info, smallest_module
from drapery.web.wasm.plan import LANES, kernels_of, plans_of, split_plan, write_plan

pytestmark = pytest.mark.usefixtures("playable")

NODE = shutil.which("node")
SCRIPT = Path(__file__).parents[2] / "drapery" / "web" / "wasm" / "cloth.js"


def plan_of(settings: Settings) -> bytes:
    (plan,) = plans_of(played_body(white_banner(settings), settings))
    return plan


def picture_plan(body: Body, settings: Settings) -> bytes:
    return write_plan(live_picture(body, settings, LANES), module_info(built_module()))


def moved(settings: Settings, steps: int) -> State:
    """The cloth of a white banner after time steps of Python."""
    moving, forces = flag_of(settings)
    return moving.advance(forces, steps).state


def digest(*arrays: Any) -> str:
    return sha256(
        b"".join(np.ascontiguousarray(a, np.float32).tobytes() for a in arrays)
    ).hexdigest()


def test_the_module_holds_no_path_of_the_machine_that_compiled_it() -> None:
    assert not re.search(rb"[/\\\\]\w+\.py", built_module())


@pytest.mark.parametrize("placement", ["standing", "wall"])
def test_600_steps_have_the_bits_of_python(placement: Any) -> None:
    settings = quick_settings(placement=placement, rotation=3 if placement == "standing" else 0)
    state = moved(settings, 600)
    staged = StagedBody(white_banner(settings), settings, curves=False)
    mesh = staged.soft(state.positions)[-1]
    player = WasmPlayer(built_module(), plan_of(settings))
    player.step(599)
    player.step(1)
    played = digest(player.read("positions"), player.read("velocities"))
    assert played == digest(state.positions[0], state.velocities[0])
    player.run("cover")
    assert digest(player.read("vertices")) == digest(mesh.positions)
    assert digest(player.read("normals")) == digest(mesh.normals)
    light = staged.staging.light.brightness(mesh.normals.astype(np.float32))
    assert np.abs(player.read("light") - light).max() < 1e-6


@pytest.mark.filterwarnings("ignore:pins or colliders pull cloth")  # a storm
def test_contact_of_the_cloth_with_itself_has_the_bits_of_python() -> None:
    played, sizes = [], []
    for contact in ("world", "all"):
        blown = {"wind": 40.0, "gusts": 2.0, "direction": 240.0, "fabric": "silk"}
        settings = quick_settings(**blown, contact=contact)
        plan = picture_plan(white_banner(settings), settings)
        player = WasmPlayer(built_module(), plan)
        player.step(300)
        sizes.append(player.memory.data_len(player.store))
        played.append(digest(player.read("positions"), player.read("velocities")))
        state = moved(settings, 300)
        assert played[-1] == digest(state.positions[0], state.velocities[0])
    assert played[0] != played[1], "the cloth has met itself"
    assert sizes[1] < sizes[0] + (1 << 20), "what a step allocates is free after it"
    player.step(300)
    grown = player.memory.data_len(player.store) - sizes[1]
    assert grown < 1 << 20, "what a step allocates is free after it"


@pytest.mark.parametrize("size", [(48, 64), (480, 640)], ids=["small", "with-curves"])
def test_a_picture_has_the_pixels_of_python(size: tuple[int, int]) -> None:
    settings = quick_settings(view="iso", light="game", size=size, samples=4, time=1.99)
    design = Banner.parse("white creeper:lime border:black")
    body = body_of(design, open_packs(()), settings)
    built_module()
    plan = picture_plan(body, settings)
    player = WasmPlayer(built_module(), plan)
    player.step(player.header["steps"])
    player.run("cover")
    player.run("draw")
    assert player.header["picture"] == [*size]
    pixels = player.read("picture").view(np.uint8).reshape(size[1], size[0], 4)
    assert np.array_equal(pixels, draw_scene(still(design, open_packs(()), settings)).pixels)


def test_the_start_has_the_wind_of_python() -> None:
    settings = quick_settings(wind=7.0, direction=40.0, placement="wall")
    body = white_banner(settings)
    (panel,) = live_panels(played_body(body, settings))
    aim = panel.calls["aim"]
    assert aim.function(*aim.arguments) == 0
    cloth = body.panels[0].cloth.make_cloth()
    expected = lower_forces(forces_of(settings, wind_of(settings)), cloth, 1).gusts
    turned = aim.arguments[2]
    for name in ("numbers", "seeds", "rates", "turns", "sines", "cosines"):
        made = getattr(turned, name)
        assert np.array_equal(getattr(expected, name).astype(made.dtype), made), name


def test_a_turned_wind_has_the_bits_of_python_and_its_gusts_do_not_jump() -> None:
    settings = quick_settings()
    (panel,) = live_panels(played_body(white_banner(settings), settings), LANES)
    player = WasmPlayer(built_module(), write_plan(panel, module_info(built_module())))
    player.step(200)
    player.write("wind", -3.0, 1.0, 8.0)
    player.run("aim")
    live, wind, gusts, loads = panel.calls["aim"].arguments
    panel.calls["aim"].function(live, wind, gusts, loads)
    before = phases_at(200 / 60, gusts)
    live.clock[0] = 200
    wind.velocity[:] = -3.0, 1.0, 8.0
    panel.calls["aim"].function(live, wind, gusts, loads)
    assert np.abs((phases_at(200 / 60, gusts) - before + 0.5) % 1 - 0.5).max() < 1e-9
    assert gusts.numbers[0, COLUMN.sine_rate] == 1 / 3.1
    image = player.image()
    for array in (gusts.numbers, gusts.phases, gusts.rates, gusts.sines, gusts.cosines):
        assert array.tobytes() in image


def test_a_seed_and_a_phase_of_the_host_are_those_of_a_wind() -> None:
    velocity = (0.5, 0.0, 5.0)
    settings = quick_settings(wind=Wind(velocity, seed=9, phases=2.5))
    state = moved(settings, 60)
    player = WasmPlayer(built_module(), plan_of(quick_settings(wind=Wind(velocity))))
    player.write("seeds", 9)
    player.write("phases", *(LANES * [2.5]))
    player.run("aim")
    player.step(60)
    played = digest(player.read("positions"), player.read("velocities"))
    assert played == digest(state.positions[0], state.velocities[0])


def phases_at(time: float, gusts: Any) -> Any:
    """The phases of gusts, swell and waves at a time [s], in turns."""
    now = time + gusts.phases[0, 0]
    numbers = gusts.numbers[0]
    cells = now * numbers[COLUMN.gust_rate] + numbers[COLUMN.gust_start]
    swell = now * numbers[COLUMN.sine_rate]
    return np.array([cells, swell, *(now * gusts.rates[0] + gusts.turns[0])])


def test_a_pull_moves_the_cloth_to_its_target_and_lets_go() -> None:
    player = WasmPlayer(built_module(), plan_of(quick_settings(wind=0.0)))
    player.step(30)
    corner = player.read("positions")[-3:].astype(float)
    target = corner + np.array([-0.1, 0.1, 0.4])
    player.write("grab", 44, -1)
    player.write("target", *target)
    player.step(60)
    assert np.abs(player.read("positions")[-3:] - target).max() < 0.03
    player.write("target", 0.0, 0.0, 1e6)
    player.step(60)
    assert np.abs(player.read("positions")).max() < 2.5
    player.write("grab", -1, 44)
    player.step(300)
    assert np.abs(player.read("positions")[-3:] - corner).max() < 0.1


def test_a_plan_is_the_same_at_every_writing_and_small() -> None:
    plan = plan_of(quick_settings())
    assert plan == plan_of(quick_settings())
    header, image = split_plan(plan)
    assert (header["columns"], header["rows"]) == (5, 9)
    assert header["pins"] == [0, 1, 2, 3, 4]
    assert len(image) <= header["image"] < 1 << 18


@pytest.mark.parametrize(
    ("options", "reason"),
    [
        ({"solver": SolverPBD()}, "use xpbd or desbrun"),
        ({"style": "voxel"}, "steps of motion"),
        ({"pose": "vanilla"}, "use pose cloth"),
    ],
)
def test_what_cannot_be_played_is_refused(options: Any, reason: str) -> None:
    with pytest.raises(DraperyError, match=reason):
        plan_of(quick_settings(**options))


def test_a_module_without_the_kernel_is_refused() -> None:
    settings = quick_settings()
    (panel,) = live_panels(played_body(white_banner(settings), settings), LANES)
    with pytest.raises(DraperyError, match="has no kernel aim for this cloth"):
        write_plan(panel, {"sources": "", "kernels": {}})


@pytest.mark.parametrize(
    ("options", "reason"),
    [
        ({"view": "hero"}, "cast shadows need Python"),
        ({"shadow": True, "light": "game"}, "translucent materials"),
        ({"pixel": 4, "light": "game"}, "leave out the picture"),
    ],
)
def test_pictures_that_need_python_are_refused(options: Any, reason: str) -> None:
    settings = quick_settings(time=0.0, **options)
    with pytest.raises(DraperyError, match=reason):
        live_picture(white_banner(settings), settings)


def test_a_build_without_its_compiler_names_the_extra(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(build.importlib.util, "find_spec", lambda name: None)
    assert build.main(["--cache"]) == 1
    message = capsys.readouterr().err
    assert message == "error: ziglang is not installed; install drapery-mc[web-build]\n"


PLAY = """
import { readFileSync } from "node:fs";
import { createHash } from "node:crypto";
import { Cloth } from "SCRIPT";
const [module, plan] = process.argv.slice(2).map((path) => readFileSync(path));
const [first, second] = [await Cloth.load(module, plan), await Cloth.load(module, plan)];
const digest = (cloth) =>
  createHash("sha256").update(cloth.positions).update(cloth.velocities).digest("hex");
first.step(300);
second.setWind(0, 0, -6);
second.pull(44, 0, -1, 1);
second.step(50);
first.step(300);
const found = [digest(first), first.time, first.kernels === second.kernels];
second.reset();
second.step(600);
found.push(digest(second), second.vertices.length, Math.max(...second.light) <= 1);
second.free();
second.free();
const [third, fourth] = [await Cloth.load(module, plan), await Cloth.load(module, plan)];
found.push(third.place === second.place, third.place === fourth.place);
try {
  second.step();
} catch (error) {
  found.push(error.constructor.name);
}
const refused = await Cloth.load(module, plan.subarray(9)).catch((error) => error.message);
console.log(JSON.stringify([...found, refused]));
"""


@pytest.mark.skipif(NODE is None, reason="node is not installed (apt: nodejs)")
def test_javascript_plays_many_cloths_in_one_memory(tmp_path: Path) -> None:
    settings = quick_settings()
    plan = plan_of(settings)
    module = smallest_module(kernels_of(plan))
    assert len(module) < len(built_module()), "it has no kernels of pictures and players"
    (tmp_path / "module").write_bytes(module)
    (tmp_path / "plan").write_bytes(plan)
    done = subprocess.run(
        [str(NODE), "--input-type=module", "-", tmp_path / "module", tmp_path / "plan"],
        input=PLAY.replace("SCRIPT", SCRIPT.as_uri()),
        capture_output=True,
        text=True,
        timeout=60,
    )
    assert done.returncode == 0, done.stderr
    state = moved(settings, 600)
    expected = digest(state.positions[0], state.velocities[0])
    staged = StagedBody(white_banner(settings), settings, curves=False)
    vertices = 3 * len(staged.at_rest()[-1].positions)
    refused = "the plan of the cloth is damaged"
    assert json.loads(done.stdout) == [
        *(expected, 10, True),
        *(expected, vertices, True),
        *(True, False, "TypeError", refused),
    ]
