"""The viewport: what its event loop and its threads share is neither lost nor waited for."""

import asyncio
import subprocess
import sys
import threading
import time
from collections.abc import Callable, Iterator
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from drapery.garments import find_garment
from drapery.packs import open_packs
from drapery.scenes import Clip, ClipPicture
from drapery.settings import Settings
from drapery.studio.live_threads import THREADS, in_thread
from drapery.studio.panels.live import show_scene, wear
from drapery.studio.player import Player, Show, garment_show
from drapery.studio.session import Session
from drapery.studio.sketch import Sketch


@pytest.fixture
def session() -> Iterator[Session]:
    opened = Session()
    opened.viewport.turn(0)  # makes the live cloth
    yield opened
    opened.close()


def test_a_viewer_does_not_wait_for_a_long_turn(session: Session) -> None:
    """Else it would not see the note which says that the turn is long."""
    viewport, began, end = session.viewport, threading.Event(), threading.Event()
    viewport.do(lambda live: (began.set(), end.wait(20)))
    turn = threading.Thread(target=viewport.turn, args=(0,))
    turn.start()
    assert began.wait(20)
    start = time.monotonic()
    assert viewport.shown() is None and time.monotonic() < start + 5
    end.set()
    turn.join()
    assert viewport.shown() is not None


def test_no_input_is_lost_while_turns_are_made(session: Session) -> None:
    viewport, seen, done = session.viewport, [], threading.Event()

    def turns() -> None:
        while not done.is_set():
            viewport.turn(0)

    thread = threading.Thread(target=turns)
    thread.start()
    for number in range(2000):
        viewport.do(lambda live, number=number: seen.append(number))
    done.set()
    thread.join()
    viewport.turn(0)
    assert seen == [*range(2000)]


def test_cloth_stands_still_for_a_user_who_prefers_that(session: Session) -> None:
    """It hangs, as at a moment of its motion, and moves once the user wants it to."""
    viewport = session.viewport

    def places() -> Any:
        shown = viewport.shown()
        assert shown is not None
        return shown.panes[0].scene.models[-1].mesh.positions

    flat, time_of_picture = places(), session.settings.time
    viewport.hold_still()
    viewport.turn(1)
    hung = places()
    assert np.abs(hung - flat).max() > 0.02
    viewport.turn(1)
    assert np.array_equal(places(), hung)
    viewport.reset()
    viewport.turn(1)
    assert np.array_equal(places(), hung), "cloth at rest would be flat"
    viewport.update(paused=False)
    viewport.hold_still()  # a connection that was lost says it again
    viewport.turn(1)
    assert not np.array_equal(places(), hung)
    assert session.settings.time == time_of_picture


def test_a_garment_is_shown_at_rest_and_then_moves(session: Session) -> None:
    viewport, kinds = session.viewport, []
    wear(session, "flag")
    assert session.settings.view == "hero" and session.settings.wind == 7
    session.adjust(grid=(3, 5))  # a garment has its own
    for base in ("white", "red"):
        session.edit(Sketch(base))
        viewport.turn(0)
        shown = viewport.shown()
        assert shown is not None and not viewport.fault and not shown.live
        (cloth,) = shown.panes[0].scene.models[-1].materials
        kinds.append([(each.tint, each.texels.tobytes()) for each in cloth.layers])
    assert kinds[0] != kinds[1]  # the flag shows the design
    wear(session, None)
    viewport.turn(0)
    shown = viewport.shown()
    assert shown is not None and shown.live


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
    session.selection.switch_kind()
    wear(session, None)
    assert session.settings.placement == "standing" and session.settings.facing is None
    session.close()


def test_the_loop_of_a_garment_follows_its_first_picture() -> None:
    garment, packs = find_garment("pennants"), open_packs(())
    show = garment_show(garment, packs, garment.settings())
    player = Player(replace(show, clip=Clip(count=2, fps=10.0)), (64, 64))
    first = player.step()
    while (shown := player.step()) is first:
        time.sleep(0.01)
    loop = [shown, *(player.step() for _ in range(3))]
    places = [each.panes[0].scene.models[-1].mesh.positions for each in loop]
    assert first.cut != loop[0].cut == loop[1].cut
    assert not np.array_equal(places[0], places[1]) and places[0] is places[2]


def test_a_loop_that_nobody_will_see_is_given_up(
    session: Session, monkeypatch: pytest.MonkeyPatch
) -> None:
    def endless(clip: Clip, on_moment: Callable[[int, int], object]) -> Iterator[ClipPicture]:
        while True:
            on_moment(0, clip.count)
            time.sleep(0.01)

    def show(*given: Any) -> Show:
        return replace(garment_show(*given), play=endless)

    monkeypatch.setattr("drapery.studio.viewport.garment_show", show)
    viewport, threads = session.viewport, set()
    wear(session, "flag")
    for base in ("white", "red", "blue"):
        session.edit(Sketch(base))
        viewport.turn(0)
        threads |= {each for each in threading.enumerate() if each.name == "show"}
    assert viewport.shown() is not None and not viewport.fault
    assert len(threads) == 3
    session.close()
    for thread in threads:
        thread.join(60)
        assert not thread.is_alive()


def test_a_process_ends_while_a_turn_is_made() -> None:
    """A kernel may be compiled for half a minute, and Ctrl-C would seem to do nothing."""
    endless = "import asyncio, threading; from drapery.studio.live_threads import in_thread\n"
    endless += "turn = in_thread(threading.Event().wait)\n"
    endless += "asyncio.run(asyncio.wait_for(turn, 0.2))"
    run = subprocess.run([sys.executable, "-c", endless], timeout=100, stderr=subprocess.PIPE)
    assert run.returncode == 1 and run.stderr.rstrip().endswith(b"TimeoutError")


def test_a_turn_is_not_made_if_it_is_cancelled_before_a_thread_is_free() -> None:
    begun, free, made = threading.Semaphore(0), threading.Event(), []

    def hold() -> None:
        begun.release()
        free.wait(60)

    async def ask() -> None:
        held = [asyncio.ensure_future(in_thread(hold)) for _ in range(THREADS)]
        for _ in held:
            while not begun.acquire(blocking=False):
                await asyncio.sleep(0.01)
        late = asyncio.ensure_future(in_thread(lambda: made.append(1)))
        await asyncio.sleep(0)
        late.cancel()
        await asyncio.gather(late, return_exceptions=True)
        free.set()
        await asyncio.gather(*held)
        await in_thread(lambda: None)  # jobs are taken in turn

    asyncio.run(asyncio.wait_for(ask(), 60))
    assert made == []


def test_no_version_is_counted_twice(session: Session) -> None:
    viewport = session.viewport
    before = viewport.version
    counts = [
        threading.Thread(target=lambda: [viewport.count_change() for _ in range(5000)])
        for _ in range(4)
    ]
    for thread in counts:
        thread.start()
    for thread in counts:
        thread.join()
    assert viewport.version == before + 20_000
