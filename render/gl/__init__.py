"""Pictures by OpenGL, through pyrender: a graphics card where EGL finds one, else Mesa's llvmpipe.

`platform` starts OpenGL, `passes` draws with it. There is one renderer for the whole process,
because deleting one would end OpenGL for all. It caches the last topology, so an animation uploads
only positions and light.
"""

import atexit
import os
import warnings
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field, replace
from functools import cache, partial
from threading import Lock
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from drapery.arrays import Matrices, Pixels, Triangles
from drapery.errors import BackendError, OptionError
from drapery.render.buffers import Buffers
from drapery.render.camera import clip_matrix
from drapery.render.drawlist import DrawList, Float32, Topology, draw_list
from drapery.render.flatten import composite_layers
from drapery.render.frame import Frame
from drapery.render.gl.platform import load_pyrender, release
from drapery.render.materials import BLEND, CUTOUT, MaterialTables
from drapery.render.relief import has_relief
from drapery.render.scene import Scene
from drapery.render.vectors import dots

CUTOUT_BIT, SOLID_BIT, UNLIT_BIT = 1, 2, 4  # as in flat.frag


@dataclass
class OffscreenContext:
    """The state of one process: pyrender, its platform and renderer, and the last scene."""

    pyrender: Any
    passes: Any
    platform: Any
    renderer: Any
    topology: Topology | None = None
    stacked: bool = False
    vertices: Any = None
    scene: Any = None
    process: int = field(default_factory=os.getpid)
    blends: list[tuple[Any, Triangles]] = field(default_factory=list)
    materials: Any = None


_lock = Lock()


def draw_scene(scene: Scene, *, stacked: bool = False) -> Frame:
    """Draw a scene.

    stacked: draw each layer in a separate pass, as the game does, instead of compositing the layers
    into one texture first. It is slower, and colours differ by up to 2/255.
    Raises OptionError for a scene that cannot be drawn, BackendError without OpenGL.
    """
    drawing = draw_list(scene.models)
    with _current() as context:
        _check(context, scene, drawing)
        if has_relief(scene):
            if scene.light.shadows:
                warnings.warn(
                    "backend pyrender draws no cast shadows on LabPBR maps; use backend soft, or"
                    " light game",
                    UserWarning,
                    stacklevel=2,
                )
            return _draw_materials(context, scene)
        if context.topology is not drawing.topology or context.stacked != stacked:
            _set_up(context, drawing.topology, stacked)
        samples = _draw(context, scene, drawing)
    return Frame(resolved(samples, round(scene.samples**0.5)))


def draw_buffers(scene: Scene) -> Buffers:
    """Depth, normal, model, texture coordinates and material in the middle of each pixel.

    Raises OptionError for a scene that cannot be drawn, BackendError without OpenGL.
    """
    scene = replace(scene, samples=1)
    drawing = draw_list(scene.models)
    with _current() as context:
        _check(context, scene, drawing)
        from drapery.render.gl.surface import draw_surface

        return draw_surface(context.renderer.programs, scene, drawing)


def draw_with_buffers(scene: Scene) -> tuple[Frame, Callable[[], Buffers]]:
    """The picture of `draw_scene`, and a function that gives what `draw_buffers` does."""
    return draw_scene(scene), partial(draw_buffers, scene)


vars(draw_scene)["with_buffers"] = draw_with_buffers  # see `drapery.render.backends`


def _draw_materials(context: OffscreenContext, scene: Scene) -> Frame:
    from drapery.render.gl.material import MaterialRenderer, draw_materials

    if context.materials is None:
        context.materials = MaterialRenderer(1, 1)
    samples = draw_materials(context.materials, scene)
    return Frame(resolved(samples, round(scene.samples**0.5)))


def describe() -> str:
    """The OpenGL renderer in use. Raises BackendError where there is none."""
    with _current() as context:
        name = type(context.platform).__name__.removesuffix("Platform")
        return f"{name}, {context.passes.renderer_name()}"


@contextmanager
def _current() -> Iterator[OffscreenContext]:
    """The context, made current in this thread only."""
    with _lock:
        context = _context()
        if context.process != os.getpid():
            raise BackendError(
                "OpenGL was started before this process was forked from another; start processes"
                " by `spawn`, or use the backend soft"
            )
        context.platform.make_current()
        try:
            yield context
        finally:
            release(context.platform)


@cache
def _context() -> OffscreenContext:
    pyrender, platform = load_pyrender()
    from drapery.render.gl import passes

    context = OffscreenContext(pyrender, passes, platform, passes.LayeredRenderer())
    atexit.register(_close, context)
    return context


def _close(context: OffscreenContext) -> None:
    """End OpenGL while its modules still exist."""
    if context.process == os.getpid():
        context.platform.make_current()
        if context.materials is not None:
            context.materials.delete()
        context.renderer.delete()
        context.platform.delete_context()


def _check(context: OffscreenContext, scene: Scene, drawing: DrawList) -> None:
    if scene.samples not in (1, 4, 16):
        raise OptionError(f"samples {scene.samples} is not known; use 1, 4 or 16")
    most = context.passes.largest_side()
    width, height = scene.size
    if min(scene.size) < 1 or max(scene.size) * round(scene.samples**0.5) > most:
        raise OptionError(
            f"size {width}x{height} with {scene.samples} samples a pixel cannot be drawn; this"
            f" OpenGL takes up to {most} samples a side, the backend soft more"
        )
    high, wide = drawing.topology.material_tables.atlas.shape[:2]
    if max(high, wide) > most:
        raise OptionError(
            f"the scene's textures need {wide}x{high} texels and this OpenGL takes {most} a side;"
            " use smaller ones, or the backend soft"
        )
    for name, values in (("positions", drawing.positions), ("normals", drawing.normals)):
        if not np.isfinite(values).all():
            vertex = int(np.flatnonzero(~np.isfinite(values).all(axis=1))[0])
            model = int(np.searchsorted(drawing.topology.vertex_start, vertex, "right")) - 1
            raise OptionError(
                f"model {model} has {name} that are not finite numbers;"
                " if a simulation diverged, use a smaller time step"
            )


def _draw(context: OffscreenContext, scene: Scene, drawing: DrawList) -> Pixels:
    """Premultiplied samples, shape [H * n, W * n, 4], n * n samples a pixel."""
    grid = round(scene.samples**0.5)
    renderer = context.renderer
    renderer.viewport_width, renderer.viewport_height = (side * grid for side in scene.size)
    renderer.matrix = clip_matrix(scene.camera, scene.size)
    renderer.light_tint = np.array(scene.light.tint, np.float32)
    renderer.grid = grid
    renderer.cast = _light(context.vertices, scene, drawing)
    for primitive, triangles in context.blends:
        primitive.reorder(far_to_near(triangles, drawing.positions, renderer.matrix))
    background = np.array(scene.background) / 255
    context.scene.bg_color = background * [*[background[3]] * 3, 1]
    flags = context.pyrender.RenderFlags
    samples: Pixels = renderer.render(context.scene, flags.OFFSCREEN | flags.RGBA | flags.FLAT)
    return samples


def _light(vertices: Any, scene: Scene, drawing: DrawList) -> Any:
    """Upload the vertices with their light; the `CastLight` of a light that casts shadows."""
    found = None
    if scene.light.shadows and len(drawing.positions):
        # Imported here: the kernel of ambient occlusion is compiled only for such lights.
        from drapery.render.soft.shadows import shadow_light

        found = shadow_light(scene.light, scene.size, drawing)
    if found is None:
        vertices.upload(drawing.positions, scene.light.brightness(drawing.normals))
        return None
    from drapery.render.gl.shadow_map import CastLight

    vertices.upload(drawing.positions, found.bright)
    vertices.upload_lifted(found.lifted, found.dark)
    matrix = clip_matrix(found.camera, (found.side, found.side))
    return CastLight(matrix, found.side, found.spread)


def far_to_near(triangles: Triangles, positions: Float32, matrix: Matrices) -> Triangles:
    """Triangles that blend [T, 3], stably sorted by the depth of their middle, farthest first."""
    corners = positions[triangles].astype(np.float64)
    z, w = (dots(corners, row[:3]) + row[3] for row in matrix[2:])
    depth = (z / w).sum(axis=1)
    return triangles[np.argsort(-depth, kind="stable")]


def _set_up(context: OffscreenContext, topology: Topology, stacked: bool) -> None:
    """Upload the constant part of a draw list, and delete the previous one."""
    pyrender, passes, old = context.pyrender, context.passes, context.vertices
    material_tables = _material_tables(topology.material_tables, stacked)
    vertex_material = np.zeros(len(topology.uvs), np.int32)
    vertex_material[topology.triangles] = topology.triangle_material[:, None]
    base_rects, _ = layer_attributes(material_tables, vertex_material, 0)
    context.topology, context.stacked = topology, stacked
    context.vertices = passes.Vertices(topology.uvs, base_rects)
    material = _material(pyrender, material_tables)
    context.blends, primitives = [], []
    for layer, triangles, blend in layer_passes(topology, material_tables):
        rects, tints = layer_attributes(material_tables, vertex_material, layer)
        primitives.append(
            passes.LayeredPrimitive(context.vertices, rects, tints, triangles, blend, material)
        )
        if blend:
            context.blends.append((primitives[-1], triangles))
    context.scene = pyrender.Scene()
    context.scene.add(pyrender.PerspectiveCamera(yfov=1.0))  # pyrender asks for one
    if primitives:
        # One mesh: pyrender draws the primitives of a mesh in order, but meshes in any order.
        context.scene.add(pyrender.Mesh(primitives))
    if old is not None:
        old.delete()


def _material_tables(material_tables: MaterialTables, stacked: bool) -> MaterialTables:
    """Tables with composited layers; if stacked, only where a material blends, because a triangle
    that blends must draw all its layers at once."""
    many = material_tables.material_layers[:, 1] > 1
    if stacked:
        many &= material_tables.material_alpha == BLEND
    return composite_layers(material_tables) if many.any() else material_tables


def _material(pyrender: Any, material_tables: MaterialTables) -> Any:
    """The atlas as a texture, with its rows reversed because pyrender reverses them again."""
    from OpenGL.GL import GL_CLAMP_TO_EDGE, GL_NEAREST

    sampler = pyrender.Sampler(None, GL_NEAREST, GL_NEAREST, GL_CLAMP_TO_EDGE, GL_CLAMP_TO_EDGE)
    atlas = material_tables.atlas[::-1]
    texture = pyrender.Texture(source=atlas, source_channels="RGBA", sampler=sampler)
    return pyrender.MetallicRoughnessMaterial(baseColorTexture=texture)


class LayerPass(NamedTuple):
    """One draw call: layer `layer` of triangles [T, 3]. blend: whether it blends."""

    layer: int
    triangles: Triangles
    blend: bool


def layer_passes(topology: Topology, material_tables: MaterialTables) -> list[LayerPass]:
    """The passes in order: layer k = 0, 1, ... of all solid triangles, then those that blend."""
    material = topology.triangle_material
    counts, blends = (
        material_tables.material_layers[material, 1],
        material_tables.material_alpha[material] == BLEND,
    )
    return [
        LayerPass(layer, topology.triangles[(blends == blend) & (counts > layer)], blend)
        for blend in (False, True)
        for layer in range(counts[blends == blend].max(initial=0))
    ]


def layer_attributes(
    material_tables: MaterialTables, vertex_material: NDArray[np.int32], layer: int
) -> tuple[NDArray[np.uint16], NDArray[np.uint8]]:
    """At each vertex its layer's rectangle [V, 4], and its tint and kind [V, 4] as in flat.frag."""
    first, count = material_tables.material_layers.T
    chosen = first + np.minimum(layer, count - 1)
    alpha = material_tables.material_alpha
    kind = (
        CUTOUT_BIT * (alpha == CUTOUT)
        + SOLID_BIT * ((alpha != BLEND) & (layer == 0))
        + UNLIT_BIT * ~material_tables.material_lit
    )
    tints = np.column_stack([material_tables.layer_tints[chosen], kind]).astype(np.uint8)
    return material_tables.layer_rects[chosen].astype(np.uint16)[vertex_material], tints[
        vertex_material
    ]


def resolved(samples: Pixels, grid: int) -> Pixels:
    """Straight-alpha pixels, each the mean of grid x grid premultiplied samples."""
    alpha = samples[..., 3]
    if grid == 1 and ((alpha == 255) | (alpha == 0)).all():
        return np.ascontiguousarray(samples)
    height, width = samples.shape[0] // grid, samples.shape[1] // grid
    cells = samples.reshape(height, grid, width, grid, 4).sum(axis=(1, 3), dtype=np.int32)
    total = np.maximum(cells[..., 3:], 1)
    pixels = np.empty((height, width, 4), np.uint8)
    pixels[..., :3] = np.minimum((cells[..., :3] * 255 + total // 2) // total, 255)
    pixels[..., 3] = (cells[..., 3] + grid * grid // 2) // grid**2
    return pixels
