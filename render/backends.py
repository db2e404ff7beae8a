"""Renderers by name. A backend is a function from a `Scene` to a `Frame`.

Another package can add a backend by an entry point in the group `drapery.backends`. The name of the
entry point is the name of the backend, its value is the function. In the package's pyproject.toml:

    [project.entry-points."drapery.backends"]
    wireframe = "my_package.drawing:draw_scene"

and in my_package/drawing.py:

    def draw_scene(scene: Scene) -> Frame: ...

The frame has the scene's size, and straight alpha over the scene's background. The function raises
OptionError for a scene that it cannot draw and BackendError if a library or device is missing. It
may cache the scene's arrays but holds no other reference to them, and any thread may call it.

What a renderer knows of each pixel beside its colour is in `Buffers`. A backend that makes these
itself has an attribute `with_buffers`: a function from a `Scene` to its frame and a function that
makes its buffers when a style asks for them. For others `soft` makes them.

It cannot have the name of a built-in backend. `drapery doctor` draws a triangle with it.
"""

from collections.abc import Callable
from importlib import import_module
from typing import TYPE_CHECKING, Any, Protocol

from drapery.errors import BackendError
from drapery.render.buffers import Buffers
from drapery.render.frame import Frame
from drapery.render.scene import Scene

if TYPE_CHECKING:
    from importlib.metadata import EntryPoint

MakeBuffers = Callable[[], Buffers]

GROUP = "drapery.backends"

BUILT_IN = {
    "soft": "drapery.render.soft:draw_scene",
    "pyrender": "drapery.render.gl:draw_scene",
}
DEFAULT = "soft"
"""The backend `auto`: it needs no system package and gives the same bits everywhere."""


class DrawScene(Protocol):
    """A backend: a function that draws a `Scene` as a `Frame` of its size.

    It raises OptionError for a scene that it cannot draw, and BackendError if a library or device
    is missing.
    """

    def __call__(self, scene: Scene, /) -> Frame: ...


def backend(name: str | DrawScene = "auto") -> DrawScene:
    """The backend of this name: a function that draws a `Scene` as a `Frame`.

    name: `soft`, `pyrender`, a name that an installed package adds, or `auto`, which is `soft`; a
        function is returned as it is.
    Raises BackendError for another name and for a backend that cannot be loaded.
    """
    if not isinstance(name, str):
        return name
    chosen = DEFAULT if name == "auto" else name
    if chosen in BUILT_IN:
        built_in: DrawScene = _load(BUILT_IN[chosen])
        return built_in
    added = _added()
    if chosen not in added:
        known = ", ".join(["auto", *BUILT_IN, *added])
        raise BackendError(f"backend {name!r} is not known; use one of: {known}")
    try:
        found: DrawScene = added[chosen].load()
    except Exception as fault:  # a package may raise anything while it is imported
        raise BackendError(
            f"backend {name!r} of {added[chosen].value} cannot be loaded ({fault});"
            " repair or remove the package that adds it"
        ) from fault
    return found


def draw_with_buffers(scene: Scene, draw_scene: DrawScene) -> tuple[Frame, MakeBuffers]:
    """A scene drawn by a backend, and a function that makes the buffers of the picture."""
    both = getattr(draw_scene, "with_buffers", None)
    if both is not None:
        found: tuple[Frame, MakeBuffers] = both(scene)
        return found
    make_buffers = _load("drapery.render.soft:draw_buffers")
    return draw_scene(scene), lambda: make_buffers(scene)


def backend_names() -> list[str]:
    """All names that `backend` takes, except `auto`."""
    return [*BUILT_IN, *_added()]


def added_backends() -> dict[str, str]:
    """The backends of installed packages, and the package that adds each."""
    return {name: point.dist.name if point.dist else name for name, point in _added().items()}


def _added() -> "dict[str, EntryPoint]":
    from importlib.metadata import entry_points

    points = sorted(entry_points(group=GROUP), key=lambda point: point.name)
    return {point.name: point for point in points if point.name not in BUILT_IN}


def _load(path: str) -> Any:
    module, _, function = path.partition(":")
    return getattr(import_module(module), function)
