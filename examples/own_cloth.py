"""The simulation core alone: a disc of cloth falls over a ball."""

import sys
from dataclasses import replace
from itertools import islice
from pathlib import Path

import numpy as np
import trimesh

from drapery.banner.packs import open_packs
from drapery.cloth import disc, rest_state, simulate
from drapery.cloth.colliders import Collider, Plane, Sphere
from drapery.cloth.collisions import Collisions
from drapery.mesh import Mesh, vertex_normals
from drapery.render.backends import backend
from drapery.render.frame import Animation
from drapery.render.scene import Material, Model, Scene, TextureLayer
from drapery.render.views import View, frame_points
from drapery.style.extrusion import extrude

RADIUS, FLOOR, THICKNESS = 0.25, -0.35, 0.02
SIZE = (240, 200)


def main(folder: Path, frames: int = 40) -> None:
    cloth = disc(9, 0.5)
    start = rest_state(cloth, dtype=np.float64)
    start = replace(start, positions=start.positions + np.array([0.04, 0.5, 0.0]))
    ball, floor = Sphere(np.zeros(3), RADIUS), Plane(np.array([0, FLOOR, 0]), np.array([0, 1.0, 0]))
    collisions = Collisions((Collider(floor), Collider(ball)), THICKNESS)
    states = simulate(cloth, dt=1 / 120, every=6, start=start, collisions=collisions)
    positions = np.stack([state.positions[0] for state in islice(states, frames)])

    texels = open_packs(()).texture("minecraft:block/white_wool")
    wool = (Material((TextureLayer(texels, (176, 46, 38)),)),)
    stone = (Material((TextureLayer(open_packs(()).texture("minecraft:block/stone")),)),)
    sphere = trimesh.creation.icosphere(subdivisions=3, radius=RADIUS - 0.01)
    vertices = np.asarray(sphere.vertices)
    uvs = vertices[:, :2] / RADIUS / 2 + 0.5
    solid = Model(Mesh(vertices, vertices / RADIUS, sphere.faces.astype(np.int32), uvs), stone)
    camera = frame_points(View(25, 22, 30), positions, SIZE[0] / SIZE[1])
    draw_scene, pictures = backend(), []
    for moment in positions:
        thin = Mesh(moment, vertex_normals(moment, cloth.triangles), cloth.triangles, cloth.uvs)
        models = (solid, Model(extrude(thin, THICKNESS), wool))
        pictures.append(draw_scene(Scene(models, camera, SIZE, background=(222, 230, 236, 255))))
    Animation(tuple(pictures), 20).save(folder / "disc.webp")


if __name__ == "__main__":
    main(Path(sys.argv[1] if len(sys.argv) > 1 else "."))
