"""Pictures of garments: the camera and light of a `Staging`, with cloth that a garment describes.

A garment's origin is the middle of a block, as a banner's is. The air comes towards a wearer
that walks at the speed of its walk, so its cloth moves as on one that walks through the wind.
"""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import product

import numpy as np

from drapery.arrays import Vectors
from drapery.banner.packs import Packs
from drapery.cloth import (
    Box,
    Collider,
    Collisions,
    Fabric,
    Force,
    MovingCloth,
    Plane,
    State,
    Wind,
)
from drapery.cloth.solvers.registry import solver
from drapery.garments.assembly import SewnCloth, tailor
from drapery.garments.layering import put_behind, put_outside, sampled
from drapery.garments.meshes import StiffMesh, read_stiff_mesh
from drapery.garments.model import Garment, GarmentPole
from drapery.garments.players import with_head_banner
from drapery.mesh import Array
from drapery.render.scene import Model, RiggedModel, Scene
from drapery.settings import Settings
from drapery.stage.bodies import STEP, with_finish
from drapery.stage.forces import in_wind, wind_of, wind_on_wearer
from drapery.stage.layered import common_bones, joint_contact, meet_each_other
from drapery.stage.recording import Drape, Meeting, Schedule, record
from drapery.stage.staging import Staging
from drapery.stage.swept_pins import without_swept_pins
from drapery.stage.wearers import Wearer, wearer_of
from drapery.style.block import turn_matrix
from drapery.style.block_world import Cell, blocks
from drapery.style.board import moved
from drapery.style.body import Part
from drapery.style.grids import finer_shell
from drapery.style.ground import ground_of
from drapery.style.piece import Piece
from drapery.style.refinement import cells_per_cell
from drapery.style.rig import moved_rig
from drapery.style.scenery import pole, pole_frame
from drapery.styles.cloth_models import moved_by_style, tailored

WORN_STEP = STEP / 2
"""The longest time step of cloth on a wearer, whose legs move fast [s]."""
MIDDLE = np.array([0.5, 0.0, 0.5])
"""Where the origin of a garment is drawn [m]: in the middle of a block."""
LOW = 0.25
"""Ground is drawn under cloth that begins lower than this [m]."""
BUST = ("head", "body", "right_arm", "left_arm")
"""The bones of a bust, which end at the waist."""
BEHIND_ROUNDS = 2
"""Garments are put outside each other and behind a shield so often in turn."""
PLAYER_HEIGHT = 1.8
"""Of a wearer that the picture shows from head to foot [m]."""
EDGE = 0.2
"""A garment may hang over the edge of its ground by this length [m]."""
ROUNDING = 1e-9
"""The share of a time step by which steps may be longer, see `Schedule.still`."""
FRICTION = 0.6
"""Of cloth on the ground; on all else its fabric's counts."""


@dataclass(frozen=True, eq=False)
class Dressed:
    """A garment with its wearer, poles and blocks, ready to be simulated and drawn.

    Its methods raise OptionError and PackError.

    garment: what is worn or hangs.
    packs: resource packs, see `drapery.packs.open_packs`.
    settings: the options of the picture.
    period: of a loop [s]; None for other pictures.
    cycle: time steps before the wearer repeats its motion, and after which it does; None where it
        repeats nothing but the loop.
    """

    garment: Garment
    packs: Packs
    settings: Settings
    period: float | None = None
    cycle: tuple[int, int] | None = None

    def check(self) -> None:
        """Raise OptionError or PackError if something cannot be drawn: an edge, file or block."""
        _ = self.cloths, self.wearer, self.fixed

    @cached_property
    def cloths(self) -> tuple[SewnCloth, ...]:
        """The cloths of the garment at rest."""
        who = self.garment.wearer
        if who and who.shown == "head":
            return ()
        sewn = tailor(with_head_banner(self.garment), self.packs)
        if self.settings.finish == "fabric":
            sewn = tuple(_finished(each) for each in sewn)
        if self.wearer is None or who is None or who.kind != "player":
            return sewn
        sewn = put_outside(sewn)
        for box, _ in self.wearer.held_boxes():
            half = np.asarray(box.size) / 2
            if any(_begins_in(each, box) for each in sewn):
                for _ in range(BEHIND_ROUNDS):
                    sewn = put_behind(put_outside(sewn), box.centre - half, box.centre + half)
        return tuple(without_swept_pins(each, self.wearer) for each in sewn)

    @cached_property
    def wearer(self) -> Wearer | None:
        """Who wears it."""
        found = wearer_of(self.garment, self.packs, self.period)
        if found is None or self.cycle is None:
            return found
        return replace(found, poses=found.poses.repeating(self.step, *self.cycle))

    @cached_property
    def meshes(self) -> tuple[StiffMesh, ...]:
        """Its 3-D files."""
        where, texel = self.garment.folder, self.garment.texel
        return tuple(read_stiff_mesh(each, where, texel) for each in self.garment.mesh)

    @cached_property
    def fixed(self) -> tuple[Model, ...]:
        """Its poles, blocks and 3-D files, which do not move."""
        texel = self.garment.texel
        poles = (
            pole(*_ends(each, texel), self.packs, each.half * texel) for each in self.garment.pole
        )
        stiff = (model for each in self.meshes for model in each.models)
        return (*(_shifted(m, -MIDDLE) for m in blocks(self.cells, self.packs)), *poles, *stiff)

    @cached_property
    def cells(self) -> dict[Cell, str]:
        """The garment's blocks by cell; the origin of cells is the corner of the middle block."""
        return {
            (x, y, z): block.kind
            for block in self.garment.block
            for x, y, z in product(
                *(range(a, a + n) for a, n in zip(block.cell, block.size, strict=True))
            )
        }

    @property
    def step(self) -> float:
        """The longest time step [s]."""
        return STEP if self.garment.wearer is None else WORN_STEP

    @property
    def tolerance(self) -> float:
        """The share of a step by which steps may be longer, see `Schedule.still`."""
        return ROUNDING

    def colliders(self, sewn: SewnCloth, *others: SewnCloth) -> tuple[Collider, ...]:
        """What stops a cloth, and others that meet it, in the garment's own frame.

        sewn: the cloth.
        others: those that it meets.
        """
        friction, texel = self.garment.fabric.friction, self.garment.texel
        found = [Collider(Plane(np.zeros(3), np.array([0.0, 1, 0])), friction=FRICTION)]
        for block in self.garment.block:
            size = np.array(block.size, float)
            middle = np.array(block.cell) + size / 2 - MIDDLE
            found.append(Collider(Box(middle, size), friction=friction))
        found += [Collider(_pole_box(each, texel), friction=friction) for each in self.garment.pole]
        found += [Collider(each.surface, friction=friction) for each in self.meshes]
        if self.wearer is not None:
            found += self.wearer.colliders(sewn.solid)
            # Cloth that begins in a shield passes through it.
            found += [
                Collider(box, path, friction=friction)
                for box, path in self.wearer.held_boxes()
                if not any(_begins_in(each, box) for each in (sewn, *others))
            ]
        return tuple(found)

    def forces(self, sewn: SewnCloth, period: float | None) -> tuple[Force, ...]:
        """All forces on a cloth.

        sewn: the cloth.
        period: the wind repeats after this time [s]; None for a wind that does not.
        """
        return (*in_wind(sewn.cloth, self.wind(period)), *self.settings.forces)

    def wind(self, period: float | None) -> Wind:
        """The wind in the garment's own frame."""
        if self.garment.wearer is None:
            return wind_of(self.settings, period)
        return wind_on_wearer(self.settings, self.garment.wearer.speed, period)

    def drape(self, sewn: SewnCloth) -> Drape:
        """A cloth in the wind, with what it meets beside other garments."""
        return Drape(
            lambda dt: self._begin(sewn, dt),
            lambda period: self.forces(sewn, period),
            None if self.wearer is None else sewn.pin_path(self.wearer.poses),
        )

    def _begin(self, sewn: SewnCloth, dt: float) -> MovingCloth:
        start, method, met = sewn.start[None], self.settings.solver, self._collisions(sewn)
        method = solver(method) if isinstance(method, str) else method
        state = State(start, np.zeros_like(start))
        return MovingCloth.begin(sewn.cloth, method, dt, start=state, collisions=met)

    def record(
        self, at: Schedule, on_moment: Callable[[int, int], object] | None = None
    ) -> Sequence[Vectors]:
        """Where each cloth is at the moments of a schedule [m], each of shape [F, N, 3].

        at: the moments.
        on_moment: see `recording.record`.
        """
        drapes = [self.drape(sewn) for sewn in self.cloths]
        return record(drapes, at, self._meeting(), on_moment)

    def _meeting(self) -> Meeting | None:
        """The contact of cloths that meet each other; None if none do."""
        met = self.garment.collisions != "none"
        numbers = meet_each_other(self.cloths) if self.wearer is not None and met else []
        if not numbers or self.wearer is None:
            return None
        sewn, body = [self.cloths[number] for number in numbers], self.wearer.poses.path("body")
        common = replace(sewn[0], solid=common_bones(sewn, tuple(self.wearer.parts)))
        colliders = self.colliders(common, *sewn[1:])
        return Meeting(numbers, joint_contact(sewn, colliders, body))

    def _collisions(self, sewn: SewnCloth) -> Collisions | None:
        """What a cloth meets beside other garments."""
        collisions = self.garment.collisions
        if collisions == "none":
            return None
        apart = sewn.thickness if collisions == "all" else None
        return Collisions(self.colliders(sewn), sewn.distance, order=3, apart=apart)

    def scenes(self, motions: Sequence[Vectors], at: Schedule) -> Iterator[Scene]:
        """The scene of each picture of a schedule; the figure of a loop is as it is after settling.

        motions: where each cloth is in them [m], each of shape [F, N, 3].
        at: the moments.
        """
        staging = Staging(self.settings, self._ground())
        moments = [
            [self._placed(staging, model) for model in models]
            for models in self._moments(staging, motions, at.times)
        ]
        framed = [self._placed(staging, model) for time in at.times for model in self._framed(time)]
        meshes = [[model.mesh for model in models] for models in moments]
        return staging.scenes(meshes, moments, [model.mesh.positions for model in framed])

    def _moments(
        self, staging: Staging, sheets: Sequence[Array], times: Sequence[float]
    ) -> Iterator[list[Model]]:
        """All models of each moment in the garment's own frame, the cloth in the style."""
        fine = [self._finer(staging, sewn) for sewn in self.cloths]
        cloth: list[list[Model]] = [
            [
                model
                for sewn, sheet in zip(fine, sheets, strict=True)
                for model in sewn.models(sheet[frame])
            ]
            for frame in range(len(times))
        ]
        for time, worn in zip(times, moved_by_style(cloth, staging.style), strict=True):
            figure = self.wearer.models(time, self._bones) if self.wearer else ()
            yield [*self.fixed, *figure, *(tailored(each, staging.style) for each in worn)]

    def _finer(self, staging: Staging, sewn: SewnCloth) -> SewnCloth:
        """A cloth whose pieces are curves where a large picture shows them; not before shape
        steps."""
        if staging.style.has("shape"):
            return sewn
        pieces, who = [], self.garment.wearer
        for piece in sewn.pieces:
            share = min(1.0, piece.size[1] / PLAYER_HEIGHT) if who and who.shown == "full" else 1.0
            if piece.shell.grid is not None:
                times = cells_per_cell(self.settings.drawn_size, piece.shell.grid, share)
                piece = replace(piece, finer=finer_shell(piece.shell, times))
            pieces.append(piece)
        return replace(sewn, pieces=tuple(pieces))

    def figures(self) -> list[RiggedModel]:
        """The models of the wearer at the start, which come directly before those of the cloths."""
        models = self.wearer.models(0.0, self._bones) if self.wearer else ()
        return [model for model in models if isinstance(model, RiggedModel)]

    @property
    def _bones(self) -> tuple[str, ...] | None:
        """The bones that are drawn; None for all."""
        who = self.garment.wearer
        return ("head",) if who is not None and who.shown == "head" else None

    def _framed(self, time: float) -> tuple[Model, ...]:
        """What the camera frames instead of all that is drawn."""
        who = self.garment.wearer
        if who is None or self.wearer is None or who.shown == "full":
            return ()
        return self.wearer.models(time, BUST if who.shown == "bust" else self._bones)

    def _placed(self, staging: Staging, model: Model) -> Model:
        mesh = staging.turned(moved(model.mesh, MIDDLE))
        if isinstance(model, RiggedModel):
            # A picture is turned about MIDDLE.
            return moved_rig(model, mesh, turn_matrix(self.settings.turned), MIDDLE)
        return replace(model, mesh=mesh)

    def _ground(self) -> tuple[Part, ...]:
        """Blocks below a garment and its poles; none where the garment has its own."""
        block = self.settings.ground
        who = self.garment.wearer
        if block == "none" or (who and who.shown != "full") or any(y < 0 for _, y, _ in self.cells):
            return ()
        texel = self.garment.texel
        ends = [
            np.array(end) * texel for each in self.garment.pole for end in (each.start, each.end)
        ]
        low_cloth = [sewn.start[sewn.start[:, 1] < LOW] for sewn in self.cloths]
        points = np.concatenate([np.zeros((1, 3)), *low_cloth, np.reshape(ends, (-1, 3))])
        cells = [(np.array(cell) - MIDDLE + [0.5, 0, 0.5])[None] for cell in self.cells]
        stiff = [model.mesh.positions for each in self.meshes for model in each.models]
        points = np.concatenate([points, *cells, *stiff])
        if self.wearer is not None:
            figure = [model.mesh.positions for model in self.wearer.models(0.0)]
            points = np.concatenate([points, *figure])
        low = np.floor((points + MIDDLE).min(axis=0) + EDGE).astype(int)
        high = np.ceil((points + MIDDLE).max(axis=0) - EDGE).astype(int)
        cells = [
            (int(x), -1, int(z))
            for x in range(low[0], max(high[0], low[0] + 1))
            for z in range(low[2], max(high[2], low[2] + 1))
        ]
        return ground_of(block, self.packs, "standing", cells)


def _begins_in(sewn: SewnCloth, box: Box) -> bool:
    """Whether a part of a cloth begins nearer to a box than it stays from what it meets."""
    places = sampled(sewn.start, sewn.cloth.triangles)
    away = np.abs(places - box.centre) - np.asarray(box.size) / 2
    return bool((away.max(axis=1) < sewn.distance / 2).any())


def _finished(sewn: SewnCloth) -> SewnCloth:
    """A cloth whose pieces look like their fabric."""
    return replace(sewn, pieces=tuple(_finished_piece(each, sewn.fabric) for each in sewn.pieces))


def _finished_piece(piece: Piece, fabric: Fabric) -> Piece:
    material = with_finish(piece.material_at(0.0), fabric, piece.shell.uv_mapping, piece.size)
    return replace(piece, material_at=lambda time: material)


def _shifted(model: Model, by: Array) -> Model:
    return replace(model, mesh=moved(model.mesh, by))


def _ends(each: GarmentPole, texel: float) -> tuple[Array, Array]:
    """Start and end of a pole [m]."""
    return np.array(each.start) * texel, np.array(each.end) * texel


def _pole_box(each: GarmentPole, texel: float) -> Box:
    start, end = _ends(each, texel)
    length, rotation = pole_frame(start, end)
    side = 2 * each.half * texel
    return Box((start + end) / 2, np.array([side, length, side]), rotation)
