"""Banner blocks in a scene: their flags, simulated as one batch in the scene's own space."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from drapery.banner import Banner
from drapery.cloth import Cloth, State, grid
from drapery.mesh import Mesh
from drapery.packs import Packs
from drapery.render import Material, Model
from drapery.style import FLAG_MAPPING, FLAG_SIZE, Shell, flag_material, make_shell, turn
from drapery.style.block import SCALE, Placement, flag_origin, wood
from drapery.style.board import moved
from drapery.style.layers import wood_material
from drapery.style.tailoring import garment


@dataclass(frozen=True)
class BannerBlock:
    """A banner block. cell: least corner of its block [m]; facing: degrees, 0 south, 90 west."""

    cell: tuple[float, float, float]
    placement: Placement = "standing"
    facing: float = 0.0


def flag_cloth(shape: tuple[int, int]) -> Cloth:
    """The flag of a banner, its top edge at y = 0. shape: particles across and down."""
    return grid(*shape, *FLAG_SIZE)


def flag_shell(cloth: Cloth) -> Shell:
    """How a flag's thick, textured shell follows the flag."""
    return make_shell(cloth.triangles, cloth.uvs, FLAG_MAPPING, cloth.grid_shape)


def flags_at_rest(cloth: Cloth, banner_blocks: Sequence[BannerBlock]) -> State:
    """All flags at rest, each at its block, shape [B, N, 3]."""
    sheets = [_at(_sheet(cloth, block), block).positions for block in banner_blocks]
    positions = np.stack(sheets)
    return State(positions, np.zeros_like(positions))


def wood_model(banner_blocks: Sequence[BannerBlock], packs: Packs) -> Model:
    """The poles and bars of blocks that all have the same placement."""
    meshes = [_at(wood(block.placement), block) for block in banner_blocks]
    mesh = Mesh(
        np.stack([mesh.positions for mesh in meshes]),
        np.stack([mesh.normals for mesh in meshes]),
        meshes[0].triangles,
        meshes[0].uvs,
    )
    return Model(mesh, (wood_material(packs),))


def flag_materials(designs: Sequence[str], packs: Packs) -> tuple[Material, ...]:
    """The materials of flags of these designs. Raises FormatError or PackError."""
    return tuple(flag_material(Banner.parse(design), packs) for design in designs)


def flag_models(
    shell: Shell, state: State, materials: tuple[Material, ...], thickness: float = 1.0
) -> Model:
    """The flags of a state. thickness: in texels.

    materials: flag number i has material number i, from the first again after the last. Give
    every frame the same objects, because the renderer recognises them by identity.
    """
    index = np.arange(len(state.positions), dtype=np.int32) % len(materials)
    thick, size = thickness * SCALE, FLAG_SIZE
    return garment(shell, state.positions, thick, *materials, index=index, size=size, texel=SCALE)


def _sheet(cloth: Cloth, block: BannerBlock) -> Mesh:
    rest = cloth.rest_positions
    sheet = Mesh(rest, np.zeros_like(rest), cloth.triangles, cloth.uvs)
    return moved(sheet, flag_origin(block.placement))


def _at(mesh: Mesh, block: BannerBlock) -> Mesh:
    return moved(turn(mesh, block.facing), np.array(block.cell, float))
