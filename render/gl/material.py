"""Scenes with LabPBR maps by pyrender's own materials: normals, roughness, metal and glow.

pyrender computes light in linear colours by a microfacet model (Cook and Torrance 1982, with the
terms of Schlick and of Trowbridge and Reitz), so its pictures differ slightly in brightness from
the game's. Import this module only after `platform.load_pyrender`.
"""

from collections.abc import Iterator
from typing import Any

import numpy as np
import pyrender
from numpy.typing import NDArray
from OpenGL import GL

from drapery.arrays import Texels
from drapery.mesh import Array
from drapery.render.camera import Camera, camera_pose
from drapery.render.gl.passes import LayeredRenderer
from drapery.render.light import Light
from drapery.render.relief import relief_of
from drapery.render.scene import Material, Model, Scene
from drapery.render.vectors import unit

GAMMA = 2.2


class MaterialRenderer(pyrender.Renderer):  # type: ignore[misc]
    """pyrender's renderer, drawing into one buffer without multisampling."""

    _configure_main_framebuffer = LayeredRenderer._configure_main_framebuffer
    _delete_main_framebuffer = LayeredRenderer._delete_main_framebuffer
    _read_main_framebuffer = LayeredRenderer._read_main_framebuffer


def draw_materials(renderer: MaterialRenderer, scene: Scene) -> NDArray[np.uint8]:
    """Premultiplied samples, shape [H * n, W * n, 4], n * n samples a pixel."""
    grid = round(scene.samples**0.5)
    renderer.viewport_width, renderer.viewport_height = (side * grid for side in scene.size)
    red, green, blue, alpha = (channel / 255 for channel in scene.background)
    gl_scene = pyrender.Scene(
        bg_color=[red * alpha, green * alpha, blue * alpha, alpha],
        ambient_light=scene.light.ambient**GAMMA * np.array(scene.light.tint),
    )
    for model in scene.models:
        gl_scene.add(pyrender.Mesh(list(_primitives(model))))
    for towards in scene.light.unit_directions():
        gl_scene.add(_lamp(scene.light), pose=_looking_along(-towards))
    pose = camera_pose(scene.camera)
    gl_scene.add(_lens(scene.camera, scene.size), pose=pose)
    flags = pyrender.RenderFlags
    samples: NDArray[np.uint8] = renderer.render(gl_scene, flags.OFFSCREEN | flags.RGBA)
    return samples


def _primitives(model: Model) -> Iterator[Any]:
    mesh = model.mesh
    shape = (-1, mesh.positions.shape[-2], 3)
    positions, normals = mesh.positions.reshape(shape), mesh.normals.reshape(shape)
    index = (
        np.zeros(len(positions), np.int32) if model.material_index is None else model.material_index
    )
    materials = [_material(material) for material in model.materials]
    for member, material in enumerate(index):
        yield pyrender.Primitive(
            positions=positions[member].astype(np.float32),
            normals=normals[member].astype(np.float32),
            texcoord_0=mesh.uvs.astype(np.float32),
            indices=mesh.triangles,
            material=materials[material],
        )


def _material(material: Material) -> Any:
    """A material's layers as one material; an unlit one emits the colours of its texture."""
    relief = relief_of(material)
    alpha = relief.texels[..., 3:]
    right, down, out = np.moveaxis(relief.bends, -1, 0)
    # Green points up in glTF and down in LabPBR.
    bends = _bytes(np.stack([right, -down, out], axis=-1) * 0.5 + 0.5, alpha)
    roughness, metal, glow = np.moveaxis(relief.matter, -1, 0)
    shine = glow if material.lit else np.ones_like(glow)
    glowing = _bytes(relief.texels[..., :3] / 255 * shine[..., None] ** (1 / GAMMA), alpha)
    return pyrender.MetallicRoughnessMaterial(
        alphaMode="OPAQUE" if material.alpha == "opaque" else "BLEND",
        doubleSided=True,
        baseColorFactor=[float(material.lit)] * 3 + [1.0],
        baseColorTexture=_texture(relief.texels),
        normalTexture=_texture(bends),
        # pyrender reads the first two channels, where glTF has the second and third.
        metallicRoughnessTexture=_texture(
            _bytes(np.stack([roughness, metal, 0 * metal], -1), alpha)
        ),
        occlusionTexture=_texture(_bytes(relief.open[..., None].repeat(3, axis=-1), alpha)),
        emissiveTexture=_texture(glowing),
        emissiveFactor=[1.0, 1.0, 1.0],
    )


def _bytes(values: Array, alpha: Texels) -> Texels:
    """Values 0..1 [H, W, 3] as a texture of four channels, so rows are multiples of four bytes."""
    channels = np.rint(np.clip(values, 0, 1) * 255).astype(np.uint8)
    return np.concatenate([channels, alpha], axis=-1)


def _texture(texels: Texels) -> Any:
    """A texture with its rows reversed, because pyrender reverses them again."""
    sampler = pyrender.Sampler(
        None, GL.GL_NEAREST, GL.GL_NEAREST, GL.GL_CLAMP_TO_EDGE, GL.GL_CLAMP_TO_EDGE
    )
    return pyrender.Texture(source=texels[::-1], source_channels="RGBA", sampler=sampler)


def _lamp(light: Light) -> Any:
    """A lamp that, at a right angle, lights a white surface as the game's light would."""
    full = min(1.0, light.ambient + light.diffuse) ** GAMMA - light.ambient**GAMMA
    return pyrender.DirectionalLight(color=np.array(light.tint), intensity=np.pi * full)


def _looking_along(direction: NDArray[np.float64]) -> NDArray[np.float64]:
    """A pose whose -z axis has the direction of a unit vector, shape [4, 4]."""
    side = np.array([1.0, 0, 0]) if abs(direction[0]) < 0.9 else np.array([0.0, 1, 0])
    right = unit(np.cross(direction, side))
    pose = np.eye(4)
    pose[:3, :3] = np.stack([right, np.cross(-direction, right), -direction], axis=1)
    return pose


def _lens(camera: Camera, size: tuple[int, int]) -> Any:
    aspect = size[0] / size[1]
    planes = {"znear": camera.near, "zfar": camera.far}
    if camera.height is None:
        return pyrender.PerspectiveCamera(np.radians(camera.fov), aspectRatio=aspect, **planes)
    half = camera.height / 2
    return pyrender.OrthographicCamera(half * aspect, half, **planes)
