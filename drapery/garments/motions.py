"""Motions of players as data: key poses, and the poses of all bones between them."""

from collections.abc import Mapping
from functools import cache, cached_property
from importlib.resources import as_file, files
from pathlib import Path
from typing import Annotated

import numpy as np
from pydantic import Field, ValidationError

from drapery.cloth.colliders import rotation_about
from drapery.elementary import sine_of_turns
from drapery.errors import OptionError
from drapery.garments.blends import unknown_motion
from drapery.garments.model import Angle, GarmentTable, Length
from drapery.json_text import JSONTextError, parse_json
from drapery.mesh import Array
from drapery.style.figure import TEXEL, WING_JOINTS, FigurePart, to_metres
from drapery.toml_text import read_toml
from drapery.user_files import read_user_file

MAX_BYTES = 1 << 16
"""The longest file of poses [bytes]."""
HIPS = np.array([0.0, 12 * TEXEL, 0.0])
"""About which `root` turns everything [m]."""
LEGS = ("right_leg", "left_leg")
CORNERS = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)])
"""Those of a box, from its middle, in halves of its edges."""

Turns = tuple[Angle, Angle, Angle]
NO_TURN: Turns = (0.0, 0.0, 0.0)


class KeyPose(GarmentTable):
    """A pose: how far each bone is turned about x, then y, then z at its joint [degrees].

    root: turns everything about the hips. shift: moves everything [texels]. Wings turn from where
    they are folded on the back, which they follow.
    """

    root: Turns = NO_TURN
    head: Turns = NO_TURN
    body: Turns = NO_TURN
    right_arm: Turns = NO_TURN
    left_arm: Turns = NO_TURN
    right_leg: Turns = NO_TURN
    left_leg: Turns = NO_TURN
    right_wing: Turns = NO_TURN
    left_wing: Turns = NO_TURN
    shift: tuple[Length, Length, Length] = (0.0, 0.0, 0.0)

    @property
    def turns(self) -> Array:
        """The turns [degrees] and the shift [texels] as `POSE_FIELDS` names them, [F, 3]."""
        return np.array([getattr(self, name) for name in POSE_FIELDS])


POSE_FIELDS = tuple(KeyPose.model_fields)
"""The fields of a pose: the bones that it turns, `root` and `shift`."""


class Motion(GarmentTable):
    """Key poses that follow each other smoothly and repeat.

    period: of all of them [s]. grounded: whether the lowest leg stays on the ground.
    """

    poses: Annotated[tuple[KeyPose, ...], Field(min_length=1, max_length=64)]
    period: Annotated[float, Field(strict=True, ge=0.1, le=60)] = 1.0
    grounded: bool = False

    @cached_property
    def _turns(self) -> Array:
        return np.array([pose.turns for pose in self.poses])

    def turns(self, times: Array) -> Array:
        """The pose at T times [s] as `KeyPose.turns`, shape [T, F, 3].

        Between key poses the angles follow a cosine.
        """
        count = len(self.poses)
        number, share = np.divmod(times / self.period % 1.0 * count, 1.0)
        first, second = (self._turns[(number.astype(int) + step) % count] for step in (0, 1))
        share = 0.5 - 0.5 * sine_of_turns(share / 2 + 0.25)
        return mixed(first, second, share[:, None, None])


def mixed(first: Array, second: Array, share: Array | float) -> Array:
    """Turns between the first ones, at share 0, and the second ones, at share 1."""
    between: Array = first + (second - first) * share
    return between


def find_motion(name: str, folder: Path = Path()) -> Motion:
    """The motion of this name, or one pose of a JSON file of `KeyPose`. Raises OptionError."""
    if name.lower().endswith(".json"):
        return Motion(poses=(_read_pose(folder / name),), grounded=False)
    known = _known()
    if name not in known:
        raise unknown_motion(name)
    return known[name]


def motion_names() -> tuple[str, ...]:
    """The names of all motions; `walk` is made by the speed of the wearer."""
    return ("walk", *_known())


@cache
def _known() -> dict[str, Motion]:
    with as_file(files("drapery.garments") / "motions.toml") as path:
        tree, _ = read_toml(path, MAX_BYTES, "a file of motions")
    return {name: Motion.model_validate(table) for name, table in tree.items()}


def _read_pose(path: Path) -> KeyPose:
    data = read_user_file(path, MAX_BYTES, shorter="a pose is shorter")
    try:
        return KeyPose.model_validate(parse_json(data.decode("utf-8-sig")))
    except ValidationError as error:
        name = ".".join(str(part) for part in error.errors()[0]["loc"])
        bones = ", ".join(KeyPose.model_fields)
        raise OptionError(
            f"{path}: {name} cannot be used; give three angles in degrees for some of: {bones}"
        ) from None
    except UnicodeDecodeError as error:
        raise OptionError(f"{path}: byte {error.start} is not UTF-8; save it as UTF-8") from None
    except JSONTextError as error:
        raise OptionError(f"{path} is not JSON{error}") from None


def player_bones(parts: Mapping[str, FigurePart]) -> tuple[str, ...]:
    """The bones of a player, in the order of `bone_table`. parts: its boxes and joints."""
    return (*parts, *WING_JOINTS)


def bone_table(turns: Array, parts: Mapping[str, FigurePart], grounded: bool) -> Array:
    """Place [m] and rotation matrix of each bone of a player in T poses, shape [T, K, 12].

    turns: of each pose, see `KeyPose.turns`, shape [T, F, 3].
    parts: its boxes and joints.
    grounded: whether the lowest leg stays on the ground.
    """
    bones = player_bones(parts)
    turn = dict(zip(POSE_FIELDS, np.moveaxis(_rotations(turns), 1, 0), strict=True))
    shift, root = turns[:, POSE_FIELDS.index("shift")] * TEXEL, turn["root"]
    table = np.empty((len(turns), len(bones), 12))
    places, rotations = table[..., :3], table[..., 3:].reshape(*table.shape[:2], 3, 3)
    for number, (name, part) in enumerate(parts.items()):
        joint = to_metres(np.array(part.joint))
        # About the joint, then about the hips: R (T (x - joint) + joint - hips) + hips.
        offset = joint - turned(turn[name], joint)
        places[:, number] = turned(root, offset - HIPS) + HIPS + shift
        rotations[:, number] = product(root, turn[name])
    body = bones.index("body")
    for name, joint_texels in WING_JOINTS.items():
        joint, number = to_metres(np.array(joint_texels)), bones.index(name)
        offset = joint - turned(turn[name], joint)
        places[:, number] = turned(rotations[:, body], offset) + places[:, body]
        rotations[:, number] = product(rotations[:, body], turn[name])
    if grounded:
        rise = np.zeros((len(turns), 1, 3))
        rise[:, 0, 1] = -_lowest(table, parts)
        places += rise
    return table


def _lowest(table: Array, parts: Mapping[str, FigurePart]) -> Array:
    """Height of the lowest corner of the legs in each pose [m], shape [T]."""
    heights = []
    for name in LEGS:
        rows = table[:, list(parts).index(name)]
        corners = parts[name].centre + CORNERS * parts[name].extent / 2
        heights.append((corners * rows[:, None, 6:9]).sum(axis=2) + rows[:, None, 1])
    lowest: Array = np.concatenate(heights, axis=1).min(axis=1)
    return lowest


def turned(rotations: Array, points: Array) -> Array:
    """Points [..., 3] turned by rotation matrices [..., 3, 3]."""
    # Summed in a fixed order; BLAS may not.
    found: Array = (rotations * points[..., None, :]).sum(axis=-1)
    return found


def product(first: Array, second: Array) -> Array:
    """The products of matrices [..., 3, 3]."""
    # Summed in a fixed order; BLAS may not.
    found: Array = (first[..., None] * second[..., None, :, :]).sum(axis=-2)
    return found


def _rotations(turns: Array) -> Array:
    """Rotations about x, then y, then z [degrees]: from shape [..., 3] to [..., 3, 3]."""
    rotations: Array = np.broadcast_to(np.eye(3), (*turns.shape, 3))
    for number, axis in enumerate(((1, 0, 0), (0, 1, 0), (0, 0, 1))):
        degrees = turns[..., number]
        made = product(rotation_about(axis, degrees), rotations)
        rotations = np.where((degrees != 0)[..., None, None], made, rotations)
    return rotations
