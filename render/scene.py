"""A scene: meshes with materials, a camera and a light."""

from dataclasses import dataclass, field
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from drapery.arrays import Integers, Texels
from drapery.mesh import Array, Mesh
from drapery.render.camera import Camera
from drapery.render.light import GAME_LIGHT, Light

Alpha = Literal["opaque", "cutout", "blend"]


@dataclass(frozen=True, eq=False)
class TextureLayer:
    """One texture of a surface, multiplied by a tint.

    A texel becomes round(texel * tint / 255) per channel and is blended over the layers below by
    its 8-bit alpha a: round((a * src + (255 - a) * dst) / 255).

    texels: sRGB with straight alpha, shape [H, W, 4], uint8.
    tint: the colour by which the texels are multiplied.
    normal: the LabPBR normal map, shape [H, W, 4], of any size; None is a smooth surface.
    specular: the LabPBR specular map, shape [H, W, 4], of any size; None is a matt surface.
    """

    texels: Texels
    tint: tuple[int, int, int] = (255, 255, 255)
    normal: Texels | None = None
    specular: Texels | None = None


@dataclass(frozen=True, eq=False)
class SurfaceDetail:
    """What a surface has that is finer than its texture: weave or grain, and gloss.

    tile: what repeats over the surface, shape [S, S, 4], uint8, S a power of two. Its first two
        numbers are the slopes of the normal to the right and down the texture, the third is the
        light, each over 128 and less one; the fourth is the share of the gloss that it has, of 255.
    repeats: how many tiles lie along a whole u and v.
    gloss: brightness of highlights in full light, 0 to 1.
    across: the share of highlights as of threads along u, which shine all around them; the rest is
        as of a smooth surface.
    along: the same share of threads along v.
    sharpness: of the highlights: the cosine of the angle to their middle is squared this many
        times.
    fuzz: how much brighter the surface is where one looks along it.
    strips: what is added along upright and level edges, shape [2, 256, 32, 4], uint8, or None: 32
        texels from the edge inwards, of the tile's size, which repeat along it. The first two of
        their numbers are slopes inwards and along the edge, the third is the light, each over 128
        and less one; the fourth is the share of the tile that shows, of 255: the rest is smooth
        and has the whole gloss.
    edges: where the surface ends on the texture: left, top, right and bottom as fractions of it,
        one or two of them.
    """

    tile: Texels
    repeats: tuple[float, float]
    gloss: float = 0.0
    across: float = 0.0
    along: float = 0.0
    sharpness: int = 3
    fuzz: float = 0.0
    strips: Texels | None = None
    edges: tuple[tuple[float, float, float, float], ...] = ()


@dataclass(frozen=True, eq=False)
class Material:
    """The layers of a surface; all share the mesh's UVs, at any size.

    layers: the textures, lowest first.
    alpha: use of the lowest layer's alpha. `opaque` ignores it (the game's solid layer), `cutout`
        does not draw pixels below one half, `blend` blends the surface with the pixels behind it.
    lit: whether the scene's light changes its colours.
    transmission: the share of the light on the far side that shines through, 0 to 1; only lights
        that cast shadows do.
    detail: what it has that is finer than its texture; only the backend `soft` draws it, where a
        light with directions falls on it.
    """

    layers: tuple[TextureLayer, ...]
    alpha: Alpha = "opaque"
    lit: bool = True
    transmission: float = 0.0
    detail: SurfaceDetail | None = None


@dataclass(frozen=True, eq=False)
class Model:
    """A mesh, or a batch of B meshes, and the material of each.

    mesh: positions [V, 3] or [B, V, 3].
    materials: the materials in use.
    material_index: index in `materials` for each member of the batch, shape [B]; None uses the
        first material for all.
    name: its name in a 3-D file, such as `banner/cloth`; it has one by its number if it is empty.
    """

    mesh: Mesh
    materials: tuple[Material, ...]
    material_index: Integers | None = None
    name: str = field(default="", kw_only=True)


@dataclass(frozen=True, eq=False)
class Rig:
    """Stiff parts on bones: what is the same in all poses.

    bones: their names. joints: about which they turn, at rest [m], shape [B, 3].
    member: the bone of each vertex, shape [V], int32. rest: the mesh before bones move it.
    """

    bones: tuple[str, ...]
    joints: Array
    member: NDArray[np.int32]
    rest: Mesh


@dataclass(frozen=True, eq=False, kw_only=True)
class PosedBones:
    """Where the bones of a rig are: a vertex x at rest is at rotation x + place.

    places: [m], shape [B, 3]. rotations: shape [B, 3, 3].
    """

    rig: Rig
    places: Array
    rotations: Array


@dataclass(frozen=True, eq=False)
class RiggedModel(Model, PosedBones):
    """A model of stiff parts on bones, from which 3-D files get a skeleton."""


@dataclass(frozen=True, eq=False)
class Scene:
    """The models, camera, light and size of one picture.

    Do not change its arrays in place: prepared data are cached by the identity of the arrays.

    models: what is drawn, in this order.
    camera: from where it is seen.
    size: width and height [pixels].
    light: the light on all models.
    background: straight-alpha sRGB colour; (0, 0, 0, 0) is transparent.
    samples: 1, 4 or 16 samples a pixel, on a regular grid; 1 is pixel art's hard edge.
    """

    models: tuple[Model, ...]
    camera: Camera
    size: tuple[int, int] = (512, 512)
    light: Light = field(default=GAME_LIGHT)
    background: tuple[int, int, int, int] = (0, 0, 0, 0)
    samples: Literal[1, 4, 16] = 1
