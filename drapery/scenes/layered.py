"""Garments of one wearer that meet each other.

Each cloth is moved by a solver of its own, with its own fabric and the bones that stop it. After
each step all of them are one system of contact, as the parts of one cloth are, so none passes
through another.
"""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np

from drapery.cloth import Cloth, Collider, Collisions, Force, MovingCloth, PinPath, State, sew
from drapery.cloth.bending import NO_BENDING
from drapery.cloth.collisions import contact_stage
from drapery.garments.assembly import BonePose, SewnCloth
from drapery.mesh import Array


@dataclass(frozen=True, eq=False)
class WornCloth:
    """A cloth that moves. moving: at the present moment. forces: on it. pins: their path."""

    moving: MovingCloth
    forces: tuple[Force, ...]
    pins: PinPath

    def advanced(self) -> MovingCloth:
        """The cloth one time step later, without contact with others."""
        return self.moving.advance(self.forces, 1, self.pins)


def meet_each_other(cloths: Sequence[SewnCloth]) -> list[int]:
    """The numbers of the cloths that meet those of other garments.

    The body must stop them.
    """
    met = [number for number, each in enumerate(cloths) if each.is_on_body]
    return met if len({cloths[number].order for number in met}) > 1 else []


def common_bones(cloths: Sequence[SewnCloth], bones: Sequence[str]) -> tuple[str, ...]:
    """The bones that stop all of the cloths. bones: of their wearer."""
    named = [set(bones if each.solid is None else each.solid) for each in cloths]
    return tuple(bone for bone in bones if all(bone in each for each in named))


def layered_motion(
    sewn: Sequence[SewnCloth],
    worn: Sequence[WornCloth],
    colliders: Sequence[Collider],
    body: Callable[[float], BonePose],
    every: int,
) -> Iterator[list[Array]]:
    """The positions of all cloths [m], each [N, 3], at the start and after every `every` steps.

    colliders: boxes and planes that stop all of them. body: the pose of the wearer's body at a time
    [s]. Raises OptionError.
    """
    resolve = joint_contact(sewn, colliders, body)
    while True:
        yield [each.moving.state.positions[0] for each in worn]
        for _ in range(every):
            after = [each.advanced() for each in worn]
            states = resolve([each.moving.state for each in worn], [each.state for each in after])
            worn = [
                replace(each, moving=replace(moved, state=state))
                for each, moved, state in zip(worn, after, states, strict=True)
            ]


def joint_contact(
    sewn: Sequence[SewnCloth], colliders: Sequence[Collider], body: Callable[[float], BonePose]
) -> Callable[[Sequence[State], Sequence[State]], list[State]]:
    """The stage of contact between cloths after each step: from their states before and after it
    to those without contact. Parameters as in `layered_motion`. Raises OptionError."""
    thick = sorted(each.thickness for each in sewn)
    apart = (thick[-2] + thick[-1]) / 2
    met = Collisions(colliders, min(each.distance for each in sewn), apart=apart)
    contact = contact_stage(sew([_passive(each.cloth) for each in sewn]), met)
    assert contact is not None, "colliders are boxes and planes"
    ends = np.cumsum([len(each.start) for each in sewn])[:-1]

    def stage(before: Sequence[State], after: Sequence[State]) -> list[State]:
        start, end = _joined(before), _joined(after)
        found = contact.resolve(start, end, _moved(body(start.time), body(end.time)))
        parts = [np.split(part, ends, axis=1) for part in (found.positions, found.velocities)]
        return [
            replace(state, positions=places, velocities=velocities)
            for state, places, velocities in zip(after, *parts, strict=True)
        ]

    return stage


def _moved(before: BonePose, after: BonePose) -> BonePose:
    """The rotation and the shift [m] that bring a bone from one pose to another."""
    # einsum adds in a fixed order; BLAS may not.
    rotation = np.einsum("ij,kj->ik", after[1], before[1])
    return rotation, after[0] - np.einsum("ij,j->i", rotation, before[0])


def _passive(cloth: Cloth) -> Cloth:
    """A cloth as contact needs it: without its drag and bending, which cloths may not share."""
    return replace(cloth, drag=0.0, bending=NO_BENDING)


def _joined(states: Sequence[State]) -> State:
    """The states of several cloths as one."""
    positions, velocities = (
        np.concatenate([getattr(state, name) for state in states], axis=1)
        for name in ("positions", "velocities")
    )
    return State(positions, velocities, states[0].time)
