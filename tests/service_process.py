"""The service as a process of its own."""

import re
import subprocess
import sys
import threading
from collections.abc import Iterator
from contextlib import contextmanager, suppress

import psutil


@contextmanager
def service(*words: str) -> Iterator[tuple[str, subprocess.Popen[str]]]:
    """The command `drapery serve` with one worker, and its address."""
    command = [sys.executable, "-m", "drapery", "serve", "--port", "0", "--workers", "1", *words]
    process = subprocess.Popen(command, stderr=subprocess.PIPE, text=True)
    assert process.stderr is not None
    reader = None
    try:
        line = next(line for line in process.stderr if "listening at" in line)
        reader = threading.Thread(target=process.stderr.read, daemon=True)
        reader.start()
        found = re.search(r"http://127\.0\.0\.1:(\d+)", line)
        assert found and int(found[1]) > 0, "port 0 is printed as the port that was chosen"
        yield found[0], process
    finally:
        process.kill()
        process.wait()
        if reader is not None:
            reader.join()
        process.stderr.close()


def workers_of(process: subprocess.Popen[str]) -> list[psutil.Process]:
    """Its workers that run."""
    with suppress(psutil.NoSuchProcess):
        family = psutil.Process(process.pid).children()
        return [p for p in family if "spawn_main" in str(_command(p))]
    return []


def _command(process: psutil.Process) -> list[str]:
    with suppress(psutil.Error):
        return process.cmdline()
    return []
