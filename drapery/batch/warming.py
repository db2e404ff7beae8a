"""Kernels compiled once, before the workers that share them are there."""

from collections.abc import Sequence

from drapery.batch.jobs import Job


def warm(jobs: Sequence[Job]) -> None:
    """Draw a tiny picture of each sort that the jobs are of, so that numba's cache is filled."""
    from drapery.banner.design import Banner
    from drapery.pictures import animate, draw

    if any(job.seconds is None for job in jobs):
        draw(Banner(), size=(8, 8), time=0.05)
    if any(job.seconds is not None for job in jobs):
        animate(Banner(), size=(8, 8), seconds=0.1, fps=10)
