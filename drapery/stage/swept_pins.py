"""Pins that the motion of a wearer takes into its own limbs.

The pins of a garment follow one bone, and other bones stop its cloth. Where a raised arm turns into
the collar that the body holds, contact moves the particles beside a pin out of the arm and the pin
stays in it, which tears the cloth between them. So such a pin holds nothing, and the limb pushes
its particle as any other. What stays in a limb, as the waist of a skirt on a seated wearer, is
held, as are pins beside which nothing is free to move.
"""

import numpy as np

from drapery.cloth import Box, Cloth, Collider
from drapery.cloth.colliders import TablePath
from drapery.garments.assembly import SewnCloth
from drapery.mesh import Array
from drapery.stage.wearers import Wearer

SECONDS, RATE = 4.0, 30
"""How long the motion is looked at [s], and how often [1/s]: all motions repeat in it."""
BEGUN = 1.0
"""A wearer has come from its rest into the motion after this time [s]."""
DEEP = 0.5
"""How deep a pin must come into a limb, as a part of the distance that its cloth keeps: beside
others, the cloth has room."""


def without_swept_pins(sewn: SewnCloth, wearer: Wearer) -> SewnCloth:
    """A cloth without the pins that its wearer's motion takes into what stops it."""
    pinned = sewn.cloth.inv_mass == 0
    if not pinned.any():
        return sewn
    times = np.arange(round(SECONDS * RATE)) / RATE
    places = sewn.pin_path(wearer.poses).at(times)
    swept = np.zeros(places.shape[1], bool)
    for collider in wearer.colliders(sewn.solid):
        depths = _depths(collider, times, places)[round(BEGUN * RATE) :]
        swept |= (depths.min(axis=0) <= 0) & (depths.max(axis=0) > DEEP * sewn.distance)
    swept &= _is_beside_free(sewn.cloth)[pinned]
    return sewn.without(swept) if swept.any() and not swept.all() else sewn


def _depths(collider: Collider, times: Array, places: Array) -> Array:
    """How deep places [T, P, 3] are in a box of a wearer at T times [s]; below 0 outside [m]."""
    box, path = collider.shape, collider.path
    assert isinstance(box, Box), "a wearer is made of boxes"
    assert isinstance(path, TablePath), "which move as a table says"
    poses = path.at(times)
    turns, offsets = poses[:, 3:].reshape(-1, 3, 3), places - poses[:, None, :3]
    # einsum adds in a fixed order; BLAS may not.
    local = np.einsum("tji,tpj->tpi", turns, offsets) - box.centre
    depths: Array = (np.asarray(box.size) / 2 - np.abs(local)).min(axis=-1)
    return depths


def _is_beside_free(cloth: Cloth) -> Array:
    """Whether a spring joins a particle to one that is free, [N]."""
    beside = np.zeros(len(cloth.inv_mass), bool)
    first, second = cloth.spring_pairs.T
    beside[first] |= cloth.inv_mass[second] > 0
    beside[second] |= cloth.inv_mass[first] > 0
    return beside
