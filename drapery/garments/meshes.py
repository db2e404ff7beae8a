"""Stiff bodies of 3-D files that a garment names: what is drawn, and what stops its cloth."""

from dataclasses import dataclass
from io import BytesIO
from pathlib import Path
from typing import Any

import numpy as np

from drapery.banner.names import shown
from drapery.banner.sprites import WHITE, Tint
from drapery.cloth import TriangleMesh, mesh_collider, rotation_about
from drapery.errors import OptionError
from drapery.garments.model import GarmentMesh
from drapery.mesh import Array, Mesh, make_mesh
from drapery.render.scene import Material, Model, Texels, TextureLayer

MAX_FILE = 8 << 20
"""The largest 3-D file of a garment [bytes]."""
MAX_FACES = 50_000
"""The most triangles of a 3-D file of a garment."""
MAX_PARTS = 1000
"""The most parts of a 3-D file of a garment, as often as the file places them."""
MAX_TEXTURE = 1024
"""The widest and highest texture of a 3-D file of a garment [px]."""


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
    parts = _parts(folder / each.file)
    models = tuple(Model(_placed(part, each, texel), (_material(part.visual),)) for part in parts)
    counts = np.cumsum([0, *(len(model.mesh.positions) for model in models)])
    points = np.concatenate([model.mesh.positions for model in models])
    faces = [model.mesh.triangles + n for model, n in zip(models, counts, strict=False)]
    return StiffMesh(models, mesh_collider(points, np.concatenate(faces)))


def _parts(path: Path) -> list[Any]:
    """The meshes of a file, each moved to its place in it."""
    import trimesh

    try:
        with path.open("rb") as file:
            data = file.read(MAX_FILE + 1)
    except OSError as error:
        raise OptionError(
            f"mesh {shown(str(path), 200)} cannot be read: {error.strerror}; check the path"
        ) from None
    if len(data) > MAX_FILE:
        raise OptionError(f"mesh {path.name} has over {MAX_FILE} bytes; simplify it")
    try:
        # From bytes, so that it cannot name other files.
        scene: Any = trimesh.load(
            BytesIO(data), file_type=path.suffix[1:].lower(), force="scene", process=False
        )
        nodes = [scene.graph[node] for node in scene.graph.nodes_geometry]
        # A copy decodes the textures, so nothing too large is copied.
        _check_size([scene.geometry[name] for _, name in nodes], path)
        found = [scene.geometry[name].copy().apply_transform(matrix) for matrix, name in nodes]
    except OptionError:
        raise
    except Exception as fault:  # trimesh's readers raise errors of many types
        raise OptionError(
            f"mesh {path.name} cannot be read ({fault}); use a .glb, .obj, .ply or .stl file"
        ) from None
    if not found or not all(hasattr(part, "faces") and len(part.faces) for part in found):
        raise OptionError(f"mesh {path.name} has a part without triangles; leave that part out")
    return found


def _placed(part: Any, each: GarmentMesh, texel: float) -> Mesh:
    positions = np.asarray(part.vertices, float) * (each.scale * texel)
    for axis, degrees in zip(((1, 0, 0), (0, 1, 0), (0, 0, 1)), each.turn, strict=True):
        if degrees:
            # einsum adds in a fixed order; BLAS may not.
            positions = np.einsum("ij,nj->ni", rotation_about(axis, degrees), positions)
    uvs: Array | None = getattr(part.visual, "uv", None)
    if uvs is not None:
        uvs = np.stack([uvs[:, 0], 1 - uvs[:, 1]], axis=1)
    return make_mesh(positions + np.array(each.place) * texel, part.faces, uvs)


def _check_size(parts: list[Any], path: Path) -> None:
    """Raise OptionError for parts that are too many or too large, as often as they are used."""
    if len(parts) > MAX_PARTS:
        raise OptionError(f"mesh {path.name} has over {MAX_PARTS} parts; join them")
    if sum(len(getattr(part, "faces", ())) for part in parts) > MAX_FACES:
        raise OptionError(f"mesh {path.name} has over {MAX_FACES} triangles; simplify it")
    for part in parts:
        for image in _images(getattr(part.visual, "material", None)):
            if max(image.size) > MAX_TEXTURE:
                raise OptionError(
                    f"mesh {path.name} has a texture over {MAX_TEXTURE} px; make it smaller"
                )


def _images(material: Any) -> list[Any]:
    """All images of a material, of which the reader has only read the headers."""
    found = [getattr(material, "image", None)]
    for name in ("baseColor", "normal", "emissive", "occlusion", "metallicRoughness"):
        found.append(getattr(material, f"{name}Texture", None))
    return [image for image in found if hasattr(image, "size")]


def _material(visual: Any) -> Material:
    """The texture of a part, or its plain colour."""
    own = getattr(visual, "material", None)
    image = getattr(own, "baseColorTexture", None) or getattr(own, "image", None)
    if image is not None:
        factor = getattr(own, "baseColorFactor", None)
        texels: Texels = np.array(image.convert("RGBA"), np.uint8)
        return Material((TextureLayer(texels, _tint(factor)),), "cutout")
    colour = np.asarray(own.main_color if own is not None else visual.main_color, np.uint8)
    return Material((TextureLayer(colour.reshape(1, 1, 4)),))


def _tint(factor: Any) -> Tint:
    """The colour that multiplies a texture, 0 to 255."""
    if factor is None:
        return WHITE
    red, green, blue = (int(value) for value in np.asarray(factor)[:3])
    return red, green, blue
