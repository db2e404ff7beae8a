"""The viewport: which addresses the viewer is told, and what they answer."""

import asyncio
import gzip
import io
import json
import sys
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from fastapi import FastAPI
from pack_maker import BANNER, META, mcmeta, noise, png, zip_pack
from PIL import Image
from starlette.testclient import TestClient

from drapery import Banner, DesignError, OptionError, draw
from drapery.settings import Settings
from drapery.studio.kernel_build import KernelBuild
from drapery.studio.panels.live import show_scene, wear
from drapery.studio.played import known_kernels
from drapery.studio.routes import add_routes
from drapery.studio.session import Session, Sessions, StudioConfig
from drapery.studio.sketch import Sketch, sketch_of
from drapery.web.messages import unpack
from drapery.web.scene_file import called_kernels, scene_bytes
from drapery.web.wasm.module import smallest_module

pytestmark = pytest.mark.page  # their module takes minutes to compile

Playable = Callable[..., Settings]
DESIGN = Banner.parse("white creeper:lime")


@pytest.fixture
def session(playable: Playable) -> Iterator[Session]:
    opened = Session(playable(size=(48, 64)), sketch_of(DESIGN))
    yield opened
    opened.close()


def key_of(address: str) -> str:
    return address.rpartition("/")[2].partition(".")[0]


def scene_key(session: Session) -> str:
    (address,) = session.viewport.shown["scenes"]
    return key_of(address)


def scene_of(session: Session) -> tuple[dict[str, Any], dict[str, Any]]:
    """The header and the arrays of the scene that is shown."""
    return unpack(gzip.decompress(session.viewport.scene(scene_key(session)).data))


def test_what_the_browser_does_itself_is_told_and_changes_no_address(session: Session) -> None:
    before = scene_key(session)
    session.edit(Sketch("red"))
    session.adjust(wind=9.0, direction=40.0, view="back", daylight=0.2, time=1.0, size=(9, 9))
    shown = session.viewport.shown
    assert scene_key(session) == before
    assert shown["design"] == "red" and shown["view"] == "back" and shown["daylight"] == 0.2
    assert (shown["wind"], shown["direction"], shown["on"]) == (9.0, 40.0, True)
    session.viewport.update(on=False)
    assert session.viewport.shown["on"] is False and scene_key(session) == before


@pytest.mark.parametrize(
    "options",
    [
        *({"thickness": 2.0}, {"gusts": 1.0}, {"rotation": 3}, {"placement": "wall"}),
        *({"fabric": "silk"}, {"grid": (3, 5)}, {"view": "hero"}),
    ],
)
def test_what_is_another_scene_has_another_address(
    session: Session, options: dict[str, Any]
) -> None:
    before = scene_key(session)
    session.adjust(**options)
    assert scene_key(session) != before
    with pytest.raises(OptionError, match="something else by now"):
        session.viewport.scene(before)


def test_a_scene_is_that_of_pages_with_all_patterns(session: Session) -> None:
    header, arrays = scene_of(session)
    assert {"creeper", "guster", "base", ""} <= set(header["sheets"])
    settings = Settings(solver="desbrun", grid=(5, 9), size=(480, 480), light="game", ground="none")
    page = unpack(gzip.decompress(scene_bytes(Banner(), session.packs(), settings)))
    assert header == page[0]
    assert all(np.array_equal(arrays[name], array) for name, array in page[1].items())


def test_the_design_on_a_garment_is_part_of_its_scene(session: Session) -> None:
    wear(session, "flag")
    white = scene_key(session)
    session.edit(Sketch("red"))
    assert scene_key(session) != white


def test_a_still_is_the_picture_of_the_settings(session: Session) -> None:
    still, film = session.viewport.shown["pictures"]
    seen = np.asarray(Image.open(io.BytesIO(session.viewport.picture(key_of(still)))))
    assert np.array_equal(seen, draw(DESIGN, session.settings).pixels)
    assert film.endswith(".webp")
    session.adjust(pose="vanilla")
    assert len(session.viewport.shown["pictures"]) == 1, "it does not move"


def test_a_ready_made_scene_is_an_animation(session: Session) -> None:
    show_scene(session, "fold")
    shown = session.viewport.shown
    (film,) = shown["pictures"]
    assert shown["scenes"] == [] and film.endswith(".webp")
    assert shown["note"] == "The scene fold is getting ready."
    show_scene(session, None)
    assert session.viewport.shown["scenes"]
    with pytest.raises(OptionError, match="something else by now"):
        session.viewport.picture(key_of(film))


def test_packs_are_shown_side_by_side(session: Session) -> None:
    session.viewport.update(beside=())
    shown = session.viewport.shown
    assert len(shown["scenes"]) == len(shown["labels"]) == 2
    session.viewport.update(beside=None)
    assert len(session.viewport.shown["scenes"]) == 1


def test_a_pause_becomes_the_moment_of_the_picture(session: Session) -> None:
    session.viewport.stop_at(1.0)
    assert session.settings.time == 3.0, "nothing stands still"
    session.viewport.update(paused=True)
    session.viewport.stop_at(61.0)
    assert session.settings.time == 3.0, "a picture would take too long"
    session.viewport.stop_at(1.23456789)
    assert session.settings.time == session.viewport.paused_at == 1.234567


def test_a_fault_of_the_settings_is_told(session: Session) -> None:
    wear(session, "flag")
    session.viewport.update(garment="no-such.toml")
    assert "no-such.toml" in session.viewport.shown["line"]


@pytest.mark.parametrize("scene", [None, "fold"])
def test_a_garment_that_is_left_gives_back_the_options_of_the_banner(scene: str | None) -> None:
    session = Session(Settings(wind=3, view="iso", placement="wall", facing="east"))
    before = session.settings
    wear(session, "flag")
    wear(session, "cape", "traveller")
    assert session.settings.view != "iso"
    session.adjust(wind=9)
    show_scene(session, scene)
    assert session.settings == before
    session.adjust(wind=9)
    show_scene(session, None)
    assert session.settings.wind == 9
    session.close()


def test_a_shield_comes_back_from_a_garment_without_the_wall_of_its_banner() -> None:
    session = Session(Settings(placement="wall", facing="east"))
    wear(session, "flag")
    session.edit(Sketch(kind="shield"))
    wear(session, None)
    assert session.settings.placement == "standing" and session.settings.facing is None
    session.close()


def test_a_step_of_the_history_brings_back_what_was_worn(tmp_path: Path) -> None:
    session = Session(Settings(wind=9, placement="wall", facing="east"))
    steps = [session.motion]
    for names in ({"garment": "cape"}, {"garment": "pennon", "skin": "traveller"}):
        wear(session, **names)
        steps.append(session.motion)
    for step in (*reversed(steps), *steps):
        session.move(json.loads(json.dumps(step)))
        assert session.motion == step
    wear(session, None)
    assert session.motion == steps[0]
    private = tmp_path / "own.toml"
    for wrong in ("cape", {"garment": str(private)}, {"pack": "x"}, {"garment": ["cape"]}):
        with pytest.raises(DesignError):
            session.move({"wind": 3, "shown": wrong})
    assert session.motion == steps[0]
    session.close()


@pytest.fixture
def client() -> Iterator[tuple[TestClient, Sessions]]:
    app, sessions = FastAPI(), Sessions()
    add_routes(app, sessions, KernelBuild(sessions, ()))
    with TestClient(app) as client:
        yield client, sessions
    sessions.close_all()


def test_the_browser_gets_scenes_kernels_viewer_and_pictures(
    client: tuple[TestClient, Sessions], playable: Playable
) -> None:
    page, sessions = client
    session = sessions.open(playable(size=(24, 32)), sketch_of(DESIGN))
    shown = session.viewport.shown
    (scene,) = shown["scenes"]
    answer = page.get(scene)
    header, _ = unpack(answer.content)
    assert header["sheets"][:2] == ["", "base"]
    kernels = page.get(answer.headers["kernels"]).content
    assert kernels == smallest_module(called_kernels({"": gzip.compress(answer.content)}))
    assert page.get(answer.headers["kernels"] + "x").status_code == 404
    assert "export { LiveViewer, StudioDesigner };" in page.get("viewer.js").text
    still = page.get(shown["pictures"][0])
    assert still.headers["content-type"] == "image/png"
    assert Image.open(io.BytesIO(still.content)).size == (24, 32)
    assert page.get(shown["pictures"][0].replace(session.token, "x")).status_code == 404
    session.adjust(solver="verlet")
    answer = page.get(session.viewport.shown["scenes"][0])
    assert (answer.status_code, answer.text[:26]) == (422, "A picture by the renderer,")


def test_a_scene_without_files_of_a_user_is_made_once_for_all_tabs(
    client: tuple[TestClient, Sessions], playable: Playable, tmp_path: Path
) -> None:
    page, sessions = client
    settings = playable(size=(24, 32), thickness=1.75)
    one, other = (sessions.open(settings) for _ in range(2))
    (scene,) = one.viewport.shown["scenes"]
    key = key_of(scene)
    assert scene == f"live/{key}.bin" and known_kernels(key) is None
    assert [scene] == other.viewport.shown["scenes"]
    assert page.get(scene).status_code == 200 and known_kernels(key)
    assert one.viewport.scene(key) is other.viewport.scene(key)
    pack = zip_pack(tmp_path / "a.zip", {META: mcmeta(), f"{BANNER}creeper.png": png(noise(1))})
    for session in (one, other):
        session.adjust(packs=(pack,))
        assert session.viewport.shown["scenes"][0].startswith(f"live/{session.token}/")
    assert page.get(scene).status_code == 204, "no tab shows it"


def test_the_first_scene_is_made_before_a_tab_asks_for_it(playable: Playable) -> None:
    sessions = Sessions(StudioConfig(playable(thickness=1.5)))
    sessions.make_first_scene()
    (scene,) = sessions.open().viewport.shown["scenes"]
    assert known_kernels(key_of(scene))
    sessions.close_all()


def test_a_module_that_is_missing_is_built_once_and_told(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("drapery.studio.kernel_build.is_module_built", bool)
    sessions, told = Sessions(), []
    made = tmp_path / "made"
    made.touch()
    sessions.open().listen(lambda: told.append(made.read_text()), "scene")
    programs = [f"open({str(made)!r}, 'a').write({each!r})" for each in ("first ", "whole")]
    building = KernelBuild(sessions, *((sys.executable, "-c", program) for program in programs))

    async def ask() -> None:
        assert await building.start() == await building.start()
        await building.wait()

    asyncio.run(ask())
    assert told == ["first ", "first whole"]
    sessions.close_all()


def test_a_build_ends_with_the_studio(tmp_path: Path) -> None:
    waiting = (sys.executable, "-c", "import time; time.sleep(600)")
    building = KernelBuild(Sessions(), waiting, waiting)

    async def ask() -> None:
        await building.start()
        await asyncio.sleep(0)
        await building.stop()

    asyncio.run(asyncio.wait_for(ask(), 60))
