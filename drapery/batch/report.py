"""The page at the end of a run: its numbers, what failed and why, and small pictures."""

import io
from collections.abc import Iterable, Mapping
from pathlib import Path

from drapery.batch.results import OutputRecord
from drapery.batch.run import Progress
from drapery.batch.stores import Store
from drapery.errors import DraperyError

FILE = "report.html"
MAX_PICTURES = 240
"""Of a million pictures a page can show a few."""
MAX_FAILURES = 2000
SIDE = 96
MAX_BYTES = 64 << 20

_PAGE = """<!doctype html>
<html lang="en">
<meta charset="utf-8">
<meta name="viewport" content="width=device-width">
<title>{{ title }}</title>
<style>
  body { font: 15px/1.5 system-ui, sans-serif; margin: 2rem auto; max-width: 72rem;
         padding: 0 1rem; color: #28282c; background: #fdfdfb; }
  table { border-collapse: collapse; }
  td, th { padding: .15rem .9rem .15rem 0; text-align: left; vertical-align: top; }
  .failed { color: #a3221c; }
  .grid { display: grid; grid-template-columns: repeat(auto-fill, minmax(7rem, 1fr)); gap: 1rem; }
  figure { margin: 0; text-align: center; } figcaption { font-size: .75rem;
         overflow-wrap: anywhere; }
  img { max-width: 100%; image-rendering: pixelated; }
</style>
<h1>{{ title }}</h1>
<table>{% for name, value in numbers.items() %}
<tr><th>{{ name }}</th><td>{{ value }}</td></tr>{% endfor %}</table>
{% if failed %}<h2 class="failed">Failed</h2>
<table><tr><th>file</th><th>place</th><th>tries</th><th>why</th></tr>{% for entry in failed %}
<tr><td>{{ entry.out }}</td><td>{{ entry.place }}</td><td>{{ entry.tries }}</td>
<td>{{ entry.why }}</td></tr>{% endfor %}</table>{% endif %}
{% if notes %}<h2>Warnings</h2><ul>{% for note in notes %}<li>{{ note }}</li>{% endfor %}</ul>
{% endif %}
<h2>Pictures{% if shown < total %}, {{ shown }} of {{ total }}{% endif %}</h2>
<div class="grid">{% for out, data in pictures %}
<figure><img alt="" src="{{ data }}"><figcaption>{{ out }}</figcaption></figure>{% endfor %}
</div>
</html>
"""


def numbers(progress: Progress, seconds: float) -> dict[str, str]:
    """The summary of a run, as names and values. seconds: that it took."""
    rate = f"{progress.drawn / seconds:.1f} pictures/s" if seconds > 0 else ""
    said = {
        "outputs": str(progress.total),
        "drawn": str(progress.drawn),
        "copied from equals": str(progress.copied),
        "there before": str(progress.kept),
        "failed": str(len(progress.failed)),
        "time": f"{seconds:.1f} s",
        "rate": rate,
    }
    return {name: value for name, value in said.items() if value}


def write_page(
    title: str,
    progress: Progress,
    seconds: float,
    entries: Mapping[str, OutputRecord],
    store: Store,
) -> None:
    """Write the page beside the outputs. Raises OutputError."""
    from jinja2 import Environment

    done = [entry.out for entry in entries.values() if entry.state == "done"]
    pictures = list(_pictures(done, store))
    page = Environment(autoescape=True).from_string(_PAGE)
    text = page.render(
        title=title,
        numbers=numbers(progress, seconds),
        failed=progress.failed[:MAX_FAILURES],
        notes=list(progress.notes),
        pictures=pictures,
        shown=len(pictures),
        total=len(done),
    )
    store.write(FILE, text.encode())


def _pictures(outs: list[str], store: Store) -> Iterable[tuple[str, str]]:
    """Small pictures, evenly chosen where there are many; videos have none."""
    step = max(1, -(-len(outs) // MAX_PICTURES))
    for out in outs[::step]:
        if Path(out).suffix.lower() in (".png", ".apng", ".gif", ".webp"):
            try:
                yield out, _thumbnail(store.read(out))
            except (DraperyError, OSError, ValueError):
                # A picture that has gone since is only missing on the page.
                continue


def _thumbnail(data: bytes) -> str:
    """The first frame, no larger than SIDE, as a `data:` address."""
    from PIL import Image

    from drapery.compare.report import data_of

    with Image.open(io.BytesIO(data)) as image:
        small = image.convert("RGBA")
    small.thumbnail((SIDE, SIDE))
    buffer = io.BytesIO()
    small.save(buffer, "PNG")
    return data_of(buffer.getvalue(), "png")
