"""What happens after a solver's step: cloth leaves what it entered, and itself.

Any solver's step moves the cloth as if nothing stood in its way. Then the collision stage brings it
back, places and velocities, and the next step goes on from there. So every solver collides alike.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from drapery.cloth.attachments import limited_links
from drapery.cloth.checks import check_count
from drapery.cloth.cloth import Cloth
from drapery.cloth.colliders import Collider, collide, probes
from drapery.cloth.contact import contacts, separate
from drapery.cloth.solvers.driver import check_limit
from drapery.cloth.state import State
from drapery.errors import OptionError

Stage = Callable[[State, State], State]
"""From the states before and after a solver's step to the state after collisions."""


@dataclass(frozen=True, eq=False)
class Collisions:
    """What a cloth collides with.

    colliders: one after another; where they touch each other the last has the last word.
    thickness: of the cloth [m]; its middle keeps half of it from every collider.
    order: how finely faces are tested, see `probes`.
    apart: least distance between particles of the cloth itself [m]; None lets it pass through
        itself. About the distance between neighbours, see `contact`.
    limit: longest length of a structural spring over its rest length; springs that colliders
        stretched further are shortened, and colliders come again, `rounds` times in all.
    threads: None for as many as there are processors.
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
            raise OptionError(f"thickness {self.thickness!r}: give a length above 0 [m]")
        check_limit(self.limit)
        check_count("rounds", self.rounds, 1, 100)


def collision_stage(cloth: Cloth, collisions: Collisions) -> Stage:
    """The stage for one cloth. Raises OptionError."""
    points = probes(cloth, collisions.order)
    contact = None if collisions.apart is None else contacts(cloth, collisions.apart)

    links = limited_links(cloth, collisions.limit, 1)

    def stage(before: State, after: State) -> State:
        if contact is not None:
            after = separate(contact, after, threads=collisions.threads)
        return collide(
            cloth,
            before,
            after,
            collisions.colliders,
            points,
            radius=collisions.thickness / 2,
            links=links,
            rounds=collisions.rounds,
            threads=collisions.threads,
        )

    return stage
