"""pyrender's renderer with ordered layers. Import it only after `platform.load_pyrender`.

One primitive draws one layer of all triangles that have it, in the order of the layers. The depth
test is GL_LEQUAL, so an upper layer covers the lower one. All primitives of a mesh share the vertex
positions: only these and the light are uploaded for a frame.
"""

import ctypes
from pathlib import Path
from typing import Any

import numpy as np
import pyrender
from numpy.typing import NDArray
from OpenGL import GL
from pyrender.constants import BufFlags
from pyrender.shader_program import ShaderProgramCache

from drapery.render.gl.shadow_map import UNIT, CastLight, DepthBuffer

SHADERS = Path(__file__).parent / "shaders"

Float32 = NDArray[np.float32]


class Vertices:
    """The vertex buffers that all primitives share: positions and light, UVs, lowest layers.

    uvs: shape [V, 2], float32. base_rects: the lowest layers' rectangles, shape [V, 4], uint16.
    """

    def __init__(self, uvs: Float32, base_rects: NDArray[np.uint16]) -> None:
        self.values = np.zeros((max(len(uvs), 1), 4), np.float32)
        # Read only where the light casts shadows.
        self.lifted = filled(GL.GL_ARRAY_BUFFER, self.values, GL.GL_DYNAMIC_DRAW)
        self.moving = filled(GL.GL_ARRAY_BUFFER, self.values, GL.GL_DYNAMIC_DRAW)
        self.uvs = filled(GL.GL_ARRAY_BUFFER, uvs)
        self.base_rects = filled(GL.GL_ARRAY_BUFFER, base_rects)

    def upload(self, positions: Float32, light: Float32) -> None:
        """positions: [m], shape [V, 3]. light: brightness, shape [V]."""
        self._fill(self.moving, positions, light)

    def upload_lifted(self, lifted: Float32, dark: Float32) -> None:
        """Where vertices look themselves up in the shadow map, and their brightness in shadow."""
        self._fill(self.lifted, lifted, dark)

    def _fill(self, buffer: int, places: Float32, factors: Float32) -> None:
        if len(places):
            self.values[:, :3], self.values[:, 3] = places, factors
        GL.glBindBuffer(GL.GL_ARRAY_BUFFER, buffer)
        GL.glBufferSubData(GL.GL_ARRAY_BUFFER, 0, self.values.nbytes, self.values)

    def delete(self) -> None:
        GL.glDeleteBuffers(4, [self.moving, self.lifted, self.uvs, self.base_rects])


class LayeredPrimitive(pyrender.Primitive):  # type: ignore[misc]
    """Triangles with one layer.

    rects: the layer's rectangle at each vertex, shape [V, 4], uint16.
    tints: its tint and kind, shape [V, 4], uint8.
    triangles: shape [T, 3]. blend: whether they are blended with the pixels behind them.
    """

    def __init__(
        self,
        vertices: Vertices,
        rects: NDArray[np.uint16],
        tints: NDArray[np.uint8],
        triangles: NDArray[np.int32],
        blend: bool,
        material: Any,
    ) -> None:
        super().__init__(positions=np.zeros((1, 3), np.float32), material=material)
        self.vertices, self.rects, self.tints = vertices, rects, tints
        self.triangles, self.blend = triangles, blend

    def _compute_buf_flags(self) -> int:
        return int(BufFlags.POSITION)  # the shader defines its attribute locations

    def _add_to_context(self) -> None:
        rects, tints = (filled(GL.GL_ARRAY_BUFFER, a) for a in (self.rects, self.tints))
        self._vaid = GL.glGenVertexArrays(1)
        GL.glBindVertexArray(self._vaid)
        attribute(0, 4, self.vertices.moving)
        attribute(1, 2, self.vertices.uvs)
        whole_attribute(2, 2, rects)
        whole_attribute(3, 2, self.vertices.base_rects)
        whole_attribute(4, 1, tints)
        attribute(5, 4, self.vertices.lifted)
        self._buffers = [rects, tints, filled(GL.GL_ELEMENT_ARRAY_BUFFER, self.triangles)]
        GL.glBindVertexArray(0)

    def reorder(self, triangles: NDArray[np.int32]) -> None:
        """Set another order of the same triangles."""
        self.triangles = triangles
        if self._in_context():
            self._bind()
            GL.glBufferSubData(GL.GL_ELEMENT_ARRAY_BUFFER, 0, triangles.nbytes, triangles)
            self._unbind()


def filled(target: int, values: NDArray[Any], usage: int = GL.GL_STATIC_DRAW) -> int:
    """A new bound buffer with these values."""
    buffer: int = GL.glGenBuffers(1)
    GL.glBindBuffer(target, buffer)
    GL.glBufferData(target, values.nbytes, np.ascontiguousarray(values), usage)
    return buffer


def attribute(location: int, size: int, buffer: int) -> None:
    """Bind a buffer of `size` floats per vertex to an attribute."""
    GL.glBindBuffer(GL.GL_ARRAY_BUFFER, buffer)
    GL.glEnableVertexAttribArray(location)
    GL.glVertexAttribPointer(location, size, GL.GL_FLOAT, GL.GL_FALSE, 0, ctypes.c_void_p(0))


def whole_attribute(location: int, size: int, buffer: int) -> None:
    """Bind a buffer of 32-bit integers per vertex; smaller ones are packed, the first lowest."""
    GL.glBindBuffer(GL.GL_ARRAY_BUFFER, buffer)
    GL.glEnableVertexAttribArray(location)
    GL.glVertexAttribIPointer(location, size, GL.GL_UNSIGNED_INT, 0, ctypes.c_void_p(0))


class LayeredRenderer(pyrender.Renderer):  # type: ignore[misc]
    """Draws into one buffer without multisampling, at any size, for the life of the process."""

    matrix: NDArray[np.float64]
    light_tint: Float32
    grid: int
    cast: CastLight | None
    _main_fb: int | None
    _main_fb_dims: tuple[int, int]

    def __init__(self) -> None:
        super().__init__(1, 1)
        self._program_cache = ShaderProgramCache(str(SHADERS))
        self._shadow_map = DepthBuffer()

    @property
    def programs(self) -> ShaderProgramCache:
        """The programs of the folder of shaders."""
        return self._program_cache

    def _get_camera_matrices(self, scene: Any) -> tuple[Any, Any]:
        return np.eye(4), self.matrix  # the shader uses only the product

    def _configure_forward_pass_viewport(self, flags: int) -> None:
        super()._configure_forward_pass_viewport(flags)
        GL.glDepthFunc(GL.GL_LEQUAL)
        GL.glDisable(GL.GL_CULL_FACE)
        GL.glDisable(GL.GL_DITHER)
        GL.glEnable(GL.GL_BLEND)
        GL.glBlendFunc(GL.GL_ONE, GL.GL_ONE_MINUS_SRC_ALPHA)

    def _forward_pass(self, scene: Any, flags: int, seg_node_map: Any = None) -> Any:
        if self.cast is not None:
            self._draw_shadow_map(scene)
        return super()._forward_pass(scene, flags, seg_node_map)

    def _draw_shadow_map(self, scene: Any) -> None:
        """Draw the lowest layer of all solid triangles, which is the first primitive."""
        assert self.cast is not None
        primitives = [each for mesh in scene.meshes for each in mesh.primitives if not each.blend]
        self._shadow_map.bind(self.cast.side)
        GL.glEnable(GL.GL_DEPTH_TEST)
        GL.glDepthFunc(GL.GL_LEQUAL)
        GL.glDisable(GL.GL_CULL_FACE)
        for primitive in primitives[:1]:
            program = self._program("flat.vert", "depth.frag", {})
            program._bind()
            program.set_uniform("P", self.cast.matrix)
            self._draw(primitive, program)
            self._reset_active_textures()
            program._unbind()

    def _get_primitive_program(self, primitive: Any, flags: int, program_flags: int) -> Any:
        return self._program("flat.vert", "flat.frag", {"CAST_SHADOWS": 1} if self.cast else {})

    def _program(self, vertex: str, fragment: str, defines: dict[str, int]) -> Any:
        program = self.programs.get_program(vertex, fragment, defines=defines)
        if not program._in_context():
            program._add_to_context()
        return program

    def _bind_and_draw_primitive(self, primitive: Any, pose: Any, program: Any, flags: int) -> None:
        program.set_uniform("light_tint", self.light_tint)
        if self.cast is not None:
            self._shadow_map.bind_texture()
            program.set_uniform("shadow_map", UNIT)
            program.set_uniform("light_matrix", self.cast.matrix)
            program.set_uniform("map_side", float(self.cast.side))
            program.set_uniform("spread", float(self.cast.spread))
            program.set_uniform("grid", self.grid)
            program.set_uniform("height", self.viewport_height)
        GL.glDepthMask(GL.GL_FALSE if primitive.blend else GL.GL_TRUE)
        self._draw(primitive, program)

    def _draw(self, primitive: Any, program: Any) -> None:
        primitive._bind()
        self._bind_texture(primitive.material.baseColorTexture, "atlas", program)
        GL.glDrawElements(
            GL.GL_TRIANGLES, primitive.triangles.size, GL.GL_UNSIGNED_INT, ctypes.c_void_p(0)
        )
        primitive._unbind()

    def _configure_main_framebuffer(self) -> None:
        size = self.viewport_width, self.viewport_height
        if self._main_fb is not None and self._main_fb_dims == size:
            return
        self._delete_main_framebuffer()
        self._main_cb, self._main_db = GL.glGenRenderbuffers(2)
        self._main_fb = self._main_fb_ms = GL.glGenFramebuffers(1)
        GL.glBindFramebuffer(GL.GL_FRAMEBUFFER, self._main_fb)
        for buffer, kind, point in (
            (self._main_cb, GL.GL_RGBA8, GL.GL_COLOR_ATTACHMENT0),
            (self._main_db, GL.GL_DEPTH_COMPONENT24, GL.GL_DEPTH_ATTACHMENT),
        ):
            GL.glBindRenderbuffer(GL.GL_RENDERBUFFER, buffer)
            GL.glRenderbufferStorage(GL.GL_RENDERBUFFER, kind, *size)
            GL.glFramebufferRenderbuffer(GL.GL_FRAMEBUFFER, point, GL.GL_RENDERBUFFER, buffer)
        self._main_fb_dims = size

    def _delete_main_framebuffer(self) -> None:
        if self._main_fb is not None:
            GL.glDeleteFramebuffers(1, [self._main_fb])
            GL.glDeleteRenderbuffers(2, [self._main_cb, self._main_db])
        self._main_fb = self._main_fb_ms = self._main_cb = self._main_db = None

    def _read_main_framebuffer(self, scene: Any, flags: int) -> NDArray[np.uint8]:
        """Premultiplied colours, shape [H, W, 4], top row first."""
        width, height = self._main_fb_dims
        pixels = np.empty((height, width, 4), np.uint8)
        GL.glBindFramebuffer(GL.GL_READ_FRAMEBUFFER, self._main_fb)
        GL.glReadPixels(0, 0, width, height, GL.GL_RGBA, GL.GL_UNSIGNED_BYTE, pixels)
        return pixels[::-1]  # rows of OpenGL start at the bottom


def largest_side() -> int:
    """The longest side of a texture and of a picture that this OpenGL takes [pixels]."""
    limits = (GL.GL_MAX_TEXTURE_SIZE, GL.GL_MAX_RENDERBUFFER_SIZE)
    return min(int(GL.glGetIntegerv(limit)) for limit in limits)


def renderer_name() -> str:
    return f"{GL.glGetString(GL.GL_RENDERER).decode()}"
