"""The cloth behind a banner: its springs by kind, its pins, and its stretch as colours."""

import sys
from itertools import islice
from pathlib import Path

from drapery.cloth import Gravity, Wind, grid, simulate
from drapery.render import (
    UNLIT,
    VIEWS,
    Mesh,
    Scene,
    at_particles,
    backend,
    frame_points,
    pins_model,
    spring_stretch,
    springs_model,
    stretch_model,
    vertex_normals,
)
from drapery.style import FLAG_SIZE

SIZE = (320, 480)


def main(folder: Path) -> None:
    cloth = grid(9, 17, *FLAG_SIZE)
    states = simulate(cloth, forces=(Gravity(), Wind((2.0, 0.0, 6.0))), every=180)
    positions = next(islice(states, 1, None)).positions[0]
    camera = frame_points(VIEWS["hero"], positions, SIZE[0] / SIZE[1])
    stretch = spring_stretch(positions, cloth.spring_pairs, cloth.spring_length)
    normals = vertex_normals(positions, cloth.triangles)
    surface = Mesh(positions, normals, cloth.triangles, cloth.uvs)
    models = (
        stretch_model(surface, at_particles(stretch, cloth.spring_pairs, len(positions)), 0.03),
        springs_model(positions, cloth.spring_pairs, cloth.spring_kind, camera, SIZE[1]),
        pins_model(positions, cloth.inv_mass, camera, SIZE[1]),
    )
    scene = Scene(models, camera, SIZE, UNLIT, (246, 246, 244, 255), samples=4)
    backend()(scene).save(folder / "wireframe.png")


if __name__ == "__main__":
    main(Path(sys.argv[1] if len(sys.argv) > 1 else "."))
