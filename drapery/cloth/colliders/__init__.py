"""Colliders: shapes, their motion and their surfaces.

A `Collider` is a shape with a path, a restitution and a friction. A shape is one of the built-in
shapes or any object that has a signed distance, see `SignedDistance`. Lengths are in metres, times
in seconds, angles in degrees.
"""

from drapery.cloth.colliders.check import check_collider
from drapery.cloth.colliders.collider import Collider
from drapery.cloth.colliders.meshes import height_collider, load_mesh, mesh_collider
from drapery.cloth.colliders.pose import (
    Path,
    Pose,
    TablePath,
    at_rest,
    rotation_about,
    straight,
    swinging,
)
from drapery.cloth.colliders.shapes import (
    Box,
    Capsule,
    Plane,
    Shape,
    Sphere,
    TriangleMesh,
    Voxels,
)
from drapery.cloth.colliders.user_defined import SignedDistance

__all__ = [
    "Box",
    "Capsule",
    "Collider",
    "Path",
    "Plane",
    "Pose",
    "Shape",
    "SignedDistance",
    "Sphere",
    "TablePath",
    "TriangleMesh",
    "Voxels",
    "at_rest",
    "check_collider",
    "height_collider",
    "load_mesh",
    "mesh_collider",
    "rotation_about",
    "straight",
    "swinging",
]
