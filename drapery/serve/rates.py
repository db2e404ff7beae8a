"""Rate limits: each client has a token bucket that fills at a constant rate.

The bucket takes ten lines on top of cachetools. The package `limits` does not fit: its in-memory
storage runs a timer thread over all clients, does not bound their number, and uses the wall clock.
"""

import time
from collections.abc import Callable

from cachetools import LRUCache

MAX_CLIENTS = 10_000


class RateLimiter:
    """per_minute: the most requests of one client; 0 means no limit. burst: how many at once."""

    def __init__(
        self,
        per_minute: float,
        burst: int = 20,
        clock: Callable[[], float] = time.monotonic,
    ) -> None:
        self.per_second, self.burst, self._clock = per_minute / 60, burst, clock
        self._buckets: LRUCache[str, tuple[float, float]] = LRUCache(MAX_CLIENTS)

    def wait(self, client: str) -> float:
        """Count a request; returns how long the client must wait first [s], 0 if not at all."""
        if self.per_second <= 0:
            return 0.0
        now = self._clock()
        tokens, before = self._buckets.get(client, (float(self.burst), now))
        tokens = min(self.burst, tokens + (now - before) * self.per_second)
        pause = 0.0 if tokens >= 1 else (1 - tokens) / self.per_second
        self._buckets[client] = (tokens - 1 if tokens >= 1 else tokens, now)
        return pause
