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

from drapery.lazy import import_lazily

if TYPE_CHECKING:
    from drapery.scenes.catalogue import (
        Clip as Clip,
        SceneEntry as SceneEntry,
        find_scene as find_scene,
        scene_names as scene_names,
    )
    from drapery.scenes.drawing import scene_frames as scene_frames
    from drapery.scenes.exploded import exploded_view as exploded_view
    from drapery.scenes.parameters import SceneParameters as SceneParameters
    from drapery.scenes.picture_grid import ClipPicture as ClipPicture, PictureGrid as PictureGrid
    from drapery.stage.bodies import (
        STEP as STEP,
        StagedBody as StagedBody,
    )
    from drapery.stage.dressing import Dressed as Dressed
    from drapery.stage.forces import (
        WIND_AXIS as WIND_AXIS,
        flow as flow,
        wind_of as wind_of,
    )
    from drapery.stage.garment_playing import (
        first_scene as first_scene,
        played_garment as played_garment,
        repeating_garment as repeating_garment,
        texture_areas as texture_areas,
    )
    from drapery.stage.playing import (
        LiveKernel as LiveKernel,
        LivePanel as LivePanel,
        PlayedCloth as PlayedCloth,
        PlayedSubject as PlayedSubject,
        live_panels as live_panels,
        live_picture as live_picture,
        played_body as played_body,
    )
    from drapery.stage.recording import Schedule as Schedule
    from drapery.stage.staging import Staging as Staging, floor_under as floor_under
    from drapery.stage.subjects import (
        StagedSubject as StagedSubject,
        loop as loop,
        moments as moments,
        stage as stage,
        still as still,
        subject_of as subject_of,
    )
else:
    import_lazily(__name__)
