"""One tab's live cloth: it moves while somebody looks, and tells those who look when it has.

Whatever happens is handed over as a call and made between two ticks, in the thread that ticks; the
page's own loop only hands over and waits.
"""

import asyncio
import math
import threading
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from contextlib import suppress
from dataclasses import dataclass, replace
from functools import cache, partial
from pathlib import Path
from typing import Any, TypeVar

from drapery.banner.design import Banner
from drapery.banner.packs import Packs, open_packs
from drapery.errors import DraperyError
from drapery.scenes.stager import STEP
from drapery.studio.live import Live
from drapery.studio.pack_store import shelf_of
from drapery.studio.panes import Shown
from drapery.studio.player import Player
from drapery.studio.session import Session
from drapery.studio.sketch import banner_of
from drapery.studio.wind_controls import wind_controls_of

BEHIND = 4
"""Ticks that are caught up at once; what is further behind is left out, and time runs slower."""
THREADS = 4
LONG = 0.8
"""A turn that takes longer is one to be told of [s]."""
FIRST = 2.0
"""How long the cloth waits for its first picture to be seen [s]."""
LONGEST = 60.0
"""Later moments are not asked of pictures, which are simulated from the start [s]."""

T = TypeVar("T")
Input = Callable[[Live], object]


@dataclass(frozen=True)
class ViewportRequest:
    """What the live cloth is asked for beyond the settings of a picture.

    on: the wind blows. paused: time stands. scene: a ready-made scene instead of the design.
    beside: packs in which the design is shown side by side; None where only one is.
    """

    on: bool = True
    paused: bool = False
    scene: str | None = None
    beside: tuple[str | Path, ...] | None = None


@cache
def _pool() -> ThreadPoolExecutor:
    """The threads in which all tabs' cloths move."""
    return ThreadPoolExecutor(THREADS, thread_name_prefix="live")


async def in_thread(call: Callable[[], T]) -> T:
    """The call's result, made in a thread of the live cloths."""
    return await asyncio.get_running_loop().run_in_executor(_pool(), call)


class Viewport:
    """The live cloth of a session.

    version: counts what can be seen. fault: why the last change did not come about; "" where it
    did. note: what takes a while. size: of the viewer [pixels]. viewers: how many are connected,
    hidden ones too. closed: whether its tab is gone.
    """

    def __init__(self, session: Session) -> None:
        self.wishes = ViewportRequest()
        self.version = 0
        self.fault = ""
        self.note = ""
        self.size = (640, 480)
        self.viewers = 0
        self.closed = False
        self._session = session
        self._live: Live | None = None
        self._player: Player | None = None
        self._inputs: list[Input] = []
        self._told: list[Callable[[], None]] = []
        self._stale = True
        self._keys: tuple[str, ...] = ()
        self._paused = False
        self._lookers = 0
        self._task: asyncio.Task[None] | None = None
        self._pulse = asyncio.Event()
        self._owed = 0.0
        self._lock = threading.Lock()
        self._picture: tuple[int, Shown | None] = (-1, None)
        self._beside: tuple[object, Packs] | None = None
        for event in ("sketch", "settings", "packs"):
            session.listen(event, self._spoil)
        session.on_close(self.close)

    def wish(self, **options: Any) -> None:
        """Ask for something else; tells "scene" where another scene is asked for.

        Raises OptionError or PackError; nothing has changed then.
        """
        before, after = self.wishes, replace(self.wishes, **options)
        self._open_beside(after.beside)
        self.wishes = after
        self._spoil()
        if after.scene != before.scene:
            self.note = f"The scene {after.scene} is getting ready." if after.scene else ""
            self._session.tell("scene")
            self.version += 1
            self._wake()

    def listen(self, call: Callable[[], None]) -> None:
        """Call this whenever keys have changed the wishes, or a fault has come or gone."""
        self._told.append(call)

    def do(self, call: Input) -> None:
        """Hand over what happens to the live cloth before the next tick."""
        self._inputs.append(call)

    def press(self, keys: tuple[str, ...], azimuth: float) -> None:
        """Hold these keys of the wind; see `Live.press`."""
        self._keys = keys
        self.do(lambda live: live.press(keys, azimuth))

    def switch(self) -> None:
        """The wind off, or on again."""
        self.wish(on=not self.wishes.on)
        self._tell()

    def reset(self) -> None:
        """The cloth back to rest, the scene back to its start."""
        self.do(self._restart)

    def look_anew(self) -> None:
        """Frame what is seen as the named view does."""
        self.do(lambda live: live.reframe())

    def enter(self) -> None:
        """Somebody looks: it begins to move."""
        self._lookers += 1
        if self._task is None and not self.closed:
            self._task = asyncio.get_running_loop().create_task(self._run(), name="live cloth")

    def leave(self) -> None:
        """Somebody looks no more; without anybody it stands still and costs nothing."""
        self._lookers -= 1
        if self._lookers <= 0:
            self._stop()

    def close(self) -> None:
        """The tab is gone."""
        self.closed = True
        self._stop()
        self.version += 1
        self._wake()
        _STAGES.pop(self._session.token, None)
        self._live = self._player = None
        self._told.clear()

    @property
    def moving(self) -> bool:
        """Whether a task of it runs."""
        return self._task is not None

    async def after(self, version: int) -> None:
        """Wait until there is something newer than this version."""
        while self.version <= version:
            await self._pulse.wait()

    def shown(self) -> Shown | None:
        """What is to be seen now; None before there is anything. Not for the page's own loop."""
        with self._lock:
            if self._picture[0] != self.version:
                self._picture = self.version, self._material()
            return self._picture[1]

    def _restart(self, live: Live) -> None:
        live.reset()
        if self._player is not None:
            self._player.restart()
            self._player.step()

    def _material(self) -> Shown | None:
        if self._player is not None:
            return self._player.now
        return self._live.shown() if self._live is not None else None

    def _open_beside(self, paths: tuple[str | Path, ...] | None) -> Packs | None:
        """The packs beside those of the settings, opened once for as long as they stay."""
        if paths is None:
            self._beside = None
            return None
        key = paths, self._session.settings.format
        if self._beside is None or self._beside[0] != key:
            self._beside = key, open_packs(paths, format=key[1])
        return self._beside[1]

    def _captions(self) -> tuple[str, str]:
        """What stands side by side."""
        called = shelf_of(self._session).called
        others = [called.get(str(path), str(path)) for path in self.wishes.beside or ()]
        return "your packs", ", ".join(Path(name).name for name in others) or "our own art"

    def _stop(self) -> None:
        if self._task is not None:
            self._task.cancel()
            self._task = None
        self._lookers = 0

    def _spoil(self) -> None:
        self._stale = True

    def _tell(self) -> None:
        for call in [*self._told]:
            with suppress(Exception):
                call()

    async def _run(self) -> None:
        try:
            await self._keep_moving()
        except Exception as error:  # a fault of ours: say so rather than stand still in silence
            self.fault = f"the live cloth has stopped ({type(error).__name__}); reload the page"
            self.version += 1
            self._wake()
            raise

    async def _keep_moving(self) -> None:
        clock = asyncio.get_running_loop().time
        due = clock()
        patience = due + FIRST
        while True:
            ticks = min(int((clock() - due) / STEP) + 1, BEHIND)
            if self._picture[1] is None and clock() < patience:
                ticks = 0  # the first picture need not wait for the kernels
            fault, version = self.fault, self.version
            if not self.wishes.paused or self._stale or self._inputs:
                await self._patiently(partial(self._turn, ticks))
            if self.version != version:
                self._wake()
            if self.fault != fault or (not self._keys and self._has_steered()):
                self._tell()
            self._note_pause()
            due = max(due + ticks * STEP, clock() - STEP)
            await asyncio.sleep(max(0.0, due - clock()))

    def _note_pause(self) -> None:
        """A moment at which it is stopped is what a picture shows too, if pictures can."""
        stopped = self.wishes.paused and not self._paused
        self._paused = self.wishes.paused
        live = self._live
        if not stopped or self._player is not None or live is None or not live.is_picture:
            return
        if 0 < live.time <= LONGEST:
            # Rounded down, lest the picture take one step more.
            self._session.adjust(time=math.floor(live.time * 1e6) / 1e6)

    def _wake(self) -> None:
        """Let those who wait for something new go on."""
        self._pulse.set()
        self._pulse = asyncio.Event()

    async def _patiently(self, call: Callable[[], None]) -> None:
        """Make a turn in a thread; what takes long, as kernels do the first time, is told."""
        turn = asyncio.ensure_future(in_thread(call))
        try:
            done, _ = await asyncio.wait({turn}, timeout=LONG)
            if not done and not self.note:
                self.note = "One moment: what is used for the first time has to get ready."
                self.version += 1
                self._wake()
                await turn
                self.note = ""
                self.version += 1
            await turn
        finally:
            turn.cancel()

    def _has_steered(self) -> bool:
        """Whether keys have made another wind; it is then what is wished for."""
        breeze = self._live.wind_controls if self._live is not None else None
        if breeze is None or self._stale or self._inputs:
            return False
        wished = wind_controls_of(self._session.settings)
        now = round(breeze.speed, 1), round(breeze.heading, 1)
        if now == (round(wished.speed, 1), round(wished.heading, 1)):
            return False
        self._session.adjust(wind=now[0], direction=now[1])
        return True

    def _turn(self, ticks: int) -> None:
        with self._lock:
            self._change(ticks)

    def _change(self, ticks: int) -> None:
        """Make the changes, then move on; what goes wrong is kept as `fault`."""
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
            self.fault = shelf_of(self._session).in_plain_words(str(error))
            self.note, moved = "", True
        if stale or inputs or moved:
            self.version += 1

    def _move(self, ticks: int) -> bool:
        if self._live is not None:
            self._live.leaves_room = not self.wishes.paused
        if self.wishes.paused or ticks <= 0:
            return False
        if self._player is None:
            if self._live is not None:
                self._live.step(ticks)
            return self._live is not None
        self._owed += ticks * STEP * self._player.fps
        if self._owed < 1.0:
            return False
        # A scene that is late is late: each of its moments is simulated only once.
        self._owed = min(self._owed - 1.0, 1.0)
        self._player.step()
        return True

    def _renew(self) -> None:
        """Take over the design, the settings and the wishes. Raises DraperyError."""
        session, wishes = self._session, self.wishes
        if wishes.scene != (self._player.entry.name if self._player is not None else None):
            self._player = None
            if wishes.scene is not None:
                player = Player(wishes.scene, self.size)
                player.step()
                self._player = player
        settings, packs = session.settings, session.packs()
        beside = self._open_beside(wishes.beside)
        design = _design(session)
        if self._live is None:
            self._live = Live(design, packs, settings)
        self._live.update(design, packs, settings, beside, self._captions())
        breeze = replace(self._live.wind_controls, on=wishes.on)
        if breeze != self._live.wind_controls and not self._keys:
            self._live.set_wind(breeze)


def _design(session: Session) -> Banner | None:
    """What the sketch shows; nothing where a texture is worn instead."""
    return None if session.settings.texture is not None else banner_of(session.sketch)


_STAGES: dict[str, Viewport] = {}


def stage_of(session: Session) -> Viewport:
    """The live cloth of a session, which ends with it."""
    if session.token not in _STAGES:
        _STAGES[session.token] = Viewport(session)
    return _STAGES[session.token]
