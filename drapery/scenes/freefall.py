"""Cloths fall on a beetle and on a fox of cubes, and drape over them."""

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from drapery.banner.packs import open_packs
from drapery.cloth import Cloth, Drag, Fabric, Gravity, State, grid
from drapery.cloth.colliders import (
    Collider,
    Plane,
    Pose,
    Voxels,
    mesh_collider,
    rotation_about,
)
from drapery.cloth.collisions import Collisions
from drapery.cloth.solvers.verlet import SolverVerlet
from drapery.mesh import Array
from drapery.render.scene import Model, Scene
from drapery.render.shadow import contact_shadow
from drapery.render.vectors import dots
from drapery.render.views import View, frame_points
from drapery.scenes.catalogue import Clip
from drapery.scenes.moving import motion, placed
from drapery.scenes.parameters import (
    MAX_DRAG,
    SceneParameters,
    grid_parameter,
    parameter,
    thickness_in_metres,
)
from drapery.style.block_world import blocks, plateau
from drapery.style.creature import CUBE, cells_of, fox
from drapery.style.extrusion import make_shell
from drapery.style.insect import Beetle, beetle
from drapery.style.scenery import SKY, moved
from drapery.style.tailoring import checked, garment

ABOVE = View(azimuth=22, elevation=20, fov=28)
HEIGHT = 1.9
"""From where the cloths fall [m]."""
BEETLE_AT, FOX_AT = np.array([-1.0, 0.0, 0.4]), np.array([1.05, 0.0, 0.5])
GROUND = Collider(Plane(np.zeros(3), np.array([0.0, 1, 0])), friction=0.6)
SOFT = Fabric(stretch=8.0, shear=2.0, flexion=0.15)


@dataclass(frozen=True)
class FreefallParameters(SceneParameters):
    """What can be set of the scene `freefall`."""

    grid: tuple[int, int] = grid_parameter((20, 20), "Particles across and down each cloth")
    side: float = parameter(1.9, "Side of each cloth", (0.5, 4), "m")
    drag: float = parameter(0.8, "Drag of the air", (0, MAX_DRAG), "1/s")
    thickness: float = thickness_in_metres(0.04)
    friction: float = parameter(0.4, "Friction of the cloth on what it touches", (0, 2))


def play(parameters: FreefallParameters, clip: Clip) -> Iterator[Scene]:
    """From the moment when both cloths are released."""
    packs = open_packs(())
    insect, cubes = beetle(BEETLE_AT), blocks(fox(), packs)
    still = (*blocks(plateau(4, 3), packs), *insect.models, *_small(cubes))
    shadow = contact_shadow(still[-len(insect.models) - len(cubes) :], 0.0)
    wool = packs.texture("block/white_wool")
    materials = [checked(wool, dyes) for dyes in (("lime", "white"), ("light_blue", "white"))]
    cloths = (sheet(parameters, BEETLE_AT), sheet(parameters, FOX_AT))
    colliders = (insect_colliders(parameters, insect), fox_colliders(parameters))
    shell = make_shell(cloths[0].triangles, cloths[0].uvs)
    size = parameters.side, parameters.side
    camera = frame_points(ABOVE, _framed_points(), clip.size[0] / clip.size[1], margin=0.03)
    motions = [
        cloth_states(parameters, *pair, clip) for pair in zip(cloths, colliders, strict=True)
    ]
    for states in zip(*motions, strict=True):
        fallen = tuple(
            garment(shell, state.positions[0], parameters.thickness, material, size=size)
            for state, material in zip(states, materials, strict=True)
        )
        yield Scene((*still, shadow, *fallen), camera, clip.size, background=SKY, samples=4)


def sheet(parameters: FreefallParameters, at: Array) -> Cloth:
    """A level cloth over a place on the ground, turned a little."""
    cloth = grid(*parameters.grid, parameters.side, parameters.side, pins="none", fabric=SOFT)
    flat = placed(cloth, np.array([0, parameters.side / 2, 0]))
    about_y, about_x = rotation_about((0, 1, 0), 12), rotation_about((1, 0, 0), -90)
    turn = dots(about_y[:, None], about_x.T)  # the product of the matrices
    return placed(flat, at + np.array([0.0, HEIGHT, 0.0]), turn)


def cloth_states(
    parameters: FreefallParameters, cloth: Cloth, colliders: tuple[Collider, ...], clip: Clip
) -> Iterator[State]:
    """One cloth at each frame."""
    return motion(
        cloth,
        clip,
        solver=SolverVerlet(),
        forces=(Gravity(), Drag(parameters.drag)),
        collisions=Collisions(colliders, parameters.thickness),
    )


def insect_colliders(parameters: FreefallParameters, insect: Beetle) -> tuple[Collider, ...]:
    """The beetle and the ground."""
    surface = mesh_collider(insect.vertices, insect.triangles)
    return Collider(surface, friction=parameters.friction), GROUND


def fox_colliders(parameters: FreefallParameters) -> tuple[Collider, ...]:
    """The fox and the ground."""
    place = Pose(FOX_AT - np.array([CUBE / 2, 0, 0]))
    cubes = Voxels(cells_of(fox()), CUBE)
    return Collider(cubes, lambda time: place, friction=parameters.friction), GROUND


def _small(cubes: tuple[Model, ...]) -> tuple[Model, ...]:
    """Blocks made as small as the cubes of the fox, and put where it stands."""
    small = tuple(
        replace(model, mesh=replace(model.mesh, positions=model.mesh.positions * CUBE))
        for model in cubes
    )
    return moved(small, FOX_AT - np.array([CUBE / 2, 0, 0]))


def _framed_points() -> Array:
    """What the camera frames [m]."""
    low = [[x, y, z] for x in (-2, 2) for z in (-1, 2) for y in (-1, 0)]
    return np.array([*low, [-1.2, HEIGHT + 0.2, 0], [1.2, HEIGHT + 0.2, 0]])
