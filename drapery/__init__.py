"""Minecraft banners as pictures of real cloth."""

from typing import TYPE_CHECKING, Any

from drapery.errors import DraperyError

if TYPE_CHECKING:
    from drapery.banner.design import Banner, Layer
    from drapery.cloth import simulate
    from drapery.pictures import animate, draw
    from drapery.style.extrusion import extrude

__all__ = ["Banner", "DraperyError", "Layer", "animate", "draw", "extrude", "simulate"]

_HOMES = {
    "Banner": "drapery.banner.design",
    "Layer": "drapery.banner.design",
    "animate": "drapery.pictures",
    "draw": "drapery.pictures",
    "extrude": "drapery.style.extrusion",
    "simulate": "drapery.cloth",
}


def __getattr__(name: str) -> Any:
    # A name is fetched when it is first used, so that `drapery --help` does not wait for numba.
    if name not in _HOMES:
        raise AttributeError(f"module 'drapery' has no attribute {name!r}")
    from importlib import import_module

    return getattr(import_module(_HOMES[name]), name)
