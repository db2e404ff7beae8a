"""Motions of players as data: key poses, and the poses of all bones between them."""

from collections.abc import Mapping
from functools import cache, lru_cache
from importlib.resources import as_file, files
from pathlib import Path
from typing import Annotated, Any

import numpy as np
from pydantic import Field, ValidationError

from drapery.cloth.colliders import rotation_about
from drapery.elementary import sine_of_turns
from drapery.errors import OptionError
from drapery.garments.blends import unknown_motion
from drapery.garments.model import Angle, GarmentTable, Length
from drapery.json_text import JSONTextError, parse_json
from drapery.mesh import Array
from drapery.style.figure import TEXEL, WING_JOINTS, FigurePart, Placed, to_metres
from drapery.toml_text import read_toml
from drapery.user_files import read_user_file

MAX_BYTES = 1 << 16
"""The longest file of poses [bytes]."""
HIPS = np.array([0.0, 12 * TEXEL, 0.0])
"""About which `root` turns everything [m]."""
LEGS = ("right_leg", "left_leg")

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

    def mixed(self, other: "KeyPose", share: float) -> "KeyPose":
        """A pose between this one, at share 0, and another, at share 1."""
        values: dict[str, Any] = {
            name: tuple(
                a + (b - a) * share
                for a, b in zip(getattr(self, name), getattr(other, name), strict=True)
            )
            for name in KeyPose.model_fields
        }
        return KeyPose.model_construct(**values)


class Motion(GarmentTable):
    """Key poses that follow each other smoothly and repeat.

    period: of all of them [s]. grounded: whether the lowest leg stays on the ground.
    """

    poses: Annotated[tuple[KeyPose, ...], Field(min_length=1, max_length=64)]
    period: Annotated[float, Field(strict=True, ge=0.1, le=60)] = 1.0
    grounded: bool = False

    def key_pose(self, time: float) -> KeyPose:
        """The pose at a time [s]; between key poses the angles follow a cosine."""
        count = len(self.poses)
        number, share = divmod(time / self.period % 1.0 * count, 1.0)
        first, second = (self.poses[(int(number) + step) % count] for step in (0, 1))
        return first.mixed(second, 0.5 - 0.5 * float(sine_of_turns(share / 2 + 0.25)))


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


def bone_poses(pose: KeyPose, parts: Mapping[str, FigurePart], grounded: bool) -> dict[str, Placed]:
    """Where each bone of a player is in a pose. parts: its boxes and joints."""
    root = _rotation(pose.root)
    shift = np.array(pose.shift) * TEXEL
    placed = {}
    for name, part in parts.items():
        turn, joint = _rotation(getattr(pose, name)), to_metres(np.array(part.joint))
        # About the joint, then about the hips: R (T (x - joint) + joint - hips) + hips.
        offset = joint - _applied(turn, joint)
        rotation = np.einsum("ij,jk->ik", root, turn)
        placed[name] = _applied(root, offset - HIPS) + HIPS + shift, rotation
    body, back = placed["body"]
    for name, joint_texels in WING_JOINTS.items():
        turn, joint = _rotation(getattr(pose, name)), to_metres(np.array(joint_texels))
        place = _applied(back, joint - _applied(turn, joint)) + body
        placed[name] = place, np.einsum("ij,jk->ik", back, turn)
    if grounded:
        rise = np.array([0.0, -_lowest(placed, parts), 0.0])
        placed = {name: (place + rise, turn) for name, (place, turn) in placed.items()}
    return placed


def _lowest(placed: Mapping[str, Placed], parts: Mapping[str, FigurePart]) -> float:
    """Height of the lowest corner of the legs [m]."""
    signs = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)])
    heights = []
    for name in LEGS:
        place, turn = placed[name]
        corners = parts[name].centre + signs * parts[name].extent / 2
        heights.append((corners * turn[1]).sum(axis=1) + place[1])
    return float(np.min(heights))


def _applied(rotation: Array, point: Array) -> Array:
    # Summed in a fixed order; BLAS may not.
    turned: Array = (rotation * point).sum(axis=1)
    return turned


@lru_cache(maxsize=256)
def _rotation(turns: Turns) -> Array:
    rotation: Array = np.eye(3)
    for axis, degrees in zip(((1, 0, 0), (0, 1, 0), (0, 0, 1)), turns, strict=True):
        if degrees:
            rotation = np.einsum("ij,jk->ik", rotation_about(axis, degrees), rotation)
    return rotation
