"""The shadow map of the light that casts shadows, drawn by OpenGL; see `soft.shadows`.

Import this module only after `platform.load_pyrender`.
"""

from dataclasses import dataclass, field

from OpenGL import GL

from drapery.arrays import Matrices

UNIT = 7
"""The texture unit of the map; pyrender counts up from 0."""


@dataclass(frozen=True, eq=False)
class CastLight:
    """How vertices look themselves up in the map.

    matrix: world to clip space of the light's view, shape [4, 4]. side: of the map [samples].
    spread: distance of the places compared [samples].
    """

    matrix: Matrices
    side: int
    spread: float


@dataclass(eq=False)
class DepthBuffer:
    """A square depth texture of 32-bit floats with its framebuffer, made at the first use."""

    side: int = 0
    buffers: list[int] = field(default_factory=list)

    def bind(self, side: int) -> None:
        """Clear the texture and draw into it until the next framebuffer is bound."""
        if side != self.side:
            self.delete()
            self._make(side)
        GL.glBindFramebuffer(GL.GL_FRAMEBUFFER, self.buffers[0])
        GL.glViewport(0, 0, side, side)
        GL.glDepthMask(GL.GL_TRUE)
        GL.glDepthRange(0.0, 1.0)
        GL.glClearDepth(1.0)
        GL.glClear(GL.GL_DEPTH_BUFFER_BIT)

    def bind_texture(self) -> None:
        """Let shaders read the texture from `UNIT`."""
        GL.glActiveTexture(GL.GL_TEXTURE0 + UNIT)
        GL.glBindTexture(GL.GL_TEXTURE_2D, self.buffers[1])
        GL.glActiveTexture(GL.GL_TEXTURE0)

    def delete(self) -> None:
        if self.buffers:
            GL.glDeleteFramebuffers(1, self.buffers[:1])
            GL.glDeleteTextures(1, self.buffers[1:])
        self.side, self.buffers = 0, []

    def _make(self, side: int) -> None:
        framebuffer, texture = int(GL.glGenFramebuffers(1)), int(GL.glGenTextures(1))
        self.side, self.buffers = side, [framebuffer, texture]
        GL.glBindTexture(GL.GL_TEXTURE_2D, texture)
        for parameter in (GL.GL_TEXTURE_MIN_FILTER, GL.GL_TEXTURE_MAG_FILTER):
            GL.glTexParameteri(GL.GL_TEXTURE_2D, parameter, GL.GL_NEAREST)
        kind, size = GL.GL_DEPTH_COMPONENT32F, (side, side)
        GL.glTexImage2D(
            GL.GL_TEXTURE_2D, 0, kind, *size, 0, GL.GL_DEPTH_COMPONENT, GL.GL_FLOAT, None
        )
        GL.glBindFramebuffer(GL.GL_FRAMEBUFFER, framebuffer)
        GL.glFramebufferTexture2D(
            GL.GL_FRAMEBUFFER, GL.GL_DEPTH_ATTACHMENT, GL.GL_TEXTURE_2D, texture, 0
        )
        GL.glDrawBuffer(GL.GL_NONE)
        GL.glReadBuffer(GL.GL_NONE)
