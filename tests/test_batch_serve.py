"""The service: the pictures that `draw` draws, each drawn once; a reason for every refusal."""

import threading
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from urllib.parse import quote

import numpy as np
import pytest
from batch_works import job
from hypothesis import given
from hypothesis import strategies as st
from PIL import Image
from starlette.testclient import TestClient

from drapery import Banner, animate, draw
from drapery.batch.jobs import Job, JobResult
from drapery.batch.manifest import PictureRequest
from drapery.batch.pool import JobLimits
from drapery.batch.warmup import warm_up
from drapery.serve.app import make_app
from drapery.serve.job_queue import BusyError, JobQueue
from drapery.serve.picture_cache import PictureCache
from drapery.serve.rates import Rates
from drapery.serve.request_params import ServiceConfig, read_request

SMALL = "size=24x32&grid=3x5"
LIME = "white+creeper:lime"


@pytest.fixture(scope="module")
def client() -> Iterator[TestClient]:
    warm_up()  # as the command does, so that no picture waits for a compiler
    with TestClient(make_app(workers=1, limits=JobLimits(20.0, 1 << 30), rate=0)) as client:
        yield client


def pixels(data: bytes) -> np.ndarray:
    import io

    with Image.open(io.BytesIO(data)) as image:
        return np.asarray(image.convert("RGBA"))


def test_a_picture_is_what_draw_draws(client: TestClient) -> None:
    got = client.get(f"/banner.png?design={LIME}&{SMALL}&wind=6&view=hero")
    assert (got.status_code, got.headers["content-type"]) == (200, "image/png")
    banner = Banner.parse("white creeper:lime")
    drawn = draw(banner, size=(24, 32), grid=(3, 5), wind=6, view="hero")
    assert np.array_equal(pixels(got.content), drawn.pixels)


def test_a_loop_has_its_frames(client: TestClient) -> None:
    import io

    got = client.get(f"/banner.gif?design=red&{SMALL}&seconds=0.3&fps=10")
    assert (got.status_code, got.headers["content-type"]) == (200, "image/gif")
    drawn = animate(Banner("red"), size=(24, 32), grid=(3, 5), seconds=0.3, fps=10)
    with Image.open(io.BytesIO(got.content)) as image:
        assert image.n_frames == len(drawn) == 3


def test_the_etag_is_the_key_so_nothing_is_drawn_twice(client: TestClient) -> None:
    first = client.get(f"/banner.png?design=blue&{SMALL}")
    again = client.get(f"/banner.png?{SMALL}&design=" + quote("/give @p blue_banner"))
    assert first.headers["etag"] == again.headers["etag"]
    assert first.content == again.content
    assert "max-age" in first.headers["cache-control"]
    tags = {"If-None-Match": f'"other", W/{first.headers["etag"]}'}
    same = client.get(f"/banner.png?design=blue&{SMALL}", headers=tags)
    assert (same.status_code, same.content) == (304, b"")
    assert "drapery_kept_total" in client.get("/metrics").text


BAD = {
    "": "design is missing",
    "design=": "design is missing",
    "design=wite": "did you mean 'white'",
    "design=/etc/passwd": "",
    "design=-": "",
    "design=red&size=9": "two whole numbers",
    "design=red&size=4000x4000": "1 to 1024 pixels",
    "design=red&size=0x5": "size (width) 0",
    "design=red&wind=nan": "wind",
    "design=red&grid=99x99": "2 to 33",
    "design=red&time=3600": "0 to 60",
    "design=red&view=up": "view 'up' is not known",
    "design=red&pack=/tmp": "'pack' is no option",
    "design=red&packs=/tmp": "'packs' is no option",
    "design=red&texture=/tmp/x.png": "'texture' is no option",
    "design=red&backend=pyrender": "'backend' is no option",
    "design=red&kind=cape": "wears a file",
    "design=red&design=blue": "given twice",
    "design=red&seconds=3": "'seconds' is no option",
    "design=red&facing=east": "facing east is of banners on a wall",
}


@pytest.mark.parametrize("query", BAD)
def test_a_bad_address_is_refused_with_its_reason(client: TestClient, query: str) -> None:
    got = client.get(f"/banner.png?{query}")
    assert got.status_code == 422
    assert BAD[query] in "; ".join(got.json()["detail"])
    assert all("\n" not in reason for reason in got.json()["detail"])


def test_loops_have_limits_of_their_own(client: TestClient) -> None:
    for query in ("seconds=11", "fps=31", "seconds=x", "seconds=nan", "size=1024x1024&seconds=9"):
        assert client.get(f"/banner.gif?design=red&{query}").status_code == 422


def test_the_api_describes_itself(client: TestClient) -> None:
    api = client.get("/openapi.json").json()
    assert set(api["paths"]) == {"/banner.png", "/banner.gif", "/metrics"}
    named = {p["name"] for p in api["paths"]["/banner.gif"]["get"]["parameters"]}
    assert {"design", "size", "pose", "seconds"} <= named
    assert client.get("/docs").status_code == 200
    assert client.post("/banner.png").status_code == 405
    assert client.get("/other").status_code == 404


def test_many_clients_at_once_share_what_is_drawn(client: TestClient) -> None:
    before = _drawn(client)
    dyes = ("white", "red", "lime")
    addresses = [f"/banner.png?design={dyes[n % 3]}+border:black&{SMALL}" for n in range(60)]
    with ThreadPoolExecutor(20) as threads:
        answers = list(threads.map(client.get, addresses))
    assert {answer.status_code for answer in answers} == {200}
    assert len({answer.content for answer in answers}) == 3
    assert _drawn(client) - before == 3
    assert len(client.app.state.studio.queue) == 0


def _drawn(client: TestClient) -> float:
    lines = client.get("/metrics").text.splitlines()
    return next(float(line.split()[1]) for line in lines if line.startswith("drapery_drawn_total"))


NAMES = st.sampled_from(["design", "size", "wind", "seed", "x", "time", "rotation"])


@given(st.lists(st.tuples(NAMES, st.text(max_size=12)), max_size=5))
def test_any_query_is_a_request_or_reasons(query: list[tuple[str, str]]) -> None:
    read = read_request(query, ".png", ServiceConfig())
    assert isinstance(read, PictureRequest) or (
        read and all(isinstance(line, str) for line in read)
    )


class Slow:
    """A executor that ends its jobs when it is on_result to."""

    def __init__(self) -> None:
        self.may_end, self.began, self.running = threading.Event(), [], []

    def free(self) -> int:
        return 2 - len(self.running)

    def start(self, one: Job) -> None:
        self.began.append(one.key)
        self.running.append(one)

    def poll(self, timeout: float) -> list[JobResult]:
        self.may_end.wait(timeout)
        if not self.may_end.is_set():
            return []
        ended, self.running = self.running, []
        return [JobResult(one) for one in ended]

    def close(self) -> None:
        pass


def test_a_desk_draws_equal_jobs_once_and_says_when_it_is_full() -> None:
    executor = Slow()
    queue = JobQueue(lambda: executor, most=2)
    try:
        first = queue.ask(job("a"))
        assert queue.ask(job("a")) is first
        others = []
        with pytest.raises(BusyError):
            for number in range(10):
                others.append(queue.ask(job(str(number))))
        executor.may_end.set()
        keys = [answer.result(5).job.key for answer in (first, *others) if answer]
        assert sorted(executor.began) == sorted(keys)
        assert len(set(keys)) == len(keys)
    finally:
        queue.close()
    assert len(queue) == 0


def test_a_shelf_keeps_what_was_used_last(tmp_path: Path) -> None:
    cache = PictureCache(tmp_path, most=25)
    for name in "abc":
        (tmp_path / name).write_bytes(name.encode() * 10)
        cache.put(name, 10)
        cache.take("a")
    assert (cache.take("b"), cache.take("a"), cache.total) == (None, b"a" * 10, 20)
    assert sorted(path.name for path in tmp_path.iterdir()) == ["a", "c"]
    (tmp_path / "a").unlink()
    assert (cache.take("a"), cache.total) == (None, 10)


def test_a_rate_lets_a_burst_pass_and_then_one_at_a_time() -> None:
    now = [0.0]
    rates = Rates(60, burst=3, clock=lambda: now[0])
    assert [rates.wait("a") for _ in range(4)] == [0, 0, 0, 1.0]
    assert rates.wait("b") == 0
    now[0] += 1.0
    assert [rates.wait("a"), rates.wait("a")] == [0, 1.0]
    assert Rates(0).wait("a") == 0


def test_too_many_requests_are_told_when_to_come_again() -> None:
    with TestClient(make_app(rate=1)) as client:
        codes = [client.get("/banner.png?design=wite").status_code for _ in range(21)]
        late = client.get("/banner.png?design=red")
    assert codes == [422] * 20 + [429]
    assert 0 < int(late.headers["retry-after"]) <= 60
