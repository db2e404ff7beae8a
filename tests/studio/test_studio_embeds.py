"""What other pages need: links and HTML that hold the whole design and nothing else."""

import re
from html.parser import HTMLParser
from pathlib import Path
from typing import Any
from urllib.parse import parse_qsl, unquote, urlsplit

import pytest

from drapery import Banner, Settings
from drapery.serve.request_params import ServiceConfig, read_request
from drapery.studio.embeds import (
    EmbedPlaces,
    component_tag,
    frame_tag,
    page_link,
    picture_address,
    picture_tag,
)

BANNER = Banner.parse("red creeper:lime acme:odd:white")
PLACES = EmbedPlaces("https://a.example/b.html#old", 'https://c.example/"><b>', "my/dist/")


class Elements(HTMLParser):
    """The elements of a text with their attributes."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.found: list[tuple[str, dict[str, str | None]]] = []
        self.feed(text)

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.found.append((tag, dict(attrs)))


def test_a_link_without_a_server_holds_the_design_after_the_hash() -> None:
    link = page_link(PLACES, BANNER)
    assert link.startswith("https://a.example/b.html#") and not re.search(r'[\s"<>]', link)
    assert Banner.parse(unquote(urlsplit(link).fragment)) == BANNER


def test_the_service_understands_the_address_of_a_picture(tmp_path: Path) -> None:
    files = (tmp_path / "mine.zip",)
    settings = Settings(files, size=(64, 96), view="iso", shadow=True, wind=2.5, time=1.0)
    address = picture_address(EmbedPlaces(), BANNER, settings)
    assert address.startswith("http://127.0.0.1:8000/banner.png?design=red+creeper")
    request = read_request(parse_qsl(urlsplit(address).query), ".png", ServiceConfig(), "banner")
    assert not isinstance(request, list), request
    drawn = request.settings
    assert (drawn.size, drawn.view, drawn.wind, drawn.time) == ((64, 96), "iso", 2.5, 1.0)
    assert drawn.packs == ()


@pytest.mark.parametrize(
    "options", [{"turntable": True}, {"pose": "vanilla", "seed": 7}, {"placement": "item"}], ids=str
)
def test_the_address_of_a_picture_leaves_out_what_does_nothing(options: dict[str, Any]) -> None:
    address = picture_address(EmbedPlaces(), BANNER, Settings(wind=9.0, **options))
    request = read_request(parse_qsl(urlsplit(address).query), ".png", ServiceConfig(), "banner")
    assert not isinstance(request, list), request


@pytest.mark.parametrize("wind", [0.0, 4.0])
def test_no_address_leaves_its_attribute(wind: float) -> None:
    settings = Settings(wind=wind, size=(64, 96))
    (tag, image), *more = Elements(picture_tag(PLACES, BANNER, settings)).found
    assert tag == "img" and not more
    assert image["src"] == picture_address(PLACES, BANNER, settings)
    (tag, frame), *more = Elements(frame_tag(PLACES, BANNER)).found
    assert tag == "iframe" and not more and frame["src"] == page_link(PLACES, BANNER)
    (_, script), (tag, banner) = Elements(component_tag(PLACES, BANNER, settings)).found
    assert script["src"] == "my/dist/drapery-banner.js" and tag == "drapery-banner"
    assert Banner.parse(str(banner["design"])) == BANNER
    assert float(str(banner["wind"])) == wind
