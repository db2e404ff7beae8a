"""An exploded view of a banner: the cloth and each layer as a sheet, one in front of the other."""

import numpy as np

from drapery.banner import Banner, flag_layers
from drapery.mesh import Mesh
from drapery.packs import Packs
from drapery.render import Material, Model, Scene, TextureLayer, frame_view
from drapery.settings import Settings, background_colour
from drapery.style import FLAG_MAPPING, FLAG_SIZE

GAP = 0.6
"""Distance between two layers [m]."""


def exploded_view(banner: Banner, packs: Packs, settings: Settings) -> Scene:
    """The layers in a row, the lowest at the back.

    banner: the design.
    packs: resource packs, see `drapery.packs.open_packs`.
    settings: the options of the picture.

    Raises PackError for a texture that cannot be used.
    """
    cloth, base, *layers = flag_layers(banner, packs)
    # Cloth and base dye are one sheet, because the cloth is never seen without a dye.
    ground = Material(tuple(TextureLayer(texels, tint) for texels, tint in (cloth, base)))
    materials = [
        ground,
        *(Material((TextureLayer(texels, tint),), "blend") for texels, tint in layers),
    ]
    names = "cloth", *(f"layer/{number}" for number in range(1, len(materials)))
    models = tuple(
        Model(_sheet(GAP * i), (material,), name=name)
        for i, (material, name) in enumerate(zip(materials, names, strict=True))
    )
    corners = np.concatenate([model.mesh.positions for model in models])
    width, height = settings.size
    camera = frame_view(settings.view, corners, width / height)
    background = background_colour(settings.background)
    return Scene(models, camera, settings.size, background=background)


def _sheet(depth: float) -> Mesh:
    width, height = FLAG_SIZE
    uvs = np.array([[0.0, 0.0], [1, 0], [0, 1], [1, 1]])
    positions = np.stack(
        [(uvs[:, 0] - 0.5) * width, (0.5 - uvs[:, 1]) * height, np.full(4, depth)], axis=-1
    )
    normals = np.broadcast_to([0.0, 0.0, 1.0], (4, 3)).copy()
    return Mesh(
        positions, normals, np.array([[0, 2, 1], [1, 2, 3]], np.int32), FLAG_MAPPING.front(uvs)
    )
