"""The types of arrays in public signatures, by their shape.

The last axis is the vector, every earlier axis a batch. Parameters say units, and the shape
where a type leaves it open.
"""

import sys
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

if sys.version_info >= (3, 12):
    from typing import TypeAliasType
else:
    from typing_extensions import TypeAliasType

__all__ = [
    *("Bytes", "Channels", "Floats", "Integers", "Mask", "Matrices", "Pairs", "Pixels"),
    *("Texels", "Triangles", "UVs", "Vectors", "Words"),
]

Vectors = TypeAliasType("Vectors", NDArray[np.floating[Any]])
"""x, y and z, shape [..., 3]: positions [m], velocities [m/s], unit normals."""
Matrices = TypeAliasType("Matrices", NDArray[np.floating[Any]])
"""Rotations, shape [..., 3, 3], or projections, shape [4, 4]."""
UVs = TypeAliasType("UVs", NDArray[np.floating[Any]])
"""Texture coordinates, shape [..., 2], as fractions; (0, 0) is the top left corner."""
Floats = TypeAliasType("Floats", NDArray[np.floating[Any]])
"""Numbers of any shape."""
Triangles = TypeAliasType("Triangles", NDArray[np.signedinteger[Any]])
"""Vertex indices, shape [T, 3]; counter-clockwise seen from outside."""
Pairs = TypeAliasType("Pairs", NDArray[np.signedinteger[Any]])
"""Indices of two ends, shape [S, 2]."""
Integers = TypeAliasType("Integers", NDArray[np.signedinteger[Any]])
"""Whole numbers of any shape."""
Bytes = TypeAliasType("Bytes", NDArray[np.uint8])
"""Numbers from 0 to 255 of any shape."""
Mask = TypeAliasType("Mask", NDArray[np.bool_])
"""Bools of any shape."""
Pixels = TypeAliasType("Pixels", NDArray[np.uint8])
"""A picture: sRGB with straight alpha, shape [H, W, 4], top row first."""
Texels = TypeAliasType("Texels", NDArray[np.uint8])
"""A texture: sRGB with straight alpha, shape [H, W, 4], top row first."""
Words = TypeAliasType("Words", NDArray[np.uint32])
"""Pixels as one number each, shape [H, W]; red is the lowest byte, alpha the highest."""
Channels = TypeAliasType("Channels", NDArray[Any])
"""Pixels of 8 or 16 bits a channel, shape [H, W, 4]."""


class HasPixels(Protocol):
    """A finished picture for the encoders, such as a `Frame`."""

    @property
    def pixels(self) -> Pixels: ...
