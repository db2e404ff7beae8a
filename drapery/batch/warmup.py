"""Kernels are compiled once, before workers start that all need them."""


def warm_up(*, stills: bool = True, loops: bool = True) -> None:
    """Fill numba's cache: draw tiny pictures of the sorts that will be drawn."""
    from drapery import Banner, animate, draw

    if stills:
        draw(Banner(), size=(8, 8), time=0.05)
    if loops:
        animate(Banner(), size=(8, 8), seconds=0.1, fps=10)
