"""Batches of pictures: draws the jobs of a manifest on one machine or many, and reports all errors.

`run_batch` runs a whole batch; the command `drapery batch` uses it.
"""

from typing import TYPE_CHECKING

from drapery.lazy import import_lazily

if TYPE_CHECKING:
    from drapery.batch.batch_run import BatchResult as BatchResult, run_batch as run_batch
    from drapery.batch.cluster import LostError as LostError
    from drapery.batch.manifest import (
        ManifestError as ManifestError,
        PictureRequest as PictureRequest,
        read_manifest as read_manifest,
    )
    from drapery.batch.results import OutputRecord as OutputRecord
    from drapery.batch.rows import ManifestFault as ManifestFault
    from drapery.batch.run import Progress as Progress
else:
    import_lazily(__name__)
