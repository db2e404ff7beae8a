"""A service with a secret: it answers signed addresses alone."""

import hashlib
import hmac
import re
from collections.abc import Callable, Iterator
from urllib.parse import urlsplit

import pytest
from conftest import Run
from served_pictures import opened
from starlette.testclient import TestClient

from drapery.batch.pool import warm_up
from drapery.errors import OptionError
from drapery.serve.app import make_app
from drapery.serve.signatures import check_secret, sign_address

SECRET = "a secret of 16 or more characters"
HOST = "https://banners.example/pictures"
DRAWN = "banner.png?design=white+creeper%3Alime&size=24x32&grid=3x5"


@pytest.fixture(scope="module")
def client() -> Iterator[TestClient]:
    warm_up()
    with TestClient(make_app(workers=1, rate=0, secret=check_secret(SECRET))) as client:
        yield client


def path_of(address: str) -> str:
    """What a proxy that serves the pictures under a prefix asks the service for."""
    parts = urlsplit(address)
    return f"/{parts.path.rpartition('/')[2]}?{parts.query}"


def test_a_signed_address_is_answered(client: TestClient) -> None:
    signed = sign_address(f"{HOST}/{DRAWN}", SECRET)
    assert signed.startswith(f"{HOST}/{DRAWN}&signature=")
    assert sign_address(signed, SECRET) == signed
    # MediaWiki shows pictures of other hosts where the last part of the address is like this.
    assert re.search(r"/[A-Za-z0-9_.,~%+&;#*?!=()@-]+\.(gif|png|webp)$", signed)
    assert opened(client.get(path_of(signed))).size == (24, 32)
    name, _, query = path_of(signed).partition("?")
    turned = "&".join(reversed(query.split("&")))
    assert client.get(f"{name}?{turned}").status_code == 200, "the order does not matter"


def test_the_signature_is_one_that_any_language_can_make() -> None:
    text = b"banner.png?design=white+creeper%3Alime&grid=3x5&size=24x32"
    made = hmac.new(SECRET.encode(), text, hashlib.sha256).hexdigest()
    assert sign_address(f"/{DRAWN}", SECRET) == f"/{DRAWN}&signature={made}.png"


@pytest.mark.parametrize(
    "change",
    [
        lambda path: path.partition("&signature")[0],
        lambda path: path.replace("lime", "red"),
        lambda path: path.replace(".png", ".gif"),
        lambda path: path + "&wind=6",
        lambda path: path[:-4],
        lambda path: path + "&signature=é",
        lambda path: path.partition("&signature")[0] + "&signature=%C3%A9",
        lambda path: path_of(sign_address(path, SECRET[::-1])),
    ],
)
def test_any_other_address_is_refused_in_one_line(
    client: TestClient, change: Callable[[str], str]
) -> None:
    got = client.get(change(path_of(sign_address(f"{HOST}/{DRAWN}", SECRET))))
    assert got.status_code == 403
    assert got.json() == {"detail": ["the address is not signed; sign it with `drapery sign`"]}


def test_health_needs_no_signature(client: TestClient) -> None:
    assert client.get("/healthz").status_code == 200


def test_the_command_signs_addresses(drapery: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("DRAPERY_SECRET", SECRET)
    signed = sign_address(f"{HOST}/{DRAWN}", SECRET)
    assert drapery("sign", f"{HOST}/{DRAWN}") == (0, f"{signed}\n", "")
    code, out, told = drapery("sign", f"{HOST}/{DRAWN}", "nothing")
    assert (code, out) == (2, "")
    assert "'nothing' names no picture; write …/banner.png?design=white" in told
    monkeypatch.delenv("DRAPERY_SECRET")
    code, out, told = drapery("sign", f"{HOST}/{DRAWN}")
    assert (code, out) == (2, "") and "set DRAPERY_SECRET" in told


def test_a_short_secret_is_refused() -> None:
    with pytest.raises(OptionError, match="under 16 characters"):
        check_secret("secret")
