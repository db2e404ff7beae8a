"""The buffers of a scene by OpenGL: all of them in one pass, each in an attachment of its own.

Import this module only after `platform.load_pyrender`.
"""

from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any, TypeVar

import numpy as np
from numpy.typing import NDArray
from OpenGL import GL
from pyrender.shader_program import ShaderProgramCache

from drapery.arrays import Matrices
from drapery.render.buffers import BACKGROUND, Buffers
from drapery.render.camera import clip_matrix, view_matrix
from drapery.render.drawlist import DrawList, Topology
from drapery.render.gl.passes import Vertices, attribute, filled, whole_attribute
from drapery.render.materials import BLEND, CUTOUT, MaterialTables, material_numbers
from drapery.render.scene import Scene
from drapery.render.vectors import dots

Number = TypeVar("Number", np.float32, np.int32)

ATTACHMENTS = (GL.GL_RGBA32F, GL.GL_RG32F, GL.GL_RG32I)
"""Normal and depth; texture coordinates; model and material."""


def draw_surface(programs: ShaderProgramCache, scene: Scene, drawing: DrawList) -> Buffers:
    """The buffers of a scene in the middle of each pixel. programs: with the shaders."""
    topology, matrix = drawing.topology, clip_matrix(scene.camera, scene.size)
    tables = topology.material_tables
    solid = tables.material_alpha[topology.triangle_material] != BLEND
    triangles = np.ascontiguousarray(topology.triangles[solid], np.uint32)
    rects, owners = _vertex_numbers(topology)
    eye = view_matrix(scene.camera)
    depth = -(dots(drawing.positions.astype(np.float64), eye[2, :3]) + eye[2, 3])
    vertices = Vertices(topology.uvs, rects)
    vertices.upload(drawing.positions, depth.astype(np.float32))
    extra = [filled(GL.GL_ARRAY_BUFFER, each) for each in (drawing.normals, owners)]
    extra.append(filled(GL.GL_ELEMENT_ARRAY_BUFFER, triangles))
    texture = _texture(tables)
    try:
        with _framebuffer(scene.size):
            if len(triangles):
                program = programs.get_program("surface.vert", "surface.frag")
                _draw(program, matrix, vertices, extra, texture, triangles.size)
            return _read(scene.size)
    finally:
        vertices.delete()
        GL.glDeleteBuffers(len(extra), extra)
        GL.glDeleteTextures(1, [texture])


def _vertex_numbers(topology: Topology) -> tuple[NDArray[np.uint16], NDArray[np.uint32]]:
    """At each vertex the lowest layer's rectangle [V, 4], and model and material [V, 2]; see
    surface.vert."""
    tables = topology.material_tables
    material = np.zeros(len(topology.uvs), np.int32)
    material[topology.triangles] = topology.triangle_material[:, None]
    marked = np.arange(len(topology.uvs))
    model = np.searchsorted(topology.vertex_start, marked, "right") - 1
    if not len(marked):
        return np.zeros((0, 4), np.uint16), np.zeros((0, 2), np.uint32)
    rects = tables.layer_rects[tables.material_layers[:, 0]].astype(np.uint16)
    cut = tables.material_alpha == CUTOUT
    number = material_numbers(tables) << 1 | cut
    return rects[material], np.stack([model, number[material]], axis=1).astype(np.uint32)


@contextmanager
def _framebuffer(size: tuple[int, int]) -> Iterator[None]:
    """A framebuffer with all attachments, bound and filled with the background."""
    places = [GL.GL_COLOR_ATTACHMENT0 + number for number in range(len(ATTACHMENTS))]
    buffers = [int(each) for each in GL.glGenRenderbuffers(len(places) + 1)]
    framebuffer = GL.glGenFramebuffers(1)
    GL.glBindFramebuffer(GL.GL_FRAMEBUFFER, framebuffer)
    try:
        formats, points = (*ATTACHMENTS, GL.GL_DEPTH_COMPONENT24), (*places, GL.GL_DEPTH_ATTACHMENT)
        for buffer, kind, point in zip(buffers, formats, points, strict=True):
            GL.glBindRenderbuffer(GL.GL_RENDERBUFFER, buffer)
            GL.glRenderbufferStorage(GL.GL_RENDERBUFFER, kind, *size)
            GL.glFramebufferRenderbuffer(GL.GL_FRAMEBUFFER, point, GL.GL_RENDERBUFFER, buffer)
        GL.glDrawBuffers(len(places), places)
        GL.glDepthMask(GL.GL_TRUE)
        GL.glClearBufferfv(GL.GL_COLOR, 0, np.array([0, 0, 0, np.inf], np.float32))
        GL.glClearBufferfv(GL.GL_COLOR, 1, np.zeros(4, np.float32))
        GL.glClearBufferiv(GL.GL_COLOR, 2, np.full(4, BACKGROUND, np.int32))
        GL.glClearBufferfv(GL.GL_DEPTH, 0, np.ones(1, np.float32))
        GL.glViewport(0, 0, *size)
        yield
    finally:
        GL.glBindFramebuffer(GL.GL_FRAMEBUFFER, 0)
        GL.glDeleteFramebuffers(1, [framebuffer])
        GL.glDeleteRenderbuffers(len(buffers), buffers)


def _draw(
    program: Any, matrix: Matrices, vertices: Vertices, extra: list[int], texture: int, count: int
) -> None:
    """Draw the triangles. extra: buffers of normals, owners and triangles. count: of corners."""
    normals, owners, triangles = extra
    if not program._in_context():
        program._add_to_context()
    array = GL.glGenVertexArrays(1)
    GL.glBindVertexArray(array)
    attribute(0, 4, vertices.moving)
    attribute(1, 2, vertices.uvs)
    attribute(2, 3, normals)
    whole_attribute(3, 2, vertices.base_rects)
    whole_attribute(4, 2, owners)
    GL.glBindBuffer(GL.GL_ELEMENT_ARRAY_BUFFER, triangles)
    GL.glDisable(GL.GL_BLEND)
    GL.glDisable(GL.GL_CULL_FACE)
    GL.glEnable(GL.GL_DEPTH_TEST)
    GL.glDepthFunc(GL.GL_LEQUAL)
    GL.glDepthRange(0.0, 1.0)
    program._bind()
    program.set_uniform("P", matrix)
    program.set_uniform("atlas", 0)
    GL.glActiveTexture(GL.GL_TEXTURE0)
    GL.glBindTexture(GL.GL_TEXTURE_2D, texture)
    GL.glDrawElements(GL.GL_TRIANGLES, count, GL.GL_UNSIGNED_INT, None)
    program._unbind()
    GL.glBindTexture(GL.GL_TEXTURE_2D, 0)
    GL.glBindVertexArray(0)
    GL.glDeleteVertexArrays(1, [array])


def _read(size: tuple[int, int]) -> Buffers:
    normal_depth = _attachment(0, GL.GL_RGBA, np.zeros((size[1], size[0], 4), np.float32))
    uv = _attachment(1, GL.GL_RG, np.zeros((size[1], size[0], 2), np.float32))
    owner = _attachment(2, GL.GL_RG_INTEGER, np.zeros((size[1], size[0], 2), np.int32))
    return Buffers(
        np.ascontiguousarray(normal_depth[..., 3]),
        np.ascontiguousarray(normal_depth[..., :3]),
        np.ascontiguousarray(owner[..., 0]),
        np.ascontiguousarray(uv),
        np.ascontiguousarray(owner[..., 1]),
    )


def _attachment(number: int, channels: int, values: NDArray[Number]) -> NDArray[Number]:
    """The values of an attachment, filled in and with the top row first."""
    GL.glReadBuffer(GL.GL_COLOR_ATTACHMENT0 + number)
    kind = GL.GL_INT if values.dtype == np.int32 else GL.GL_FLOAT
    GL.glReadPixels(0, 0, values.shape[1], values.shape[0], channels, kind, values)
    return values[::-1]


def _texture(tables: MaterialTables) -> int:
    """The atlas, or one texel where nothing is cut out, which alone reads it."""
    cut = (tables.material_alpha == CUTOUT).any()
    texels = np.ascontiguousarray(tables.atlas if cut else np.zeros((1, 1, 4), np.uint8))
    texture: int = GL.glGenTextures(1)
    GL.glBindTexture(GL.GL_TEXTURE_2D, texture)
    for side in (GL.GL_TEXTURE_MIN_FILTER, GL.GL_TEXTURE_MAG_FILTER):
        GL.glTexParameteri(GL.GL_TEXTURE_2D, side, GL.GL_NEAREST)
    size = texels.shape[1], texels.shape[0]
    GL.glTexImage2D(
        GL.GL_TEXTURE_2D, 0, GL.GL_RGBA8, *size, 0, GL.GL_RGBA, GL.GL_UNSIGNED_BYTE, texels
    )
    return texture
