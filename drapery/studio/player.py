"""A ready-made scene or a garment, played in a loop at its own frame rate."""

import threading
from collections.abc import Callable, Iterator
from concurrent.futures import Future
from dataclasses import dataclass, replace

from drapery import Settings
from drapery.garments import Garment
from drapery.packs import Packs
from drapery.render import Scene
from drapery.scenes import (
    Clip,
    ClipPicture,
    Dressed,
    PictureGrid,
    Schedule,
    find_scene,
    loop,
)
from drapery.studio.chosen_scene import SceneChoice
from drapery.web.panes import ViewerState, shown_picture

MAX_CACHED = 96 << 20
"""The most memory for cached moments of a scene [bytes]; cached moments are simulated once."""
REDUCED = {"stress": {"side": "7"}}
"""Parameters for scenes that would be too large for a browser with their defaults."""
MAX_SIDE = 960
"""The longest side of the picture for which a scene is framed [pixels]; a viewer may be larger."""


@dataclass(frozen=True)
class Show:
    """What is played. clip: its length and frame rate.

    play: the pictures of a clip; what it calls while it simulates may raise to end it.
    first: a picture that is shown until the first one of the clip is ready, if that takes long.
    """

    name: str
    clip: Clip
    play: Callable[[Clip, Callable[[int, int], object]], Iterator[ClipPicture]]
    first: Callable[[Clip], ClipPicture] | None = None


def scene_show(scene: SceneChoice) -> Show:
    """A scene of the catalogue. Raises OptionError for an unknown name."""
    entry = find_scene(scene.name)
    parameters = entry.parameters(REDUCED.get(scene.name, {}) | dict(scene.words))
    return Show(scene.name, entry.clip, lambda clip, _: entry.play(parameters, clip))


def garment_show(garment: Garment, packs: Packs, settings: Settings) -> Show:
    """A garment: first at rest, then its seamless loop."""

    def play(clip: Clip, on_moment: Callable[[int, int], object]) -> Iterator[ClipPicture]:
        settings = _sized(clip)
        return loop(garment, packs, settings, clip.count, clip.fps, on_moment)

    def first(clip: Clip) -> ClipPicture:
        dressed = Dressed(garment, packs, _sized(clip))
        starts = [each.start[None] for each in dressed.cloths]
        return next(dressed.scenes(starts, Schedule.at([0.0], dressed.step)))

    def _sized(clip: Clip) -> Settings:
        return settings.changed(size=clip.size, pixel=1)

    return Show(garment.name, Clip(), play, first)


class _ClosedError(Exception):
    """The player is closed, so nobody waits for the rest of the loop."""


class Player:
    """Plays a show from its first moment to its last, in a loop.

    size: width and height of the picture for which it is framed [pixels].
    clip: what it plays: the moments of the show, framed for the picture.
    """

    def __init__(self, show: Show, size: tuple[int, int] = (640, 480)) -> None:
        self.show = show
        self.clip: Clip = replace(show.clip, size=_framed_size(size))
        self._prepared: Future[list[ViewerState]] | None = None
        self._cache: list[ViewerState] = []
        self._starts = 0
        self._closed = threading.Event()
        self._upcoming: Iterator[ViewerState] = iter(())
        self.now: ViewerState | None = None

    @property
    def fps(self) -> float:
        """Moments per second."""
        return self.clip.fps

    def step(self) -> ViewerState:
        """The next moment; after the last moment comes the first.

        A show with a first picture shows it until a thread has simulated all moments.
        """
        if self.show.first is not None and self._prepared is None:
            first = shown_picture(self.show.first(self.clip))  # it may raise PackError
            self._prepared = Future()
            self.now = replace(first, cut=(self.show.name, "first"))
            threading.Thread(target=self._prepare, name="show", daemon=True).start()
        if self._prepared is not None:
            if not self._prepared.done() and self.now is not None:
                return self.now
            self._cache = self._prepared.result()
        shown = next(self._upcoming, None)
        if shown is None:
            self._restart()
            shown = next(self._upcoming)
        self.now = replace(shown, cut=(self.show.name, self.clip.size, self._starts))
        return self.now

    def _prepare(self) -> None:
        assert self._prepared is not None
        try:
            pictures = self.show.play(self.clip, self._check_open)
            self._prepared.set_result([*map(shown_picture, pictures)])
        except Exception as error:  # `step` raises it
            self._prepared.set_exception(error)

    def _check_open(self, _number: int, _last: int) -> None:
        if self._closed.is_set():
            raise _ClosedError

    def close(self) -> None:
        """End the thread that simulates the loop, if it still runs."""
        self._closed.set()

    def begin_anew(self) -> None:
        """Go to the first moment, with the scene's own camera."""
        self._starts += 1
        self._restart()
        self.step()

    def _restart(self) -> None:
        whole = len(self._cache) == self.clip.count
        self._upcoming = iter(self._cache) if whole else self._simulated()

    def _simulated(self) -> Iterator[ViewerState]:
        """Simulate all moments; caches them unless they exceed the cache's limit."""
        self._cache = []
        for picture in self.show.play(self.clip, self._check_open):
            shown = shown_picture(picture)
            if self.clip.count * _changing_bytes(picture) <= MAX_CACHED:
                self._cache.append(shown)
            yield shown


def _changing_bytes(picture: ClipPicture) -> int:
    """The size of what may differ from moment to moment; textures are the same arrays [bytes]."""
    if isinstance(picture, PictureGrid):
        return sum(map(_changing_bytes, picture.pictures))
    if isinstance(picture, Scene):
        meshes = [model.mesh for model in picture.models]
        arrays = ((m.positions, m.normals, m.triangles, m.uvs) for m in meshes)
        return sum(each.nbytes for of_mesh in arrays for each in of_mesh)
    return picture.pixels.nbytes


def _framed_size(size: tuple[int, int]) -> tuple[int, int]:
    """The size reduced to MAX_SIDE in proportion, each side a multiple of 4 and at least 64."""
    scale = min(1.0, MAX_SIDE / max(size))
    width, height = (max(64, int(side * scale) // 4 * 4) for side in size)
    return width, height
