"""The service as a FastAPI application."""

import asyncio
import logging
import math
import shutil
import time
from collections.abc import AsyncIterator, Callable, Mapping
from contextlib import asynccontextmanager
from dataclasses import replace
from functools import partial
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from fastapi import FastAPI, Request, Response
from fastapi.responses import JSONResponse
from prometheus_client import CollectorRegistry, Counter, Gauge, Histogram, generate_latest
from prometheus_client.exposition import CONTENT_TYPE_LATEST
from starlette.concurrency import run_in_threadpool
from starlette.types import ASGIApp, Message, Receive, Scope, Send

from drapery.batch.executor import RetryPolicy
from drapery.batch.jobs import OUT_OF_MEMORY, Job, JobResult, make_job, run_job
from drapery.batch.keys import DigestCache, code_version
from drapery.batch.pool import JobLimits, ProcessPool
from drapery.batch.stores import LocalStore
from drapery.errors import DraperyError, OptionError
from drapery.file_formats import FileFormat, Kind, formats_of
from drapery.option_checks import one_line
from drapery.serve.job_queue import BusyError, JobQueue, Unavailable
from drapery.serve.picture_cache import PictureCache
from drapery.serve.rates import RateLimiter
from drapery.serve.request_params import (
    SUBJECTS,
    Resource,
    ServiceConfig,
    parameters,
    parse_query,
    read_request,
)
from drapery.serve.signatures import is_signed, unsigned
from drapery.serve.uploads import MAX_UPLOAD, SkinUploads

SERVED = tuple(each for each in formats_of("still", "loop") if each.single and not each.extra)
"""The formats of answers."""
CACHE_CONTROL = "public, max-age=86400"
WORKER_RESTARTS = RetryPolicy(limit=math.inf, pause=0.25, longest=30.0)
"""Workers that fail to start are started again without a limit: memory may be free later."""
SUMMARIES: dict[tuple[Kind, Kind], str] = {
    ("still", "still"): "A {} as one picture.",
    ("loop", "loop"): "A {} in the wind, as a seamless loop.",
    ("still", "loop"): "A {} as one picture, or as a seamless loop if seconds or fps are given.",
}
"""By what an answer shows without and with a length."""
SENT = " The body is its skin, a PNG file."
CLOSED_REQUEST = 499
"""The status that metrics count for a client that disconnected; it is not sent."""
REASONS = {
    304: "the picture that If-None-Match names is unchanged",
    403: "the service has a secret, and the address has no signature made with it",
    408: "the skin did not arrive in time",
    413: "the skin is too large",
    414: "the query is too long",
    422: "the address is wrong; `detail` says why",
    429: "too many requests; Retry-After says when to ask again",
    503: "too busy, or the service could not draw; ask again",
    504: "the picture takes too long to draw",
}
_DETAIL = {
    "type": "object",
    "required": ["detail"],
    "properties": {"detail": {"type": "array", "items": {"type": "string"}}},
}
_log = logging.getLogger(__name__)


class Metrics:
    """The numbers of /metrics."""

    def __init__(self) -> None:
        registry = self.registry = CollectorRegistry()
        labels = ["path", "status"]
        self.requests = Counter("drapery_requests", "Requests.", labels, registry=registry)
        self.drawn = Counter("drapery_drawn", "Pictures drawn.", registry=registry)
        self.cache_hits = Counter("drapery_cache_hits", "Pictures drawn before.", registry=registry)
        self.waiting = Gauge("drapery_waiting", "Pictures to be drawn.", registry=registry)
        self.ready = Gauge("drapery_ready", "1 if a worker can draw, else 0.", registry=registry)
        self.cache = Gauge("drapery_cache_bytes", "Bytes of cached pictures.", registry=registry)
        self.seconds = Histogram("drapery_draw_seconds", "Time of a drawing.", registry=registry)


class PictureService:
    """The state that the handlers share."""

    def __init__(
        self,
        config: ServiceConfig,
        store: LocalStore,
        pool: Callable[[], ProcessPool],
        metrics: Metrics,
        rates: RateLimiter,
        uploads: SkinUploads,
        *,
        cache: int,
        waiting: int,
        deadline: float,
        secret: bytes,
    ) -> None:
        """Start the workers; see `make_app`. store: where workers write. uploads: what they read
        of clients."""
        self.config, self.store, self.metrics, self.rates = config, store, metrics, rates
        self.uploads = uploads
        self.deadline, self.secret = deadline, secret
        self.cache = PictureCache(cache)
        self.digests = DigestCache()
        for pack in config.base.pack_paths:
            self.digests.of(pack)
        code_version()  # cache the result before the first request
        self.queue: JobQueue[bytes | JobResult] = JobQueue(pool, self._finish, waiting)

    async def answer(self, request: Request, subject: Resource, format: FileFormat) -> Response:
        """The response to a request: a picture, or an error that states the reason."""
        end = time.monotonic() + self.deadline
        pause = self.rates.wait(request.client.host if request.client else "")
        if pause:
            return _refusal(429, ["too many requests; ask again later"], pause)
        try:
            query = parse_query(request.scope["query_string"])
        except OptionError as error:
            return _refusal(414, [str(error)])
        if self.secret:
            if not is_signed(request.url.path, query, self.secret):
                return _refusal(403, ["the address is not signed; sign it with `drapery sign`"])
            query = unsigned(query)
        sent = b""
        if request.method == "POST":
            body = await self._body(request, end)
            if isinstance(body, Response):
                return body
            sent = body
        # Use a thread, so that a long design does not block other requests.
        job = await run_in_threadpool(self._job, query, subject, format.ending, sent)
        if isinstance(job, list):
            return _refusal(422, job)
        headers = {"ETag": f'"{job.key}"', "Cache-Control": CACHE_CONTROL}
        if _matches(request.headers.get("if-none-match", ""), job.key):
            return Response(status_code=304, headers=headers)
        data = self.cache.get(job.key)
        if data is None:
            drawn = await self.draw(request, job, end)
            if isinstance(drawn, Response):
                return drawn
            data = drawn
        else:
            self.metrics.cache_hits.inc()
        return Response(data, media_type=format.media_type, headers=headers)

    async def _body(self, request: Request, end: float) -> bytes | Response:
        """What a client sends until a time, or why it is refused."""
        try:
            body = await asyncio.wait_for(_read_body(request), end - time.monotonic())
        except TimeoutError:
            return _refusal(
                408, [f"the skin did not arrive within {self.deadline:g} s; send again"]
            )
        if body is None:
            return _refusal(413, [f"the skin has over {MAX_UPLOAD} bytes; make it smaller"])
        return body or _refusal(422, ["the body is empty; send the PNG file of a skin"])

    def _job(
        self, query: list[tuple[str, str]], subject: Resource, ending: str, sent: bytes
    ) -> Job | list[str]:
        """The job of a query, whose key is its file name, or the errors of the query.

        sent: the skin of a player; empty for none.
        """
        try:
            skin = self.uploads.put(sent) if sent else None
            request = read_request(query, ending, self.config, subject, skin)
            if isinstance(request, list):
                return request
            job = make_job(request, self.digests)
        except DraperyError as error:
            return [one_line(str(error))]
        return replace(job, outs=(f"{job.key}{ending}",))

    def _finish(self, result: JobResult) -> bytes | JobResult:
        """The bytes of the result's picture, or the result itself if drawing failed."""
        if result.error is not None:
            _log.warning("a picture was not drawn: %s", result.error)
            return result
        for line in result.warnings:
            _log.warning("a picture was drawn: %s", line)
        path = self.store.path(result.job.outs[0])
        data = path.read_bytes()
        path.unlink(missing_ok=True)
        self.cache.put(result.job.key, data)
        self.metrics.drawn.inc()
        self.metrics.seconds.observe(result.seconds)
        return data

    async def draw(self, request: Request, job: Job, end: float) -> bytes | Response:
        """The picture, drawn before the end of time.monotonic(), or why there is none."""
        try:
            answer = self.queue.ask(job, lambda: self.cache.get(job.key))
        except BusyError:
            return _refusal(503, ["too many pictures are waiting; ask again"], 2)
        left = asyncio.create_task(_disconnected(request))
        try:
            # Other requests may wait for the same picture, so do not cancel the job here.
            ends: set[asyncio.Future[Any]] = {asyncio.wrap_future(answer), left}
            first = asyncio.FIRST_COMPLETED
            await asyncio.wait(ends, timeout=max(0.0, end - time.monotonic()), return_when=first)
        finally:
            left.cancel()
            self.queue.leave(job, answer)
        if answer.done():
            return _answered(answer.result())
        if left.done() and not left.cancelled():
            return Response(status_code=CLOSED_REQUEST)
        if not self.queue.ready:
            return _refusal(503, ["no worker is running; ask again"], 5)
        return _refusal(504, [f"the picture was not drawn within {self.deadline:g} s"])


def make_app(
    config: ServiceConfig | None = None,
    *,
    workers: int = 1,
    limits: JobLimits | None = None,
    rate: float = 600.0,
    cache: int = 64 << 20,
    waiting: int = 64,
    deadline: float = 30.0,
    secret: bytes = b"",
) -> FastAPI:
    """Make the application; its worker processes live as long as it runs.

    workers: the number of processes that draw. limits: time and memory for one picture.
    rate: requests per minute of one client; 0 means no limit. cache: the size of the picture cache
    [bytes]. waiting: the most pictures that wait to be drawn. deadline: the longest time until an
    answer [s]. secret: only addresses that are signed with it are answered; empty for all.
    """
    chosen, bounds = config or ServiceConfig(), limits or JobLimits(20.0, 1 << 30)
    metrics = Metrics()

    @asynccontextmanager
    async def lifespan(app: FastAPI) -> AsyncIterator[None]:
        with TemporaryDirectory(prefix="drapery-serve-", ignore_cleanup_errors=True) as folder:
            store = LocalStore(Path(folder, "pictures"))
            own = await run_in_threadpool(_with_own_files, chosen, Path(folder, "own"))
            work = partial(run_job, store=store)
            pool = partial(ProcessPool, work, workers, bounds, restarts=WORKER_RESTARTS)
            service = PictureService(
                *(own, store, pool, metrics, RateLimiter(rate)),
                SkinUploads(Path(folder, "skins")),
                cache=cache,
                waiting=waiting,
                deadline=deadline,
                secret=secret,
            )
            app.state.service = service
            try:
                yield
            finally:
                await run_in_threadpool(service.queue.close)

    app = FastAPI(
        title="Drapery",
        description="Pictures of Minecraft banners, garments and players as cloth.",
        lifespan=lifespan,
        # Pages of documentation load scripts of another site.
        docs_url=None,
        redoc_url=None,
        # A redirect from `/banner.png/` would lead to whatever host the request names.
        redirect_slashes=False,
    )
    app.add_middleware(CountRequests, metrics=metrics)
    for subject in SUBJECTS:
        for format in SERVED:
            _add_picture(app, subject, format, chosen)
    _add_metrics(app, metrics)
    _add_health(app)
    return app


def _with_own_files(config: ServiceConfig, folder: Path) -> ServiceConfig:
    """The configuration with private copies of its packs, skins and capes.

    Without copies, a picture of a pack that was edited meanwhile would have the old ETag.
    """
    skins, capes = (
        _copied(listed, folder / name)
        for name, listed in (("skins", config.skins), ("capes", config.capes))
    )
    packs = []
    for number, pack in enumerate(map(Path, config.base.pack_paths)):
        target = folder / str(number) / pack.name
        target.parent.mkdir(parents=True)
        if pack.is_dir():
            ignored = shutil.ignore_patterns(".git")
            shutil.copytree(pack, target, ignore=ignored, ignore_dangling_symlinks=True)
        else:
            shutil.copyfile(pack, target)
        packs.append(target)
    return replace(config, base=config.base.changed(packs=tuple(packs)), skins=skins, capes=capes)


def _copied(pictures: Mapping[str, Path], folder: Path) -> dict[str, Path]:
    folder.mkdir(parents=True)
    return {
        name: Path(shutil.copyfile(path, folder / f"{name}.png")) for name, path in pictures.items()
    }


def _add_picture(
    app: FastAPI, subject: Resource, format: FileFormat, config: ServiceConfig
) -> None:
    async def handler(request: Request) -> Response:
        service: PictureService = request.app.state.service
        return await service.answer(request, subject, format)

    described = parameters(format.kind() == "loop", config.limits, subject)
    summary = SUMMARIES[format.kind(timed=False), format.kind()].format(subject)
    for method in ("GET", "POST") if subject == "player" else ("GET",):
        extra: dict[str, Any] = {"parameters": described}
        if method == "POST":
            skin = {"schema": {"type": "string", "format": "binary"}}
            extra["requestBody"] = {"content": {"image/png": skin}, "required": True}
        app.add_api_route(
            f"/{subject}{format.ending}",
            handler,
            methods=[method],
            summary=summary + SENT * (method == "POST"),
            response_class=Response,
            operation_id=f"{subject}_{format.ending[1:]}" + "_sent" * (method == "POST"),
            responses=_responses(format.media_type),
            openapi_extra=extra,
        )


def _responses(kind: str) -> dict[int | str, dict[str, Any]]:
    picture = {kind: {"schema": {"type": "string", "format": "binary"}}}
    described: dict[int | str, dict[str, Any]] = {
        200: {"description": "The picture.", "content": picture}
    }
    for status, reason in REASONS.items():
        described[status] = {"description": reason}
        if status != 304:
            described[status]["content"] = {"application/json": {"schema": _DETAIL}}
    return described


def _add_metrics(app: FastAPI, metrics: Metrics) -> None:
    text = {"text/plain": {"schema": {"type": "string"}}}

    @app.get(
        "/metrics",
        summary="Counters for Prometheus.",
        response_class=Response,
        responses={200: {"description": "The counters.", "content": text}},
    )
    def read_metrics(request: Request) -> Response:
        service: PictureService = request.app.state.service
        metrics.waiting.set(len(service.queue))
        metrics.ready.set(service.queue.ready)
        metrics.cache.set(service.cache.size)
        return Response(generate_latest(metrics.registry), media_type=CONTENT_TYPE_LATEST)


def _add_health(app: FastAPI) -> None:
    detail = {"application/json": {"schema": _DETAIL}}
    unwell: dict[int | str, dict[str, Any]] = {503: {"description": "No.", "content": detail}}

    @app.get("/healthz", summary="Whether the service works.", responses=unwell)
    def read_health(request: Request) -> Response:
        alive = request.app.state.service.queue.alive
        return _state(alive, "the queue of pictures has ended; restart the service")

    @app.get("/readyz", summary="Whether a worker can draw.", responses=unwell)
    def read_readiness(request: Request) -> Response:
        ready = request.app.state.service.queue.ready
        return _state(ready, "no worker is running; workers are being started")


COUNTED = frozenset(
    {
        *(f"/{subject}{format.ending}" for subject in SUBJECTS for format in SERVED),
        *("/metrics", "/healthz", "/readyz"),
    }
)
"""The paths that metrics count by themselves."""


class CountRequests:
    """Middleware that counts requests, and tells browsers not to guess media types."""

    def __init__(self, app: ASGIApp, metrics: Metrics) -> None:
        self.app, self.metrics = app, metrics

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Answer a request (ASGI)."""
        if scope["type"] != "http":
            await self.app(scope, receive, send)
            return
        path = scope["path"] if scope["path"] in COUNTED else "other"

        async def count(message: Message) -> None:
            if message["type"] == "http.response.start":
                self.metrics.requests.labels(path, str(message["status"])).inc()
                message["headers"].append((b"x-content-type-options", b"nosniff"))
            await send(message)

        await self.app(scope, receive, count)


async def _read_body(request: Request) -> bytes | None:
    """What a client sends, or None if that is too much."""
    data = bytearray()
    async for part in request.stream():
        data += part
        if len(data) > MAX_UPLOAD:
            return None
    return bytes(data)


async def _disconnected(request: Request) -> None:
    """Wait until the client disconnects."""
    while (await request.receive())["type"] != "http.disconnect":
        pass


def _matches(header: str, key: str) -> bool:
    """Whether an If-None-Match names the key (RFC 9110, 13.1.2)."""
    tags = (tag.strip().removeprefix("W/").strip('"') for tag in header.split(","))
    return header.strip() == "*" or key in tags


def _answered(answer: bytes | JobResult | Unavailable) -> bytes | Response:
    """The picture, or an error response; details go to the log, not to clients."""
    if isinstance(answer, bytes):
        return answer
    if isinstance(answer, Unavailable):
        return _refusal(503, ["the picture was lost with its worker; ask again"], 5)
    error = str(answer.error)
    if answer.timed_out:
        return _refusal(504, ["the picture takes too long to draw; make it smaller"])
    if error.startswith(OUT_OF_MEMORY):
        return _refusal(503, ["the picture needs too much memory; make it smaller"])
    if answer.retryable:
        return _refusal(503, ["the service could not draw the picture; ask again"], 5)
    return _refusal(422, [error])


def _state(good: bool, otherwise: str) -> Response:
    return JSONResponse({"detail": ["yes"]}) if good else _refusal(503, [otherwise], 5)


def _refusal(status: int, reasons: list[str], pause: float = 0.0) -> JSONResponse:
    headers = {"Cache-Control": "no-store"}
    if pause:
        headers["Retry-After"] = str(max(1, math.ceil(pause)))
    return JSONResponse({"detail": reasons}, status, headers)
