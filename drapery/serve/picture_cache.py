"""Pictures that were drawn, kept up to a number of bytes; the one unused longest goes first."""

import threading
from collections import OrderedDict
from pathlib import Path


class PictureCache:
    """Files of a folder that nobody else writes to. most: bytes of all."""

    def __init__(self, folder: Path, most: int = 256 << 20) -> None:
        self.folder, self.most = folder, most
        self._sizes: OrderedDict[str, int] = OrderedDict()
        self._total = 0
        self._lock = threading.Lock()

    def __len__(self) -> int:
        return len(self._sizes)

    @property
    def total(self) -> int:
        """Bytes of all files."""
        return self._total

    def __contains__(self, name: object) -> bool:
        return name in self._sizes

    def take(self, name: str) -> bytes | None:
        """A file's bytes, or None where it is not kept."""
        with self._lock:
            if name not in self._sizes:
                return None
            self._sizes.move_to_end(name)
        try:
            return (self.folder / name).read_bytes()
        except OSError:
            self._drop(name)
            return None

    def put(self, name: str, size: int) -> None:
        """Say that a file of this size [bytes] is there now."""
        with self._lock:
            self._total += size - self._sizes.pop(name, 0)
            self._sizes[name] = size
            old = []
            while self._total > self.most and len(self._sizes) > 1:
                other, its = self._sizes.popitem(last=False)
                self._total -= its
                old.append(other)
        for other in old:
            (self.folder / other).unlink(missing_ok=True)

    def _drop(self, name: str) -> None:
        with self._lock:
            self._total -= self._sizes.pop(name, 0)
