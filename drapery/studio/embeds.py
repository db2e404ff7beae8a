"""What other pages need to show a design: addresses and lines of HTML."""

from dataclasses import dataclass
from html import escape
from urllib.parse import quote, urlencode

from drapery import Banner, Settings
from drapery.banner import alt_text, write_banner
from drapery.settings import NAMED_OPTIONS
from drapery.studio.share import options_of
from drapery.studio.snippets import plain
from drapery.studio.wind_heading import heading_of


@dataclass(frozen=True)
class EmbedPlaces:
    """Where the user's files and services are.

    page: a page that `drapery web` wrote. server: the address of `drapery serve`. package: the
    folder that `drapery web --component` wrote.
    """

    page: str = "banner.html"
    server: str = "http://127.0.0.1:8000"
    package: str = "dist"


def page_link(places: EmbedPlaces, banner: Banner) -> str:
    """The address of the page with the design, which needs no server."""
    return f"{places.page.partition('#')[0]}#{quote(write_banner(banner, 'shorthand'), safe=':')}"


def picture_address(places: EmbedPlaces, banner: Banner, settings: Settings) -> str:
    """The address at which `drapery serve` draws the design with these settings."""
    query = {"design": write_banner(banner, "shorthand")}
    for name, value in options_of(settings).items():
        option = NAMED_OPTIONS[name]
        if option.public and option.applies(settings.subject(banner.kind), "still"):
            pair_or_list = option.parts or option.several
            query[name] = option.to_text(value) if pair_or_list or value is True else plain(value)
    return f"{places.server.rstrip('/')}/banner.png?{urlencode(query)}"


def picture_tag(places: EmbedPlaces, banner: Banner, settings: Settings) -> str:
    """The picture as HTML."""
    width, height = settings.size
    address = escape(picture_address(places, banner, settings))
    return f'<img src="{address}" alt="{_alt(banner)}" width="{width}" height="{height}">'


def component_tag(places: EmbedPlaces, banner: Banner, settings: Settings) -> str:
    """The design as `<drapery-banner>`, and the line that loads the component."""
    attributes = {
        "design": write_banner(banner, "shorthand"),
        "kind": "wall" if settings.placement == "wall" else "standing",
        "wind": plain(round(settings.wind_speed, 1)),
        "direction": plain(round(heading_of(settings), 1)),
        "alt": alt_text(banner),
    }
    words = " ".join(f'{name}="{escape(value)}"' for name, value in attributes.items())
    module = escape(f"{places.package.rstrip('/')}/drapery-banner.js")
    return (
        f'<script type="module" src="{module}"></script>\n<drapery-banner {words}></drapery-banner>'
    )


def frame_tag(places: EmbedPlaces, banner: Banner) -> str:
    """The page within another page, as HTML."""
    return (
        f'<iframe src="{escape(page_link(places, banner))}" title="{_alt(banner)}"'
        ' width="360" height="600"></iframe>'
    )


def _alt(banner: Banner) -> str:
    return escape(alt_text(banner))
