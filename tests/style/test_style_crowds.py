"""Many cloths thickened at once are the same as one by one."""

from typing import Any

import numpy as np
import pytest

from drapery.mesh import vertex_normals
from drapery.style.block import FLAG_MAPPING
from drapery.style.crowds import cover_crowd
from drapery.style.extrusion import make_shell


@pytest.mark.parametrize("real", [np.float32, np.float64])
@pytest.mark.parametrize("thickness", [0.04, 0.0])
@pytest.mark.parametrize("count", [70, 1, 0])
def test_a_crowd_is_covered_as_each_sheet_alone(
    real: type[np.floating[Any]], thickness: float, count: int
) -> None:
    columns, rows = 5, 9
    u, v = np.meshgrid(np.linspace(0, 1, columns), np.linspace(0, 1, rows))
    uvs = np.stack([u, v], axis=-1).reshape(-1, 2)
    a = (np.arange(rows - 1)[:, None] * columns + np.arange(columns - 1)).ravel()
    halves = [
        np.stack([a, a + columns, a + 1], 1),
        np.stack([a + 1, a + columns, a + columns + 1], 1),
    ]
    triangles = np.concatenate(halves).astype(np.int32)
    random = np.random.default_rng(0)
    sheets = np.concatenate([uvs, uvs[:, :1]], axis=1) + random.normal(0, 0.05, (70, 45, 3))
    sheets[-3] = 0  # without area: the normal is (0, 0, 1), not NaN
    sheets = sheets[70 - count :].astype(real)
    shell = make_shell(triangles, uvs, FLAG_MAPPING)
    expected = shell.cover(sheets, vertex_normals(sheets, triangles), thickness)
    crowd = cover_crowd(shell, sheets, thickness)
    assert crowd.positions.dtype == real and crowd.positions.shape == expected.positions.shape
    assert (crowd.positions == expected.positions).all()
    assert (crowd.normals == expected.normals).all()
    assert (crowd.triangles == expected.triangles).all() and (crowd.uvs == expected.uvs).all()
