"""A sheet as a page of HTML that holds its pictures inside itself."""

from drapery.compare.report import data_address
from drapery.render.frame import Frame
from drapery.sheets.sheet import Sheet

_PAGE = """<!doctype html>
<html lang="en">
<meta charset="utf-8">
<meta name="viewport" content="width=device-width">
<title>{{ sheet.title }}</title>
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
<h1>{{ sheet.title }}</h1>
{% if sheet.across %}
<table>
<thead><tr><th></th>{% for head in sheet.across %}<th>{{ head }}</th>{% endfor %}</tr></thead>
{% for head in sheet.down %}<tr><th>{{ head }}</th>
{% for cell in rows[loop.index0] %}<td>{{ picture(cell) }}</td>
{% endfor %}</tr>
{% endfor %}</table>
{% else %}
<div class="list">
{% for cell in sheet.cells %}<figure><figcaption>{{ cell.label }}</figcaption>
{{ picture(cell) }}</figure>
{% endfor %}</div>
{% endif %}
</html>
"""
_PICTURE = '<img alt="{{ cell.label }}" title="{{ cell.label }}" src="{{ address(cell) }}">'


def html_page(sheet: Sheet) -> str:
    """The page as text; it needs no other file."""
    from jinja2 import Environment

    macro = "{% macro picture(cell) -%}" + _PICTURE + "{%- endmacro %}"
    template = Environment(autoescape=True).from_string(macro + _PAGE)
    rows = [
        sheet.cells[first : first + sheet.columns]
        for first in range(0, len(sheet.cells), sheet.columns)
    ]
    return template.render(
        sheet=sheet, rows=rows, address=lambda cell: data_address(Frame(cell.pixels))
    )
