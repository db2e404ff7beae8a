"""Rectangles of cloth: equal specs are one cloth, and the settings say what it meets."""

from dataclasses import replace

import numpy as np
import pytest

from drapery import Banner, Settings
from drapery.cloth import Gravity, SolverXPBD
from drapery.packs import open_packs
from drapery.style import ClothSpec, body_of, cloth_at_rest

STEP = 1 / 60
SPEC = ClothSpec((5, 9), (0.8, 1.6), "top", "xpbd")


def flag(**options: object) -> ClothSpec:
    settings = Settings(**options)  # type: ignore[arg-type]
    (panel,) = body_of(Banner("white"), open_packs(()), settings).panels
    return panel.cloth


def test_equal_specs_are_one_cloth_which_no_motion_changes() -> None:
    hung = cloth_at_rest(SPEC, STEP)
    before = hung.state.positions.copy()
    moved = hung.advance([Gravity((3.0, -9.81, 0.0))], 5)
    assert not np.array_equal(moved.state.positions, before)
    again = cloth_at_rest(replace(SPEC), STEP)
    assert again is hung
    assert np.array_equal(again.state.positions, before)
    assert cloth_at_rest(SPEC, STEP / 2) is not hung


def test_a_solver_that_is_an_object_is_asked_for_each_cloth() -> None:
    spec = replace(SPEC, solver=SolverXPBD())
    assert cloth_at_rest(spec, STEP) is not cloth_at_rest(spec, STEP)


def test_pictures_of_other_designs_winds_and_sizes_have_one_cloth() -> None:
    assert flag() == flag(wind=9.0, seed=4, size=(64, 64), view="hero")
    for name, value in {"grid": (5, 9), "fabric": "silk", "solver": "pbd", "pins": "none"}.items():
        assert flag() != flag(**{name: value})


@pytest.mark.parametrize(
    "contact, solids, itself", [("none", 0, 0), ("world", 3, 0), ("all", 3, 1)]
)
def test_contact_says_what_the_cloth_meets(contact: str, solids: int, itself: int) -> None:
    made = flag(contact=contact)
    assert (len(made.solids), made.itself) == (solids, bool(itself))


def test_solids_are_in_the_frame_of_the_cloth() -> None:
    (panel,) = body_of(Banner("white"), open_packs(()), Settings()).panels
    ground = panel.cloth.solids[-1].high[1]
    assert ground == pytest.approx(-panel.origin[1])
