"""The options of collisions, which are resolved after every step of every solver."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from drapery.cloth.attachments import stretch_limits
from drapery.cloth.box_contact import BoxContact, boxes_of
from drapery.cloth.checks import check_count
from drapery.cloth.cloth import Cloth
from drapery.cloth.colliders.collider import Collider
from drapery.cloth.colliders.collision_world import THINNEST, CollisionWorld
from drapery.cloth.colliders.pose import still
from drapery.cloth.colliders.sampling import sample_points
from drapery.cloth.colliders.shapes import Box, Plane
from drapery.cloth.contact import self_contact
from drapery.cloth.solvers.driver import check_limit
from drapery.errors import OptionError


@dataclass(frozen=True, eq=False)
class Collisions:
    """What a cloth collides with.

    colliders: applied one after another; where two overlap, the last one decides.
    thickness: of the cloth [m]; particles stay half of it away from every collider.
    order: how finely faces are tested, 1 to 16, see `sample_points`.
    apart: least distance between particles of the cloth itself [m]; None lets it pass through
        itself. Use about the distance between neighbours.
    limit: longest length of a structural spring over its rest length. Springs that colliders
        stretched more are shortened, and colliders are applied again.
    rounds: how often colliders are applied in a step.
    threads: None for as many as there are processors.

    Raises OptionError for numbers out of range.
    """

    colliders: Sequence[Collider] = ()
    thickness: float = 0.02
    order: int = 2
    apart: float | None = None
    limit: float = 1.1
    rounds: int = 4
    threads: int | None = None

    def __post_init__(self) -> None:
        if not 0 < self.thickness < np.inf:
            raise OptionError(
                f"thickness {self.thickness!r} is out of range; use a length above 0 [m]"
            )
        check_limit(self.limit)
        check_count("rounds", self.rounds, 1, 100)


def collision_world(cloth: Cloth, collisions: Collisions) -> CollisionWorld:
    """The collision world of one cloth; any number of steps and threads may use it.

    Raises OptionError.
    """
    apart = collisions.apart
    return CollisionWorld(
        np.array(cloth.inv_mass, float),
        tuple(collisions.colliders),
        sample_points(cloth, collisions.order),
        collisions.thickness / 2,
        None if apart is None else self_contact(cloth, apart),
        stretch_limits(cloth, collisions.limit, 1),
        collisions.rounds,
        collisions.threads,
    )


def boxes_met(cloth: Cloth, collisions: Collisions) -> BoxContact | None:
    """The colliders of a cloth as boxes, which solvers meet inside their steps; None where one is
    neither a Box nor a Plane, moves or bounces, or where the cloth meets itself."""
    colliders = collisions.colliders
    simple = all(
        isinstance(c.shape, Box | Plane) and c.path is still and not c.restitution
        for c in colliders
    )
    if not colliders or not simple or collisions.apart is not None:
        return None
    radius = max(collisions.thickness / 2, THINNEST)
    return boxes_of(cloth.inv_mass, cloth.triangles, cloth.rest_positions, colliders, radius)
