"""Minecraft banners as pictures of real cloth.

    from drapery import Banner, draw

    draw(Banner.parse("white creeper:lime border:black"), view="hero").save("banner.png")

`drapery.banner` reads and writes designs and composites their sheets, `drapery.packs` opens
resource packs and makes them in memory, `drapery.cloth` simulates cloth, `drapery.style` gives a
simulated cloth its thickness and textures, `drapery.render` draws meshes, `drapery.scenes` hangs
cloth before a camera and plays ready-made scenes, `drapery.comparison` and `drapery.sheets` compare
and list pictures, `drapery.testing` checks them against golden ones. Names are loaded when they
are first used.
"""

from pathlib import Path
from typing import TYPE_CHECKING

from drapery.lazy import lazy_names

if not Path(__path__[0], "render").is_dir():
    # In a checkout `assets` and `render` lie beside this package, and Python that is started there
    # finds it before the package that is installed.
    __path__.append(str(Path(__path__[0]).parent))

if TYPE_CHECKING:
    from drapery.banner.design import Banner, Layer
    from drapery.banner.formats import FoundBanner, parse_banners, read_designs
    from drapery.banner.packs import Packs
    from drapery.cloth import simulate
    from drapery.comparison.pairs import Comparison, compare
    from drapery.errors import (
        BackendError,
        DesignError,
        DraperyError,
        OptionError,
        OutputError,
        PackError,
    )
    from drapery.pictures import animate, draw, draw_face, iter_frames, save_model
    from drapery.render.frame import Animation, Frame
    from drapery.settings import Settings
    from drapery.style.extrusion import extrude

__version__: str = "0.1.0"
"""The version, which `pyproject.toml` repeats for the distribution `drapery-mc`."""

__all__ = [
    "Animation",
    "BackendError",
    "Banner",
    "Comparison",
    "DesignError",
    "DraperyError",
    "FoundBanner",
    "Frame",
    "Layer",
    "OptionError",
    "OutputError",
    "PackError",
    "Packs",
    "Settings",
    "__version__",
    "animate",
    "compare",
    "draw",
    "draw_face",
    "extrude",
    "iter_frames",
    "parse_banners",
    "read_designs",
    "save_model",
    "simulate",
]

__getattr__, __dir__ = lazy_names(
    __name__,
    {
        "banner.design": ("Banner", "Layer"),
        "banner.formats": ("FoundBanner", "parse_banners", "read_designs"),
        "banner.packs": ("Packs",),
        "cloth": ("simulate",),
        "comparison.pairs": ("Comparison", "compare"),
        "errors": (
            "BackendError",
            "DesignError",
            "DraperyError",
            "OptionError",
            "OutputError",
            "PackError",
        ),
        "pictures": ("animate", "draw", "draw_face", "iter_frames", "save_model"),
        "render.frame": ("Animation", "Frame"),
        "settings": ("Settings",),
        "style.extrusion": ("extrude",),
    },
)
