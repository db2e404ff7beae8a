"""What cloth can meet, and how it answers."""

from drapery.cloth.colliders.collision_world import Collider, Probes, collide, face_probes, probes
from drapery.cloth.colliders.meshes import height_collider, load_mesh, mesh_collider
from drapery.cloth.colliders.pose import Path, Pose, rotation_about, still, straight, swinging
from drapery.cloth.colliders.shapes import (
    Box,
    Capsule,
    Plane,
    Shape,
    Sphere,
    TriangleMesh,
    Voxels,
)

__all__ = [
    "Box",
    "Capsule",
    "Collider",
    "Path",
    "Plane",
    "Pose",
    "Probes",
    "Shape",
    "Sphere",
    "TriangleMesh",
    "Voxels",
    "collide",
    "face_probes",
    "height_collider",
    "load_mesh",
    "mesh_collider",
    "probes",
    "rotation_about",
    "still",
    "straight",
    "swinging",
]
