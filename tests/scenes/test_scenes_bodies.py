"""Cloth of bodies: names and objects give the same cloth; objects are never taken from a cache."""

from dataclasses import dataclass, replace
from typing import Any

import numpy as np
import pytest
from scene_helpers import flag_of

import drapery.style
from drapery import Banner
from drapery.banner.packs import open_packs
from drapery.cloth import FABRICS, Cloth, Fabric, SolverXPBD, State, Wind, grid
from drapery.mesh import Array
from drapery.scenes import STEP, StagedBody, loop, still, wind_of
from drapery.settings import FabricName, Settings
from drapery.style.kinds import body_of

NAMED = Settings(time=0.5, grid=(5, 9), solver="xpbd", wind=6.0, direction=40.0, seed=3)


def flag(**options: Any) -> Array:
    return still(Banner(), open_packs(()), replace(NAMED, **options)).models[-1].mesh.positions


def test_objects_equal_the_names_they_stand_for() -> None:
    named = flag()
    assert np.array_equal(flag(solver=SolverXPBD()), named)
    assert np.array_equal(flag(wind=wind_of(NAMED)), named)
    assert np.array_equal(flag(fabric=FABRICS["wool"]), named)


def test_the_cloth_of_a_body_advances_to_the_still() -> None:
    staged = StagedBody(body_of(Banner(), open_packs(()), NAMED), NAMED)
    (drape,) = staged.drapes
    moving, forces = drape.begin(STEP), drape.forces(None)
    for _ in range(30):
        moving = moving.advance(forces, 1)
    assert np.allclose(staged.soft(moving.state.positions)[-1].positions, flag(), atol=1e-6)


@dataclass
class Push:
    """A force that a program changes between two pictures."""

    strength: float

    def acceleration(self, cloth: Cloth, state: State) -> Array:
        return np.full_like(state.positions, self.strength)


def test_objects_are_not_taken_from_the_cache() -> None:
    named, push = flag(), Push(0.0)
    assert np.allclose(flag(forces=(push,)), named, atol=1e-5)
    push.strength = 5.0
    assert not np.allclose(flag(forces=(push,)), named, atol=1e-2)
    assert not np.array_equal(flag(solver=SolverXPBD(substeps=8)), named)
    assert not np.array_equal(flag(fabric=Fabric(density=0.9)), named)
    assert not np.array_equal(flag(wind=Wind((0.0, 0.0, 9.0))), named)


def creases(fabric: FabricName) -> float:
    """The share of neighbouring cells that meet at over 60 degrees in 8 m/s."""
    settings = Settings(fabric=fabric, wind=8.0)
    (moving, forces), (columns, rows) = flag_of(settings), settings.grid
    found = []
    for _ in range(16):
        moving = moving.advance(forces, 24)
        places = moving.state.positions[0].reshape(rows, columns, 3)
        normals = np.cross(places[1:, :-1] - places[:-1, 1:], places[1:, 1:] - places[:-1, :-1])
        normals /= np.linalg.norm(normals, axis=-1, keepdims=True)
        across = (normals[:, 1:] * normals[:, :-1]).sum(axis=-1)
        down = (normals[1:] * normals[:-1]).sum(axis=-1)
        found.append([(across < 0.5).mean(), (down < 0.5).mean()])
    return float(np.mean(found))


def test_light_fabrics_do_not_crumple_in_strong_wind() -> None:
    assert max(creases("silk"), creases("cotton")) < 0.03


@pytest.mark.parametrize("fabric", ["wool", "canvas", "leather", "felt"])
@pytest.mark.parametrize("shape", [(5, 9), (16, 31), (33, 65)])
def test_fabrics_of_stiff_folds_bend_as_they_are(
    fabric: FabricName, shape: tuple[int, int]
) -> None:
    settings = Settings(fabric=fabric, grid=shape, wind=8.0)
    cloth = flag_of(settings)[0].cloth
    size = np.ptp(cloth.rest_positions[:, :2], axis=0)
    expected = grid(*shape, *size, fabric=FABRICS[fabric]).bending
    assert np.allclose(cloth.bending.stiffness, expected.stiffness, rtol=1e-6)


def test_only_fabrics_lighter_than_wool_ripple_less() -> None:
    names: tuple[FabricName, ...] = ("wool", "felt", "leather", "canvas", "cotton", "silk")
    found = [wind_of(Settings(fabric=fabric)).ripples / Settings.gusts for fabric in names]
    assert found == pytest.approx([2.5, 2.5, 2.5, 2.34, 1.7, 1.02], rel=0.02)


def test_a_given_wind_loops_without_a_seam() -> None:
    settings = replace(NAMED, wind=Wind((1.0, 0.0, 6.0), period=1.7))
    scenes = loop(Banner(), open_packs(()), settings, 40, 20.0)
    moments = np.stack([scene.models[-1].mesh.positions for scene in scenes])
    steps = np.linalg.norm(np.roll(moments, -1, axis=0) - moments, axis=-1).max(axis=1)
    assert steps[-1] <= 1.1 * steps[:-1].max()


def test_every_public_name_of_style_is_there_and_documented() -> None:
    assert dir(drapery.style) == sorted(drapery.style.__all__)
    for name in drapery.style.__all__:
        assert getattr(drapery.style, name) is not None
    with pytest.raises(AttributeError, match="nothing"):
        drapery.style.nothing  # noqa: B018
