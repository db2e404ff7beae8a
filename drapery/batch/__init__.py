"""Batches of pictures: draws the jobs of a manifest on one machine or many, and reports all errors.

`run_batch` runs a whole batch; the command `drapery batch` uses it.
"""

from typing import TYPE_CHECKING

from drapery.lazy import lazy_names

if TYPE_CHECKING:
    from drapery.batch.batch_run import BatchResult, run_batch
    from drapery.batch.cluster import LostError
    from drapery.batch.manifest import (
        ManifestError,
        PictureRequest,
        read_manifest,
    )
    from drapery.batch.results import OutputRecord
    from drapery.batch.rows import ManifestFault
    from drapery.batch.run import Progress

__all__ = [
    "BatchResult",
    "LostError",
    "ManifestError",
    "ManifestFault",
    "OutputRecord",
    "PictureRequest",
    "Progress",
    "read_manifest",
    "run_batch",
]

__getattr__, __dir__ = lazy_names(
    __name__,
    {
        "batch.batch_run": ("BatchResult", "run_batch"),
        "batch.cluster": ("LostError",),
        "batch.manifest": ("ManifestError", "PictureRequest", "read_manifest"),
        "batch.results": ("OutputRecord",),
        "batch.rows": ("ManifestFault",),
        "batch.run": ("Progress",),
    },
)
