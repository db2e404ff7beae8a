"""A garment on its wearer that plays on without Python: see `playing`.

The motion of the wearer repeats after whole time steps, so tables of one period hold the places of
pins, boxes and bones. The cloth is of single precision, as a banner's is.
"""

import math
from dataclasses import replace

import numpy as np

from drapery.banner.packs import Packs
from drapery.cloth import Gravity, State, Wind
from drapery.cloth.live import LiveMotion
from drapery.errors import OptionError
from drapery.garments.assembly import SewnCloth
from drapery.garments.blends import read_blend
from drapery.garments.model import Garment, GarmentWearer
from drapery.garments.motions import find_motion
from drapery.garments.players import WING
from drapery.render.scene import Scene
from drapery.settings import Settings
from drapery.stage.dressing import MIDDLE, WORN_STEP, Dressed
from drapery.stage.forces import wind_of
from drapery.stage.layered import meet_each_other
from drapery.stage.player_motion import RAMP, STRIDE
from drapery.stage.playing import PlayedCloth, PlayedSubject, turning_of
from drapery.stage.recording import Schedule
from drapery.stage.staging import Staging
from drapery.stage.wearers import Wearer
from drapery.style.live_figure import LiveFigure, make_live_figure
from drapery.style.skins import SIDE

BLENDED = 4.0
"""The period of a blend of several motions [s]."""
SWINGS = np.array(((0.0, 0.0, 0.0), (0.2, 0.0, -0.2), (-0.2, 0.2, -0.7)))
"""How far cloth moves from its start in the picture that the camera frames [m]."""


def repeating_garment(garment: Garment, packs: Packs, settings: Settings) -> Dressed:
    """A garment whose wearer repeats its motion after whole time steps, to be played.

    garment: what is worn or hangs.
    packs: resource packs, see `drapery.packs.open_packs`.
    settings: the options of the picture.

    Raises OptionError or PackError for what cannot be played.
    """
    worn = Dressed(garment, packs, settings, *_cycle_of(garment))
    if not worn.cloths:
        raise OptionError(f"garment {garment.name} has no cloth; give a player a cape or elytra")
    if worn.wearer and garment.collisions != "none" and meet_each_other(worn.cloths):
        raise OptionError(
            "garments that meet each other cannot be played without Python; use only one of them"
        )
    if garment.collisions == "all":
        raise OptionError(
            f"garment {garment.name} meets itself, which cloth that can be pulled does not;"
            ' use collisions = "world"'
        )
    if garment.mesh and garment.collisions != "none":
        raise OptionError(
            f"garment {garment.name} has 3-D files, which cannot be played without Python;"
            " use another garment"
        )
    for sewn in worn.cloths:
        if len(sewn.pieces) > 1 or sewn.pieces[0].shell.count != len(sewn.start):
            raise OptionError(
                f"garment {garment.name} has sewn pieces, which cannot be played without Python;"
                " use a cape, elytra or another garment without seams"
            )
    return worn


def played_garment(worn: Dressed) -> PlayedSubject:
    """The cloths and the wearer of a garment at the start, in the wind of its settings.

    worn: see `repeating_garment`.

    Raises OptionError for cloth that cannot be played.
    """
    staging = Staging(worn.settings)
    figure = None if worn.wearer is None else _figure(worn, worn.wearer, staging)
    return PlayedSubject(staging, tuple(_played_cloth(worn, sewn) for sewn in worn.cloths), figure)


def first_scene(worn: Dressed) -> Scene:
    """The scene at the start, with a camera that frames cloth in a light wind."""
    places = [sewn.start + SWINGS[:, None] for sewn in worn.cloths]
    return next(worn.scenes(places, Schedule.at([0.0] * len(SWINGS), worn.step)))


def texture_areas(worn: Dressed) -> tuple[list[int], list[int]]:
    """Which part of a skin the wearer shows, and which part of a cape's texture the first cloth
    does, for textures 64 texels wide: left, top, width, height [texels]."""
    height, width = worn.cloths[0].pieces[0].material_at(0.0).layers[0].texels.shape[:2]
    # Wings of wool show all of it.
    left, top, *extent = map(int, WING["front"])
    is_sheet = width % SIDE == 0
    cape = [0, 0, SIDE, SIDE * height // width] if is_sheet else [left, top, *extent]
    return [0, 0, SIDE, SIDE], cape


def _cycle_of(garment: Garment) -> tuple[float | None, tuple[int, int]]:
    """The period of the wearer's motion [s], and its `cycle`, see `Dressed`."""
    who = garment.wearer
    if who is None:
        return None, (0, 1)
    steps = max(1, round(_period_of(who, garment) / WORN_STEP))
    ramp = who.motion != "walk" or (who.head is not None and any(who.look))
    return steps * WORN_STEP, (math.ceil(RAMP / WORN_STEP) if ramp else 0, steps)


def _played_cloth(worn: Dressed, sewn: SewnCloth) -> PlayedCloth:
    drape, settings, who = worn.drape(sewn), worn.settings, worn.garment.wearer
    start = sewn.start[None].astype(np.float32)
    single = State(start, np.zeros_like(start))
    speed = 0.0 if who is None or isinstance(settings.wind, Wind) else who.speed
    wind, cycle = worn.wind(None), worn.cycle or (0, 1)
    return PlayedCloth(
        replace(drape.begin(worn.step), state=single),
        (Gravity(), wind, *settings.forces),
        replace(wind, velocity=wind_of(settings).velocity),
        sewn.pieces[0],
        MIDDLE,
        motion=LiveMotion(drape.pins, *cycle, (0.0, 0.0, -speed), sewn.cloth.drag),
    )


def _figure(worn: Dressed, wearer: Wearer, staging: Staging) -> LiveFigure:
    """The wearer, with a table of its poses."""
    bones, poses = [*wearer.parts], wearer.poses
    table = poses.at(np.arange(sum(worn.cycle or (0, 1))) * worn.step)
    table = table[:, [poses.bones.index(bone) for bone in bones]]
    rigs = [model.rig for model in worn.figures()]
    light, turned = staging.light, turning_of(staging.settings)
    return make_live_figure(rigs, bones, table, MIDDLE, light, *turned)


def _period_of(who: GarmentWearer, garment: Garment) -> float:
    """After which time the motion of a wearer repeats [s]."""
    if who.motion == "walk":
        return STRIDE
    parts = read_blend(who.motion, garment.folder).parts
    if len(parts) > 1 or parts[0][0] == "walk":
        return BLENDED
    return find_motion(parts[0][0], garment.folder).period
