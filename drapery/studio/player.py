"""A ready-made scene played over and over, at its own pace."""

from collections.abc import Iterator
from dataclasses import replace
from typing import Any

from drapery.render import Scene
from drapery.scenes import Clip, Picture, PictureGrid, SceneEntry, find_scene
from drapery.studio.panes import Shown, shown_picture

MAX_KEPT = 96 << 20
"""A scene is remembered up to this size [bytes], so that it need not be simulated again."""
LIGHTER = {"stress": {"side": "7"}}
"""Parameters of scenes that would be too much for a browser."""
LONGEST = 960
"""The longest side for which a scene is laid out [pixels]; the viewer draws at its own."""


class Player:
    """A scene of the catalogue, from its first moment to its last and again.

    size: width and height for which it is laid out [pixels]. Raises OptionError for a name that is
    none.
    """

    def __init__(self, name: str, size: tuple[int, int] = (640, 480)) -> None:
        self.entry: SceneEntry = find_scene(name)
        self.parameters = self.entry.parameters(LIGHTER.get(name, {}))
        self._clip: Clip = replace(self.entry.clip, size=_laid_out(size))
        self._kept: list[Shown] | None = []
        self._room = MAX_KEPT
        self._known: set[int] = set()
        self._coming: Iterator[Shown] = iter(())
        self._round = 0
        self.now: Shown | None = None

    @property
    def fps(self) -> float:
        """Moments a second."""
        return self._clip.fps

    def step(self) -> Shown:
        """The next moment; after the last the first again."""
        shown = next(self._coming, None)
        if shown is None:
            self.restart()
            shown = next(self._coming)
        self.now = replace(shown, cut=(self.entry.name, self._clip.size))
        return self.now

    def restart(self) -> None:
        """From the first moment again."""
        whole = self._kept is not None and len(self._kept) == self._clip.count
        self._coming = iter(self._kept or ()) if whole else self._played()

    def _played(self) -> Iterator[Shown]:
        """All moments, simulated; remembered where there is room."""
        self._kept, self._room = ([], MAX_KEPT) if self._kept is not None else (None, 0)
        self._known = set()
        for picture in self.entry.play(self.parameters, self._clip):
            shown = shown_picture(picture)
            self._keep(shown, picture)
            yield shown

    def _keep(self, shown: Shown, picture: Picture) -> None:
        if self._kept is None:
            return
        self._room -= self._weight(picture)
        self._kept.append(shown)
        if self._room < 0:
            self._kept = None

    def _weight(self, picture: Picture) -> int:
        """The bytes of what is new in a picture."""
        total = 0
        for array in _arrays(picture):
            # What is known by its identity is held by the moments that are kept.
            if id(array) not in self._known:
                self._known.add(id(array))
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
            yield from (layer.texels for look in model.materials for layer in look.layers)
    else:
        yield picture.pixels


def _laid_out(size: tuple[int, int]) -> tuple[int, int]:
    """The size, made smaller or larger in its proportion, in whole pixels that halve."""
    scale = min(1.0, LONGEST / max(size))
    width, height = (max(64, int(side * scale) // 4 * 4) for side in size)
    return width, height
