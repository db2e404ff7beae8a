"""The ready-made scenes by name: one module each, which offers `play(parameters, clip)`.

The type of `parameters` is a subclass of `SceneParameters`, a frozen dataclass with the scene's
defaults. `play` yields one picture for each frame of the clip. The first line of the module's
docstring describes the scene; its CLIP, if it has one, is the scene's own length and frame rate.
"""

import pkgutil
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from importlib import import_module
from types import ModuleType
from typing import Self, get_type_hints

from drapery.errors import OptionError, shown
from drapery.scenes.parameters import SceneParameters, read_parameters
from drapery.scenes.picture_grid import ClipPicture
from drapery.settings import LoopSettings

_PACKAGE = __name__.rpartition(".")[0]


@dataclass(frozen=True)
class Clip:
    """The size and length of a film.

    size: width and height [pixels].
    count: number of frames.
    fps: [frames/s].
    """

    size: tuple[int, int] = (480, 480)
    count: int = 80
    fps: float = 20.0

    @classmethod
    def timed(cls, size: tuple[int, int], timing: LoopSettings) -> Self:
        """The film that plays as long as a loop.

        size: width and height [pixels].
        timing: the options of the loop.
        """
        return cls(size, timing.count, timing.fps)

    @property
    def timing(self) -> LoopSettings:
        """The options of a loop as long as the film. Raises OptionError beyond their limits."""
        return LoopSettings(self.count / self.fps, self.fps)


@dataclass(frozen=True)
class SceneEntry:
    """One scene of the catalogue.

    name: as in `drapery scene NAME`.
    summary: what it shows, in one line.
    module: where it is defined.
    """

    name: str
    summary: str
    module: ModuleType

    @property
    def clip(self) -> Clip:
        """The scene's own length and frame rate."""
        own: Clip = getattr(self.module, "CLIP", Clip())
        return own

    def parameters(self, words: Mapping[str, str] | None = None) -> SceneParameters:
        """The scene's parameters. words: those that are given, as text.

        Raises OptionError.
        """
        kind: type[SceneParameters] = get_type_hints(self.module.play)["parameters"]
        return read_parameters(kind, words or {}, self.name)

    def play(self, parameters: SceneParameters, clip: Clip) -> Iterator[ClipPicture]:
        """One picture for each frame of a film.

        parameters: the values of the scene's own options.
        clip: size and length of the film.
        """
        pictures: Iterator[ClipPicture] = self.module.play(parameters, clip)
        return pictures


def scene_names() -> list[str]:
    """The names of all scenes, as on the command line."""
    found = (info.name for info in pkgutil.iter_modules(import_module(_PACKAGE).__path__))
    return sorted(name.replace("_", "-") for name in found if _is_scene(name))


def find_scene(name: str) -> SceneEntry:
    """The scene of this name.

    Raises OptionError if there is none.
    """
    known = scene_names()
    if name not in known:
        raise OptionError(f"scene {shown(name)} is not known; use one of: {', '.join(known)}")
    module = import_module(f"{_PACKAGE}.{name.replace('-', '_')}")
    summary = (module.__doc__ or "").strip().splitlines()[0]
    return SceneEntry(name, summary, module)


def _is_scene(name: str) -> bool:
    return hasattr(import_module(f"{_PACKAGE}.{name}"), "play")
