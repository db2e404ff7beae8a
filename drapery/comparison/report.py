"""A page of HTML with embedded pictures."""

import base64
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path

from drapery.output_files import replacing
from drapery.render import Frame, png_bytes

_PAGE = """<!doctype html>
<html lang="en">
<meta charset="utf-8">
<meta name="viewport" content="width=device-width">
<title>{{ title }}</title>
<style>
  body { font: 15px/1.5 system-ui, sans-serif; margin: 2rem auto; max-width: 72rem;
         padding: 0 1rem; color: #28282c; background: #fdfdfb; }
  h2 { margin: 2.5rem 0 .3rem; font-size: 1.1rem; }
  img { image-rendering: pixelated; max-width: 100%; }
  table { border-collapse: collapse; } td, th { padding: .15rem .9rem .15rem 0; text-align: left; }
  .same { color: #23702e; } .different { color: #a3221c; }
</style>
<h1>{{ title }}</h1>
<p>{{ summary }}</p>
{% for entry in entries %}
<section>
<h2 class="{{ 'same' if entry.same else 'different' }}">{{ entry.name }}</h2>
<p>{{ entry.line }}</p>
{% if entry.facts %}<table>{% for key, value in entry.facts.items() %}
<tr><th>{{ key }}</th><td>{{ value }}</td></tr>{% endfor %}</table>{% endif %}
{% for label, data in entry.pictures %}<figure><img
alt="{{ label }}{% if entry.shown %}: {{ entry.shown }}{% endif %}" src="{{ data }}">
<figcaption>{{ label }}</figcaption></figure>{% endfor %}
</section>
{% endfor %}
</html>
"""


@dataclass(frozen=True)
class ReportEntry:
    """One part of a report.

    name: its heading.
    same: whether the pictures agree.
    line: the result.
    facts: numbers and words by their name.
    pictures: pairs of a label and a picture as a `data:` address.
    shown: what the pictures show, in words.
    """

    name: str
    same: bool
    line: str
    facts: Mapping[str, object] = field(default_factory=dict)
    pictures: tuple[tuple[str, str], ...] = ()
    shown: str = ""


def data_address(frame: Frame) -> str:
    """The picture as a `data:` address."""
    return data_of(png_bytes(frame.pixels), "png")


def data_of(encoded: bytes, kind: str) -> str:
    """An encoded picture as a `data:` address.

    encoded: the bytes of its file.
    kind: png, gif or webp.
    """
    return f"data:image/{kind};base64,{base64.b64encode(encoded).decode('ascii')}"


def html_report(title: str, summary: str, entries: list[ReportEntry]) -> str:
    """A report as the text of a page, which needs no other file.

    title: of the page.
    summary: the result of all entries in one line.
    entries: the parts, in this order.
    """
    from jinja2 import Environment

    template = Environment(autoescape=True).from_string(_PAGE)
    return template.render(title=title, summary=summary, entries=entries)


def write_text(path: Path, text: str) -> None:
    """Write a text file, replacing it as a whole.

    path: the file.
    text: its new content.

    Raises OutputError for a target that cannot be written.
    """
    with replacing(path) as beside:
        beside.write_text(text, encoding="utf-8")
