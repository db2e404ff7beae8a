"""Renderers by name. A backend is a function from a scene to a frame.

Installed packages add their own by an entry point in the group `drapery.backends`, whose name is
the backend's and whose value is such a function.
"""

from collections.abc import Callable
from importlib import import_module
from importlib.metadata import EntryPoint, entry_points

from drapery.errors import BackendError
from drapery.render.frame import Frame
from drapery.render.scene import Scene

DrawScene = Callable[[Scene], Frame]

GROUP = "drapery.backends"

BUILT_IN = {
    "soft": "drapery.render.soft:draw_scene",
    "pyrender": "drapery.render.gl:draw_scene",
}
DEFAULT = "soft"
"""What `auto` means: it needs no system package and gives the same bits everywhere."""


def backend(name: str | DrawScene = "auto") -> DrawScene:
    """The renderer of this name; a renderer is returned as it is. Raises BackendError."""
    if not isinstance(name, str):
        return name
    chosen = DEFAULT if name == "auto" else name
    if chosen in BUILT_IN:
        return _load(BUILT_IN[chosen])
    added = _added()
    if chosen not in added:
        known = ", ".join(["auto", *BUILT_IN, *added])
        raise BackendError(f"backend {name!r} is not known; use one of: {known}")
    try:
        found: DrawScene = added[chosen].load()
    except Exception as fault:  # whatever a stranger's package raises while it is imported
        raise BackendError(
            f"backend {name!r} of {added[chosen].value} cannot be loaded ({fault});"
            " mend or remove the package that brings it"
        ) from fault
    return found


def backend_names() -> list[str]:
    """All names that `backend` takes, `auto` aside."""
    return [*BUILT_IN, *_added()]


def _added() -> dict[str, EntryPoint]:
    points = sorted(entry_points(group=GROUP), key=lambda point: point.name)
    return {point.name: point for point in points if point.name not in BUILT_IN}


def _load(path: str) -> DrawScene:
    module, _, function = path.partition(":")
    found: DrawScene = getattr(import_module(module), function)
    return found
