"""A style on models of cloth: their meshes, materials and motion."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from drapery.mesh import Array, Mesh
from drapery.render.scene import Model
from drapery.style.piece import Piece
from drapery.style.tailoring import ClothModel
from drapery.styles.style import Style


def tailored(model: Model, style: Style) -> Model:
    """A model of cloth with the style's material, and its shape if it is a rectangle."""
    if not isinstance(model, ClothModel):
        return model
    materials = tuple(style.material(material) for material in model.materials)
    mesh = model.mesh
    if model.thin is not None and style.has("shape"):
        mesh = _shaped(*model.thin, style)
    return replace(model, mesh=mesh, materials=materials)


def _shaped(piece: Piece, positions: Array, style: Style) -> Mesh:
    """The mesh of a piece, or of a batch of pieces, by the style's shape steps."""
    batch = positions.reshape(-1, *positions.shape[-2:])
    meshes = [style.mesh(piece, each) for each in batch]
    if positions.ndim == 2:
        return meshes[0]
    places = np.stack([mesh.positions for mesh in meshes])
    return replace(meshes[0], positions=places, normals=np.stack([m.normals for m in meshes]))


def moved_by_style(frames: Sequence[Sequence[Model]], style: Style) -> list[list[Model]]:
    """The models of each frame with the motion steps applied to each rectangle of cloth.

    frames: each has the same models in the same order.
    """
    models = [[*frame] for frame in frames]
    if not style.has("motion"):
        return models
    for place in range(min(map(len, models))):
        cloth = [model for frame in models if isinstance(model := frame[place], ClothModel)]
        thin = [model.thin for model in cloth if model.thin is not None]
        if len(thin) == len(models):
            piece = thin[0][0]
            motion = _moved_positions(piece, np.stack([positions for _, positions in thin]), style)
            for frame, model, positions in zip(models, cloth, motion, strict=True):
                mesh = piece.mesh(positions)
                frame[place] = replace(model, mesh=mesh, thin=(piece, positions))
    return models


def _moved_positions(piece: Piece, motion: Array, style: Style) -> Array:
    """The positions of a piece or batch at all moments after the motion steps."""
    batch = motion.reshape(len(motion), -1, *motion.shape[-2:])
    members = (batch[:, member] for member in range(batch.shape[1]))
    moved = [style.move(piece, member) for member in members]
    return np.stack(moved, axis=1).reshape(motion.shape)
