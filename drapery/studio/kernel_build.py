"""The module of WebAssembly kernels, compiled beside the studio where an installation has none.

Wheels of releases have it. To compile it takes some minutes of the processor's time; until then
the viewer shows pictures. What the page shows at first is compiled first, in a third of that time.
"""

import asyncio
import importlib.util
import os
import signal
import sys
from collections.abc import Sequence
from contextlib import suppress

from drapery.module_process import module_command
from drapery.studio.session import Sessions
from drapery.web.wasm.module import is_module_built

COMMAND = module_command("drapery.web.wasm.build", "--cache")
FIRST = [*COMMAND, "--only", "xpbdsheet"]
"""What plays a banner with the studio's own settings."""
BUILDING = "The live cloth is compiled once, which takes some minutes; until then it stands still."
MISSING = (
    "The live cloth needs a module that this installation lacks: install drapery-mc[web-build] and"
    " start the studio again."
)


class KernelBuild:
    """A process that builds the module, begun when a page asks for it.

    first: builds a module that lacks some kernels, where there is none. whole: the whole module.
    """

    def __init__(
        self,
        sessions: Sessions,
        first: Sequence[str] = FIRST,
        whole: Sequence[str] = COMMAND,
    ) -> None:
        self._sessions = sessions
        self._commands = first, whole
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
        for command in self._commands[is_module_built() :]:
            await _run(command)
            self._sessions.notify("scene")


async def _run(command: Sequence[str]) -> None:
    """Run a command to its end, which comes when the task ends."""
    # A group of its own, since it starts another process.
    process = await asyncio.create_subprocess_exec(
        *command, stdout=asyncio.subprocess.DEVNULL, start_new_session=True
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
