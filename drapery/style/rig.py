"""Stiff parts on bones, as one model whose constant part is shared by all of its poses."""

from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np

from drapery.mesh import Array, Mesh
from drapery.render.scene import Material, Rig, RiggedModel
from drapery.style.boxes import join
from drapery.style.figure import FigurePart, Placed


def make_rig(parts: Sequence[tuple[str, Mesh]], figure: Mapping[str, FigurePart]) -> Rig:
    """The rig of meshes at rest, each on a bone. figure: the joints of all bones."""
    bones = tuple(dict.fromkeys(bone for bone, _ in parts))
    count = [len(mesh.uvs) for _, mesh in parts]
    member = np.repeat([bones.index(bone) for bone, _ in parts], count).astype(np.int32)
    joints = np.array([figure[bone].pivot for bone in bones])
    return Rig(bones, joints, member, join([mesh for _, mesh in parts]))


def rigged_model(
    rig: Rig, poses: Mapping[str, Placed], material: Material, name: str = ""
) -> RiggedModel:
    """The rig in poses of its bones. name: of the model."""
    placed = [poses[bone] for bone in rig.bones]
    places, rotations = (np.array([pose[part] for pose in placed]) for part in (0, 1))
    rest, turns = rig.rest, rotations[rig.member]
    # einsum adds in a fixed order; BLAS may not.
    positions = np.einsum("vij,vj->vi", turns, rest.positions) + places[rig.member]
    normals = np.einsum("vij,vj->vi", turns, rest.normals)
    mesh = Mesh(positions, normals, rest.triangles, rest.uvs)
    return RiggedModel(mesh, (material,), rig=rig, places=places, rotations=rotations, name=name)


def moved_rig(model: RiggedModel, mesh: Mesh, rotation: Array, place: Array) -> RiggedModel:
    """A model that is turned, then moved, as a whole. mesh: its mesh there."""
    return replace(
        model,
        mesh=mesh,
        places=np.einsum("ij,bj->bi", rotation, model.places) + place,
        rotations=np.einsum("ij,bjk->bik", rotation, model.rotations),
    )
