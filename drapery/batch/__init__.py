"""Batches of pictures: draws the jobs of a manifest on one machine or many, and reports all errors.

`run_batch` runs a whole batch; the command `drapery batch` uses it.
"""

from typing import TYPE_CHECKING, Any

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

_MODULES = {
    "BatchResult": "batch_run",
    "LostError": "cluster",
    "ManifestError": "manifest",
    "ManifestFault": "rows",
    "OutputRecord": "results",
    "PictureRequest": "manifest",
    "Progress": "run",
    "read_manifest": "manifest",
    "run_batch": "batch_run",
}


def __getattr__(name: str) -> Any:
    # A name is imported when it is first used, so that `drapery --help` does not wait for numba.
    if name not in _MODULES:
        raise AttributeError(f"module 'drapery.batch' has no attribute {name!r}")
    from importlib import import_module

    return getattr(import_module(f"drapery.batch.{_MODULES[name]}"), name)


def __dir__() -> list[str]:
    return __all__
