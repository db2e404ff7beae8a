"""Ready-made scenes, one file each, and how a subject with its settings becomes a scene.

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

from typing import TYPE_CHECKING

from drapery.lazy import lazy_names

if TYPE_CHECKING:
    from drapery.scenes.bodies import (
        STEP,
        WIND_AXIS,
        ClothSpec,
        LiveBody,
        StagedBody,
        cloth_at_rest,
        cloth_spec,
        flow,
        wind_of,
    )
    from drapery.scenes.catalogue import Clip, SceneEntry, find_scene, scene_names
    from drapery.scenes.drawing import scene_frames
    from drapery.scenes.dressing import Dressed
    from drapery.scenes.exploded import exploded_view
    from drapery.scenes.garment_playing import (
        first_scene,
        played_garment,
        repeating_garment,
        texture_areas,
    )
    from drapery.scenes.parameters import SceneParameters
    from drapery.scenes.picture_grid import Picture, PictureGrid
    from drapery.scenes.playing import (
        LiveKernel,
        LivePanel,
        PlayedCloth,
        PlayedSubject,
        live_panels,
        live_picture,
        played_body,
    )
    from drapery.scenes.recording import Schedule
    from drapery.scenes.staging import Staging, floor_under
    from drapery.scenes.subjects import StagedSubject, loop, moments, stage, still, subject_of

__all__ = [
    "STEP",
    "WIND_AXIS",
    "Clip",
    "ClothSpec",
    "Dressed",
    "LiveBody",
    "LiveKernel",
    "LivePanel",
    "Picture",
    "PictureGrid",
    "PlayedCloth",
    "PlayedSubject",
    "SceneEntry",
    "SceneParameters",
    "Schedule",
    "StagedBody",
    "StagedSubject",
    "Staging",
    "cloth_at_rest",
    "cloth_spec",
    "exploded_view",
    "find_scene",
    "first_scene",
    "floor_under",
    "flow",
    "live_panels",
    "live_picture",
    "loop",
    "moments",
    "played_body",
    "played_garment",
    "repeating_garment",
    "scene_frames",
    "scene_names",
    "stage",
    "still",
    "subject_of",
    "texture_areas",
    "wind_of",
]

__getattr__, __dir__ = lazy_names(
    __name__,
    {
        "scenes.catalogue": ("Clip", "SceneEntry", "find_scene", "scene_names"),
        "scenes.drawing": ("scene_frames",),
        "scenes.dressing": ("Dressed",),
        "scenes.exploded": ("exploded_view",),
        "scenes.garment_playing": (
            "first_scene",
            "played_garment",
            "repeating_garment",
            "texture_areas",
        ),
        "scenes.parameters": ("SceneParameters",),
        "scenes.picture_grid": ("Picture", "PictureGrid"),
        "scenes.playing": (
            "LiveKernel",
            "LivePanel",
            "PlayedCloth",
            "PlayedSubject",
            "live_panels",
            "live_picture",
            "played_body",
        ),
        "scenes.recording": ("Schedule",),
        "scenes.subjects": ("StagedSubject", "loop", "moments", "stage", "still", "subject_of"),
        "scenes.bodies": (
            "STEP",
            "WIND_AXIS",
            "ClothSpec",
            "LiveBody",
            "StagedBody",
            "cloth_at_rest",
            "cloth_spec",
            "flow",
            "wind_of",
        ),
        "scenes.staging": ("Staging", "floor_under"),
    },
)
