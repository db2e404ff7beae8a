"""A garment on its wearer that plays on without Python: see `playing`.

The motion of the wearer repeats after whole time steps, so tables of one period hold the places of
pins, boxes and bones. The cloth is of single precision, as that of a banner.
"""

import math
from dataclasses import dataclass, replace
from functools import cached_property

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
from drapery.garments.poses import BonePoses
from drapery.mesh import Array
from drapery.render.scene import RiggedModel, Scene
from drapery.scenes.dressing import MIDDLE, WORN_STEP, Dressed
from drapery.scenes.layered import meet_each_other
from drapery.scenes.player_motion import RAMP, STRIDE
from drapery.scenes.playing import PlayedCloth, PlayedSubject, turning_of
from drapery.scenes.recording import Drape, Schedule
from drapery.scenes.stager import wind_of
from drapery.scenes.staging import Staging
from drapery.scenes.wearers import Wearer
from drapery.settings import Settings
from drapery.style.live_figure import LiveFigure, make_live_figure
from drapery.style.skins import SIDE

TICKS = 5040
"""Poses are computed at so many moments of a time step, which most numbers of substeps divide."""
BLENDED = 4.0
"""The period of a blend of several motions [s]."""
SWINGS = np.array(((0.0, 0.0, 0.0), (0.2, 0.0, -0.2), (-0.2, 0.2, -0.7)))
"""How far cloth moves from its start in the picture that the camera frames [m]."""


@dataclass(frozen=True, eq=False)
class PlayedGarment(Dressed):
    """A garment whose wearer repeats its motion after `period`; see `played_garment`."""

    @property
    def cycle(self) -> tuple[int, int]:
        """Time steps before the motion repeats, and after which it does."""
        who = self.garment.wearer
        if who is None or self.period is None:
            return 0, 1
        ramp = who.motion != "walk" or (who.head is not None and any(who.look))
        return math.ceil(RAMP / self.step) if ramp else 0, round(self.period / self.step)

    @cached_property
    def wearer(self) -> Wearer | None:
        """Who wears it, in poses that repeat."""
        found = super().wearer
        return found and replace(found, poses=_repeated(found.poses, self.step, *self.cycle))

    def drape(self, sewn: SewnCloth) -> Drape:
        """A cloth in the wind, in single precision."""
        drape = super().drape(sewn)
        start = drape.start.positions.astype(np.float32)
        return replace(drape, start=State(start, np.zeros_like(start)))

    def first_scene(self) -> Scene:
        """The scene at the start, with a camera that frames cloth in a light wind."""
        sheets = [sewn.start + SWINGS[:, None] for sewn in self.cloths]
        return next(self.scenes(sheets, Schedule.at([0.0] * len(SWINGS), self.step)))

    def texture_areas(self) -> tuple[list[int], list[int]]:
        """Which part of a skin its wearer shows, and which part of a cape's texture its first cloth
        does, for textures 64 texels wide: left, top, width, height [texels]."""
        height, width = self.cloths[0].pieces[0].material.layers[0].texels.shape[:2]
        # Wings of wool show all of it.
        left, top, *extent = map(int, WING["front"])
        is_sheet = width % SIDE == 0
        cape = [0, 0, SIDE, SIDE * height // width] if is_sheet else [left, top, *extent]
        return [0, 0, SIDE, SIDE], cape

    def subject(self) -> PlayedSubject:
        """Its cloths and its wearer at the start, to be played in the wind of the settings."""
        staging = Staging(self.settings)
        figure = None if self.wearer is None else _figure(self, self.wearer, staging)
        cloths = tuple(_played_cloth(self, sewn) for sewn in self.cloths)
        return PlayedSubject(staging, cloths, figure)

    def figures(self) -> list[RiggedModel]:
        """The models of the wearer, which come directly before those of the cloths."""
        models = self.wearer.models(0.0, self._bones) if self.wearer else ()
        return [model for model in models if isinstance(model, RiggedModel)]


def played_garment(garment: Garment, packs: Packs, settings: Settings) -> PlayedGarment:
    """A garment to be played. Raises OptionError or PackError for what cannot be."""
    who = garment.wearer
    steps = None if who is None else max(1, round(_period_of(who, garment) / WORN_STEP))
    period = None if steps is None else steps * WORN_STEP
    played = PlayedGarment(garment, packs, settings, period)
    if not played.cloths:
        raise OptionError(f"garment {garment.name} has no cloth; give a player a cape or elytra")
    if played.wearer and garment.collisions != "none" and meet_each_other(played.cloths):
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
    for sewn in played.cloths:
        if len(sewn.pieces) > 1 or len(sewn.pieces[0].particles) != len(sewn.start):
            raise OptionError(
                f"garment {garment.name} has sewn pieces, which cannot be played without Python;"
                " use a cape, elytra or another garment without seams"
            )
    return played


def _played_cloth(played: PlayedGarment, sewn: SewnCloth) -> PlayedCloth:
    drape, settings, who = played.drape(sewn), played.settings, played.garment.wearer
    speed = 0.0 if who is None or isinstance(settings.wind, Wind) else who.speed
    wind = played.wind(None)
    return PlayedCloth(
        drape.begin(played.step),
        (Gravity(), wind, *settings.forces),
        replace(wind, velocity=wind_of(settings).velocity),
        sewn.pieces[0].shell,
        sewn.thickness,
        MIDDLE,
        motion=LiveMotion(drape.pins, *played.cycle, (0.0, 0.0, -speed), sewn.cloth.drag),
    )


def _figure(played: PlayedGarment, wearer: Wearer, staging: Staging) -> LiveFigure:
    """The wearer, with a table of its poses."""
    bones, poses = [*wearer.parts], wearer.poses
    table = poses.at(np.arange(sum(played.cycle)) * played.step)
    table = table[:, [poses.bones.index(bone) for bone in bones]]
    rigs = [model.rig for model in played.figures()]
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


def _repeated(poses: BonePoses, step: float, first: int, period: int) -> BonePoses:
    """Poses that repeat after `period` steps from step number `first` on, at whole ticks."""

    def table(times: Array) -> Array:
        ticks, start = np.rint(times / step * TICKS), first * TICKS
        repeated = start + (ticks - start) % (period * TICKS)
        return poses.at(np.where(ticks < start, ticks, repeated) * step / TICKS)

    return BonePoses(poses.bones, table)
