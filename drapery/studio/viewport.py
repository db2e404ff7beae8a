"""The live cloth of one tab: it moves while a viewer is visible, and wakes the viewers.

Each input is a function that is queued and called between two ticks, in the thread that makes the
ticks; the page's event loop only adds to the queue and waits.
"""

import asyncio
import logging
import math
import threading
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path
from typing import Any

from drapery import Banner, DraperyError
from drapery.garments import Garment
from drapery.packs import Packs, open_packs
from drapery.scenes import STEP
from drapery.studio.chosen_scene import SceneChoice, scene_choice
from drapery.studio.document import Document
from drapery.studio.live import Live
from drapery.studio.live_threads import in_thread
from drapery.studio.pack_store import PackStore
from drapery.studio.player import Player, garment_show, scene_show
from drapery.studio.sketch import banner_of
from drapery.studio.snippets import ExportRequest, options_for, subject_of
from drapery.studio.wind_controls import wind_controls_of
from drapery.web.panes import ViewerState

LOG = logging.getLogger(__name__)
BEHIND = 4
"""The most ticks in one turn; more delayed ticks are skipped, so simulated time runs slower."""
LONG = 0.8
"""The user gets a note if a turn takes longer than this [s]."""
FIRST = 2.0
"""How long the cloth waits until its first picture has been seen [s]."""
HUNG = 120
"""The number of time steps after which cloth that stands still for its user is shown."""
LONGEST = 60.0
"""The latest moment of a pause that becomes the picture's `time` [s].

A picture is simulated from the start, so a later moment would take too long.
"""

Input = Callable[[Live], object]


@dataclass(frozen=True)
class ViewportRequest:
    """What the live cloth shows, in addition to the settings of a picture.

    on: whether the wind blows. paused: whether time stands still. scene: a ready-made scene, shown
    in place of the design. garment: the name of a garment, shown in place of the banner. skin: the
    name or path of a skin, whose player is shown with the garment and the design.
    beside: packs for a second view of the design, side by side with the first; None shows only one
    view.
    """

    on: bool = True
    paused: bool = False
    scene: str | None = None
    garment: str | None = None
    skin: str | None = None
    beside: tuple[str | Path, ...] | None = None

    @property
    def shown(self) -> tuple[str | None, ...]:
        """What takes the place of the banner, if anything does."""
        return self.scene, self.garment, self.skin


class Viewport:
    """The live cloth of a tab.

    request: what it shows. version: grows with every visible change. fault: why the last change
    failed, or "". note: a line about work that takes long, or "". size: width and height of the
    viewer [pixels]. viewers: the number of connected viewers, including hidden ones. paused_at: the
    `time` that the last pause has set, or None. banner_options: the options of the banner that a
    garment's replace while it is shown. closed: whether its tab is closed.
    """

    def __init__(self, document: Document, packs: PackStore) -> None:
        self.request = ViewportRequest()
        self.version = 0
        self.fault = ""
        self.note = ""
        self.size = (640, 480)
        self.viewers = 0
        self.paused_at: float | None = None
        self.banner_options: dict[str, Any] = {}
        self.closed = False
        self._document = document
        self._pack_store = packs
        self._live: Live | None = None
        self._player: Player | None = None
        self._played: object = None  # what the player shows
        self._inputs: list[Input] = []
        self._stale = True
        self._keys: tuple[str, ...] = ()
        self._paused = False
        self._still = False  # whether its user prefers reduced motion
        self._visible = 0
        self._task: asyncio.Task[None] | None = None
        self._pulse = asyncio.Event()
        self._owed = 0.0
        self._turning = threading.Lock()
        self._swapping = threading.Lock()  # guards what both the event loop and the thread change
        self._picture: tuple[int, ViewerState | None] = (-1, None)
        self._beside: tuple[object, Packs] | None = None
        document.listen(self._mark_stale, "sketch", "settings", "packs")
        document.on_close(self.close)

    def update(self, **options: Any) -> None:
        """Change the request; notifies "scene" if it differs.

        Raises OptionError or PackError; then nothing changes.
        """
        before, after = self.request, replace(self.request, **options)
        self._open_beside(after.beside)
        self.request = after
        self._mark_stale()
        if after.shown != before.shown:
            name = Path(after.scene or after.garment or after.skin or "").stem
            kind = "scene" if after.scene else "garment" if after.garment else "player"
            self.note = f"The {kind} {name} is getting ready." if name else ""
            self.count_change()
            self._wake()
        if after != before:
            self._document.notify("scene")

    def do(self, call: Input) -> None:
        """Queue an input; it is called before the next tick."""
        with self._swapping:
            self._inputs.append(call)

    def press(self, keys: tuple[str, ...], azimuth: float) -> None:
        """Hold these keys of the wind; see `Live.press`."""
        self._keys = keys
        self.do(lambda live: live.press(keys, azimuth))

    def switch(self) -> None:
        """Switch the wind on or off."""
        self.update(on=not self.request.on)
        self._notify()

    def reset(self) -> None:
        """Reset the cloth to rest, a scene to its start, and the camera to the named view."""
        self.do(self._restart)

    def hold_still(self) -> None:
        """Begin paused, for a user who prefers reduced motion; cloth then shows a moment in which
        it hangs. The picture keeps its `time`."""
        if not self._still:
            self._still = self._paused = True
            self.update(paused=True)

    def look_anew(self) -> None:
        """Reset the camera to the named view."""
        self.do(lambda live: live.reframe())

    def enter(self) -> None:
        """Count a viewer that has become visible; the first starts the motion."""
        self._visible += 1
        if self._task is None and not self.closed:
            self._task = asyncio.get_running_loop().create_task(self._run(), name="live cloth")

    def leave(self) -> None:
        """Count a viewer that has become hidden; after the last one, the motion stops."""
        self._visible -= 1
        if self._visible <= 0:
            self._stop()

    def close(self) -> None:
        """End the motion and disconnect its viewers, because the tab is closed."""
        self.closed = True
        self._stop()
        self.count_change()
        self._wake()
        self._leave_player()
        self._live = None

    @property
    def moving(self) -> bool:
        """Whether its motion task runs."""
        return self._task is not None

    async def after(self, version: int) -> None:
        """Wait for a version newer than this one."""
        while self.version <= version:
            await self._pulse.wait()

    def shown(self) -> ViewerState | None:
        """What is visible now; None before the first picture, and while a turn takes long.

        It blocks, so call it in a thread.
        """
        if not self._turning.acquire(timeout=LONG):
            return None
        try:
            version = self.version
            if self._picture[0] != version:
                self._picture = version, self._content()
            return self._picture[1]
        finally:
            self._turning.release()

    def _restart(self, live: Live) -> None:
        live.reset()
        live.reframe()
        if self._player is not None:
            self._player.begin_anew()

    def _content(self) -> ViewerState | None:
        if self._player is not None:
            return self._player.now
        return self._live.shown() if self._live is not None else None

    def _open_beside(self, paths: tuple[str | Path, ...] | None) -> Packs | None:
        """The packs of the second view; opened again only when they change."""
        key = paths, self._document.settings.format
        with self._swapping:
            if paths is None:
                self._beside = None
                return None
            if self._beside is None or self._beside[0] != key:
                self._beside = key, open_packs(paths, format=key[1])
            return self._beside[1]

    def _captions(self) -> tuple[str, str]:
        """The labels of the two sides."""
        names = self._pack_store.names
        others = [names.get(str(path), str(path)) for path in self.request.beside or ()]
        return "your packs", ", ".join(Path(name).name for name in others) or "our own art"

    def _stop(self) -> None:
        if self._task is not None:
            self._task.cancel()
            self._task = None
        self._visible = 0

    def _mark_stale(self) -> None:
        with self._swapping:
            self._stale = True

    def count_change(self) -> None:
        """Count a visible change, from any thread."""
        with self._swapping:
            self.version += 1

    def _notify(self) -> None:
        try:
            self._document.notify("steered")
        except Exception:  # the cloth moves on without the panel that failed
            LOG.exception("a panel failed")

    async def _run(self) -> None:
        try:
            await self._keep_moving()
        except Exception as error:  # an error in the program: tell the user
            self.fault = f"the live cloth has stopped ({type(error).__name__}); reload the page"
            self.count_change()
            self._wake()
            raise

    async def _keep_moving(self) -> None:
        clock = asyncio.get_running_loop().time
        due = clock()
        patience = due + FIRST
        while True:
            ticks = min(int((clock() - due) / STEP) + 1, BEHIND)
            if self._picture[1] is None and clock() < patience:
                ticks = 0  # show the first picture before the kernels are compiled
            fault, version = self.fault, self.version
            if not self.request.paused or self._stale or self._inputs or self._must_hang():
                await self._run_in_thread(partial(self.turn, ticks))
            if self.version != version:
                self._wake()
            if self.fault != fault or (not self._keys and self._has_steered()):
                self._notify()
            self._note_pause()
            due = max(due + ticks * STEP, clock() - STEP)
            await asyncio.sleep(max(0.0, due - clock()))

    def _note_pause(self) -> None:
        """Set the picture's `time` to the moment of the pause, if a picture can show it."""
        stopped = self.request.paused and not self._paused
        self._paused = self.request.paused
        live = self._live
        if not stopped or self._player is not None or live is None or not live.is_picture:
            return
        if 0 < live.time <= LONGEST:
            # Round down: the picture must not make one more step.
            self.paused_at = math.floor(live.time * 1e6) / 1e6
            self._document.adjust(time=self.paused_at)

    def _wake(self) -> None:
        """Wake all tasks that wait for a change."""
        self._pulse.set()
        self._pulse = asyncio.Event()

    async def _run_in_thread(self, call: Callable[[], None]) -> None:
        """Run a turn in a thread; sets a note if it takes long, such as at the first compile."""
        turn = asyncio.ensure_future(in_thread(call))
        try:
            done, _ = await asyncio.wait({turn}, timeout=LONG)
            if not done and not self.note:
                self.note = "One moment: the first use needs some preparation."
                self.count_change()
                self._wake()
                await turn
                self.note = ""
                self.count_change()
            await turn
        finally:
            turn.cancel()

    def _has_steered(self) -> bool:
        """Whether keys have changed the wind; if so, the settings adopt the new wind."""
        wind = self._live.wind_controls if self._live is not None else None
        if wind is None or self._stale or self._inputs:
            return False
        before = wind_controls_of(self._document.settings)
        now = round(wind.speed, 1), round(wind.heading, 1)
        if now == (round(before.speed, 1), round(before.heading, 1)):
            return False
        self._document.adjust(wind=now[0], direction=now[1])
        return True

    def turn(self, ticks: int) -> None:
        """Apply the queued changes, then advance the motion by some ticks."""
        with self._turning:
            self._change(ticks)

    def _change(self, ticks: int) -> None:
        """Apply the queued changes, then advance the motion; stores an error in `fault`."""
        with self._swapping:
            inputs, self._inputs = self._inputs, []
            stale, self._stale = self._stale, False
        try:
            if stale:
                self._renew()
            for call in inputs:
                if self._live is not None:
                    call(self._live)
            moved = self._move(ticks)
            if stale:
                self.fault = self.note = ""
        except DraperyError as error:
            self.fault = self._pack_store.with_names(str(error))
            self.note, moved = "", True
        if stale or inputs or moved:
            self.count_change()

    def _move(self, ticks: int) -> bool:
        if self._live is not None:
            self._live.leaves_room = not self.request.paused
        must_hang = self._must_hang()
        if ticks <= 0 or (self.request.paused and not must_hang):
            return False
        if self._player is None:
            if self._live is not None:
                self._live.step(HUNG if must_hang else ticks)
            return self._live is not None
        self._owed += ticks * STEP * self._player.fps
        if self._owed < 1.0:
            return False
        # Do not catch up on a delay: a scene advances by at most one moment per turn.
        self._owed = min(self._owed - 1.0, 1.0)
        self._player.step()
        return True

    def _must_hang(self) -> bool:
        """Whether cloth that stands still for its user is at rest yet, where it is flat."""
        live = self._live if self._still and self._player is None else None
        return live is not None and self.request.paused and not live.time

    def _choose_player(self, packs: Packs) -> None:
        """Begin another scene or garment if the request asks for one. Raises DraperyError."""
        request, document = self.request, self._document
        settings = document.settings if request.on else document.settings.changed(wind=0.0)
        wanted: object = None
        if request.scene is not None:
            wanted = scene_choice(request.scene, _design(document), settings)
        elif request.garment is not None or request.skin is not None:
            worn, skin = request.garment, request.skin
            wanted = ExportRequest(_design(document), settings, garment=worn, skin=skin)
        if wanted == self._played:
            return
        self._leave_player()
        self._played = wanted
        if isinstance(wanted, ExportRequest):
            garment = subject_of(wanted)
            assert isinstance(garment, Garment)
            self._player = Player(garment_show(garment, packs, options_for(wanted)), self.size)
        elif isinstance(wanted, SceneChoice):
            self._player = Player(scene_show(wanted), self.size)
        if self._player is not None:
            self._player.step()

    def _leave_player(self) -> None:
        if self._player is not None:
            self._player.close()
        self._player = None

    def _renew(self) -> None:
        """Apply the design, the settings and the request. Raises DraperyError."""
        document, request = self._document, self.request
        settings, packs = document.settings, document.packs()
        self._choose_player(packs)
        beside = self._open_beside(request.beside)
        design = _design(document)
        if self._live is None:
            self._live = Live(design, packs, settings)
        self._live.update(design, packs, settings, beside, self._captions())
        wind = replace(self._live.wind_controls, on=request.on)
        if wind != self._live.wind_controls and not self._keys:
            self._live.set_wind(wind)


def _design(document: Document) -> Banner | None:
    """The banner of the sketch; None if a texture is shown instead."""
    return None if document.settings.texture is not None else banner_of(document.sketch)
