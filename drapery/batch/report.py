"""The report of a run: its numbers, the failures with their reasons, and small pictures."""

import io
from base64 import b64encode
from collections.abc import Iterable, Mapping, Sequence
from typing import Protocol

from drapery.batch.results import OutputRecord
from drapery.batch.run import Progress
from drapery.batch.stores import Store
from drapery.errors import DraperyError
from drapery.file_formats import endings_read
from drapery.picture_file import opened_picture

FILE = "report.html"
MAX_PICTURES = 240
"""The most pictures on the page."""
MAX_FAILURES = 2000
SIDE = 96

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
<table><tr><th>file</th><th>place</th><th>tries</th><th>why</th></tr>{% for record in failed %}
<tr><td>{{ record.out }}</td><td>{{ record.place }}</td><td>{{ record.tries }}</td>
<td>{{ record.error }}</td></tr>{% endfor %}</table>{% endif %}
{% if notes %}<h2>Warnings</h2><ul>{% for note in notes %}<li>{{ note }}</li>{% endfor %}</ul>
{% endif %}
<h2>Pictures{% if shown < total %}, {{ shown }} of {{ total }}{% endif %}</h2>
<div class="grid">{% for out, data in pictures %}
<figure><img alt="{{ out }}" src="{{ data }}">
<figcaption>{{ out }}</figcaption></figure>{% endfor %}
</div>
</html>
"""


class RunCounts(Protocol):
    """The counts of a run, as `Progress` and `BatchResult` have them."""

    @property
    def total(self) -> int: ...
    @property
    def drawn(self) -> int: ...
    @property
    def copied(self) -> int: ...
    @property
    def existing(self) -> int: ...
    @property
    def failed(self) -> Sequence[OutputRecord]: ...


def summary(counts: RunCounts, seconds: float) -> dict[str, str]:
    """The numbers of a run by their names. seconds: its duration [s]."""
    lines = {
        "outputs": str(counts.total),
        "drawn": str(counts.drawn),
        "copied from equals": str(counts.copied),
        "there before": str(counts.existing),
        "failed": str(len(counts.failed)),
        "time": f"{seconds:.1f} s",
    }
    if seconds > 0:
        lines["rate"] = f"{counts.drawn / seconds:.1f} pictures/s"
    return lines


def write_report(
    title: str,
    progress: Progress,
    seconds: float,
    records: Mapping[str, OutputRecord],
    store: Store,
) -> None:
    """Write the report beside the outputs. Raises OutputError."""
    from jinja2 import Environment

    done = [record.out for record in records.values() if record.state == "done"]
    pictures = list(_pictures(done, store))
    page = Environment(autoescape=True).from_string(_PAGE)
    text = page.render(
        title=title,
        numbers=summary(progress, seconds),
        failed=progress.failed[:MAX_FAILURES],
        notes=[*progress.errors, *progress.warnings],
        pictures=pictures,
        shown=len(pictures),
        total=len(done),
    )
    store.write(FILE, text.encode())


def _pictures(outs: list[str], store: Store) -> Iterable[tuple[str, str]]:
    """Small pictures, evenly chosen if there are many; videos have none."""
    step = max(1, -(-len(outs) // MAX_PICTURES))
    for out in outs[::step]:
        if out.lower().endswith(endings_read()):
            try:
                yield out, _thumbnail(store.read(out))
            except (DraperyError, OSError, ValueError):
                # A picture that was deleted meanwhile is left out of the page.
                continue


def _thumbnail(data: bytes) -> str:
    """The first frame, no larger than SIDE, as a `data:` address."""
    with opened_picture(data, "a picture", max_pixels=1 << 27) as image:
        small = image.convert("RGBA")
    small.thumbnail((SIDE, SIDE))
    buffer = io.BytesIO()
    small.save(buffer, "PNG")
    return f"data:image/png;base64,{b64encode(buffer.getvalue()).decode()}"
