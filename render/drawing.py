"""Pictures of meshes in one or two lines of code, by a `Scene` and a backend."""

from collections.abc import Iterable
from typing import Literal

import numpy as np
from PIL import ImageColor

from drapery.arrays import Texels
from drapery.errors import OptionError
from drapery.mesh import Mesh
from drapery.render.backends import DrawScene, backend as backend_named
from drapery.render.camera import Camera
from drapery.render.frame import Frame
from drapery.render.light import GAME_LIGHT, Light
from drapery.render.scene import Alpha, Material, Model, Scene, TextureLayer
from drapery.render.views import View, frame_view

Colour = str | tuple[int, int, int] | tuple[int, int, int, int]
"""`#rrggbb`, `#rrggbbaa`, a CSS name, or red, green, blue and alpha, each 0 to 255."""


def draw_scene(scene: Scene, backend: str | DrawScene = "auto") -> Frame:
    """Draw a scene.

    scene: what is drawn.
    backend: a name or a function, see `backend`.

    Raises BackendError for a backend that is not known or cannot run, OptionError for sizes,
    textures or meshes that cannot be drawn.
    """
    return backend_named(backend)(scene)


def draw_models(
    models: Iterable[Model | Mesh],
    *,
    view: str | View = "iso",
    camera: Camera | None = None,
    size: tuple[int, int] = (512, 512),
    background: Colour = (0, 0, 0, 0),
    light: Light = GAME_LIGHT,
    samples: Literal[1, 4, 16] = 4,
    backend: str | DrawScene = "auto",
) -> Frame:
    """Draw models, framed by a view.

        red = make_model(make_mesh(positions, triangles), colour="#b02e26")
        draw_models([red], view="hero").save("red.png")

    models: what is drawn; a mesh without a material is white.
    view: a View or its name in VIEWS, used if `camera` is None. For an animation make one camera
        with `frame_view` from the points of all its frames.
    camera: from where the models are seen; None for the view.
    size: width and height [pixels].
    background: colour behind the models.
    light: the light on all models.
    samples: 1, 4 or 16 for each pixel.
    backend: a name or a function, see `backend`.

    Raises OptionError or BackendError as `draw_scene` and `frame_view` do.
    """
    drawn = tuple(make_model(one) if isinstance(one, Mesh) else one for one in models)
    if camera is None:
        points = [model.mesh.positions.reshape(-1, 3) for model in drawn]
        everything = np.concatenate([np.zeros((0, 3)), *points])
        camera = frame_view(view, everything, size[0] / size[1])
    return draw_scene(Scene(drawn, camera, size, light, rgba(background), samples), backend)


def make_model(
    mesh: Mesh,
    *,
    colour: Colour = "white",
    texture: Texels | None = None,
    alpha: Alpha = "opaque",
    lit: bool = True,
) -> Model:
    """A mesh, or a batch of meshes, with one material.

    mesh: positions [m], shape [..., V, 3].
    colour: of the whole surface; it multiplies the texture if there is one.
    texture: sRGB, shape [H, W, 3], or with straight alpha [H, W, 4], uint8, top row first. It is
        placed by the mesh's UVs.
    alpha: see `Material`.
    lit: whether the scene's light changes its colours.

    Raises OptionError for a colour or texture of another form.
    """
    red, green, blue, opacity = rgba(colour)
    texels = np.full((1, 1, 4), 255, np.uint8) if texture is None else np.asarray(texture)
    if texels.dtype != np.uint8 or texels.ndim != 3 or texels.shape[2] not in (3, 4):
        raise OptionError(
            f"texture has shape {texels.shape} and type {texels.dtype};"
            " use [height, width, 3 or 4] of uint8"
        )
    if texels.shape[2] == 3:
        texels = np.concatenate([texels, np.full_like(texels[..., :1], 255)], axis=2)
    if opacity < 255:
        texels = texels.copy()
        texels[..., 3] = (texels[..., 3].astype(int) * opacity + 127) // 255
    return Model(mesh, (Material((TextureLayer(texels, (red, green, blue)),), alpha, lit),))


def rgba(colour: Colour) -> tuple[int, int, int, int]:
    """Red, green, blue and alpha of a colour, each 0 to 255. Raises OptionError."""
    try:
        values = ImageColor.getrgb(colour) if isinstance(colour, str) else tuple(colour)
    except (ValueError, TypeError):
        values = ()
    if len(values) not in (3, 4) or not all(0 <= int(value) <= 255 for value in values):
        raise OptionError(f"colour {colour!r} is not a colour; use #rrggbb or 3 to 4 of 0 to 255")
    red, green, blue, alpha = (*(int(value) for value in values), 255)[:4]
    return red, green, blue, alpha
