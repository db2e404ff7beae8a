"""A cache of drawn pictures with a size limit; it evicts the least recently used one first."""

import threading

from cachetools import LRUCache


class PictureCache:
    """Encoded pictures by key. Threads may share it. limit: the most bytes of all pictures."""

    def __init__(self, limit: int = 64 << 20) -> None:
        self._pictures: LRUCache[str, bytes] = LRUCache(limit, getsizeof=len)
        self._lock = threading.Lock()

    @property
    def size(self) -> int:
        """Bytes of all pictures."""
        return int(self._pictures.currsize)

    def get(self, key: str) -> bytes | None:
        """A picture, or None."""
        with self._lock:
            return self._pictures.get(key)

    def put(self, key: str, data: bytes) -> None:
        """Add a picture, unless it is larger than the whole cache."""
        with self._lock:
            if len(data) <= self._pictures.maxsize:
                self._pictures[key] = data
