"""Banner blocks in a scene: their flags, simulated as one batch in the scene's own space."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np

from drapery.banner import Banner
from drapery.cloth import Box, Cloth, Collider, Collisions, Force, Gravity, State, grid, sew
from drapery.mesh import Mesh
from drapery.packs import Packs
from drapery.render import Material, Model
from drapery.scenes.catalogue import Clip
from drapery.scenes.moving import motion
from drapery.style import FLAG_MAPPING, FLAG_SIZE, Shell, flag_material, make_shell, turn
from drapery.style.block import SCALE, Placement, flag_origin, solids, wood
from drapery.style.block_world import blocks, plateau
from drapery.style.board import moved
from drapery.style.layers import wood_material
from drapery.style.piece import Piece
from drapery.style.scenery import shadow
from drapery.style.tailoring import ClothModel

THINNEST = 1e-4
"""Flags that meet keep at least this distance [m]."""
FLAG_STEP = 1.0 / 60.0
"""The longest time step of a flag [s]."""


@dataclass(frozen=True)
class BannerBlock:
    """A banner block. cell: least corner of its block [m]; facing: degrees, 0 south, 90 west."""

    cell: tuple[float, float, float]
    placement: Placement = "standing"
    facing: float = 0.0


@dataclass(frozen=True, eq=False)
class Flags:
    """The flags of banner blocks, which hang from their bars, as one batch of B equal cloths.

    cloth: one of them; its top edge is at y = 0.
    shell: how its thick, textured shell follows it.
    start: all at rest, each at its block, positions [B, N, 3].
    materials: flag number i has material number i, from the first again after the last. They are
        the same objects in every picture, because the renderer recognises them by identity.
    """

    cloth: Cloth
    shell: Shell
    start: State
    materials: tuple[Material, ...]

    def motion(
        self,
        clip: Clip,
        *forces: Force,
        settle: float = 0.0,
        collisions: Collisions | None = None,
    ) -> Iterator[State]:
        """All flags at each frame of a clip, under their weight and other forces.

        settle: time before the first frame [s].
        collisions: what they meet.
        Raises OptionError.
        """
        return motion(
            self.cloth,
            clip,
            forces=(Gravity(), *forces),
            collisions=collisions,
            start=self.start,
            settle=settle,
            step=FLAG_STEP,
        )

    def model(self, state: State, thickness: float = 1.0) -> ClothModel:
        """The flags of a state. thickness: [texels]."""
        index = np.arange(len(state.positions), dtype=np.int32) % len(self.materials)
        piece = Piece(self.shell, thickness * SCALE, SCALE, FLAG_SIZE)
        thin = piece, state.positions
        return ClothModel(
            piece.mesh(state.positions), self.materials, index, thin=thin, name="banner/cloth"
        )


def meeting(
    flags: Sequence[Flags],
    banner_blocks: Sequence[BannerBlock],
    clip: Clip,
    *forces: Force,
    thickness: float,
    settle: float = 0.0,
) -> Iterator[list[State]]:
    """Flags of one banner each, which meet each other and the poles: all states at every frame.

    banner_blocks: those that stand on the ground and have poles.
    forces: beside the weight of the flags.
    thickness: of the flags [texels].
    settle: time before the first frame [s].
    Raises OptionError.
    """
    placed = [replace(each.cloth, rest_positions=each.start.positions[0]) for each in flags]
    ends = np.cumsum([len(cloth.inv_mass) for cloth in placed])[:-1]
    thick = max(thickness * SCALE, THINNEST)
    met = Collisions(_poles(banner_blocks), thick, apart=thick)
    states = motion(
        sew(placed),
        clip,
        forces=(Gravity(), *forces),
        collisions=met,
        settle=settle,
        step=FLAG_STEP,
    )
    for state in states:
        parts = [np.split(each, ends, axis=1) for each in (state.positions, state.velocities)]
        yield [State(places, moves, state.time) for places, moves in zip(*parts, strict=True)]


def hang_flags(
    banner_blocks: Sequence[BannerBlock],
    shape: tuple[int, int],
    designs: Sequence[str],
    packs: Packs,
) -> Flags:
    """The flags of banner blocks at rest.

    shape: particles across and down each flag.
    designs: of the first flags, and from the first again after the last.
    packs: with the textures.
    Raises FormatError or PackError.
    """
    cloth = flag_cloth(shape)
    shell = make_shell(cloth.triangles, cloth.uvs, FLAG_MAPPING, cloth.grid_shape)
    positions = np.stack([_at(_sheet(cloth, block), block).positions for block in banner_blocks])
    start = State(positions, np.zeros_like(positions))
    return Flags(cloth, shell, start, design_materials(designs, packs))


def flag_cloth(shape: tuple[int, int]) -> Cloth:
    """The flag of a banner, its top edge at y = 0. shape: particles across and down."""
    return grid(*shape, *FLAG_SIZE)


def banner_ground(
    banner_blocks: Sequence[BannerBlock], size: tuple[int, int], packs: Packs
) -> tuple[Model, ...]:
    """A piece of grass about the origin, with standing blocks' wood and their shadows on it.

    size: its width and depth [blocks].
    """
    grass = blocks(plateau(*size), packs)
    shadows = [shadow((block.cell[0] + 0.5, block.cell[2] + 0.5), 0.42) for block in banner_blocks]
    return (*grass, *shadows, wood_model(banner_blocks, packs))


def wood_model(banner_blocks: Sequence[BannerBlock], packs: Packs) -> Model:
    """The poles and bars of blocks that all have the same placement."""
    meshes = [_at(wood(block.placement), block) for block in banner_blocks]
    mesh = Mesh(
        np.stack([mesh.positions for mesh in meshes]),
        np.stack([mesh.normals for mesh in meshes]),
        meshes[0].triangles,
        meshes[0].uvs,
    )
    return Model(mesh, (wood_material(packs),), name="banner/pole")


def design_materials(designs: Sequence[str], packs: Packs) -> tuple[Material, ...]:
    """The materials of flags of these designs. Raises FormatError or PackError."""
    return tuple(flag_material(Banner.parse(design), packs) for design in designs)


def _poles(banner_blocks: Sequence[BannerBlock]) -> list[Collider]:
    pole, *_ = solids("standing")
    low, high = np.array(pole.low), np.array(pole.high)
    return [
        Collider(Box((low + high) / 2 + np.array(block.cell), high - low))
        for block in banner_blocks
    ]


def _sheet(cloth: Cloth, block: BannerBlock) -> Mesh:
    rest = cloth.rest_positions
    sheet = Mesh(rest, np.zeros_like(rest), cloth.triangles, cloth.uvs)
    return moved(sheet, flag_origin(block.placement))


def _at(mesh: Mesh, block: BannerBlock) -> Mesh:
    return moved(turn(mesh, block.facing), np.array(block.cell, float))
