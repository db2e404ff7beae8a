"""`check_style` accepts every preset, and names the fault of a bad style."""

from dataclasses import replace
from itertools import count

import numpy as np
import pytest

from drapery.errors import OptionError
from drapery.mesh import Array, Mesh
from drapery.styles import Canvas, Piece, Style, StyleStep, find_style
from drapery.styles.catalogue import PRESETS
from drapery.styles.step import StepFunction, StepKind
from drapery.testing import check_style

calls = count(1)


def flicker(canvas: Canvas) -> Canvas:
    """Another colour at each call."""
    return canvas.painted(np.full_like(canvas.pixels, next(calls) * 7 % 256))


def crop(canvas: Canvas) -> Canvas:
    """A row too few."""
    return replace(canvas, pixels=canvas.pixels[1:])


def drift(piece: Piece, positions: Array) -> Array:
    """The cloth wanders aside during the loop."""
    away = 0.06 * np.arange(len(positions))[:, None, None]
    return positions + away * [1.0, 0, 0]


def bare(piece: Piece, positions: Array) -> Mesh:
    """A piece without its back."""
    mesh, part = piece.mesh(positions), len(piece.shell.sheet)
    return replace(mesh, triangles=mesh.triangles[:part])


@pytest.mark.parametrize("name", PRESETS)
def test_every_preset_passes(name: str) -> None:
    check_style(find_style(name))


@pytest.mark.parametrize(
    ("kind", "function", "fault"),
    [
        ("picture", flicker, "two drawings differ"),
        ("picture", crop, "became one of 48x63"),
        ("motion", drift, "a loop jumps at its end"),
        ("shape", bare, "its mesh has a hole"),
    ],
)
def test_a_fault_is_named(kind: StepKind, function: StepFunction, fault: str) -> None:
    with pytest.raises(OptionError, match=fault):
        check_style(Style("bad", (StyleStep(kind, function),)))
