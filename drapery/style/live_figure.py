"""Who wears a cloth that a page plays without Python: vertices in each pose, by a kernel."""

from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from drapery.jit import entry_point
from drapery.mesh import Array
from drapery.render.light import Light
from drapery.render.scene import Rig
from drapery.style.live_shell import show

__all__ = ["LiveFigure", "make_live_figure", "pose_figure"]


class LiveFigure(NamedTuple):
    """Meshes on bones, and their V vertices as `pose_figure` writes them.

    rest, units: places [m] and normals at rest, [V, 3]. member: the bone of each vertex, [V].
    poses: place [m] and rotation of each bone in each row of the motion, [T, B, 12].
    place, turn, middle, lights, levels, vertices, normals, light: see `LiveShell`.
    """

    rest: Array
    units: Array
    member: NDArray[np.int32]
    poses: Array
    place: Array
    turn: Array
    middle: Array
    lights: Array
    levels: Array
    vertices: Array
    normals: Array
    light: Array


def make_live_figure(
    rigs: Sequence[Rig],
    bones: Sequence[str],
    poses: Array,
    place: Array,
    light: Light,
    turn: Array,
    middle: Array,
) -> LiveFigure:
    """The figure of some rigs, whose vertices follow each other.

    bones: the names of all bones, in the order of `poses`. For the others see `LiveFigure`.
    """
    member = [
        np.array([bones.index(bone) for bone in rig.bones], np.int32)[rig.member] for rig in rigs
    ]
    rest = np.concatenate([rig.rest.positions for rig in rigs])
    return LiveFigure(
        np.ascontiguousarray(rest, np.float32),
        np.ascontiguousarray(np.concatenate([rig.rest.normals for rig in rigs]), np.float32),
        np.concatenate(member),
        np.ascontiguousarray(poses, np.float32),
        np.array(place, float),
        np.array(turn, float),
        np.array(middle, float),
        light.unit_directions(),
        np.array([light.ambient, light.diffuse], float),
        np.zeros((len(rest), 3), np.float32),
        np.zeros((len(rest), 3), np.float32),
        np.zeros(len(rest), np.float32),
    )


@entry_point
def pose_figure(row: Any, figure: Any) -> Any:
    """Write the vertices of the figure in row[0] of its poses. Returns 0."""
    for v in range(figure.member.size):
        pose = figure.poses[row[0], figure.member[v]]
        point, unit = figure.rest[v], figure.units[v]
        x = pose[3] * point[0] + pose[4] * point[1] + pose[5] * point[2] + pose[0]
        y = pose[6] * point[0] + pose[7] * point[1] + pose[8] * point[2] + pose[1]
        z = pose[9] * point[0] + pose[10] * point[1] + pose[11] * point[2] + pose[2]
        nx = pose[3] * unit[0] + pose[4] * unit[1] + pose[5] * unit[2]
        ny = pose[6] * unit[0] + pose[7] * unit[1] + pose[8] * unit[2]
        nz = pose[9] * unit[0] + pose[10] * unit[1] + pose[11] * unit[2]
        at = x + figure.place[0], y + figure.place[1], z + figure.place[2]
        show(figure, v, at, (nx, ny, nz))
    return 0
