"""A pattern from an array, in a resource pack that lies in memory."""

import numpy as np

from drapery import Banner, Layer, draw
from drapery.packs import MemoryPack, open_packs

down, across = np.mgrid[0:256, 0:256] / 4.0  # the flag fills 20 x 40 of a sheet's 64 x 64 texels
x, y = (across - 11) / 7, (20 - down) / 7
heart = (x**2 + y**2 - 1) ** 3 < x**2 * y**3
packs = open_packs(MemoryPack(patterns={"mymod:heart": heart}))
banner = Banner("white", (Layer("mymod:heart", "red"), Layer("border", "red")))
draw(banner, packs=packs, view="hero", size=(256, 320)).save("heart.png")
