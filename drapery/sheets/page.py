"""A sheet as a page of HTML with embedded pictures."""

from collections.abc import Sequence

from drapery.arrays import Pixels
from drapery.comparison.report import data_address
from drapery.render import Frame

_PAGE = """<!doctype html>
<html lang="en">
<meta charset="utf-8">
<meta name="viewport" content="width=device-width">
<title>{{ title }}</title>
<style>
  body { font: 14px/1.4 system-ui, sans-serif; margin: 1.5rem; color: #28282c;
         background: #f6f6f4; }
  h1 { font-size: 1.2rem; }
  img { display: block; image-rendering: pixelated;
        background: repeating-conic-gradient(#e0e0e0 0 25%, #d6d6d6 0 50%) 0 0 / 16px 16px; }
  th { font-weight: normal; text-align: left; vertical-align: top; padding: 0 .6rem 0 0; }
  thead th { position: sticky; top: 0; background: #f6f6f4; padding: .3rem 0; }
  td { padding: 0 .4rem .4rem 0; }
  .list { display: flex; flex-wrap: wrap; gap: .8rem; }
  figure { margin: 0; } figcaption { max-width: 10rem; }
</style>
<h1>{{ title }}</h1>
{% if across %}
<table>
<thead><tr><th></th>{% for head in across %}<th>{{ head }}</th>{% endfor %}</tr></thead>
{% for head in down %}<tr><th>{{ head }}</th>
{% for label, source in rows[loop.index0] %}<td>{{ picture(label, source) }}</td>
{% endfor %}</tr>
{% endfor %}</table>
{% else %}
<div class="list">
{% for label, source in pictures %}<figure><figcaption>{{ label }}</figcaption>
{{ picture(label, source) }}</figure>
{% endfor %}</div>
{% endif %}
</html>
"""
_PICTURE = '<img alt="{{ label }}" title="{{ label }}" src="{{ source }}">'


def html_page(
    title: str,
    cells: Sequence[tuple[str, Pixels]],
    columns: int,
    across: Sequence[str] = (),
    down: Sequence[str] = (),
) -> str:
    """The page as text; it needs no other file.

    cells: labels and pictures, row by row. columns, across, down: as in `PictureSheet`.
    """
    from jinja2 import Environment

    macro = "{% macro picture(label, source) -%}" + _PICTURE + "{%- endmacro %}"
    pictures = [(label, data_address(Frame(pixels))) for label, pixels in cells]
    rows = [pictures[first : first + columns] for first in range(0, len(pictures), columns)]
    template = Environment(autoescape=True).from_string(macro + _PAGE)
    return template.render(title=title, across=across, down=down, pictures=pictures, rows=rows)
