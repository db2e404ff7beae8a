"""From a garment to cloth that moves: pieces are cut, sewn and pinned."""

import warnings
from collections.abc import Mapping, Sequence
from dataclasses import astuple, dataclass, replace

import numpy as np

from drapery.arrays import Integers, Mask, Vectors
from drapery.banner.names import shown
from drapery.banner.packs import Packs
from drapery.cloth import Cloth, Fabric, Seam, sew
from drapery.cloth.pins import PinTable
from drapery.cloth.sewing import sewn_particles
from drapery.errors import OptionError, counted
from drapery.garments.model import NO_BONE, Garment, GarmentPin, GridPiece
from drapery.garments.poses import BonePoses
from drapery.garments.shapes import CutPiece, Particles, cut_pieces
from drapery.garments.textures import texture_of
from drapery.mesh import Array, vertex_normals
from drapery.style.extrusion import make_shell
from drapery.style.piece import Piece
from drapery.style.tailoring import ClothModel
from drapery.style.visible import is_invisible

LAYER = 2.5
"""How many thicknesses a layer of cloth adds to the distance of the next from what it meets."""


@dataclass(frozen=True, eq=False)
class SewnCloth:
    """One cloth of a garment: pieces that seams join.

    cloth: its particles and springs.
    start: where its particles begin [m], shape [N, 3].
    pieces: how it is drawn.
    drawn: the particle at each vertex of each piece, each of shape [V].
    fabric: of its garment.
    bones: what each pinned particle is fastened to, in the order of the particles.
    solid: the bones that stop it; None for all.
    distance: twice the distance of its particles from what it meets [m].
    unpinned: 1 over the mass of each particle if nothing held it [1/kg], shape [N].
    order: of its garment among those of one wearer; higher ones lie outside lower ones.
    """

    cloth: Cloth
    start: Vectors
    pieces: tuple[Piece, ...]
    drawn: tuple[Integers, ...]
    fabric: Fabric
    bones: tuple[str, ...]
    solid: tuple[str, ...] | None
    distance: float
    unpinned: Vectors
    order: int = 0

    @property
    def thickness(self) -> float:
        """Of all its pieces [m]."""
        return self.pieces[0].thickness

    @property
    def is_on_body(self) -> bool:
        """Whether the body stops it; the flag of a banner on the head meets no garment."""
        return self.solid is None or "body" in self.solid

    def pin_path(self, poses: BonePoses) -> PinTable:
        """Where its pins are. poses: of the bones that hold them."""
        rest = self.start[self.cloth.inv_mass == 0]
        held = [
            (poses.bones.index(name), np.flatnonzero([bone == name for bone in self.bones]))
            for name in sorted(set(self.bones) - {NO_BONE})
        ]

        def at(times: Array) -> Array:
            table, places = poses.at(times), np.repeat(rest[None], len(times), axis=0)
            for number, pins in held:
                position, rotation = table[:, number, None, :3], table[:, number, 3:]
                turns = rotation.reshape(-1, 3, 3)
                # einsum adds in a fixed order; BLAS may not.
                places[:, pins] = np.einsum("tij,nj->tni", turns, rest[pins]) + position
            return places

        return PinTable(at)

    def without(self, pins: Mask) -> "SewnCloth":
        """The cloth with fewer pins.

        pins: those that it loses, in the order of the particles.
        """
        loose = np.flatnonzero(self.cloth.inv_mass == 0)[pins]
        inv_mass = self.cloth.inv_mass.copy()
        inv_mass[loose] = self.unpinned[loose]
        bones = tuple(bone for bone, lost in zip(self.bones, pins, strict=True) if not lost)
        return replace(self, cloth=replace(self.cloth, inv_mass=inv_mass), bones=bones)

    def models(self, positions: Vectors) -> list[ClothModel]:
        """Its pieces, thick. positions: of the particles [m], shape [N, 3]."""
        normals = vertex_normals(positions, self.cloth.triangles)
        found = []
        for piece, drawn in zip(self.pieces, self.drawn, strict=True):
            places, along = positions[drawn], normals[drawn]
            mesh, materials = piece.mesh(places, along), (piece.material_at(0.0),)
            # A step that changed one of several pieces would tear it from the others.
            whole = piece.shell.grid is not None and len(self.pieces) == 1
            thin = (piece, places) if whole else None
            found.append(ClothModel(mesh, materials, None, thin, name=piece.name))
        return found


def tailor(garment: Garment, packs: Packs) -> tuple[SewnCloth, ...]:
    """The cloths of a garment and of those over it, at rest on a wearer at rest.

    garment: the innermost garment.
    packs: resource packs, see `drapery.packs.open_packs`.

    Raises OptionError for seams and pins that do not fit, DesignError and PackError.
    """
    cut = cut_pieces(garment)
    place = {each.piece.name: number for number, each in enumerate(cut)}
    joins = [_seam(garment, seam.join, cut, place) for seam in garment.seam]
    pinned = [_pinned(garment, pin, cut[place[pin.piece]]) for pin in garment.pin]
    held: list[dict[int, str]] = [{} for _ in cut]
    for pin, particles in zip(garment.pin, pinned, strict=True):
        held[place[pin.piece]] |= dict.fromkeys(particles, pin.to)
    groups = _groups(len(cut), joins, together=garment.collisions == "all") if cut else []
    sewn = [_sewn(garment, group, cut, joins, held, packs) for group in groups]
    for over in garment.over:
        first = max((each.order + 1 for each in sewn), default=0)
        sewn += [replace(each, order=first + each.order) for each in tailor(over, packs)]
    return tuple(sewn)


def _sewn(
    garment: Garment,
    group: Sequence[int],
    cut: Sequence[CutPiece],
    joins: Sequence[Seam],
    held: Sequence[Mapping[int, str]],
    packs: Packs,
) -> SewnCloth:
    """The cloth of the pieces of a group."""
    cloths = [cut[number].cloth for number in group]
    own = [
        Seam(group.index(join.first), join[1], group.index(join.second), join[3])
        for join in joins
        if join.first in group
    ]
    cloth, numbers = cloths[0], [np.arange(len(cloths[0].inv_mass))]
    if len(group) > 1 or own:
        cloth, numbers = sew(cloths, own), [*sewn_particles(cloths, own)]
    bones: dict[int, str] = {}
    for number, particles in zip(group, numbers, strict=True):
        bones |= {int(particles[p]): bone for p, bone in held[number].items()}
    start = np.zeros_like(cloth.rest_positions)
    for number, particles in zip(group, numbers, strict=True):
        np.add.at(start, particles, cut[number].start)
    start /= np.bincount(np.concatenate(numbers))[:, None]
    inv_mass = cloth.inv_mass.copy()
    inv_mass[sorted(bones)] = 0.0
    layer = max(cut[number].piece.layer for number in group)
    return SewnCloth(
        replace(cloth, inv_mass=inv_mass),
        start,
        tuple(_piece(garment, cut[number], packs) for number in group),
        tuple(each[cut[number].drawn] for number, each in zip(group, numbers, strict=True)),
        garment.fabric,
        tuple(bones[particle] for particle in sorted(bones)),
        garment.wearer.solid if garment.wearer else None,
        garment.thickness * garment.texel * (1 + LAYER * layer),
        cloth.inv_mass,
    )


def _piece(garment: Garment, cut: CutPiece, packs: Packs) -> Piece:
    texture = cut.piece.texture or garment.texture
    material, mapping = texture_of(texture, cut.size, packs, garment.folder)
    if texture.source in ("file", "pack") and is_invisible(
        material.layers[0].texels, astuple(mapping)
    ):
        warnings.warn(
            f"garment {garment.name}: texture {shown(str(texture.file or texture.pack), 200)} is"
            f" transparent where piece {cut.piece.name} shows it, so nothing can be seen of the"
            " piece; use another texture",
            UserWarning,
            stacklevel=2,
        )
    material = replace(material, transmission=garment.fabric.transmission)
    plain = isinstance(cut.piece, GridPiece) and cut.piece.hem is None
    shell = make_shell(cut.triangles, cut.uvs, mapping, cut.cloth.grid_shape if plain else None)
    width, height = cut.size
    size = (width * garment.texel, height * garment.texel)
    return Piece(
        shell,
        garment.thickness * garment.texel,
        garment.texel,
        size,
        lambda time: material,
        cut.piece.name,
    )


def _groups(count: int, joins: Sequence[Seam], together: bool) -> list[list[int]]:
    """Pieces that seams join, or all of them."""
    if together:
        return [[*range(count)]]
    first = [*range(count)]
    for join in joins:
        a, b = sorted((first[join.first], first[join.second]))
        first = [a if number == b else number for number in first]
    return [[n for n in range(count) if first[n] == root] for root in sorted(set(first))]


def _edge(garment: Garment, cut: CutPiece, name: str) -> Particles:
    if name not in cut.edges:
        raise OptionError(
            f"garment {garment.name}: piece {cut.piece.name} has no edge {name};"
            f" use one of: {', '.join(cut.edges)}"
        )
    return cut.edges[name]


def _pinned(garment: Garment, pin: GarmentPin, cut: CutPiece) -> list[int]:
    if isinstance(pin.at, str):
        return [int(particle) for particle in _edge(garment, cut, pin.at)]
    return [cut.nearest(spot) for spot in pin.at]


def _seam(
    garment: Garment, join: tuple[str, str], cut: Sequence[CutPiece], place: Mapping[str, int]
) -> Seam:
    """The seam of two edges, in the order that brings them together.

    Each particle is sewn to the nearest one of the other edge, if these are pairs; otherwise in
    the order of the edges, or in the reverse order if that is nearer.
    """
    names = [side.split(".") for side in join]
    sides = [(place[piece], _edge(garment, cut[place[piece]], edge)) for piece, edge in names]
    (first, a), (second, b) = sides
    if len(a) != len(b):
        raise OptionError(
            f"garment {garment.name}: seam of {join[0]} with {counted(len(a), 'particle')} and"
            f" {join[1]} with {len(b)}; give both the same number"
        )
    one, other = cut[first].start[a], cut[second].start[b]
    away = np.sqrt(((one[:, None] - other) ** 2).sum(axis=-1))
    nearest = away.argmin(axis=1)
    if len(set(nearest.tolist())) < len(b):
        order = np.arange(len(b))
        back = away[order, order].sum() > away[order, order[::-1]].sum()
        nearest = order[::-1] if back else order
    return Seam(first, a, second, b[nearest])
