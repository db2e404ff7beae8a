"""A ready-made scene, played in a loop at its own frame rate."""

from collections.abc import Iterator
from dataclasses import replace
from typing import Any

from drapery.render import Scene
from drapery.scenes import Clip, Picture, PictureGrid, SceneEntry, find_scene
from drapery.studio.panes import ViewerState, shown_picture

MAX_CACHED = 96 << 20
"""The most memory for cached moments of a scene [bytes]; cached moments are simulated once."""
REDUCED = {"stress": {"side": "7"}}
"""Parameters for scenes that would be too large for a browser with their defaults."""
MAX_SIDE = 960
"""The longest side of the picture for which a scene is framed [pixels]; a viewer may be larger."""


class Player:
    """Plays a scene of the catalogue from its first moment to its last, in a loop.

    size: width and height of the picture for which it is framed [pixels]. Raises OptionError for
    an unknown name.
    """

    def __init__(self, name: str, size: tuple[int, int] = (640, 480)) -> None:
        self.entry: SceneEntry = find_scene(name)
        self.parameters = self.entry.parameters(REDUCED.get(name, {}))
        self._clip: Clip = replace(self.entry.clip, size=_framed_size(size))
        self._cache: list[ViewerState] | None = []
        self._free = MAX_CACHED
        self._counted: set[int] = set()
        self._upcoming: Iterator[ViewerState] = iter(())
        self.now: ViewerState | None = None

    @property
    def fps(self) -> float:
        """Moments per second."""
        return self._clip.fps

    def step(self) -> ViewerState:
        """The next moment; after the last moment comes the first."""
        shown = next(self._upcoming, None)
        if shown is None:
            self.restart()
            shown = next(self._upcoming)
        self.now = replace(shown, cut=(self.entry.name, self._clip.size))
        return self.now

    def restart(self) -> None:
        """Restart at the first moment."""
        whole = self._cache is not None and len(self._cache) == self._clip.count
        self._upcoming = iter(self._cache or ()) if whole else self._simulated()

    def _simulated(self) -> Iterator[ViewerState]:
        """Simulate all moments; caches them unless they exceed the cache's limit."""
        self._cache, self._free = ([], MAX_CACHED) if self._cache is not None else (None, 0)
        self._counted = set()
        for picture in self.entry.play(self.parameters, self._clip):
            shown = shown_picture(picture)
            self._add_to_cache(shown, picture)
            yield shown

    def _add_to_cache(self, shown: ViewerState, picture: Picture) -> None:
        if self._cache is None:
            return
        self._free -= self._new_bytes(picture)
        self._cache.append(shown)
        if self._free < 0:
            self._cache = None

    def _new_bytes(self, picture: Picture) -> int:
        """The size of those arrays that no cached moment refers to yet [bytes]."""
        total = 0
        for array in _arrays(picture):
            # An array keeps its identity while a cached moment holds it.
            if id(array) not in self._counted:
                self._counted.add(id(array))
                total += array.nbytes
        return total


def _arrays(picture: Picture) -> Iterator[Any]:
    if isinstance(picture, PictureGrid):
        for part in picture.pictures:
            yield from _arrays(part)
    elif isinstance(picture, Scene):
        for model in picture.models:
            mesh = model.mesh
            yield from (mesh.positions, mesh.normals, mesh.triangles, mesh.uvs)
            yield from (layer.texels for material in model.materials for layer in material.layers)
    else:
        yield picture.pixels


def _framed_size(size: tuple[int, int]) -> tuple[int, int]:
    """The size reduced to MAX_SIDE in proportion, each side a multiple of 4 and at least 64."""
    scale = min(1.0, MAX_SIDE / max(size))
    width, height = (max(64, int(side * scale) // 4 * 4) for side in size)
    return width, height
