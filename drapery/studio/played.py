"""Files from which the browser plays live cloth: scenes, and the kernels that each calls.

A scene that is made of nothing but what Drapery brings is the same for all tabs. So it is made
once, and its address holds no token: a browser keeps it until its next visit.
"""

import gzip
import threading
from dataclasses import dataclass
from functools import lru_cache

from drapery import Banner
from drapery.garments import Garment
from drapery.packs import Packs
from drapery.settings import Settings
from drapery.web.scene_file import called_kernels, scene_bytes
from drapery.web.wasm.module import module_places, smallest_module, sources_hash

MAX_SHARED = 8
"""The most scenes that are kept for all tabs."""


@dataclass(frozen=True, eq=False)
class PlayedScene:
    """What the file of a scene is made of; see `scene_bytes`.

    paths: of the packs.
    """

    subject: Banner | Garment | None
    packs: Packs
    paths: object
    settings: Settings
    patterns: tuple[str, ...]

    @property
    def is_shared(self) -> bool:
        """Whether no file of a user is part of it."""
        own = self.paths or self.settings.texture or self.settings.style
        return isinstance(self.subject, Banner) and not own


@dataclass(frozen=True)
class SceneFile:
    """A scene. data: compressed with gzip. kernels: the address of what it calls."""

    data: bytes
    kernels: str


def scene_file(key: str, scene: PlayedScene) -> SceneFile:
    """The file of a scene. key: another one for each other file.

    It blocks, so call it in a thread. Raises DraperyError for what a page cannot play.
    """
    if not scene.is_shared:
        return _made(scene)
    with _one_at_a_time:
        if key not in _shared:
            while len(_shared) >= MAX_SHARED:
                del _shared[next(iter(_shared))]
            _shared[key] = _made(scene)
        return _shared[key]


def known_kernels(key: str) -> str | None:
    """The address of the kernels of a scene that has been made for all tabs."""
    file = _shared.get(key)
    return None if file is None else file.kernels


def built_module() -> str:
    """The module that scenes are made for; another one is built for other sources or methods."""
    sizes = [path.stat().st_size for path in module_places() if path.is_file()]
    return f"{sources_hash()}-{sizes[0] if sizes else 0}"


@lru_cache(maxsize=MAX_SHARED)
def kernel_file(module: str, names: str) -> bytes:
    """The kernels of these names with commas between, compressed with gzip.

    module: from `built_module`. Raises WasmBuildError where it is not built, and KeyError for a
    name that it does not have.
    """
    return gzip.compress(smallest_module(names.split(",")), mtime=0)


_shared: dict[str, SceneFile] = {}
_one_at_a_time = threading.Lock()


def _made(scene: PlayedScene) -> SceneFile:
    data = scene_bytes(scene.subject, scene.packs, scene.settings, scene.patterns)
    names = ",".join(sorted(called_kernels({"scene": data})))
    return SceneFile(data, f"cloth.wasm?module={built_module()}&kernels={names}")
