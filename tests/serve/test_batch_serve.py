"""The service: the pictures that `draw` draws, each drawn once; a reason for every refusal."""

import shutil
import time
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from urllib.parse import quote

import numpy as np
import pytest
from cost import limited_cost
from hypothesis import given, strategies as st
from pack_maker import CREEPER, make_pack, plain
from served_pictures import opened, pixels_of
from starlette.testclient import TestClient

from drapery import Banner, animate, draw
from drapery.batch.manifest import PictureRequest
from drapery.batch.pool import JobLimits, warm_up
from drapery.comparison import read_picture
from drapery.errors import OptionError
from drapery.file_formats import FileFormat, formats_of
from drapery.garments import find_garment
from drapery.serve.app import SERVED, make_app
from drapery.serve.picture_cache import PictureCache
from drapery.serve.rates import MAX_CLIENTS, RateLimiter
from drapery.serve.request_params import (
    MAX_PARAMETERS,
    MAX_QUERY,
    MAX_REASONS,
    ServiceConfig,
    parse_query,
    read_request,
)
from drapery.settings import Settings

SMALL = "size=24x32&grid=3x5"
LIME = "white+creeper:lime"


@pytest.fixture(scope="module")
def client() -> Iterator[TestClient]:
    warm_up()  # as the command does, so that no picture waits for a compiler,
    for view in ("front", "hero"):  # nor these, whose small grid has kernels of its own
        draw(Banner(), size=(24, 32), grid=(3, 5), view=view)
    with TestClient(make_app(workers=1, limits=JobLimits(20.0, 1 << 30), rate=0)) as client:
        yield client


def test_a_picture_is_what_draw_draws(client: TestClient) -> None:
    got = client.get(f"/banner.png?design={LIME}&{SMALL}&wind=6&view=hero")
    banner = Banner.parse("white creeper:lime")
    drawn = draw(banner, size=(24, 32), grid=(3, 5), wind=6, view="hero")
    assert np.array_equal(pixels_of(got), drawn.pixels)


def test_a_loop_has_its_frames(client: TestClient) -> None:
    got = client.get(f"/banner.gif?design=red&{SMALL}&seconds=0.3&fps=10")
    drawn = animate(Banner("red"), size=(24, 32), grid=(3, 5), seconds=0.3, fps=10)
    with opened(got, "gif") as image:
        assert image.n_frames == len(drawn) == 3


def test_the_deadline_includes_the_time_of_reading(monkeypatch: pytest.MonkeyPatch) -> None:
    def slow(*args: object) -> object:
        time.sleep(1.1)
        return read_request(*args)  # type: ignore[arg-type]

    with TestClient(make_app(rate=0, deadline=1)) as client:
        while client.get(f"/banner.png?design=red&{SMALL}").status_code != 200:
            time.sleep(0.02)
        monkeypatch.setattr("drapery.serve.app.read_request", slow)
        assert client.get(f"/banner.png?design=blue&{SMALL}").status_code == 504


def test_a_garment_is_what_draw_draws(client: TestClient) -> None:
    got = client.get("/garment.png?name=pennon&design=red&size=24x32&time=0.1")
    pennon = find_garment("pennon").with_design("red")
    drawn = draw(pennon, size=(24, 32), time=0.1)  # the file's own view and wind
    assert np.array_equal(pixels_of(got), drawn.pixels)


@pytest.mark.parametrize(
    ("query", "reason"),
    [
        ("", "name is missing; use one of: awning"),
        ("name=toga", "name 'toga' is not a garment; use one of: awning"),
        ("name=../mine.toml", "is not a garment"),
        ("name=flag&design=wite", "did you mean 'white'"),
        ("name=flag&grid=5x9", "'grid' is not an option"),
        ("name=flag&texture=/tmp/x.png", "'texture' is not an option"),
        ("name=flag&time=99", "0 to 60"),
    ],
)
def test_a_bad_address_of_a_garment_is_refused(client: TestClient, query: str, reason: str) -> None:
    got = client.get(f"/garment.png?{query}")
    assert got.status_code == 422
    assert reason in "; ".join(got.json()["detail"])


def test_the_etag_is_the_key_so_nothing_is_drawn_twice(client: TestClient) -> None:
    first = client.get(f"/banner.png?design=blue&{SMALL}")
    again = client.get(f"/banner.png?{SMALL}&design=" + quote("/give @p blue_banner"))
    assert first.headers["etag"] == again.headers["etag"]
    assert first.content == again.content
    assert "max-age" in first.headers["cache-control"]
    tags = {"If-None-Match": f'"other", W/{first.headers["etag"]}'}
    same = client.get(f"/banner.png?design=blue&{SMALL}", headers=tags)
    assert (same.status_code, same.content) == (304, b"")
    assert "drapery_cache_hits_total" in client.get("/metrics").text


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
    "design=red&pack=/tmp": "'pack' is not an option",
    "design=red&packs=/tmp": "'packs' is not an option",
    "design=red&texture=/tmp/x.png": "'texture' is not an option",
    "design=red&backend=pyrender": "'backend' is not an option",
    "design=red&kind=cape": "which an address cannot name",
    "design=red&design=blue": "given twice",
    "design=red&seconds=3": "'seconds' is not an option",
    "design=red&facing=east": "facing east applies only to banners on a wall",
}


@pytest.mark.parametrize("query", BAD)
def test_a_bad_address_is_refused_with_its_reason(client: TestClient, query: str) -> None:
    got = client.get(f"/banner.png?{query}")
    assert got.status_code == 422
    assert BAD[query] in "; ".join(got.json()["detail"])
    assert all("\n" not in reason for reason in got.json()["detail"])


@pytest.mark.parametrize("format", SERVED, ids=lambda each: each.name)
def test_each_format_is_served(client: TestClient, format: FileFormat, tmp_path: Path) -> None:
    kinds = dict.fromkeys((format.kind(timed=False), format.kind()))
    for kind in kinds:
        times = "&seconds=0.2&fps=10" if kind == "loop" else ""
        got = client.get(f"/banner{format.ending}?design=red&{SMALL}{times}")
        assert (got.status_code, got.headers["content-type"]) == (200, format.media_type), got.text
        (tmp_path / f"a{format.ending}").write_bytes(got.content)
        frames = read_picture(tmp_path / f"a{format.ending}").frames
        assert len(frames) == (2 if kind == "loop" else 1)
    if "loop" not in kinds:
        assert client.get(f"/banner{format.ending}?design=red&seconds=1").status_code == 422


def test_loops_have_limits_of_their_own(client: TestClient) -> None:
    for query in ("seconds=11", "fps=31", "seconds=x", "seconds=nan", "size=1024x1024&seconds=9"):
        assert client.get(f"/banner.gif?design=red&{query}").status_code == 422


def test_the_api_describes_itself(client: TestClient) -> None:
    api = client.get("/openapi.json").json()
    pictures = {
        f"/{name}{each.ending}"
        for name in ("banner", "garment", "player")
        for each in formats_of("still", "loop")
        if each.single and not each.extra
    }
    assert set(api["paths"]) == pictures | {"/metrics", "/healthz", "/readyz"}
    taken = {p["name"] for p in api["paths"]["/garment.png"]["get"]["parameters"]}
    assert {"name", "design", "wind"} <= taken and not {"grid", "kind"} & taken
    named = {p["name"] for p in api["paths"]["/banner.gif"]["get"]["parameters"]}
    assert {"design", "size", "pose", "seconds"} <= named
    for page in ("/docs", "/redoc"):  # they would load scripts of another site
        assert client.get(page).status_code == 404
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
    assert len(client.app.state.service.queue) == 0


def _drawn(client: TestClient) -> float:
    lines = client.get("/metrics").text.splitlines()
    return next(float(line.split()[1]) for line in lines if line.startswith("drapery_drawn_total"))


@pytest.mark.parametrize(
    "query",
    [
        "&".join(f"wnid{n}=1" for n in range(MAX_PARAMETERS)),
        "&".join(f"{n:x}" for n in range(6_000)),
        "&".join(["design=red"] * MAX_PARAMETERS),
        "design=" + "%F0%9F%8F%B4" * 2000,
        "wnid" * 8000 + "=1",
        "=" * 30_000,
        "&" * 30_000,
        "design=red&seed=" + "9" * 310,
        "design=red&rotation=" + "9" * 310,
        "design=red&seed=" + "9" * 20_000,
        "x" * 60_000,
    ],
    ids=range(11),
)
def test_a_long_query_costs_little_and_is_answered_briefly(client: TestClient, query: str) -> None:
    with limited_cost():
        got = client.get(f"/banner.png?{query}")
    assert got.status_code in (414, 422)
    assert len(got.content) < 4096
    assert 1 <= len(got.json()["detail"]) <= MAX_REASONS


def test_a_query_has_a_longest_length_and_a_most_parameters() -> None:
    assert len(parse_query(b"a" * MAX_QUERY)) == 1
    with pytest.raises(OptionError, match="32768 bytes"):
        parse_query(b"a" * (MAX_QUERY + 1))
    assert len(parse_query(b"&".join([b"a"] * MAX_PARAMETERS))) == MAX_PARAMETERS
    with pytest.raises(OptionError, match="over 64 parameters"):
        parse_query(b"&".join([b"a"] * (MAX_PARAMETERS + 1)))


def test_the_service_says_that_it_is_alive_and_ready(client: TestClient) -> None:
    client.get(f"/banner.png?design=red&{SMALL}")
    assert client.get("/healthz").status_code == 200
    assert client.get("/readyz").status_code == 200
    assert "drapery_ready 1.0" in client.get("/metrics").text


@pytest.mark.filterwarnings("ignore:not in .* taken from our own art")
def test_a_pack_that_changes_is_not_drawn_under_its_old_etag(tmp_path: Path) -> None:
    pack = make_pack(tmp_path / "pack")
    config = ServiceConfig(Settings(packs=(pack,), size=(24, 32)))
    red, blue = (f"/banner.png?design={base}+creeper:lime&{SMALL}" for base in ("red", "blue"))
    with TestClient(make_app(config, rate=0)) as client:
        before = client.get(blue)
        (pack / CREEPER).write_bytes(plain(9, 9, 9, 255))
        after = client.get(red)
    again = make_pack(tmp_path / "again")
    assert (before.status_code, after.status_code) == (200, 200)
    assert before.content == drawn_with(again, "blue")
    assert after.content == drawn_with(again, "red") != drawn_with(pack, "red")


def drawn_with(pack: Path, base: str) -> bytes:
    path = pack.with_suffix(".png")
    banner = Banner.parse(f"{base} creeper:lime")
    draw(banner, packs=[pack], size=(24, 32), grid=(3, 5)).save(path)
    return path.read_bytes()


def test_no_answer_names_a_folder_of_the_service(tmp_path: Path) -> None:
    pack = make_pack(tmp_path / "pack")
    with TestClient(make_app(ServiceConfig(Settings(packs=(pack,))), rate=0)) as client:
        service = client.app.state.service
        shutil.rmtree(service.config.base.packs[0])
        got = client.get(f"/banner.png?design=red+creeper:lime&{SMALL}")
    assert got.status_code == 503
    assert got.json()["detail"] == ["the service could not draw the picture; ask again"]


NAMES = st.sampled_from(["design", "size", "wind", "seed", "x", "time", "rotation"])


@given(st.lists(st.tuples(NAMES, st.text(max_size=12)), max_size=5))
def test_any_query_is_a_request_or_reasons(query: list[tuple[str, str]]) -> None:
    read = read_request(query, ".png", ServiceConfig())
    assert isinstance(read, PictureRequest) or (
        read and all(isinstance(line, str) for line in read)
    )


def test_a_cache_holds_what_was_used_last() -> None:
    cache = PictureCache(25)
    for name in "abc":
        cache.put(name, name.encode() * 10)
        cache.get("a")
    assert (cache.get("b"), cache.get("a"), cache.size) == (None, b"a" * 10, 20)
    cache.put("large", b"x" * 26)
    assert (cache.get("large"), cache.size) == (None, 20)


def test_a_rate_lets_a_burst_pass_and_then_one_at_a_time() -> None:
    now = [0.0]
    rates = RateLimiter(60, burst=3, clock=lambda: now[0])
    assert [rates.wait("a") for _ in range(4)] == [0, 0, 0, 1.0]
    assert rates.wait("b") == 0
    now[0] += 1.0
    assert [rates.wait("a"), rates.wait("a")] == [0, 1.0]
    assert RateLimiter(0).wait("a") == 0


def test_a_flood_of_clients_takes_bounded_memory() -> None:
    rates = RateLimiter(60, burst=1, clock=lambda: 0.0)
    assert [rates.wait("first"), rates.wait("first")] == [0, 1.0]
    for number in range(MAX_CLIENTS):
        rates.wait(str(number))
    assert rates.wait("first") == 0, "it is forgotten"


def test_too_many_requests_get_the_time_to_ask_again() -> None:
    with TestClient(make_app(rate=1)) as client:
        codes = [client.get("/banner.png?design=wite").status_code for _ in range(21)]
        late = client.get("/banner.png?design=red")
    assert codes == [422] * 20 + [429]
    assert 0 < int(late.headers["retry-after"]) <= 60


@pytest.mark.parametrize("ending", [".gif", ".apng", ".webp"])
def test_a_turntable_is_served_in_each_format_of_a_loop(ending: str) -> None:
    query = [("design", "white"), ("turntable", "yes"), ("seconds", "1"), ("fps", "10")]
    read = read_request(query, ending, ServiceConfig())
    assert not isinstance(read, list), read
    assert read.settings.turntable and read.seconds == 1


@pytest.mark.parametrize("ending", [".png", ".webp"])
def test_a_still_has_no_turntable(ending: str) -> None:
    read = read_request([("design", "white"), ("turntable", "yes")], ending, ServiceConfig())
    assert read == ["turntable does nothing for a still picture; leave it out"]
