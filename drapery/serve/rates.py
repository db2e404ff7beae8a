"""How often a client may ask: a token bucket for each client, filled at a steady rate.

The bucket is ten lines over cachetools. The package `limits` was tried: its storage in memory runs
a timer thread over all clients, has no bound on their number, and follows the wall clock.
"""

import time
from collections.abc import Callable

from cachetools import LRUCache

MAX_CLIENTS = 10_000


class RateLimiter:
    """per_minute: requests of one client; 0 is without limit. burst: how many at once."""

    def __init__(
        self,
        per_minute: float,
        burst: int = 20,
        clock: Callable[[], float] = time.monotonic,
    ) -> None:
        self.per_second, self.burst, self._clock = per_minute / 60, burst, clock
        self._buckets: LRUCache[str, tuple[float, float]] = LRUCache(MAX_CLIENTS)

    def wait(self, client: str) -> float:
        """Count a request: 0 if the client may ask now, else how long it must wait [s]."""
        if self.per_second <= 0:
            return 0.0
        now = self._clock()
        tokens, before = self._buckets.get(client, (float(self.burst), now))
        tokens = min(self.burst, tokens + (now - before) * self.per_second)
        pause = 0.0 if tokens >= 1 else (1 - tokens) / self.per_second
        self._buckets[client] = (tokens - 1 if tokens >= 1 else tokens, now)
        return pause
