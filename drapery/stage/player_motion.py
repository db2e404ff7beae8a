"""How a player moves: its motion or a blend of several, and where its head looks.

`walk+wave` is a walk whose arm waves: bones that a later motion turns follow it, all others the one
before. `walk:0.7,wave:0.3` is the mean of both, by weight.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path

import numpy as np

from drapery.cloth.colliders import rotation_about
from drapery.garments.blends import read_blend
from drapery.garments.model import GarmentWearer
from drapery.garments.motions import (
    POSE_FIELDS,
    Motion,
    bone_table,
    find_motion,
    mixed,
    player_bones,
    product,
    turned,
)
from drapery.garments.poses import BonePoses
from drapery.mesh import Array
from drapery.stage.gait import ARM_SHARE, Gait
from drapery.style.figure import TEXEL, FigurePart, to_metres

STRIDE = 0.8
"""The period of a stride [s], unless a loop needs a whole number of them."""
RAMP = 0.5
"""A wearer takes its pose in this time, so that its cloth can follow [s]."""
EYES = np.array([0.0, 4 * TEXEL, 0.0])
"""The middle of the head from its joint [m]."""


@dataclass(frozen=True)
class MotionLayer:
    """One motion of a blend.

    turns: its pose at T times [s], see `KeyPose.turns`: from shape [T] to [T, F, 3].
    bones: the fields of `KeyPose` that it changes.
    grounded: whether the lowest leg stays on the ground.
    weight: its share of a mean.
    """

    turns: Callable[[Array], Array]
    bones: frozenset[str]
    grounded: bool
    weight: float


def player_poses(
    who: GarmentWearer, folder: Path, parts: Mapping[str, FigurePart], loop: float | None
) -> BonePoses:
    """The poses of a player.

    folder: of files of poses. parts: its boxes. loop: the length of a loop [s], which a whole
    number of periods of each motion fills; None for none. Raises OptionError.
    """
    moves = _moves(who, folder, parts, loop)
    if not any(who.look):
        return moves
    head = moves.bones.index("head")

    def looking(times: Array) -> Array:
        table = moves.at(times).copy()
        # The flag of a banner on the head needs time to follow.
        shares = np.ones(len(times)) if who.head is None else _eased(times)
        if len(who.look) == 3:
            rotations = _at_point(who.look, table, moves.bones, parts, shares)
        else:
            rotations = _by_angles(who.look, table, moves.bones, shares)
        table[:, head] = _about_joint(table[:, head], parts["head"], rotations)
        return table

    return BonePoses(moves.bones, looking)


def whole_period(period: float, loop: float | None) -> float:
    """The period that fills a loop a whole number of times."""
    return period if loop is None else loop / max(1, round(loop / period))


def walk(who: GarmentWearer, loop: float | None) -> Gait:
    """The walk of a wearer."""
    return Gait(who.speed, whole_period(STRIDE, loop), who.kind)


def _eased(times: Array) -> Array:
    """How far a wearer has taken its pose at T times [s], 0 to 1, shape [T]."""
    share = np.minimum(times / RAMP, 1.0)
    eased: Array = share * share * (3 - 2 * share)
    return eased


def _moves(
    who: GarmentWearer, folder: Path, parts: Mapping[str, FigurePart], loop: float | None
) -> BonePoses:
    if who.motion == "walk":
        return walk(who, loop).poses
    found = read_blend(who.motion, folder)
    layers = [_layer(name, weight, who, folder, loop) for name, weight in found.parts]
    blend = _mean if found.is_mean else _layered
    grounded = max(layers, key=lambda layer: layer.weight).grounded

    def table(times: Array) -> Array:
        turns = blend(layers, times) * _eased(times)[:, None, None]
        return bone_table(turns, parts, grounded)

    return BonePoses(player_bones(parts), table)


def _layer(
    name: str, weight: float, who: GarmentWearer, folder: Path, loop: float | None
) -> MotionLayer:
    if name == "walk":
        limbs = frozenset({"right_leg", "left_leg", "right_arm", "left_arm"})
        return MotionLayer(partial(_walk_turns, walk(who, loop)), limbs, True, weight)
    motion = find_motion(name, folder)
    motion = motion.model_copy(update={"period": whole_period(motion.period, loop)})
    return MotionLayer(motion.turns, _moved_bones(motion), motion.grounded, weight)


def _moved_bones(motion: Motion) -> frozenset[str]:
    return frozenset(
        field for field in POSE_FIELDS if any(any(getattr(p, field)) for p in motion.poses)
    )


def _walk_turns(gait: Gait, times: Array) -> Array:
    leg = gait.turn(times)
    arm = ARM_SHARE * leg
    turns = np.zeros((len(times), len(POSE_FIELDS), 3))
    angles = {"right_leg": leg, "left_leg": -leg, "right_arm": -arm, "left_arm": arm}
    for bone, angle in angles.items():
        turns[:, POSE_FIELDS.index(bone), 0] = angle
    return turns


def _layered(layers: Sequence[MotionLayer], times: Array) -> Array:
    turns = layers[0].turns(times).copy()
    for layer in layers[1:]:
        moved = [POSE_FIELDS.index(bone) for bone in layer.bones]
        turns[:, moved] = layer.turns(times)[:, moved]
    return turns


def _mean(layers: Sequence[MotionLayer], times: Array) -> Array:
    whole: Array = np.zeros((len(times), len(POSE_FIELDS), 3))
    total = 0.0
    for layer in layers:
        total += layer.weight
        if layer.weight:
            whole = mixed(whole, layer.turns(times), layer.weight / total)
    return whole


def _by_angles(look: Sequence[float], table: Array, bones: Sequence[str], shares: Array) -> Array:
    """Rotations of the head, turned to its left and downwards [degrees] beside its own motion."""
    yaw, pitch = (angle * shares for angle in look)
    turn = product(rotation_about((0, 1, 0), yaw), rotation_about((1, 0, 0), pitch))
    return product(_rotations_of(table, bones, "head"), turn)


def _at_point(
    look: Sequence[float],
    table: Array,
    bones: Sequence[str],
    parts: Mapping[str, FigurePart],
    shares: Array,
) -> Array:
    """Rotations of the head towards a point [m], at most a right angle aside of the body."""
    body, head = (_rotations_of(table, bones, name) for name in ("body", "head"))
    joint = turned(head, to_metres(np.array(parts["head"].joint)))
    joint = joint + table[:, bones.index("head"), :3]
    away = np.array(look) - joint - turned(body, EYES)
    x, y, z = turned(np.swapaxes(body, 1, 2), away).T
    flat = np.sqrt(x * x + z * z)
    level = np.where(flat > 1e-9, flat, 1.0)
    across, front = x / level, np.where(flat > 1e-9, z / level, 1.0)
    aside = front < 0
    across = np.where(aside, np.where(across > 0, 1.0, -1.0), across)
    front = np.where(aside, 0.0, front)
    zero = np.zeros_like(y)
    above = np.stack([zero, y, zero + 1e-9], axis=-1)
    ahead = np.stack([across * flat, y, front * flat], axis=-1)
    ahead = _unit(np.where((flat > 1e-9)[:, None], ahead, above))
    share = shares[:, None]
    ahead = _unit(share * ahead + (1 - share) * np.array([0.0, 0.0, 1.0]))
    right = _unit(np.stack([ahead[:, 2], zero, -ahead[:, 0]], axis=-1))  # up x ahead
    return product(body, np.stack([right, np.cross(ahead, right), ahead], axis=-1))


def _rotations_of(table: Array, bones: Sequence[str], bone: str) -> Array:
    return table[:, bones.index(bone), 3:].reshape(-1, 3, 3)


def _about_joint(rows: Array, part: FigurePart, rotations: Array) -> Array:
    """Poses [T, 12] of a bone in other rotations [T, 3, 3]; its joint stays where it is."""
    joint, own = to_metres(np.array(part.joint)), rows[:, 3:].reshape(-1, 3, 3)
    places = rows[:, :3] + turned(own, joint) - turned(rotations, joint)
    return np.concatenate([places, rotations.reshape(-1, 9)], axis=1)


def _unit(vectors: Array) -> Array:
    units: Array = vectors / np.sqrt((vectors * vectors).sum(axis=-1, keepdims=True))
    return units
