"""How a player moves: its motion or a blend of several, and where its head looks.

`walk+wave` is a walk whose arm waves: bones that a later motion turns follow it, all others the one
before. `walk:0.7,wave:0.3` is the mean of both, by weight.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path
from typing import Any

import numpy as np

from drapery.cloth.colliders import rotation_about
from drapery.garments.blends import read_blend
from drapery.garments.model import GarmentWearer
from drapery.garments.motions import KeyPose, Motion, bone_poses, find_motion
from drapery.mesh import Array
from drapery.scenes.gait import ARM_SHARE, Gait
from drapery.style.figure import TEXEL, FigurePart, Placed, to_metres

STRIDE = 0.8
"""The period of a stride [s], unless a loop needs a whole number of them."""
RAMP = 0.5
"""A wearer takes its pose in this time, so that its cloth can follow [s]."""
EYES = np.array([0.0, 4 * TEXEL, 0.0])
"""The middle of the head from its joint [m]."""

Poses = Mapping[str, Placed]
PosesAt = Callable[[float], Poses]


@dataclass(frozen=True)
class MotionLayer:
    """One motion of a blend.

    key_pose: its pose at a time [s]. bones: the fields of `KeyPose` that it changes.
    grounded: whether the lowest leg stays on the ground. weight: its share of a mean.
    """

    key_pose: Callable[[float], KeyPose]
    bones: frozenset[str]
    grounded: bool
    weight: float


def player_poses(
    who: GarmentWearer, folder: Path, parts: Mapping[str, FigurePart], loop: float | None
) -> PosesAt:
    """The poses of a player at a time [s].

    folder: of files of poses. parts: its boxes. loop: the length of a loop [s], which a whole
    number of periods of each motion fills; None for none. Raises OptionError.
    """
    moves = _moves(who, folder, parts, loop)
    if not any(who.look):
        return moves
    looks = _at_point if len(who.look) == 3 else _by_angles

    @lru_cache(maxsize=64)
    def looking(time: float) -> Poses:
        poses = dict(moves(time))
        # The flag of a banner on the head needs time to follow.
        share = 1.0 if who.head is None else _eased(time)
        poses["head"] = looks(who.look, poses, parts, share)
        return poses

    return looking


def whole_period(period: float, loop: float | None) -> float:
    """The period that fills a loop a whole number of times."""
    return period if loop is None else loop / max(1, round(loop / period))


def walk(who: GarmentWearer, loop: float | None) -> Gait:
    """The walk of a wearer."""
    return Gait(who.speed, whole_period(STRIDE, loop), who.kind)


def _eased(time: float) -> float:
    """How far a wearer has taken its pose, 0 to 1."""
    share = min(time / RAMP, 1.0)
    return share * share * (3 - 2 * share)


def _moves(
    who: GarmentWearer, folder: Path, parts: Mapping[str, FigurePart], loop: float | None
) -> PosesAt:
    if who.motion == "walk":
        return walk(who, loop).poses
    found = read_blend(who.motion, folder)
    layers = [_layer(name, weight, who, folder, loop) for name, weight in found.parts]
    blend = _mean if found.is_mean else _layered
    grounded = max(layers, key=lambda layer: layer.weight).grounded

    @lru_cache(maxsize=64)
    def poses(time: float) -> Poses:
        pose, share = blend(layers, time), _eased(time)
        if share < 1:
            pose = KeyPose().mixed(pose, share)
        return bone_poses(pose, parts, grounded)

    return poses


def _layer(
    name: str, weight: float, who: GarmentWearer, folder: Path, loop: float | None
) -> MotionLayer:
    if name == "walk":
        gait = walk(who, loop)
        limbs = frozenset({"right_leg", "left_leg", "right_arm", "left_arm"})
        return MotionLayer(lambda time: _walk_pose(gait, time), limbs, True, weight)
    motion = find_motion(name, folder)
    motion = motion.model_copy(update={"period": whole_period(motion.period, loop)})
    return MotionLayer(motion.key_pose, _turned(motion), motion.grounded, weight)


def _turned(motion: Motion) -> frozenset[str]:
    return frozenset(
        field for field in KeyPose.model_fields if any(any(getattr(p, field)) for p in motion.poses)
    )


def _walk_pose(gait: Gait, time: float) -> KeyPose:
    leg = gait.turn(time)
    arm = ARM_SHARE * leg
    angles = {"right_leg": leg, "left_leg": -leg, "right_arm": -arm, "left_arm": arm}
    return KeyPose.model_construct(
        **{name: getattr(KeyPose(), name) for name in KeyPose.model_fields}
        | {bone: (angle, 0.0, 0.0) for bone, angle in angles.items()}
    )


def _layered(layers: Sequence[MotionLayer], time: float) -> KeyPose:
    values: dict[str, Any] = {}
    for number, layer in enumerate(layers):
        pose = layer.key_pose(time)
        bones = layer.bones if number else KeyPose.model_fields
        values |= {name: getattr(pose, name) for name in bones}
    return KeyPose.model_construct(**values)


def _mean(layers: Sequence[MotionLayer], time: float) -> KeyPose:
    total, whole = 0.0, KeyPose()
    for layer in layers:
        total += layer.weight
        if layer.weight:
            whole = whole.mixed(layer.key_pose(time), layer.weight / total)
    return whole


def _by_angles(
    look: Sequence[float], poses: Poses, parts: Mapping[str, FigurePart], share: float
) -> Placed:
    """The head turned to its left and downwards [degrees] beside its own motion."""
    yaw, pitch = (angle * share for angle in look)
    turn = np.einsum("ij,jk->ik", rotation_about((0, 1, 0), yaw), rotation_about((1, 0, 0), pitch))
    return _head(poses, parts, np.einsum("ij,jk->ik", poses["head"][1], turn))


def _at_point(
    look: Sequence[float], poses: Poses, parts: Mapping[str, FigurePart], share: float
) -> Placed:
    """The head towards a point [m], at most a right angle aside of the body."""
    body = poses["body"][1]
    place, rotation = poses["head"]
    joint = (rotation * to_metres(np.array(parts["head"].joint))).sum(axis=1) + place
    away = np.array(look) - joint - (body * EYES).sum(axis=1)
    x, y, z = (body.T * away).sum(axis=1)
    flat = float(np.sqrt(x * x + z * z))
    x, z = (x / flat, z / flat) if flat > 1e-9 else (0.0, 1.0)
    if z < 0:
        x, z = (1.0 if x > 0 else -1.0), 0.0
    ahead = _unit(np.array([x * flat, y, z * flat]) if flat > 1e-9 else np.array([0.0, y, 1e-9]))
    ahead = _unit(share * ahead + (1 - share) * np.array([0.0, 0.0, 1.0]))
    right = _unit(np.array([ahead[2], 0.0, -ahead[0]]))  # up x ahead
    turn = np.stack([right, np.cross(ahead, right), ahead], axis=-1)
    return _head(poses, parts, np.einsum("ij,jk->ik", body, turn))


def _head(poses: Poses, parts: Mapping[str, FigurePart], rotation: Array) -> Placed:
    """The head in another rotation; its joint stays where it is."""
    joint = to_metres(np.array(parts["head"].joint))
    place, old = poses["head"]
    return place + (old * joint).sum(axis=1) - (rotation * joint).sum(axis=1), rotation


def _unit(vector: Array) -> Array:
    unit: Array = vector / np.sqrt((vector * vector).sum())
    return unit
