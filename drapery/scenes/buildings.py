"""What scenes build of blocks: a hall, a tower on a hill, and a raft.

Each function returns the blocks by cell, for `drapery.style.block_world.blocks`.
"""

from itertools import product

import numpy as np

from drapery.style.block_world import Cell


def hall(width: int, height: int, bays: int, bay: int) -> dict[Cell, str]:
    """A hall along -z without a roof: its floor, walls with pillars, and beams.

    width, height: [blocks].
    bays: their number.
    bay: the length of each [blocks], one of them its pillar.
    """
    half, length = width // 2, bay * bays + 1
    cells: dict[Cell, str] = {}
    for z in range(-length, 1):
        for x in range(-half, half):
            carpet = x in (-1, 0)
            cells[x, -1, z] = "spruce_planks" if carpet else "stone"
        for y in range(height):
            wall = "stone_bricks" if z % bay else "oak_log"
            cells[-half - 1, y, z] = cells[half, y, z] = wall if y else "cobblestone"
        if z % bay == 0:
            for x in range(-half, half):
                cells[x, height, z] = "oak_planks"
    return cells


def tower_on_hill(height: int) -> dict[Cell, str]:
    """A hill of grass with a tower at the origin. height: of the tower [blocks]."""
    cells: dict[Cell, str] = {}
    for x, z in product(range(-9, 9), repeat=2):
        radius = max(2.0, np.hypot(x + 0.5, z + 0.5) + 0.7 * ((x * 7 + z * 5) % 3 - 1))
        top = min(0, 1 - int(radius // 3.4))
        for y in range(-3, top - 1):
            cells[x, y, z] = "dirt"
        if top > -3:
            cells[x, top - 1, z] = "grass"
    return cells | tower(height)


def tower(height: int) -> dict[Cell, str]:
    """A tower with battlements, some of its blocks of older stone. height: [blocks]."""
    cells: dict[Cell, str] = {}
    for x, z, y in product(range(-2, 2), range(-2, 2), range(height + 1)):
        old = (5 * x + 3 * y + 7 * z) % 4 == 0
        cells[x, y, z] = "cobblestone" if old else "stone_bricks"
    for x, z in product(range(-3, 3), repeat=2):
        if x in (-3, 2) or z in (-3, 2):
            cells[x, height, z] = "stone_bricks"
            if (x + z) % 2 == 0:
                cells[x, height + 1, z] = "stone_bricks"
    return cells


def raft() -> dict[Cell, str]:
    """A raft of planks with logs at its corners, its top at y = 0."""
    cells = {(x, -1, z): "oak_planks" for x in range(-2, 2) for z in range(-3, 3)}
    cells.update({(x, -1, z): "oak_log" for x in (-2, 1) for z in (-3, 2)})
    return cells
