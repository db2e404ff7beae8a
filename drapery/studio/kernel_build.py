"""The module of WebAssembly kernels, compiled beside the studio where an installation has none.

Wheels of releases have it. To compile it takes some minutes of the processor's time; until then
the viewer shows pictures.
"""

import asyncio
import importlib.util
import os
import signal
import sys
from collections.abc import Sequence
from contextlib import suppress

from drapery.studio.session import Sessions

COMMAND = sys.executable, "-m", "drapery.web.wasm.build", "--cache"
BUILDING = "The live cloth is compiled once, which takes some minutes; until then it stands still."
MISSING = (
    "The live cloth needs a module that this installation lacks: install drapery-mc[web-build] and"
    " start the studio again."
)


class KernelBuild:
    """A process that builds the module, begun when a page asks for it."""

    def __init__(self, sessions: Sessions, command: Sequence[str] = COMMAND) -> None:
        self._sessions = sessions
        self._command = command
        self._task: asyncio.Task[None] | None = None

    async def start(self) -> str:
        """Build the module unless that is under way; returns a line for the user."""
        if importlib.util.find_spec("ziglang") is None:
            return MISSING
        if self._task is None:
            self._task = asyncio.create_task(self._build(), name="kernels")
        return BUILDING

    async def wait(self) -> None:
        """Wait for the end of the process, if it runs."""
        if self._task is not None:
            await self._task

    async def stop(self) -> None:
        """End the process, if it runs."""
        if self._task is not None:
            self._task.cancel()
            await asyncio.gather(self._task, return_exceptions=True)

    async def _build(self) -> None:
        # A group of its own, since it starts another process.
        process = await asyncio.create_subprocess_exec(
            *self._command, stdout=asyncio.subprocess.DEVNULL, start_new_session=True
        )
        try:
            await process.wait()
        except asyncio.CancelledError:
            with suppress(ProcessLookupError):
                if sys.platform == "win32":
                    process.terminate()
                else:
                    os.killpg(process.pid, signal.SIGTERM)
            raise
        self._sessions.notify("scene")
