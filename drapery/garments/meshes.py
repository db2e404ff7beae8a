"""Stiff bodies of 3-D files that a garment names: what is drawn, and what stops its cloth."""

from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from drapery.arrays import Texels
from drapery.banner.names import shown
from drapery.banner.sprites import WHITE, Tint
from drapery.cloth import TriangleMesh, mesh_collider, rotation_about
from drapery.errors import OptionError
from drapery.garments.model import MAX_LENGTH, GarmentMesh
from drapery.mesh import Array, make_mesh
from drapery.mesh_file import FilePart, joined, read_mesh_file
from drapery.picture_pixels import pixels_of
from drapery.render.scene import Material, Model, TextureLayer

MAX_FILE = 8 << 20
"""The largest 3-D file of a garment [bytes]."""
MAX_FACES = 50_000
"""The most triangles of a 3-D file of a garment."""
MAX_OVERLAP = 1000
"""The most triangles of such a file at one place, on average; cloth there is compared with each."""


@dataclass(frozen=True, eq=False)
class StiffMesh:
    """A 3-D file in its place. models: as it is drawn. surface: what stops cloth [m]."""

    models: tuple[Model, ...]
    surface: TriangleMesh


def read_stiff_mesh(each: GarmentMesh, folder: Path, texel: float) -> StiffMesh:
    """The 3-D file of a garment in its place, its parts in their own colours and textures.

    folder: where a relative path starts. texel: [m].
    Raises OptionError for a file that cannot be read or is too large.
    """
    parts = read_mesh_file(folder / each.file, MAX_FILE, MAX_FACES)
    points, faces = joined(parts)
    _check_extent(points, each)
    _check_overlap(points[faces], each)
    placed = _placed(points, each, texel)
    decoded: dict[int, Texels] = {}
    models, start = [], 0
    for part in parts:
        own = placed[start : start + len(part.positions)]
        start += len(own)
        try:
            material = _material(part.visual, decoded)
        except Exception:  # a file may give anything as a colour
            said = f"mesh {shown(str(each.file), 200)} has a broken material"
            raise OptionError(f"{said}; export it again") from None
        mesh = make_mesh(own, part.triangles, _drawn_uvs(part))
        models.append(Model(mesh, (material,), name=f"mesh/{Path(each.file).stem}"))
    return StiffMesh(tuple(models), mesh_collider(placed, faces))


def _check_extent(points: Array, each: GarmentMesh) -> None:
    """Raise OptionError for a file that is longer than anything in a garment may be."""
    size, far = np.ptp(points, axis=0), np.abs(points).max()
    if max(float(size.max()), float(far)) * each.scale > MAX_LENGTH:
        extent = " x ".join(f"{side:.4g}" for side in size)
        raise OptionError(
            f"mesh {shown(str(each.file), 200)} is {extent} units large and reaches {far:.4g} from"
            f" its origin; with scale = {each.scale:g} at most {MAX_LENGTH / each.scale:g} are"
            " drawn: give a smaller scale, such as 0.016 for a file in millimetres"
        )


def _check_overlap(corners: Array, each: GarmentMesh) -> None:
    """Raise OptionError for triangles [T, 3, 3] that lie over each other.

    The surface of a box about each, as a part of that about all, is how many a search meets on
    average (MacDonald and Booth, "Heuristics for ray tracing using space subdivision", 1990).
    """
    sides = np.ptp(corners, axis=1)
    whole = np.ptp(corners.reshape(-1, 3), axis=0)
    surfaces = (sides * np.roll(sides, 1, axis=1)).sum(axis=1)
    overlap = float(surfaces.sum()) / max(float((whole * np.roll(whole, 1)).sum()), 1e-300)
    if overlap > MAX_OVERLAP:
        raise OptionError(
            f"mesh {shown(str(each.file), 200)} has {len(corners)} triangles, of which"
            f" {overlap:.0f} lie at one place on average; at most {MAX_OVERLAP} are drawn: remove"
            " those that lie over others"
        )


def _placed(points: Array, each: GarmentMesh, texel: float) -> Array:
    positions = points * (each.scale * texel)
    for axis, degrees in zip(((1, 0, 0), (0, 1, 0), (0, 0, 1)), each.turn, strict=True):
        if degrees:
            # einsum adds in a fixed order; BLAS may not.
            positions = np.einsum("ij,nj->ni", rotation_about(axis, degrees), positions)
    moved: Array = positions + np.array(each.place) * texel
    return moved


def _drawn_uvs(part: FilePart) -> Array | None:
    return None if part.uvs is None else np.stack([part.uvs[:, 0], 1 - part.uvs[:, 1]], axis=1)


def _material(visual: Any, decoded: dict[int, Texels]) -> Material:
    """The texture of a part, or its plain colour. decoded: pictures of other parts, by identity."""
    own = getattr(visual, "material", None)
    image = getattr(own, "baseColorTexture", None) or getattr(own, "image", None)
    if image is not None:
        factor = getattr(own, "baseColorFactor", None)
        if id(image) not in decoded:
            decoded[id(image)] = pixels_of(image)
        return Material((TextureLayer(decoded[id(image)], _tint(factor)),), "cutout")
    colour = np.asarray(own.main_color if own is not None else visual.main_color, np.uint8)
    return Material((TextureLayer(colour.reshape(1, 1, 4)),))


def _tint(factor: Any) -> Tint:
    """The colour that multiplies a texture, 0 to 255."""
    if factor is None:
        return WHITE
    red, green, blue = (int(value) for value in np.asarray(factor)[:3])
    return red, green, blue
