"""Exports: files made by the code that the commands use, each in a thread that can be stopped."""

import logging
import os
import sys
import threading
from collections.abc import Callable, Iterator
from contextlib import suppress
from dataclasses import dataclass, field
from pathlib import Path

from drapery import DraperyError, Frame, OptionError
from drapery.banner import write_banner
from drapery.option import one_of
from drapery.studio.document import Document
from drapery.studio.snippets import (
    FILE_OPTIONS,
    KINDS,
    LOOPS,
    MODELS,
    MOVING,
    STILLS,
    ExportRequest,
    file_name,
    file_values,
    options_for,
    scene_clip,
    scene_of,
    subject_of,
)
from drapery.studio.warning_log import collected_warnings
from drapery.user_files import reason

MAX_PIXELS = 1 << 31
"""The most pixels of all frames together: 512 x 512 for six minutes at 20 frames/s."""
MAX_RUNNING = 4
"""The most exports that run at the same time, over all tabs."""

LOG = logging.getLogger(__name__)

Progress = Callable[[int, int], None]
"""A callable that gets the number of finished frames and the number of all frames."""


class StoppedError(DraperyError):
    """The user stopped the export."""


def make(
    request: ExportRequest,
    path: Path,
    progress: Progress | None = None,
    on_moment: Progress | None = None,
) -> None:
    """Write the file, as the command of `snippets.as_command` does.

    on_moment: called at each moment of a loop's cloth with its number and the last one's.
    If it or progress raises, the work stops and no file remains.
    Raises OptionError, PackError, BackendError or OutputError.
    """
    from drapery import save_model
    from drapery.render import save_animation

    check(request)
    tick, total = progress or (lambda done, total: None), count_frames(request)
    tick(0, total)
    if request.kind in LOOPS:
        frames = _frames(request, on_moment)
        save_animation(frames, request.timing.fps, path, progress=lambda done, _: tick(done, total))
    elif request.kind in MODELS:
        given = subject_of(request), path, options_for(request)
        save_model(*given, progress=tick, on_moment=on_moment, **file_values(request))
        tick(total, total)
    else:
        drawn = _drawn(request)
        tick(1, 1)
        path.write_bytes(drawn.encode()) if isinstance(drawn, str) else drawn.save(path)


def count_frames(request: ExportRequest) -> int:
    """The number of frames in the file; 1 for a file without motion."""
    return request.timing.count if request.kind in MOVING else 1


def check(request: ExportRequest) -> None:
    """Raise OptionError for a request that exceeds the limits; called before drawing starts."""
    one_of("kind", request.kind, KINDS)
    FILE_OPTIONS["scale"].check(request.scale)
    width, height = request.settings.size
    frames = count_frames(request)
    if request.kind in LOOPS and width * height * frames > MAX_PIXELS:
        raise OptionError(
            f"{frames} frames of {width}x{height} are over {MAX_PIXELS >> 20} million pixels;"
            " use fewer or smaller ones"
        )


def _frames(request: ExportRequest, on_moment: Progress | None = None) -> Iterator[Frame]:
    """The frames of a loop, or the last one of a scene for a picture."""
    from drapery import iter_frames
    from drapery.scenes import find_scene, scene_frames

    settings, chosen = options_for(request), scene_of(request)
    if chosen is None:
        subject = subject_of(request)
        return iter_frames(subject, settings, on_moment=on_moment, **file_values(request))
    scene = find_scene(chosen.name)
    clip, parameters = scene_clip(request, scene), scene.parameters(dict(chosen.words))
    backend = settings.backend if isinstance(settings.backend, str) else "auto"
    last = request.kind in STILLS
    return scene_frames(scene, parameters, clip, backend, last=last, style=settings.style)


def _drawn(request: ExportRequest) -> Frame | str:
    """A picture, a page or a design."""
    from drapery import draw, draw_face
    from drapery.web.page import page_text

    settings, banner = options_for(request), request.banner
    if scene_of(request) is not None:
        return next(_frames(request))
    if request.kind in STILLS:
        return draw(subject_of(request), settings)
    if request.kind == "html":
        return page_text(banner, settings)
    if banner is None:
        raise OptionError(f"a {request.kind} is of a design; give one")
    if request.kind == "json":
        return write_banner(banner) + "\n"
    return draw_face(banner, packs=settings.packs, format=settings.format, scale=request.scale)


@dataclass(eq=False)
class Export:
    """One export: running, done, failed or stopped.

    path: the place of the file once `state` is "done". fault: the reason if `state` is "failed".
    moved: how much of a loop's motion is simulated, which comes before its frames, 0 to 1.
    warnings: one line each, as the command writes them.
    """

    request: ExportRequest
    path: Path
    name: str
    done: int = 0
    total: int = 1
    moved: float = 0.0
    state: str = "running"
    fault: str = ""
    warnings: tuple[str, ...] = ()
    _stop: threading.Event = field(default_factory=threading.Event)
    _thread: threading.Thread | None = None

    def start(self) -> None:
        """Start the export in a new thread."""
        self._thread = threading.Thread(target=self._run, name="export", daemon=True)
        self._thread.start()

    @property
    def share(self) -> float:
        """How much of the work is done, 0 to 1: the motion of a loop is the first half."""
        drawn = self.done / self.total
        return (self.moved + drawn) / 2 if self.moved else drawn

    def stop(self) -> None:
        """Stop at the next frame or moment; removes what has been written."""
        self._stop.set()

    def wait(self, seconds: float) -> bool:
        """Wait for the end of the export; returns whether it has ended."""
        if self._thread is not None:
            self._thread.join(seconds)
        return self.state != "running"

    def _progress(self, done: int, total: int) -> None:
        self.done, self.total = done, total
        self._check_stop()

    def _move(self, number: int, last: int) -> None:
        self.moved = number / max(last, 1)
        self._check_stop()

    def _check_stop(self) -> None:
        if self._stop.is_set():
            raise StoppedError("the export was stopped")

    def _run(self) -> None:
        _lower_priority()
        try:
            with collected_warnings() as warnings:
                make(self.request, self.path, self._progress, self._move)
            self.warnings = tuple(dict.fromkeys(warnings))
        except StoppedError:
            self.state = "stopped"
        except DraperyError as error:
            self.state, self.fault = "failed", str(error)
        except MemoryError:
            self.state, self.fault = "failed", "the export failed: it needs too much memory"
        except OSError as error:
            self.state, self.fault = "failed", f"the export failed: {reason(error)}"
        except Exception as error:
            # This is an error in the program: show one line to the user, log the traceback.
            LOG.exception("the export of %s failed", self.name)
            kind = type(error).__name__
            self.state, self.fault = "failed", f"the export failed ({kind}); see the studio's log"
        else:
            self.state = "stopped" if self._stop.is_set() else "done"
        if self.state != "done":
            self.path.unlink(missing_ok=True)


class ExportSlots:
    """The running exports of all tabs. limit: how many may run at the same time."""

    def __init__(self, limit: int = MAX_RUNNING) -> None:
        self._limit = limit
        self._lock = threading.Lock()
        self._running: list[Export] = []

    def take(self, export: Export, instead_of: Export | None) -> None:
        """Let an export run; it may replace `instead_of`. Raises OptionError if no slot is free."""
        with self._lock:
            self._running = [each for each in self._running if each.state == "running"]
            others = [each for each in self._running if each is not instead_of]
            if len(others) >= self._limit:
                raise OptionError(f"{self._limit} exports are under way; wait for one to end")
            self._running.append(export)


class Exports:
    """The exports of one tab: one at a time, and the file of the last one.

    current: the export that was started last. number: identifies it.
    """

    def __init__(self, document: Document, slots: ExportSlots) -> None:
        self._document = document
        self._slots = slots
        self.current: Export | None = None
        self.number = 0
        document.on_close(self.clear)

    def start(self, request: ExportRequest, stem: str = "banner") -> Export:
        """Start another export; stops the previous one and removes its file.

        Raises OptionError for a request that exceeds the limits, or while too many exports run.
        """
        check(request)
        # The request determines only the file name's ending.
        suffix = Path(file_name(request)).suffix
        path = self._document.folder / f"export-{self.number + 1}{suffix}"
        export = Export(request, path, file_name(request, stem))
        self._slots.take(export, self.current)
        self.clear()
        self.current, self.number = export, self.number + 1
        export.start()
        return export

    def finished(self, number: int) -> Export | None:
        """The export with this number, if its file exists."""
        work = self.current
        return work if work and number == self.number and work.state == "done" else None

    def clear(self) -> None:
        """Stop the current export, if there is one, and remove its file."""
        if self.current is not None:
            self.current.stop()
            if self.current.state != "running":
                self.current.path.unlink(missing_ok=True)
            self.current = None


def _lower_priority() -> None:
    """Give the live cloth priority over this thread. On Linux each thread has its own niceness."""
    if sys.platform == "linux":
        with suppress(OSError):  # a sandbox may forbid it
            os.setpriority(os.PRIO_PROCESS, threading.get_native_id(), 5)


def stem_of(title: str) -> str:
    """The file name, without ending, for a title: letters, digits and dashes."""
    plain = "".join(letter if letter.isalnum() else " " for letter in title.lower())
    return "-".join(plain.split())[:60] or "banner"
