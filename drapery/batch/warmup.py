"""Kernels compiled once, before the workers that share them are there."""


def warm_up(*, stills: bool = True, loops: bool = True) -> None:
    """Draw tiny pictures of the sorts that will be drawn, so that numba's cache is filled."""
    from drapery.banner.design import Banner
    from drapery.pictures import animate, draw

    if stills:
        draw(Banner(), size=(8, 8), time=0.05)
    if loops:
        animate(Banner(), size=(8, 8), seconds=0.1, fps=10)
