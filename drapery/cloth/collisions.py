"""The options of collisions, which are resolved after every step of every solver."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from drapery.cloth.attachments import stretch_limits
from drapery.cloth.checks import check_count
from drapery.cloth.cloth import STRUCTURAL, Cloth
from drapery.cloth.colliders.collider import Collider
from drapery.cloth.colliders.collision_world import THINNEST, CollisionWorld
from drapery.cloth.colliders.pose import at_rest
from drapery.cloth.colliders.sampling import sample_points
from drapery.cloth.colliders.shapes import Box, Plane, Shape
from drapery.cloth.contact.box_data import NOTHING, BoxColliders, box_colliders
from drapery.cloth.contact.lanes_contact import resolve_block
from drapery.cloth.contact.self_contact_data import SelfContact, make_self_contact
from drapery.cloth.contact.velocities import set_velocities, speeds_of
from drapery.cloth.lanes import run_blocks, thread_count
from drapery.cloth.solvers.driver import check_limit
from drapery.cloth.state import State
from drapery.cloth.strain import NEVER, StrainLimit, worse, worst_now
from drapery.errors import OptionError
from drapery.mesh import Array

BESIDE = 0.5
"""Cloth keeps at most the distance of a particle at rest from a box at rest and this part of the
cell beside the particle. A cell that is pushed farther in a step is torn, or folded over the next
one; one beside a pin would stand off."""


@dataclass(frozen=True, eq=False)
class Collisions:
    """What a cloth collides with.

    colliders: applied one after another; where two overlap, the last one decides.
    thickness: of the cloth [m]; particles stay half of it away from every collider. Cloth that is
        thicker than its cells and begins nearer to a box at rest stays less far from boxes.
    order: how finely faces are tested, 1 to 16, see `sample_points`.
    apart: least distance between parts of the cloth itself [m], such as its thickness; None lets it
        pass through itself. Cloths that `sew` joins without seams meet each other.
    limit: longest length of a structural spring over its rest length. Springs that colliders
        stretched more are shortened, and colliders are applied again. Boxes and planes are met
        without it, see docs/explanation/contact.md.
    rounds: how often colliders are applied in a step.
    threads: 1 or more; None uses every processor.

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


def collision_world(
    cloth: Cloth, collisions: Collisions, limit: StrainLimit = NEVER
) -> CollisionWorld:
    """The collision world of one cloth; any number of steps and threads may use it.

    limit: of its strain. Raises OptionError.
    """
    apart = collisions.apart
    return CollisionWorld(
        np.array(cloth.inv_mass, float),
        tuple(collisions.colliders),
        sample_points(cloth, collisions.order),
        collisions.thickness / 2,
        None if apart is None else make_self_contact(cloth, apart),
        stretch_limits(cloth, collisions.limit, 1),
        collisions.rounds,
        collisions.threads,
        limit,
    )


def boxes_met(cloth: Cloth, collisions: Collisions) -> BoxColliders | None:
    """The colliders of a cloth as boxes; None where one is of another shape or bounces."""
    colliders = collisions.colliders
    if not all(isinstance(c.shape, Box | Plane) and not c.restitution for c in colliders):
        return None
    radius = max(_radius_at_start(cloth, collisions), THINNEST)
    surface = cloth.inv_mass, cloth.triangles, cloth.rest_positions
    return box_colliders(*surface, colliders, radius) if colliders else NOTHING


def _radius_at_start(cloth: Cloth, collisions: Collisions) -> float:
    """The distance [m] that a cloth keeps from boxes: half its thickness, see also BESIDE."""
    structural = cloth.spring_kind == STRUCTURAL
    cells = np.full(len(cloth.rest_positions), np.inf)
    for ends in cloth.spring_pairs[structural].T:
        np.minimum.at(cells, ends, cloth.spring_length[structural])
    radius = collisions.thickness / 2
    for collider in collisions.colliders:
        if collider.path is at_rest:
            gaps = _gaps(cloth.rest_positions, collider.shape)
            kept = (gaps + BESIDE * cells)[gaps >= 0]
            radius = min(radius, float(kept.min(initial=np.inf)))
    return radius


def _gaps(places: Array, shape: Shape) -> Array:
    """Distances of places [N, 3] from a box or a plane [m], [N]; below 0 inside."""
    if isinstance(shape, Plane):
        normal = np.asarray(shape.normal, float)
        length = np.sqrt((normal * normal).sum())
        return np.asarray(((places - shape.point) * normal).sum(axis=1) / length)
    assert isinstance(shape, Box)
    local = np.einsum("ji,nj->ni", np.asarray(shape.rotation, float), places - shape.centre)
    away = np.abs(local) - np.asarray(shape.size, float) / 2
    outside = np.maximum(away, 0.0)
    gaps: Array = np.sqrt((outside * outside).sum(axis=1)) + np.minimum(away.max(axis=1), 0.0)
    return gaps


def met_inside(cloth: Cloth, collisions: Collisions) -> BoxColliders | None:
    """What a cloth meets inside the steps of its solver: boxes, and itself; None where it meets
    other shapes. Raises OptionError."""
    boxes = boxes_met(cloth, collisions)
    if boxes is None or collisions.apart is None or not len(cloth.triangles):
        return boxes
    return replace(boxes, itself=make_self_contact(cloth, collisions.apart))


def resolver(
    cloth: Cloth, collisions: Collisions, limit: StrainLimit = NEVER
) -> Callable[[State, State], State]:
    """The collision stage after each step of any solver. limit: of strain. Raises OptionError."""
    stage = contact_stage(cloth, collisions, limit)
    return (collision_world(cloth, collisions, limit) if stage is None else stage).resolve


def contact_stage(
    cloth: Cloth, collisions: Collisions, limit: StrainLimit = NEVER
) -> "ContactStage | None":
    """The stage of a cloth that meets itself and only boxes; None for all else.

    limit: of its strain. Raises OptionError.
    """
    boxes = boxes_met(cloth, collisions)
    if boxes is None or collisions.apart is None:
        return None
    contact = make_self_contact(cloth, collisions.apart)
    return ContactStage(contact, boxes, collisions.threads, limit)


@dataclass(frozen=True, eq=False)
class ContactStage:
    """Contact of cloths with themselves and with boxes, after each step."""

    contact: SelfContact
    boxes: BoxColliders
    threads: int | None
    limit: StrainLimit = NEVER

    def resolve(
        self, before: State, after: State, carrier: tuple[Array, Array] | None = None
    ) -> State:
        """The state after a step, without contacts. before: the state at its start.

        carrier: how a body on which the cloth lies moves in the step: rotation, shape [3, 3], then
        shift [m], shape [3]. What contact stops then moves with that body.
        """
        start, wanted = (np.array(s.positions, float, order="C") for s in (before, after))
        x, carried, long = wanted.copy(), np.zeros(wanted.shape[:2]), []
        boxes, dt = self.boxes.step(before.time, after.time), after.time - before.time
        begun = start
        if carrier is not None:
            rotation, shift = carrier
            # einsum adds in a fixed order; BLAS may not.
            begun = np.einsum("ij,bnj->bni", rotation, start) + shift
            places = np.einsum("ij,kj->ki", rotation, boxes.starts[:, :3]) + shift
            turns = np.einsum("ij,kjl->kil", rotation, boxes.starts[:, 3:].reshape(-1, 3, 3))
            boxes = boxes._replace(starts=np.hstack([places, turns.reshape(-1, 9)]))

        def work(first: int, last: int) -> None:
            block = begun, x, (first, last), boxes, self.contact, self.limit
            carried[first:last], is_long = resolve_block(*block)
            if is_long:
                long.append(first)

        run_blocks(work, len(x), 1, thread_count(self.threads))
        velocities = np.array(after.velocities, float, order="C")
        # All particles of a cloth with contact have the velocity of their motion: what a solver
        # does to the neighbours of stopped ones is not motion.
        changed = (x != wanted).any(axis=(1, 2))
        moved = np.repeat(changed[:, None], x.shape[1], axis=1)
        most = np.maximum(speeds_of(velocities), carried / dt)
        set_velocities(velocities, (x - start) / dt, moved, most)
        dtype = after.positions.dtype
        worst = worse(before.worst, worst_now(x, self.limit, after.time) if long else None)
        return State(x.astype(dtype), velocities.astype(dtype), after.time, worst)
