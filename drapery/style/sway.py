"""How the game itself moves banners and capes: as stiff boards that sway and lag behind."""

import numpy as np

from drapery.elementary import sin
from drapery.mesh import Mesh
from drapery.style.board import moved, stiff_board, tilted
from drapery.style.figure import CAPE_SIZE, SKIN_SHEET, TEXEL, cape_mapping

TICKS_PER_SECOND = 20
SWAY_TICKS = 100

LEAN, MAX_LEAN = 6.0, 81.0
"""Lean of a cape while its player stands, and at the highest speed [degrees]."""
LAG_TICKS = 3.0
"""A cape moves 1/4 of its distance to the player in each tick: 1/4 (d + v) = v, so d = 3 v."""
LEAN_PER_LAG = 50.0
"""Lean of a cape for its distance behind the player [degrees/m]."""
BOB, BOB_PER_METRE = 3.2, 3.6
"""Amplitude of a cape's shaking in a walk [degrees], and its phase [radians/m walked]."""


def sway_phase(block: tuple[int, int, int], time: float) -> float:
    """Phase 0..1 of a banner's sway. block: its place [blocks]. time: of the game [s]."""
    x, y, z = block
    ticks = time * TICKS_PER_SECOND
    whole = int(np.floor(ticks + 1e-9))
    return ((7 * x + 9 * y + 13 * z + whole) % SWAY_TICKS + ticks - whole) / SWAY_TICKS


def cape_lean(speed: float, time: float) -> float:
    """Lean of a cape [degrees]. speed: of a steady walk [m/s]. time: [s]."""
    lag = LAG_TICKS * speed / TICKS_PER_SECOND
    bob = BOB * min(1.0, speed / 2.0) * sin(BOB_PER_METRE * speed * time)
    return float(min(LEAN + LEAN_PER_LAG * lag, MAX_LEAN) + bob)


def stiff_cape(lean: float) -> Mesh:
    """The game's cape on the back of the figure. lean: how far it is lifted [degrees]."""
    board = tilted(stiff_board(CAPE_SIZE, TEXEL, cape_mapping(SKIN_SHEET)), -np.radians(lean))
    about = np.array([-1.0, 1.0, -1.0])
    turned = Mesh(board.positions * about, board.normals * about, board.triangles, board.uvs)
    return moved(turned, np.array([0.0, 24 * TEXEL, -2.5 * TEXEL]))
