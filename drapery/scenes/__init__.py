"""Ready-made scenes, one file each, and the stager that hangs cloth and steps it in time.

    from drapery import Banner, Settings
    from drapery.packs import open_packs
    from drapery.render import draw_scene
    from drapery.scenes import find_scene, scene_frames, still

    scene = still(Banner.parse("red cross:white"), open_packs(()), Settings(wind=6))
    draw_scene(scene).save("banner.png")  # a drapery.render.Scene: move its camera, add models

    flag = find_scene("flag")
    frames = scene_frames(flag, flag.parameters({"wind": "8"}), flag.clip)

Lengths are metres, times seconds, angles degrees. Names are loaded when they are first used.
"""

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from drapery.scenes.catalogue import Clip, SceneEntry
    from drapery.scenes.catalogue import find as find_scene
    from drapery.scenes.catalogue import names as scene_names
    from drapery.scenes.drawing import scene_frames
    from drapery.scenes.exploded import apart as exploded_view
    from drapery.scenes.parameters import SceneParameters
    from drapery.scenes.picture_grid import Picture, PictureGrid
    from drapery.scenes.stager import (
        STEP,
        WIND_AXIS,
        ClothSpec,
        Stager,
        cloth_at_rest,
        cloth_spec,
        floor_under,
        flow,
        loop,
        still,
    )

__all__ = [
    "STEP",
    "WIND_AXIS",
    "Clip",
    "ClothSpec",
    "Picture",
    "PictureGrid",
    "SceneEntry",
    "SceneParameters",
    "Stager",
    "cloth_at_rest",
    "cloth_spec",
    "exploded_view",
    "find_scene",
    "floor_under",
    "flow",
    "loop",
    "scene_frames",
    "scene_names",
    "still",
]

_NAMES = {
    "drapery.scenes.catalogue": ("Clip", "SceneEntry", "find_scene", "scene_names"),
    "drapery.scenes.drawing": ("scene_frames",),
    "drapery.scenes.exploded": ("exploded_view",),
    "drapery.scenes.parameters": ("SceneParameters",),
    "drapery.scenes.picture_grid": ("Picture", "PictureGrid"),
    "drapery.scenes.stager": (
        *("STEP", "WIND_AXIS", "ClothSpec", "Stager", "cloth_at_rest"),
        *("cloth_spec", "floor_under", "flow", "loop", "still"),
    ),
}
_MODULE_OF = {name: module for module, names in _NAMES.items() for name in names}
_NAME_THERE = {"find_scene": "find", "scene_names": "names", "exploded_view": "apart"}
"""Names that are shorter within their modules."""


def __getattr__(name: str) -> Any:
    if name not in _MODULE_OF:
        raise AttributeError(f"module 'drapery.scenes' has no attribute {name!r}")
    value = getattr(import_module(_MODULE_OF[name]), _NAME_THERE.get(name, name))
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    return sorted(__all__)
