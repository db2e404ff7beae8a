"""The service as a FastAPI application."""

import asyncio
import math
from collections.abc import AsyncIterator, Callable
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

from drapery.batch.executor import Executor
from drapery.batch.jobs import Job, JobResult, make_job, run_job
from drapery.batch.keys import DigestCache
from drapery.batch.pool import JobLimits, ProcessPool
from drapery.batch.stores import LocalStore
from drapery.errors import DraperyError
from drapery.serve.job_queue import BusyError, JobQueue
from drapery.serve.picture_cache import PictureCache
from drapery.serve.rates import Rates
from drapery.serve.request_params import ServiceConfig, parameters, read_request

KINDS = {".png": "image/png", ".gif": "image/gif"}
CACHING = "public, max-age=86400"
REASONS = {
    304: "the picture that If-None-Match names is still the one",
    422: "the address is at fault; `detail` says why",
    429: "too many requests; Retry-After says when to ask again",
    503: "too busy, or the drawing failed for a reason of ours; ask again",
    504: "the picture takes too long to draw",
}
_DETAIL = {
    "type": "object",
    "required": ["detail"],
    "properties": {"detail": {"type": "array", "items": {"type": "string"}}},
}


class Metrics:
    """What /metrics tells."""

    def __init__(self) -> None:
        own = self.registry = CollectorRegistry()
        counted = ["path", "status"]
        self.requests = Counter("drapery_requests", "Requests.", counted, registry=own)
        self.drawn = Counter("drapery_drawn", "Pictures drawn.", registry=own)
        self.kept = Counter("drapery_kept", "Pictures drawn before.", registry=own)
        self.waiting = Gauge("drapery_waiting", "Pictures to be drawn.", registry=own)
        self.cache = Gauge("drapery_shelf_bytes", "Bytes of pictures kept.", registry=own)
        self.seconds = Histogram("drapery_draw_seconds", "Time of a drawing.", registry=own)


class Studio:
    """What the handlers share. config: packs and limits of pictures. The rest: see there."""

    def __init__(
        self,
        config: ServiceConfig,
        spawn: Callable[[], Executor],
        waiting: int,
        cache: PictureCache,
        rates: Rates,
    ) -> None:
        self.config, self.cache, self.rates = config, cache, rates
        self.meters, self.digests = Metrics(), DigestCache()
        self.queue = JobQueue(spawn, waiting, self._keep)
        # Packs are read once, at the start.
        for pack in config.base.packs:
            self.digests.of(pack)

    async def answer(self, request: Request, ending: str) -> Response:
        """A picture, or why there is none."""
        pause = self.rates.wait(request.client.host if request.client else "")
        if pause:
            return _refusal(429, ["too many requests; ask again later"], pause)
        picture = read_request(request.query_params.multi_items(), ending, self.config)
        if isinstance(picture, list):
            return _refusal(422, picture)
        try:
            job = _filed(make_job(picture, self.digests), ending)
        except DraperyError as error:
            return _refusal(503, [str(error)])
        headers = {"ETag": f'"{job.key}"', "Cache-Control": CACHING}
        if _names(request.headers.get("if-none-match", ""), job.key):
            return Response(status_code=304, headers=headers)
        kept = await run_in_threadpool(self.cache.take, job.outs[0])
        if kept is not None:
            self.meters.kept.inc()
            return Response(kept, media_type=KINDS[ending], headers=headers)
        return await self._draw(job, ending, headers)

    def _keep(self, result: JobResult) -> None:
        if result.error is None:
            self.cache.put(result.job.outs[0], result.size)
            self.meters.drawn.inc()
            self.meters.seconds.observe(result.seconds)

    async def _draw(self, job: Job, ending: str, headers: dict[str, str]) -> Response:
        try:
            answer = self.queue.ask(job, lambda: job.outs[0] in self.cache)
            if answer is not None:
                # Others may wait for the same picture, so one who leaves must not cancel it.
                fault = _fault(await asyncio.shield(asyncio.wrap_future(answer)))
                if fault is not None:
                    return fault
        except BusyError:
            return _refusal(503, ["too many pictures are waiting; ask again"], 2)
        except RuntimeError as error:
            return _refusal(503, [str(error)], 5)
        data = await run_in_threadpool(self.cache.take, job.outs[0])
        if data is None:
            return _refusal(503, ["the picture has gone; ask again"], 1)
        return Response(data, media_type=KINDS[ending], headers=headers)


def make_app(
    config: ServiceConfig | None = None,
    *,
    workers: int = 1,
    limits: JobLimits | None = None,
    rate: float = 600.0,
    cache: int = 256 << 20,
    waiting: int = 64,
) -> FastAPI:
    """The application; its processes live as long as it runs.

    workers: processes that draw. limits: of one picture's time and memory.
    rate: requests a minute of one client, 0 for any. cache: bytes of pictures kept.
    waiting: pictures that may wait to be drawn.
    """
    chosen, bounds = config or ServiceConfig(), limits or JobLimits(20.0, 1 << 30)

    @asynccontextmanager
    async def lifespan(app: FastAPI) -> AsyncIterator[None]:
        with TemporaryDirectory(prefix="drapery-serve-") as folder:
            store = LocalStore(Path(folder))
            spawn = partial(ProcessPool, partial(run_job, store=store), workers, bounds)
            studio = Studio(chosen, spawn, waiting, PictureCache(store.folder, cache), Rates(rate))
            app.state.studio = studio
            try:
                yield
            finally:
                await run_in_threadpool(studio.queue.close)

    app = FastAPI(
        title="Drapery",
        description="Pictures of Minecraft banners as cloth.",
        lifespan=lifespan,
    )
    _count_requests(app)
    _add_picture(app, ".png", "A banner as one picture.", chosen)
    _add_picture(app, ".gif", "A banner waving, as a seamless loop.", chosen)
    _add_metrics(app)
    return app


def _add_picture(app: FastAPI, ending: str, summary: str, config: ServiceConfig) -> None:
    async def handler(request: Request) -> Response:
        studio: Studio = request.app.state.studio
        return await studio.answer(request, ending)

    app.add_api_route(
        f"/banner{ending}",
        handler,
        methods=["GET"],
        summary=summary,
        response_class=Response,
        operation_id=f"banner_{ending[1:]}",
        responses=_responses(KINDS[ending]),
        openapi_extra={"parameters": parameters(ending == ".gif", config.limits)},
    )


def _responses(kind: str) -> dict[int | str, dict[str, Any]]:
    picture = {kind: {"schema": {"type": "string", "format": "binary"}}}
    on_result: dict[int | str, dict[str, Any]] = {
        200: {"description": "The picture.", "content": picture}
    }
    for status, reason in REASONS.items():
        on_result[status] = {"description": reason}
        if status != 304:
            on_result[status]["content"] = {"application/json": {"schema": _DETAIL}}
    return on_result


def _add_metrics(app: FastAPI) -> None:
    text = {"text/plain": {"schema": {"type": "string"}}}

    @app.get(
        "/metrics",
        summary="Counters for Prometheus.",
        response_class=Response,
        responses={200: {"description": "The counters.", "content": text}},
    )
    def metrics(request: Request) -> Response:
        studio: Studio = request.app.state.studio
        studio.meters.waiting.set(len(studio.queue))
        studio.meters.cache.set(studio.cache.total)
        return Response(generate_latest(studio.meters.registry), media_type=CONTENT_TYPE_LATEST)


def _count_requests(app: FastAPI) -> None:
    @app.middleware("http")
    async def count(request: Request, call_next: Callable[[Request], Any]) -> Response:
        response: Response = await call_next(request)
        known = request.url.path in ("/banner.png", "/banner.gif", "/metrics")
        path = request.url.path if known else "other"
        request.app.state.studio.meters.requests.labels(path, str(response.status_code)).inc()
        response.headers["X-Content-Type-Options"] = "nosniff"
        return response


def _filed(job: Job, ending: str) -> Job:
    """The job with its key as its file."""
    return replace(job, outs=(f"{job.key}{ending}",))


def _names(header: str, key: str) -> bool:
    """Whether an If-None-Match names the key (RFC 9110, 13.1.2)."""
    tags = (tag.strip().removeprefix("W/").strip('"') for tag in header.split(","))
    return header.strip() == "*" or key in tags


def _fault(result: JobResult) -> Response | None:
    """The refusal where a picture could not be drawn."""
    if result.error is None:
        return None
    status = 504 if "it took over" in result.error else 503 if result.retryable else 422
    return _refusal(status, [result.error])


def _refusal(status: int, reasons: list[str], pause: float = 0.0) -> JSONResponse:
    headers = {"Cache-Control": "no-store"}
    if pause:
        headers["Retry-After"] = str(max(1, math.ceil(pause)))
    return JSONResponse({"detail": reasons}, status, headers)
