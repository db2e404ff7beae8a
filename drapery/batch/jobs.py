"""A job is one picture, drawn once and stored under every file name that asks for it."""

import time
import warnings
from collections.abc import Iterable
from dataclasses import asdict, dataclass, replace
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING

from drapery import Banner
from drapery.batch.keys import DigestCache, code_version, picture_key
from drapery.batch.manifest import PictureRequest
from drapery.batch.stores import LocalStore, Store
from drapery.errors import BackendError, DesignError, DraperyError, OptionError
from drapery.settings import LoopSettings, Settings

if TYPE_CHECKING:
    from drapery.garments import Garment


@dataclass(frozen=True)
class Job:
    """A picture to draw.

    key: the hash of its design and options, see `picture_key`. outs: the files to write. places:
    of each file in the manifest. timing: the options of an animation; None for a still. version:
    of the code.
    """

    key: str
    outs: tuple[str, ...]
    places: tuple[str, ...]
    banner: "Banner | Garment | None"
    settings: Settings
    timing: LoopSettings | None
    version: str

    @property
    def motion(self) -> tuple[object, ...]:
        """Equal for jobs with the same motion of the cloth; a worker simulates it once."""
        moved, drawn = self.settings.only("motion", "wind"), self.banner
        kind: str = moved.kind
        if drawn is not None and kind == "auto":
            kind = drawn.kind if isinstance(drawn, Banner) else drawn.name
        if self.timing is not None:
            moved = replace(moved, time=0.0)
        return (kind, replace(moved, kind="auto"), self.timing)


@dataclass(frozen=True)
class JobResult:
    """The result of a job.

    error: why it failed, one line; None if it succeeded. retryable: whether another try may help.
    seconds: its duration [s]. size: of its file [bytes]. timed_out: whether it exceeded its time.
    """

    job: Job
    error: str | None = None
    retryable: bool = False
    seconds: float = 0.0
    size: int = 0
    warnings: tuple[str, ...] = ()
    timed_out: bool = False


def plan(requests: Iterable[PictureRequest]) -> list[Job]:
    """Jobs for requests: equal ones are merged, those with the same motion are adjacent.

    Raises PackError if packs cannot be read.
    """
    digests = DigestCache()
    jobs: dict[str, Job] = {}
    for request in requests:
        job = make_job(request, digests)
        same = jobs.get(job.key)
        if same is not None:
            job = replace(same, outs=same.outs + job.outs, places=same.places + job.places)
        jobs[job.key] = job
    first: dict[tuple[object, ...], int] = {}
    for job in jobs.values():
        first.setdefault(job.motion, len(first))
    return sorted(jobs.values(), key=lambda job: first[job.motion])


def make_job(request: PictureRequest, digests: DigestCache) -> Job:
    """The job of one request. Raises PackError."""
    ending = Path(request.out).suffix.lower()
    timing = request.timing
    key = picture_key(request.banner, request.settings, digests, ending=ending, timing=timing)
    return Job(
        key,
        (request.out,),
        (request.place,),
        request.banner,
        request.settings,
        timing,
        code_version(),
    )


def run_job(job: Job, store: Store) -> JobResult:
    """Draw a job's picture and store it. Raises MemoryError; other errors become results."""
    start = time.perf_counter()
    try:
        size, caught = _draw_and_store(job, store)
    except DraperyError as error:
        retryable = not isinstance(error, (OptionError, DesignError, BackendError))
        return JobResult(job, str(error), retryable, time.perf_counter() - start)
    except MemoryError:
        raise
    except Exception as error:
        # A defect of this package or of an installed backend; the other jobs continue.
        line = f"{type(error).__name__}: {' '.join(str(error).split())[:300]}; please report it"
        return JobResult(job, line, True, time.perf_counter() - start)
    return JobResult(job, None, False, time.perf_counter() - start, size, caught)


OUT_OF_MEMORY = "it needs more memory than --memory allows; make it smaller or raise the limit"


def _draw_and_store(job: Job, store: Store) -> tuple[int, tuple[str, ...]]:
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always", UserWarning)
        if isinstance(store, LocalStore):
            first = store.prepare(job.outs[0])
            _save(job, first)
            data = None
            size = first.stat().st_size
        else:
            with TemporaryDirectory() as folder:
                path = Path(folder, "picture" + Path(job.outs[0]).suffix)
                _save(job, path)
                data = path.read_bytes()
            store.write(job.outs[0], data)
            size = len(data)
    for out in job.outs[1:]:
        store.write(out, store.read(job.outs[0]) if data is None else data)
    return size, tuple(dict.fromkeys(str(one.message) for one in caught))


def _save(job: Job, path: Path) -> None:
    from drapery import draw, iter_frames
    from drapery.render import save_animation

    if job.timing is None:
        draw(job.banner, job.settings).save(path)
        return
    drawn = iter_frames(job.banner, job.settings, **asdict(job.timing))
    save_animation(drawn, job.timing.fps, path, total=job.timing.count)
