"""Skins that clients send, as files that the workers read."""

import hashlib
from collections import OrderedDict
from pathlib import Path
from threading import Lock

from drapery.garments import check_skin

MAX_UPLOAD = 1 << 20
"""The most bytes of a skin."""
MAX_SIDE = 512
"""The widest skin [px]."""
KEPT = 512
"""The most skins on the disk; a picture of one that has left must be uploaded again."""


class SkinUploads:
    """A folder of the last skins that clients sent, named after their bytes."""

    def __init__(self, folder: Path, kept: int = KEPT) -> None:
        folder.mkdir(parents=True, exist_ok=True)
        self._folder, self._kept, self._lock = folder, kept, Lock()
        self._known: OrderedDict[str, Path] = OrderedDict()

    def put(self, data: bytes) -> Path:
        """The file of a skin. Raises OptionError or PackError for what is not a skin."""
        name = hashlib.sha256(data).hexdigest()
        with self._lock:
            if name in self._known:
                self._known.move_to_end(name)
                return self._known[name]
            path = self._folder / f"{name}.png"
            path.write_bytes(data)
            try:
                check_skin(path, MAX_SIDE)
            except Exception:
                path.unlink()
                raise
            self._known[name] = path
            while len(self._known) > self._kept:
                self._known.popitem(last=False)[1].unlink(missing_ok=True)
            return path
