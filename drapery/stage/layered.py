"""Garments of one wearer that meet each other.

Each cloth is moved by a solver of its own, with its own fabric and the bones that stop it. After
each step all of them are one system of contact, as the parts of one cloth are, so none passes
through another.
"""

from collections.abc import Callable, Sequence
from dataclasses import replace

import numpy as np

from drapery.cloth import Cloth, Collider, Collisions, State, sew
from drapery.cloth.bending import NO_BENDING
from drapery.cloth.colliders import TablePath
from drapery.cloth.collisions import contact_stage
from drapery.cloth.strain import MOST_STRETCH, strain_limit, worse, worst_now
from drapery.garments import SewnCloth
from drapery.mesh import Array


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


def joint_contact(
    sewn: Sequence[SewnCloth], colliders: Sequence[Collider], body: TablePath
) -> Callable[[Sequence[State], Sequence[State]], list[State]]:
    """The contact of cloths after each step, from their states before and after it; see `Meeting`.

    colliders: boxes and planes that stop all of them.
    body: the path of the wearer's body. Raises OptionError.
    """
    thick = sorted(each.thickness for each in sewn)
    apart = (thick[-2] + thick[-1]) / 2
    met = Collisions(colliders, min(each.distance for each in sewn), apart=apart)
    cloth = sew([_passive(each.cloth) for each in sewn])
    contact = contact_stage(cloth, met, strain_limit(cloth, MOST_STRETCH))
    assert contact is not None, "colliders are boxes and planes"
    limits = [strain_limit(each.cloth, MOST_STRETCH) for each in sewn]
    ends = np.cumsum([len(each.start) for each in sewn])[:-1]

    def stage(before: Sequence[State], after: Sequence[State]) -> list[State]:
        start, end = _joined(before), _joined(after)
        found = contact.resolve(start, end, _moved(*body.at(np.array([start.time, end.time]))))
        parts = [np.split(part, ends, axis=1) for part in (found.positions, found.velocities)]
        now = [worst_now(x, limit, end.time) for x, limit in zip(parts[0], limits, strict=True)]
        worst = [worse(old.worst, each) for old, each in zip(before, now, strict=True)]
        return [State(x, v, end.time, each) for x, v, each in zip(*parts, worst, strict=True)]

    return stage


def _moved(before: Array, after: Array) -> tuple[Array, Array]:
    """The rotation and the shift [m] that bring a bone from one pose [12] to another."""
    old, new = before[3:].reshape(3, 3), after[3:].reshape(3, 3)
    # einsum adds in a fixed order; BLAS may not.
    rotation = np.einsum("ij,kj->ik", new, old)
    return rotation, after[:3] - np.einsum("ij,j->i", rotation, before[:3])


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
