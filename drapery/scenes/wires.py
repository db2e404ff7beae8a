"""Cloth drawn as its grid: pale faces, edges and pins."""

from dataclasses import replace

import numpy as np

from drapery.cloth import Cloth
from drapery.mesh import Array, Mesh, vertex_normals
from drapery.render import (
    Light,
    Material,
    Model,
    TextureLayer,
    edges_model,
    pins_model,
    springs_model,
)
from drapery.scenes.backdrop import Backdrop

PAPER = (246, 246, 244, 255)
DAYLIGHT = Light(((0.4, 0.9, 0.7), (-0.6, 0.3, 0.4)), 0.62, 0.4)
"""Softer than the light of the game: folds are visible, and no face is dark."""
LINE = 1.25
"""Width of an edge [pixels]."""


def paper(colour: tuple[int, int, int]) -> Material:
    """A material of one colour, sRGB 0..255."""
    return Material((TextureLayer(np.array([[[*colour, 255]]], np.uint8)),))


def on_paper(backdrop: Backdrop) -> Backdrop:
    """The backdrop as a sheet of paper in daylight."""
    return replace(backdrop, light=DAYLIGHT, background=PAPER)


def wired(
    cloth: Cloth,
    positions: Array,
    backdrop: Backdrop,
    material: Material | None = None,
    springs: bool = False,
) -> tuple[Model, ...]:
    """A cloth's edges and pins as lines and dots, and its faces in a material if one is given.

    positions: [m], shape [N, 3].
    backdrop: of the picture.
    springs: whether all springs are drawn, coloured by kind, in place of the edges.
    """
    camera, height = backdrop.camera, backdrop.size[1]
    normals = vertex_normals(positions, cloth.triangles)
    sheet = Mesh(positions, normals, cloth.triangles, cloth.uvs)
    lines = (
        springs_model(positions, cloth.spring_pairs, cloth.spring_kind, camera, height, LINE)
        if springs
        else edges_model(sheet, camera, height, width=LINE)
    )
    faces = () if material is None else (Model(sheet, (material,), name="cloth"),)
    return (*faces, lines, pins_model(positions, cloth.inv_mass, camera, height))
