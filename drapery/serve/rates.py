"""How often a client may ask: a bucket of tokens for each, filled at a steady rate."""

import time
from collections import OrderedDict
from collections.abc import Callable

MAX_CLIENTS = 10_000


class Rates:
    """per_minute: requests of one client; 0 is without limit. burst: how many at once."""

    def __init__(
        self,
        per_minute: float,
        burst: int = 20,
        clock: Callable[[], float] = time.monotonic,
    ) -> None:
        self.per_second, self.burst, self._clock = per_minute / 60, burst, clock
        self._buckets: OrderedDict[str, tuple[float, float]] = OrderedDict()

    def wait(self, client: str) -> float:
        """0 where the client may ask now, which is counted; else how long it must wait [s]."""
        if self.per_second <= 0:
            return 0.0
        now = self._clock()
        tokens, before = self._buckets.pop(client, (float(self.burst), now))
        tokens = min(self.burst, tokens + (now - before) * self.per_second)
        pause = 0.0 if tokens >= 1 else (1 - tokens) / self.per_second
        self._buckets[client] = (tokens - 1 if tokens >= 1 else tokens, now)
        while len(self._buckets) > MAX_CLIENTS:
            self._buckets.popitem(last=False)
        return pause
