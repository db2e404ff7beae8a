"""Normal maps: every texel is lit by its normal before the scene is drawn.

Textures are sampled at the nearest texel, so one light value per texel is exact, and every backend
draws it in the same way. The position of a texel on the surface is where its middle lies in texture
space, where the mesh is unfolded by its UVs (Heckbert, "Survey of texture mapping", 1986). The
normal of the mesh there, changed by the map, is lit by the scene's light. Each part of a sheet
should cover one part of a mesh; where triangles share texels, the last triangle lights them.
"""

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from drapery.arrays import Texels, Triangles
from drapery.mesh import Array, Mesh
from drapery.render.flatten import lay_over
from drapery.render.identity_cache import IdentityCache
from drapery.render.light import Light
from drapery.render.scene import Material, Model, Scene, TextureLayer
from drapery.render.vectors import dots, unit

SLACK = 1e-9
"""Tolerance [texels] with which a texel's middle on an edge belongs to the triangle."""


def bake_normal_maps(scene: Scene) -> Scene:
    """The scene with textures that contain the light of surfaces with normal maps.

    A scene without such maps is returned unchanged.
    """
    if not any(_is_bent(material) for model in scene.models for material in model.materials):
        return scene
    return replace(scene, models=tuple(_relieved(model, scene.light) for model in scene.models))


def _is_bent(material: Material) -> bool:
    return material.lit and any(layer.normal is not None for layer in material.layers)


def _relieved(model: Model, light: Light) -> Model:
    if not any(map(_is_bent, model.materials)):
        return model
    mesh = model.mesh
    if mesh.positions.ndim == 2:
        return replace(
            model, materials=tuple(_lit(material, mesh, light) for material in model.materials)
        )
    members = [
        replace(mesh, positions=positions, normals=normals)
        for positions, normals in zip(mesh.positions, mesh.normals, strict=True)
    ]
    index = (
        np.zeros(len(members), np.int32) if model.material_index is None else model.material_index
    )
    materials = tuple(
        _lit(model.materials[place], member, light)
        for place, member in zip(index, members, strict=True)
    )
    index = np.arange(len(members), dtype=np.int32)
    return replace(model, materials=materials, material_index=index)


def _lit(material: Material, mesh: Mesh, light: Light) -> Material:
    if not _is_bent(material):
        return material
    relief = relief_of(material)
    layout = _layouts.get(
        (mesh.triangles, mesh.uvs),
        relief.bends.shape,
        lambda: _layout(mesh.triangles, mesh.uvs, relief.bends.shape[:2]),
    )
    factors = np.ones(relief.bends.shape, np.float32)
    factors[layout.rows, layout.columns] = _light(relief, layout, mesh, light)
    texels = relief.texels.copy()
    texels[..., :3] = texels[..., :3] * factors + np.float32(0.5)
    return Material((TextureLayer(texels),), material.alpha, lit=False)


@dataclass(frozen=True, eq=False)
class Relief:
    """A material's layers and maps combined.

    texels: tinted, shape [H, W, 4]. bends: the normal's x (to the right on the sheet), y (down)
    and z (out of it), shape [H, W, 3]. open: fraction of the ambient light (1 less the occlusion),
    shape [H, W]. matter: roughness, metalness and emission, 0..1 each, shape [H, W, 3].
    """

    texels: Texels
    bends: Array
    open: Array
    matter: Array


@dataclass(frozen=True, eq=False)
class TexelLayout:
    """The K texels that a mesh shows.

    rows, columns: of the texels. triangle: that contains their middles, shape [K]. weights: of its
    corners there, shape [K, 3]. inverse: UV edges to texture axes, shape [T, 2, 2].
    """

    rows: NDArray[np.intp]
    columns: NDArray[np.intp]
    triangle: NDArray[np.int32]
    weights: Array
    inverse: Array


_reliefs: IdentityCache[Relief] = IdentityCache(16)
_layouts: IdentityCache[TexelLayout] = IdentityCache(16)


def relief_of(material: Material) -> Relief:
    """The material's layers and their maps combined; the last 16 results are cached."""
    return _reliefs.get((material,), None, lambda: _relief(material))


def has_relief(scene: Scene) -> bool:
    """Whether any material of the scene has a normal or specular map."""
    layers = (
        layer for model in scene.models for material in model.materials for layer in material.layers
    )
    return any(layer.normal is not None or layer.specular is not None for layer in layers)


def _relief(material: Material) -> Relief:
    """All layers combined; a layer without a map does not change the maps below it."""
    sheets = [(layer.texels, layer.normal, layer.specular) for layer in material.layers]
    sizes = [sheet.shape[:2] for layer in sheets for sheet in layer if sheet is not None]
    size = max(height for height, _ in sizes), max(width for _, width in sizes)
    texels = _tinted(material.layers[0], size)
    if material.alpha == "opaque":
        texels[..., 3] = 255
    bends, matter = np.zeros((*size, 4), np.float32), np.zeros((*size, 3), np.float32)
    bends[..., 2:] = matter[..., 0] = 1.0
    for number, layer in enumerate(material.layers):
        top = _tinted(layer, size)
        share = top[..., 3:] / np.float32(255) if number else np.float32(1)
        texels = lay_over(top, texels) if number else texels
        if layer.normal is not None:
            bends += share * (_bends(_sized(layer.normal, size)) - bends)
        if layer.specular is not None:
            matter += share * (_matter(_sized(layer.specular, size)) - matter)
    return Relief(texels, unit(bends[..., :3]), bends[..., 3], matter)


def _bends(texels: Texels) -> Array:
    """LabPBR's normal map as x, y, z and the fraction of ambient light, shape [H, W, 4].

    Red and green are x and y, 128 means 0, and green points down the sheet; blue is the fraction of
    the ambient light (shaderLABS, "LabPBR material standard" 1.3).
    """
    xy = np.maximum((texels[..., :2].astype(np.float32) - 128) / 127, -1)
    z = np.sqrt(np.maximum(1 - (xy * xy).sum(axis=-1, keepdims=True), 0))
    return np.concatenate([xy, z, texels[..., 2:3] / np.float32(255)], axis=-1)


def _matter(texels: Texels) -> Array:
    """LabPBR's specular map as roughness, metalness and emission, shape [H, W, 3].

    Red is the perceptual smoothness, green from 230 on is metal, alpha up to 254 is emission.
    """
    smooth, metal, glow = (texels[..., channel].astype(np.float32) for channel in (0, 1, 3))
    parts = [1 - smooth / 255, np.where(metal >= 230, 1, 0), np.where(glow < 255, glow / 254, 0)]
    return np.stack(parts, axis=-1).astype(np.float32)


def _tinted(layer: TextureLayer, size: tuple[int, int]) -> Texels:
    texels = _sized(layer.texels, size)
    tint = np.array(layer.tint, np.uint16)
    texels[..., :3] = (texels[..., :3] * tint + 127) // 255
    return texels


def _sized(texels: Texels, size: tuple[int, int]) -> Texels:
    """A copy at another size: the nearest texels to the middles of the new ones."""
    rows, columns = (
        (2 * np.arange(new) + 1) * old // (2 * new)
        for new, old in zip(size, texels.shape[:2], strict=True)
    )
    sized: Texels = texels[rows[:, None], columns]
    return sized


def _layout(triangles: Triangles, uvs: Array, size: tuple[int, int]) -> TexelLayout:
    height, width = size
    # Texel (i, j) has its middle at the whole number (i, j).
    corners = (uvs.astype(np.float64) * (width, height) - 0.5)[triangles]
    of_texel = np.full((height, width), -1, np.int32)
    weights = np.zeros((height, width, 3))
    for number, triangle in enumerate(corners):
        low = np.maximum(np.ceil(triangle.min(axis=0) - SLACK), 0).astype(int)
        high = np.minimum(np.floor(triangle.max(axis=0) + SLACK), (width - 1, height - 1))
        window = tuple(slice(a, int(b) + 1) for a, b in zip(low[::-1], high[::-1], strict=True))
        found, inside = _within(triangle, low, of_texel[window].shape)
        of_texel[window][inside] = number
        weights[window][inside] = found[inside]
    _spread(of_texel, weights)
    rows, columns = np.nonzero(of_texel >= 0)
    seen = of_texel[rows, columns]
    return TexelLayout(rows, columns, seen, weights[rows, columns], _inverse(uvs[triangles]))


def _within(
    triangle: Array, low: NDArray[np.int64], shape: tuple[int, ...]
) -> tuple[Array, NDArray[np.bool_]]:
    """Weights of a triangle's corners [3, 2] at the integer points from `low`, and which points are
    inside."""
    a, b, c = triangle
    area = _cross(b - a, c - a)
    rows, columns = np.indices(shape)
    points = np.stack([columns + low[0], rows + low[1]], axis=-1)
    if area == 0:
        return np.zeros((*shape, 3)), np.zeros(shape, np.bool_)
    parts = [_cross(q - p, points - p) / area for p, q in ((b, c), (c, a), (a, b))]
    weights: Array = np.stack(parts, axis=-1)
    inside: NDArray[np.bool_] = np.min(weights, axis=-1) >= -SLACK
    return weights, inside


def _spread(of_texel: NDArray[np.int32], weights: Array) -> None:
    """Light texels that a mesh covers only partly, without their middle, as a neighbour is lit."""
    for axis, step in ((0, 1), (0, -1), (1, 1), (1, -1)):
        beside = np.roll(of_texel, step, axis)
        edge = np.zeros(of_texel.shape, np.bool_)
        edge[tuple(slice(None) if k != axis else (0 if step > 0 else -1) for k in (0, 1))] = True
        fill = (of_texel < 0) & (beside >= 0) & ~edge
        weights[fill] = np.roll(weights, step, axis)[fill]
        of_texel[fill] = beside[fill]


def _inverse(corners: Array) -> Array:
    """The inverse of each triangle's UV edges, [T, 2, 2]; it converts edges to texture axes."""
    (a, b), (c, d) = np.moveaxis(corners[:, 1:] - corners[:, :1], 0, -1)
    area = a * d - b * c
    sound = np.where(area == 0, 1, area)
    inverse = np.stack([np.stack([d, -b], axis=-1), np.stack([-c, a], axis=-1)], axis=-2)
    return inverse / sound[:, None, None]


def _light(relief: Relief, layout: TexelLayout, mesh: Mesh, light: Light) -> Array:
    """The light's factors for red, green and blue at each texel of the layout, shape [K, 3]."""
    used = mesh.triangles[layout.triangle]
    normals = unit(np.sum(mesh.normals[used] * layout.weights[..., None], axis=1))
    edges = mesh.positions[mesh.triangles[:, 1:]] - mesh.positions[mesh.triangles[:, :1]]
    # dP/du and dP/dv, shape [T, 2, 3], then orthogonal to the normal, shape [K, 3] each.
    axes = np.sum(layout.inverse[..., None] * edges[:, None], axis=2)[layout.triangle]
    right = unit(axes[:, 0] - normals * dots(normals, axes[:, 0])[:, None])
    down = np.cross(normals, right)
    down *= np.where(dots(down, axes[:, 1])[:, None] < 0, -1, 1)
    x, y, z = np.moveaxis(relief.bends[layout.rows, layout.columns], -1, 0)[..., None]
    bent = unit(x * right + y * down + z * normals)
    openness = relief.open[layout.rows, layout.columns]
    total = openness * light.ambient
    for towards in light.unit_directions():
        total = total + light.diffuse * np.maximum(dots(bent, towards), 0)
    factors: Array = np.minimum(total, 1)[:, None] * np.array(light.tint)
    return factors.astype(np.float32)


def _cross(a: Array, b: Array) -> Array:
    cross: Array = a[..., 0] * b[..., 1] - a[..., 1] * b[..., 0]
    return cross
