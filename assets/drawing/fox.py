"""A fox of small cubes, an angular body for cloth to fall on."""

from itertools import product

from drapery.style.block_world import Cell

CUBE = 0.17
"""Edge of a cube [m]."""


def fox() -> dict[Cell, str]:
    """Cells and their dyes. The fox stands on y = 0 over the origin and looks along +z."""
    cells: dict[Cell, str] = {}
    for x, y, z in product((-1, 0, 1), (2, 3, 4), range(-4, 2)):
        cells[x, y, z] = "white" if y == 2 else "orange"
    for x, y, z in product((-1, 1), (0, 1), (-4, 1)):
        cells[x, y, z] = "black" if y == 0 else "brown"
    for x, y, z in product((-1, 0, 1), (4, 5, 6), (2, 3, 4)):
        cells[x, y, z] = "white" if y == 4 and z == 4 else "orange"
    cells.update({(-1, 5, 4): "black", (1, 5, 4): "black"})
    cells.update({(0, 4, 5): "white", (0, 4, 6): "black"})
    cells.update({(-1, 7, 3): "orange", (1, 7, 3): "orange"})
    cells.update({(0, 4, -5): "orange", (0, 5, -5): "orange", (0, 5, -6): "orange"})
    cells.update({(0, 6, -6): "white", (0, 6, -7): "white"})
    return cells
