"""The live cloth: it moves as pictures do, goes where a hand pulls it, and tells what is new."""

import asyncio
import json
import threading
from dataclasses import replace
from itertools import islice
from typing import Any

import numpy as np
import pytest

pytest.importorskip("nicegui")

from drapery.banner.design import Banner
from drapery.banner.packs import open_packs
from drapery.cloth import Wind
from drapery.errors import OptionError
from drapery.render.drawlist import draw_list
from drapery.render.light import GAME_LIGHT
from drapery.render.soft import draw_scene
from drapery.scenes import STEP, still, wind_of
from drapery.settings import OPTIONS, Settings
from drapery.studio.chosen_scene import SceneChoice
from drapery.studio.live import Live, Ray
from drapery.studio.live_cloth import new_live_cloth
from drapery.studio.player import Player, scene_show
from drapery.studio.session import Session, Sessions
from drapery.studio.sketch import sketch_of
from drapery.studio.stream import UNDER_WAY, UNKNOWN, WRONG, add_routes
from drapery.studio.wind_controls import (
    WindControls,
    around,
    carried_on,
    steered,
    wind_controls_of,
)
from drapery.style import ClothSpec
from drapery.web.messages import MessageEncoder, pack, unpack

DESIGN = Banner.parse("white creeper:lime border:black")
SETTINGS = Settings(wind=6.0, time=1.5, size=(96, 96))
SHAPE = {"shape": [96, 96]}


def a_live(**options: Any) -> Live:
    return Live(DESIGN, open_packs(()), replace(SETTINGS, **options))


def straight_at(point: np.ndarray) -> Ray:
    """A line of sight along -z through a point."""
    towards = np.array([0.0, 0.0, -1.0])
    return Ray(point + np.array([0.0, 0.0, 5.0]), towards, towards)


@pytest.mark.parametrize(
    "options",
    [
        {},
        {"placement": "wall", "facing": "east"},
        {"direction": -70.0, "gusts": 0.9, "pins": "three-corners"},
    ],
)
def test_left_alone_it_is_the_picture(options: dict[str, Any]) -> None:
    live = a_live(**options)
    live.step(round(SETTINGS.time / STEP))
    pane = live.shown().panes[0]
    picture = still(DESIGN, open_packs(()), replace(SETTINGS, **options))
    for mine, own in zip(pane.scene.models, picture.models, strict=True):
        assert np.array_equal(mine.mesh.positions, own.mesh.positions)
        assert np.array_equal(mine.mesh.normals, own.mesh.normals)
    assert pane.framing(1.0) == picture.camera
    seen = replace(pane.scene, camera=pane.framing(1.0))
    assert np.array_equal(draw_scene(seen).pixels, draw_scene(picture).pixels)


def stirred() -> Live:
    """A live banner after a gale, a hand and another solver."""
    live = a_live()
    live.step(20)
    live.press(("d", "e"), 30.0)
    live.step(15)
    live.press((), 0.0)
    live.grab(straight_at(np.array([0.5, 0.6, 0.5])))
    live.pull(straight_at(np.array([0.9, 1.2, 0.5])))
    live.step(15)
    live.update(DESIGN, open_packs(()), replace(SETTINGS, solver="xpbd"))
    live.release()
    live.step(15)
    return live


def test_same_inputs_same_bits() -> None:
    one, other = stirred(), stirred()
    assert np.array_equal(one.particles()[0], other.particles()[0])
    assert one.wind_controls == other.wind_controls and one.time == other.time


def test_steps_of_one_turn_are_those_of_many() -> None:
    alone, together = a_live(placement="wall"), a_live(placement="wall")
    for live, turns in ((alone, [1] * 60), (together, [4, 1, 3, 2] * 6)):
        live.grab(straight_at(live.particles()[0][44] + still_origin(live)))
        live.pull(straight_at(np.array([0.8, 1.2, 0.0])))
        for number, steps in enumerate(turns):
            if sum(turns[:number]) == 20:
                live.release()
            live.step(steps)
    assert np.array_equal(alone.particles()[0], together.particles()[0])


def test_another_design_leaves_the_motion() -> None:
    changed, left = a_live(), a_live()
    changed.step(30)
    changed.update(Banner.parse("red skull:black"), open_packs(()), replace(SETTINGS, shadow=True))
    changed.step(30)
    left.step(60)
    assert np.array_equal(changed.particles()[0], left.particles()[0])


def test_an_item_has_no_shadow_as_its_picture_has_none() -> None:
    """The settings of a page keep what does nothing for what is shown now."""
    shadows = a_live(placement="item", shadow=True), a_live(placement="item")
    with_it, without = (live.shown().panes[0].scene for live in shadows)
    assert len(with_it.models) == len(without.models)
    live = a_live(shadow=True)
    live.update(DESIGN, open_packs(()), replace(SETTINGS, placement="item", shadow=True))
    assert len(live.shown().panes[0].scene.models) == len(without.models)


def test_packs_side_by_side_have_one_motion() -> None:
    live = a_live()
    live.update(DESIGN, open_packs(()), SETTINGS, open_packs(()))
    live.step(10)
    left, right = (pane.scene.models for pane in live.shown().panes)
    assert all(a.mesh is b.mesh for a, b in zip(left, right, strict=True))


def test_a_fault_changes_nothing() -> None:
    live = a_live()
    live.step(5)
    with pytest.raises(OptionError):
        live.update(DESIGN, open_packs(()), replace(SETTINGS, kind="cape"))
    live.step(5)
    whole = a_live()
    whole.step(10)
    assert np.array_equal(live.particles()[0], whole.particles()[0])


def test_reset_begins_again() -> None:
    live = stirred()
    fresh = a_live(solver="xpbd")
    fresh.set_wind(live.wind_controls)
    live.reset()
    fresh.reset()
    live.step(20)
    fresh.step(20)
    assert np.array_equal(live.particles()[0], fresh.particles()[0])


SPEC = ClothSpec((5, 9), (0.8, 1.6), "top", "desbrun")


@pytest.mark.parametrize("solver", ["desbrun", "xpbd", "pbd", "verlet", "provot", "implicit"])
def test_a_hand_takes_a_particle_where_it_wants(solver: str) -> None:
    live = a_live(wind=0.0, solver=solver)
    live.step(5)
    before = live.particles()[0].copy()
    corner = len(before) - 1
    origin = still_origin(live)
    assert live.grab(straight_at(before[corner] + origin))
    goal = before[corner] + np.array([0.15, 0.3, 0.0])
    live.pull(straight_at(goal + origin))
    live.step(60)
    assert np.allclose(live.particles()[0][corner], goal, atol=1e-3)
    live.release()
    live.step(8)
    assert live.particles()[0][corner][1] < goal[1] - 0.02


def test_a_hand_takes_what_is_under_the_finger() -> None:
    live = a_live(wind=0.0, grid=(33, 65))
    rest = live.particles()[0].copy()
    assert live.grab(straight_at(rest[40 * 33 + 16] + still_origin(live)))
    live.pull(straight_at(rest[40 * 33 + 16] + still_origin(live) + [0.1, 0.2, 0]))
    live.step(40)
    taken = np.abs(live.particles()[0] - rest - [0.1, 0.2, 0]).max(axis=1) < 1e-3
    away = np.linalg.norm(rest - rest[40 * 33 + 16], axis=1)
    assert taken[away < 0.04].all() and taken.sum() < 20


def still_origin(live: Live) -> np.ndarray:
    """Where the flag's frame lies in the world, from its pinned corner."""
    shown = live.shown().panes[0].scene.models[1].mesh.positions
    half = len(live.particles()[0])
    middle = (shown[:half] + shown[half : 2 * half]) / 2
    return middle[0] - live.particles()[0][0]


def test_a_hand_does_not_tear_the_cloth() -> None:
    held = new_live_cloth(SPEC).grabbed(44)
    far = held.reachable(np.array([9.0, 3.0, 2.0]))
    rest = held.whole.rest_positions
    for pin in range(5):
        flat = np.linalg.norm(rest[44] - rest[pin])
        assert np.linalg.norm(far - rest[pin]) <= flat * 0.99 + 2e-3
    near = rest[44] + np.array([-0.1, 0.2, 0.1])
    assert np.array_equal(held.reachable(near), near)
    assert new_live_cloth(SPEC).pulled(far).grab is None


def test_what_is_held_moves_no_faster_than_a_hand() -> None:
    live = a_live(wind=0.0)
    live.grab(straight_at(live.particles()[0][44] + still_origin(live)))
    places = []
    live.pull(straight_at(np.array([5.0, 5.0, 0.0])))
    for _ in range(30):
        live.step()
        places.append(live.particles()[0][44].copy())
    assert np.linalg.norm(np.diff(places, axis=0), axis=1).max() <= 0.2 + 1e-6


def test_pins_that_come_back_are_gone_to_gently() -> None:
    live = a_live(wind=8.0, pins="corners")

    def hold(pins: Any) -> None:
        live.update(DESIGN, open_packs(()), replace(SETTINGS, wind=8.0, pins=pins))

    live.step(40)
    sagged = live.particles()[0][2].copy()
    hold("top")
    live.step(1)
    assert np.linalg.norm(live.particles()[0][2] - sagged) <= 0.2
    live.step(60)
    assert np.array_equal(live.particles()[0][:5, 1], np.zeros(5, np.float32))
    hold("none")
    live.step(60)
    assert live.particles()[0].max(axis=0)[1] < -1


@pytest.mark.parametrize("seconds", [1, 4])
def test_a_cloth_that_fell_hangs_again_and_is_framed_anew(seconds: int) -> None:
    live = a_live()
    before = live.shown()
    live.update(DESIGN, open_packs(()), replace(SETTINGS, pins="none"))
    live.step(60 * seconds)
    live.update(DESIGN, open_packs(()), SETTINGS)
    live.step(60)
    assert live.particles()[0].min() > -2
    fallen = live.shown()
    assert fallen.cut == before.cut
    live.update(DESIGN, open_packs(()), replace(SETTINGS, pins="none"))
    assert live.shown().cut != fallen.cut


def test_the_cloth_hangs_as_before_after_the_games_flag() -> None:
    live = a_live()
    live.step(60)
    live.update(DESIGN, open_packs(()), replace(SETTINGS, pose="vanilla"))
    live.step(60)
    game = live.shown()
    live.update(DESIGN, open_packs(()), SETTINGS)
    live.step(30)
    assert live.particles()[0].min() > -2
    assert live.shown().cut != game.cut


def test_another_grid_goes_on_from_the_same_shape() -> None:
    cloth = new_live_cloth(SPEC)
    finer = cloth.remade(replace(SPEC, shape=(9, 17)))
    assert np.allclose(finer.positions, new_live_cloth(finer.spec).positions, atol=1e-6)
    live = a_live(grid=(5, 9))
    live.step(40)
    coarse = live.particles()[0].copy()
    live.update(DESIGN, open_packs(()), replace(SETTINGS, grid=(9, 17)))
    fine = live.particles()[0].reshape(17, 9, 3)
    assert np.allclose(fine[::2, ::2].reshape(-1, 3), coarse, atol=1e-6)


@pytest.mark.parametrize(
    ("key", "azimuth", "heading"),
    [("w", 0, 180), ("s", 0, 0), ("d", 0, 90), ("a", 0, -90), ("w", 90, -90), ("d", 180, -90)],
)
def test_keys_send_the_wind_as_the_viewer_sees_it(key: str, azimuth: float, heading: float) -> None:
    controls = WindControls()
    for _ in range(180):
        controls = steered(controls, (key,), azimuth, STEP)
    assert abs(around(controls.heading - heading)) < 1e-6


def test_keys_make_the_wind_weaker_and_stronger_within_bounds() -> None:
    controls = WindControls(Settings(wind=4.0))
    assert steered(controls, "e", 0, 0.5).speed == 6.5
    assert steered(controls, "q", 0, 5.0).speed == 0.0
    assert steered(controls, "e", 0, 50.0).speed == 40.0
    assert steered(controls, "", 0, 1.0) == controls


def test_a_changed_wind_goes_on_where_it_was() -> None:
    before, time = WindControls(Settings(wind=4.0)).wind, 61.7
    after = carried_on(before, WindControls(Settings(wind=4.3)).wind, time)
    phase = float(np.asarray(after.phases))
    swells = phase / after.sine_period
    assert abs(swells - round(swells)) < 1e-6
    old, new = (4.0 * time / 1.5) % 4096, (4.3 * (time + phase) / 1.5) % 4096
    assert abs(old - new) < 0.1
    aside = WindControls(Settings(wind=4.0, direction=40.0)).wind
    assert carried_on(before, aside, time).phases == before.phases


def test_a_wind_beyond_the_controls_is_kept_within_their_bounds() -> None:
    wild = Settings(wind=Wind((0.0, 0.0, 90.0), gusts=9.0, seed=-1))
    controls = wind_controls_of(wild)
    assert (controls.speed, controls.heading) == (40.0, 0.0)
    assert (controls.settings.gusts, controls.settings.seed) == (2.0, 2**32 - 1)


@pytest.mark.parametrize("name", [n for n, o in OPTIONS.items() if "wind" in o.affects])
def test_the_controls_hold_each_option_of_the_wind(name: str) -> None:
    other = {"fabric": "silk", "wind": 9.0, "direction": 30.0, "gusts": 1.5, "seed": 4}
    settings = Settings(**{name: other[name]})
    assert wind_controls_of(settings) != wind_controls_of(Settings())
    assert repr(wind_controls_of(settings).wind) == repr(wind_of(settings))


def told_positions(encoder: MessageEncoder, live: Live, seen: dict[str, Any]) -> list[str]:
    """Take a moment's messages as a viewer does; their kinds."""
    kinds = []
    for message in encoder.messages(live.shown()):
        header, arrays = unpack(message)
        kinds.append(header["kind"])
        if header["kind"] == "scene":
            seen.update(header, **arrays)
            seen["positions"] = np.full((header["vertices"], 3), np.nan, np.float32)
            seen["light"] = np.full(header["vertices"], np.nan, np.float32)
            continue
        at = 0
        for first, count in header["runs"]:
            seen["positions"][first : first + count] = arrays["positions"].reshape(-1, 3)[
                at : at + count
            ]
            seen["light"][first : first + count] = arrays["light"][at : at + count]
            at += count
        assert at == len(arrays["light"])
    return kinds


def test_messages_describe_the_picture() -> None:
    live, encoder, seen = a_live(), MessageEncoder(), {}
    for number in range(4):
        kinds = told_positions(encoder, live, seen)
        assert kinds == (["scene", "moment"] if number == 0 else ["moment"])
        drawing = draw_list(live.shown().panes[0].scene.models)
        assert np.array_equal(seen["positions"], drawing.positions)
        assert np.array_equal(seen["light"], drawing.brightness(GAME_LIGHT))
        assert np.array_equal(seen["triangles"].reshape(-1, 3), drawing.topology.triangles)
        live.step(3)
    live.update(Banner.parse("red"), open_packs(()), replace(SETTINGS, daylight=0.0))
    assert told_positions(encoder, live, seen) == ["scene", "moment"]
    # Night falls on the wood too, which does not move.
    live.update(Banner.parse("red"), open_packs(()), replace(SETTINGS, block_light=9))
    assert told_positions(encoder, live, seen) == ["moment"]
    live.step()
    assert told_positions(encoder, live, seen) == ["moment"]


def test_a_moment_is_as_long_as_what_moves() -> None:
    live, encoder = a_live(), MessageEncoder()
    encoder.messages(live.shown())
    live.step()
    shown = live.shown()
    (message,) = encoder.messages(shown)
    header, arrays = unpack(message)
    vertices = 2 * 496 + 4 * 90  # two sheets of 16 x 31 particles and a rim of 90 edges
    assert [run[1] for run in header["runs"]] == [vertices]
    assert sum(array.nbytes for array in arrays.values()) == 16 * vertices
    assert len(message) < 16 * vertices + 512
    (nothing,) = encoder.messages(shown)
    assert len(nothing) < 512


def test_pack_and_unpack_are_inverse() -> None:
    arrays = {"a": np.arange(3, dtype=np.uint8), "b": np.array([1.5], np.float32)}
    header, back = unpack(pack({"kind": "é"}, arrays))
    assert header == {"kind": "é"}
    assert all(np.array_equal(back[name], array) for name, array in arrays.items())


def test_a_camera_is_sent_once_per_cut() -> None:
    live, encoder = a_live(), MessageEncoder()
    encoder.reframe((200, 100))
    first = [unpack(message)[0] for message in encoder.messages(live.shown())][-1]
    assert first["cameras"]["cut"] is True
    live.step()
    (again,) = encoder.messages(live.shown())
    assert "cameras" not in unpack(again)[0]
    live.reframe()
    (anew,) = encoder.messages(live.shown())
    assert unpack(anew)[0]["cameras"]["cut"] is True


@pytest.mark.parametrize("shape", [(300, 200), (200, 300)])
def test_upright_viewers_stack_scenes_but_not_banners(shape: tuple[int, int]) -> None:
    live = a_live()
    live.update(DESIGN, open_packs(()), SETTINGS, open_packs(()), ("one", "other"))
    banners, _ = unpack(MessageEncoder("all", shape).messages(live.shown())[0])
    assert banners["columns"] == 2
    assert [pane["label"] for pane in banners["panes"]] == ["one", "other"]
    only, _ = unpack(MessageEncoder("right", shape).messages(live.shown())[0])
    assert [pane["label"] for pane in only["panes"]] == ["other"]
    scenes, _ = unpack(
        MessageEncoder("all", shape).messages(
            Player(scene_show(SceneChoice("fold")), shape).step()
        )[0]
    )
    assert scenes["columns"] == (2 if shape[0] > shape[1] else 1)


def test_a_scene_comes_round_again() -> None:
    player = Player(scene_show(SceneChoice("fold")), (96, 96))
    player.clip = replace(player.clip, count=5)
    first = [player.step() for _ in range(5)]
    again = [player.step() for _ in range(5)]
    for one, other in zip(first, again, strict=True):
        assert one.panes[0].scene is other.panes[0].scene
    pictures = islice(player.show.play(player.clip, lambda *moment: None), 5)
    for shown, picture in zip(first, pictures, strict=True):
        parts = picture.pictures
        for pane, scene in zip(shown.panes, parts, strict=True):
            for a, b in zip(pane.scene.models, scene.models, strict=True):
                assert np.array_equal(a.mesh.positions, b.mesh.positions)


def test_a_finished_picture_is_hung_up_as_it_is() -> None:
    shown = Player(scene_show(SceneChoice("julia")), (96, 96)).step()
    (pane,) = shown.panes
    assert pane.flat
    scene = replace(pane.scene, camera=pane.framing(1.0))
    width, height = scene.size
    assert width == height
    assert np.array_equal(
        draw_scene(scene).pixels, pane.scene.models[0].materials[0].layers[0].texels
    )


SESSIONS = Sessions()


def open_session(settings: Settings) -> Session:
    return SESSIONS.open(settings, sketch_of(DESIGN))


def an_app() -> Any:
    from fastapi import FastAPI

    app = FastAPI()
    add_routes(app, SESSIONS)
    return app


@pytest.fixture
def client() -> Any:
    from starlette.testclient import TestClient

    with TestClient(an_app()) as client:
        yield client


def moments(socket: Any, count: int) -> list[dict[str, Any]]:
    """The next moments in which something has moved, each said to be drawn."""
    found: list[dict[str, Any]] = []
    while len(found) < count:
        header, arrays = unpack(socket.receive_bytes())
        socket.send_json({"drawn": 1})
        if header["kind"] == "moment" and header["runs"]:
            found.append({**header, **arrays})
    return found


def test_the_socket_streams_the_motion_of_pictures(client: Any) -> None:
    session = open_session(SETTINGS)
    with client.websocket_connect(f"/live/{session.token}") as socket:
        socket.send_json(SHAPE)
        sent = [m["positions"].reshape(-1, 3)[-1352:] for m in moments(socket, 12)]
    session.close()
    pictures = flags(400)
    places = [place_of(flag, pictures) for flag in sent]
    assert places == sorted(places) and len(set(places)) > 6


def test_the_socket_waits_for_the_viewer(client: Any) -> None:
    session = open_session(SETTINGS)
    viewport = session.viewport
    with client.websocket_connect(f"/live/{session.token}") as socket:
        socket.send_json(SHAPE)
        first, _ = unpack(socket.receive_bytes())
        second, _ = unpack(socket.receive_bytes())
        assert [first["kind"], second["kind"]] == ["scene", "moment"]
        version = viewport.version
        wait_for(lambda: viewport.version > version + 30)
        # All that has been sent meanwhile lies unread; the next moment skips what was not sent.
        socket.send_json({"drawn": UNDER_WAY})
        third = moments(socket, 1)[0]["positions"].reshape(-1, 3)[-1352:]
    pictures = flags(400)
    assert place_of(third, pictures) > 20
    session.close()


def flags(count: int) -> list[np.ndarray]:
    """The flag at its first ticks, as it is drawn."""
    live, found = a_live(), []
    for _ in range(count):
        found.append(live.shown().panes[0].scene.models[1].mesh.positions.astype(np.float32))
        live.step()
    return found


def place_of(flag: np.ndarray, pictures: list[np.ndarray]) -> int:
    return next(n for n, known in enumerate(pictures) if np.array_equal(known, flag))


def wait_for(condition: Any, seconds: float = 60.0) -> None:
    import time

    end = time.monotonic() + seconds
    while not condition():
        assert time.monotonic() < end
        time.sleep(0.01)


def test_unknown_tabs_and_nonsense_are_turned_away(client: Any) -> None:
    from starlette.websockets import WebSocketDisconnect

    with client.websocket_connect("/live/nobody") as socket:
        with pytest.raises(WebSocketDisconnect) as caught:
            socket.receive_bytes()
        assert caught.value.code == UNKNOWN
    session = open_session(SETTINGS)
    for nonsense in (
        "{",
        "[1]",
        '{"dance": 1}',
        '{"shape": [0, 5]}',
        '{"shape": "wide"}',
        '{"keys": ["w", NaN]}',
        '{"grab": [1, 2, 3]}',
        json.dumps({"pull": [0.0] * 9}),
        '{"drawn": -1}',
        "x" * 4000,
    ):
        with client.websocket_connect(f"/live/{session.token}") as socket:
            socket.send_text(nonsense)
            with pytest.raises(WebSocketDisconnect) as caught:
                socket.receive_bytes()
            assert caught.value.code == WRONG, nonsense
    wait_for(lambda: not session.viewport.moving)
    session.close()


def test_nothing_is_left_of_closed_sockets(client: Any) -> None:
    session = open_session(SETTINGS)
    threads: list[int] = []
    for number in range(40):
        with client.websocket_connect(f"/live/{session.token}") as socket:
            socket.send_json(SHAPE)
            moments(socket, 2)
        if number in (9, 39):
            wait_for(lambda: not session.viewport.moving)
            threads.append(threading.active_count())
            assert live_tasks(client) == []
    assert threads[0] == threads[1]
    assert session.viewport.viewers == 0
    session.close()
    assert SESSIONS.find(session.token) is None


def live_tasks(client: Any) -> list[str]:
    """The names of the live cloths' tasks in the server's loop."""

    async def names() -> list[str]:
        every = (task.get_name() for task in asyncio.all_tasks())
        return [name for name in every if name.startswith("live")]

    return client.portal.call(names)


def test_keys_and_hands_reach_the_cloth_over_the_socket(client: Any) -> None:
    session = open_session(replace(SETTINGS, wind=2.0))
    viewport = session.viewport
    with client.websocket_connect(f"/live/{session.token}") as socket:
        socket.send_json(SHAPE)
        moments(socket, 3)
        socket.send_json({"keys": ["e", 0.0]})
        watch(socket, lambda moment: moment["wind"][0] >= 4.0)
        socket.send_json({"keys": ["", 0.0]})
        wait_for(lambda: session.settings.wind >= 4.0)
        socket.send_json({"switch": 1})
        watch(socket, lambda moment: not moment["wind"][2])
        assert not viewport.request.on
        goal = np.array([1.1, 1.0])
        socket.send_json({"grab": [0.6, 0.4, 5.0, 0, 0, -1, 0, 0, -1]})
        socket.send_json({"pull": [*goal, 5.0, 0, 0, -1, 0, 0, -1]})
        watch(socket, lambda moment: away_from(goal, moment) < 0.03)
        socket.send_json({"drop": 1})
        watch(socket, lambda moment: away_from(goal, moment) > 0.15)
    session.close()


def watch(socket: Any, condition: Any) -> None:
    """Look at moments until something is true of one."""
    for _ in range(600):
        if condition(moments(socket, 1)[0]):
            return
    raise AssertionError("it has not come about")


def away_from(place: np.ndarray, moment: dict[str, Any]) -> float:
    """How far the nearest vertex is from a place of the picture, x and y [m]."""
    vertices = moment["positions"].reshape(-1, 3)[:, :2]
    return float(np.linalg.norm(vertices - place, axis=1).min())


def test_a_hidden_viewer_costs_nothing(client: Any) -> None:
    session = open_session(SETTINGS)
    viewport = session.viewport
    with client.websocket_connect(f"/live/{session.token}") as socket:
        socket.send_json(SHAPE)
        moments(socket, 2)
        socket.send_json({"hidden": True})
        wait_for(lambda: not viewport.moving)
        socket.send_json({"hidden": False})
        wait_for(lambda: viewport.moving)
        moments(socket, 2)


def test_a_tab_that_closes_ends_its_sockets(client: Any) -> None:
    from starlette.websockets import WebSocketDisconnect

    session = open_session(SETTINGS)
    viewport = session.viewport
    with client.websocket_connect(f"/live/{session.token}") as socket:
        socket.send_json(SHAPE)
        moments(socket, 2)
        session.close()
        wait_for(lambda: not viewport.moving)
        with pytest.raises(WebSocketDisconnect) as caught:
            moments(socket, 100)
        assert caught.value.code == UNKNOWN


def test_unstable_cloth_is_reported_and_reset(client: Any) -> None:
    session = open_session(SETTINGS)
    viewport = session.viewport

    def tear(live: Live) -> None:
        (cloth,) = live.cloths
        state = replace(cloth.state, velocities=cloth.state.velocities * np.nan)
        live.replace_cloth(0, replace(cloth, state=state))

    with client.websocket_connect(f"/live/{session.token}") as socket:
        socket.send_json(SHAPE)
        moments(socket, 3)
        viewport.do(tear)
        while "text" not in (said := socket.receive()):
            socket.send_json({"drawn": 1})
        assert "blew up" in json.loads(said["text"])["line"]
        assert all(np.isfinite(moment["positions"]).all() for moment in moments(socket, 5))
    session.close()
