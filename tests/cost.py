"""Limits that tell work which explodes from work which is merely slow today."""

import time
from collections.abc import Iterator
from contextlib import contextmanager


@contextmanager
def limited_cost(seconds: float = 10) -> Iterator[None]:
    """Fail if the block takes more processor time [s] than that.

    The inputs in question take minutes without their limit and less than a tenth of this with it,
    so a busy or slow machine does not decide the test. Speeds are measured in benchmarks/.
    """
    start = time.process_time()
    yield
    assert time.process_time() - start < seconds
